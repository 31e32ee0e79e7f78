// SPDX-License-Identifier: MIT
#include "standing.hpp"

#include "muro/simd/rows.hpp"

namespace muro::penalty {
namespace {

using namespace lane;
using namespace law;

/// Friction springs of a group in the step before: n of them, or as many as a robot may have.
template <class S, int n>
struct Springs {
  V3<S> at[n], stretch[n];

  MURO_INLINE void load(int k, const Places<S>& grips, int grip) {
    S g[grip_numbers];
    load_rows(grips, grip * grip_stride, g);
    at[k] = {g[0], g[1], g[2]};
    stretch[k] = {g[3], g[4], g[5]};
  }
  /// The stretch of the nearest of the first `count`.
  MURO_INLINE V3<S> nearest(const V3<S>& point, int count) const {
    V3<S> found = stretch[0];
    if (count == 1) return found;
    V3<S> away = at[0] - point;
    S least = dot(away, away);
    for (int k = 1; k < count; ++k) {
      away = at[k] - point;
      const S distance = dot(away, away);
      const auto nearer = distance < least;
      least = select(nearer, distance, least);
      found = select(nearer, stretch[k], found);
    }
    return found;
  }
};

/// The contacts of as many robots as S has values. `one_patch`: of which all are part. What one pass over the contacts
/// finds is kept for the next: so the steps of a pass do not wait for each other.
template <class S, bool one_patch>
class Push {
 public:
  /// Where there are fewer than S has values, the first stands in.
  MURO_INLINE Push(const StandingWork& work, const StandingRobot* const* robots, int count)
      : work_(work), layout_(*work.layout), count_(count) {
    for (int i = 0; i < count_of<S>; ++i) {
      const StandingRobot& r = *robots[i < count ? i : 0];
      contacts_.at[i] = r.contacts, before_.at[i] = r.before;
      grips_.at[i] = r.grips, wrench_.at[i] = r.wrench;
      poses_[0].at[i] = r.base_pose, poses_[1].at[i] = r.link_pose;
      twists_[0].at[i] = r.base_twist, twists_[1].at[i] = r.link_twist;
    }
    const PoseOf<S> pose = load_pose(poses_[0]);
    body_ = mobility_of(*work.mass, pose);
    base_ = pose.position;
  }

  /// Returns a bit for each robot that is not served.
  MURO_INLINE unsigned run() {
    const unsigned served = load_contacts() & first_lanes(count_);
    const S load = share();
    move_contacts();
    add_forces(load, served);
    return ~served & first_lanes(count_);
  }

 private:
  struct Point {
    V3<S> at, normal;
    S depth, friction;
    S approach;     ///< m/s
    V3<S> slip;     ///< m/s
    V3<S> stretch;  ///< m, of the friction spring
  };
  /// Contacts `begin` to `end` - 1 and their springs of the step before.
  struct Group {
    int number, begin, end, springs_begin, springs_end;
  };

  MURO_INLINE int patch_of(int contact) const { return one_patch ? 0 : work_.patch_of[contact]; }

  /// Returns a bit for each robot whose contacts make the patches that `work` says.
  MURO_INLINE unsigned load_contacts() {
    auto one = S(1) == S(1);
    for (int k = 0; k < layout_.contacts; ++k) {
      S c[contact_numbers];
      load_rows(contacts_, k * contact_stride, c);
      Point& p = points_[k];
      p.at = {c[0], c[1], c[2]}, p.normal = {c[3], c[4], c[5]};
      p.depth = c[6], p.friction = c[7];
      one = one & (dot(points_[0].normal, p.normal) > S(same_direction));
    }
    return one_patch ? bits(one) : all_lanes<S>;
  }

  /// Shares the effective mass of each patch among its points. Returns the load of the robot.
  MURO_INLINE S share() {
    Resistance<S> all;
    for (int p = 0; p < (one_patch ? 1 : work_.patches); ++p) {
      int first = 0;
      while (patch_of(first) != p) ++first;
      Patch<S> patch(points_[first].normal, body_.centre);
      for (int k = first; k < layout_.contacts; ++k)
        if (patch_of(k) == p) patch.add(points_[k].at);
      shares_[p] = Share<S>(patch.at_middle(body_), patch.count);
      all += patch.resistance(shares_[p].along, shares_[p].across);
    }
    return all.greatest(body_);
  }

  /// Velocities in the points, and their springs.
  MURO_INLINE void move_contacts() {
    Group group{};
    for (; group.number < layout_.groups; ++group.number) {
      group.end = layout_.ends[group.number];
      group.springs_end = work_.springs_ends[group.number];
      const int springs = group.springs_end - group.springs_begin;
      if (springs == 1)  // as wheels that are balls and feet have them
        move_group<1>(group);
      else if (springs == 2)  // as wheels that are cylinders and tracks
        move_group<2>(group);
      else
        move_any_group(group);
      group.begin = group.end;
      group.springs_begin = group.springs_end;
    }
  }
  [[gnu::noinline]] void move_any_group(const Group& group) { move_group<most_contacts>(group); }
  /// A group that has n springs, or any number of them.
  template <int n>
  MURO_INLINE void move_group(const Group& group) {
    const BodyPlace& body = layout_.bodies[group.number];
    const V3<S> origin = load_vector(poses_[body.of_link], body.pose);
    const TwistOf<S> motion = load_twist(twists_[body.of_link], body.twist);
    const int springs = n < most_contacts ? n : group.springs_end - group.springs_begin;
    Springs<S, n> before;
    for (int k = 0; k < springs; ++k) before.load(k, before_, group.springs_begin + k);
    const S zero(0), elapsed(work_.elapsed);
    for (int k = group.begin; k < group.end; ++k) {
      Point& p = points_[k];
      const V3<S> velocity = motion.linear + cross(motion.angular, p.at - origin);
      p.approach = -dot(velocity, p.normal);
      p.slip = velocity + p.approach * p.normal;
      const V3<S> stretch = (springs > 0 ? before.nearest(p.at, springs) : V3<S>{zero, zero, zero}) + p.slip * elapsed;
      p.stretch = stretch - p.normal * dot(p.normal, stretch);
    }
  }

  MURO_INLINE void add_forces(S load, unsigned served) {
    V3<S> force{S(0), S(0), S(0)}, torque = force;
    const FrictionLaw<S> friction(work_.stiffness, load);
    NormalLaw<S> law(work_.stiffness, layout_.zeta[0], load);
    for (int group = 0, k = 0; group < layout_.groups; ++group) {
      if (layout_.zeta[group] != law.zeta) law = {work_.stiffness, layout_.zeta[group], load};
      for (; k < layout_.ends[group]; ++k) {
        const Point& p = points_[k];
        const Share<S>& share = shares_[patch_of(k)];
        V3<S> stretch = p.stretch;
        const S normal = share.along * law.force(p.depth, p.approach);
        const V3<S> across = friction.force(stretch, p.slip, p.friction * normal * share.inverse_across);
        const V3<S> sum = normal * p.normal + share.across * across;
        force += sum;
        torque += cross(p.at - base_, sum);
        store_rows(grips_, k * grip_stride, {p.at.x, p.at.y, p.at.z, stretch.x, stretch.y, stretch.z}, served);
      }
    }
    store_rows(wrench_, 0, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, served);
  }

  const StandingWork& work_;
  const Layout& layout_;
  const int count_;
  Places<S> contacts_, before_;
  Places<S> poses_[2], twists_[2];  ///< of bases, of links
  Places<S, double> grips_, wrench_;
  Mobility<S> body_;
  V3<S> base_;
  Point points_[most_contacts];
  Share<S> shares_[one_patch ? 1 : most_contacts];  ///< of each patch
};

unsigned push(const StandingWork& work, const StandingRobot* const* robots, int count) {
  if (work.patch_of) {
    for (int i = 0; i < count; ++i) Push<double, false>(work, robots + i, 1).run();
    return 0;
  }
  return in_lanes(count, [&]<class S>(int first, int used) { return Push<S, true>(work, robots + first, used).run(); });
}

}  // namespace

namespace MURO_ISA {
extern const StandingKernels standing_kernels;
const StandingKernels standing_kernels{&push};
}  // namespace MURO_ISA

}  // namespace muro::penalty
