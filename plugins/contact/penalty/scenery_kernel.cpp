// SPDX-License-Identifier: MIT
#include "scenery_kernel.hpp"

#include "muro/simd/rows.hpp"

namespace muro::penalty {
namespace {

using namespace lane;
using namespace law;

/// Friction anchors of a group from the step before: n of them, or as many as a robot may have.
template <class S, int n>
struct OldAnchors {
  V3<S> at[n], displacement[n];

  MURO_INLINE void load(int k, const Places<S>& anchors, int anchor) {
    S g[anchor_numbers];
    load_rows(anchors, anchor * anchor_stride, g);
    at[k] = {g[0], g[1], g[2]};
    displacement[k] = {g[3], g[4], g[5]};
  }
  /// The tangential displacement of the nearest of the first `count`.
  MURO_INLINE V3<S> nearest(const V3<S>& point, int count) const {
    V3<S> found = displacement[0];
    if (count == 1) return found;
    V3<S> away = at[0] - point;
    S least = dot(away, away);
    for (int k = 1; k < count; ++k) {
      away = at[k] - point;
      const S distance = dot(away, away);
      const auto nearer = distance < least;
      least = select(nearer, distance, least);
      found = select(nearer, displacement[k], found);
    }
    return found;
  }
};

/// The contacts of as many robots as S has values. `one_patch`: all contacts belong to it. Each pass over the
/// contacts stores its results for the next, so that the iterations of a pass do not wait for each other.
template <class S, bool one_patch>
class RobotContacts {
 public:
  /// Where there are fewer than S has values, the first stands in.
  MURO_INLINE RobotContacts(const KernelBatch& batch, const KernelRobot* const* robots, int count)
      : batch_(batch), layout_(*batch.layout), count_(count) {
    for (int i = 0; i < count_of<S>; ++i) {
      const KernelRobot& r = *robots[i < count ? i : 0];
      contacts_.at[i] = r.contacts, before_.at[i] = r.before;
      anchors_.at[i] = r.anchors, wrench_.at[i] = r.wrench, forces_.at[i] = r.forces;
      poses_[0].at[i] = r.base_pose, poses_[1].at[i] = r.link_pose;
      twists_[0].at[i] = r.base_twist, twists_[1].at[i] = r.link_twist;
    }
    const PoseOf<S> pose = load_pose(poses_[0]);
    body_ = mobility_of(*batch.mass, pose);
    base_ = pose.position;
  }

  /// Returns a bit for each robot that is not processed.
  MURO_INLINE unsigned run() {
    const unsigned processed = load_contacts() & first_lanes(count_);
    const S load = find_effective_masses();
    move_contacts();
    add_forces(load, processed);
    return ~processed & first_lanes(count_);
  }

 private:
  struct Point {
    V3<S> at, normal;
    S depth, friction;
    S approach;          ///< m/s
    V3<S> slip;          ///< m/s
    V3<S> displacement;  ///< m, tangential
  };
  /// Contacts `begin` to `end` - 1 and their friction anchors of the step before.
  struct Group {
    int number, begin, end, anchors_begin, anchors_end;
  };

  MURO_INLINE int patch_of(int contact) const { return one_patch ? 0 : batch_.patch_of[contact]; }

  /// Returns a bit for each robot whose contacts agree with the patches of `batch`.
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

  /// Divides the effective mass of each patch among its points. Returns the load of the robot.
  MURO_INLINE S find_effective_masses() {
    SpringStiffness<S> all;
    for (int p = 0; p < (one_patch ? 1 : batch_.patches); ++p) {
      int first = 0;
      while (patch_of(first) != p) ++first;
      Patch<S> patch(points_[first].normal, body_.centre);
      for (int k = first; k < layout_.contacts; ++k)
        if (patch_of(k) == p) patch.add(points_[k].at);
      effective_masses_[p] = EffectiveMass<S>(patch.at_middle(body_), patch.count);
      all += patch.stiffness(effective_masses_[p].along, effective_masses_[p].across);
    }
    return all.max_eigenvalue_bound(body_);
  }

  /// Velocities and tangential displacements of the points.
  MURO_INLINE void move_contacts() {
    Group group{};
    for (; group.number < layout_.groups; ++group.number) {
      group.end = layout_.ends[group.number];
      group.anchors_end = batch_.anchors_ends[group.number];
      const int anchors = group.anchors_end - group.anchors_begin;
      if (anchors == 1)  // spherical wheels and feet
        move_group<1>(group);
      else if (anchors == 2)  // cylindrical wheels and tracks
        move_group<2>(group);
      else
        move_any_group(group);
      group.begin = group.end;
      group.anchors_begin = group.anchors_end;
    }
  }
  [[gnu::noinline]] void move_any_group(const Group& group) { move_group<max_contacts>(group); }
  /// A group that has n anchors, or any number of them.
  template <int n>
  MURO_INLINE void move_group(const Group& group) {
    const BodyOffsets& body = layout_.bodies[group.number];
    const V3<S> origin = load_vector(poses_[body.of_link], body.pose);
    const TwistOf<S> motion = load_twist(twists_[body.of_link], body.twist);
    const int anchors = n < max_contacts ? n : group.anchors_end - group.anchors_begin;
    OldAnchors<S, n> before;
    for (int k = 0; k < anchors; ++k) before.load(k, before_, group.anchors_begin + k);
    const S zero(0), elapsed(batch_.elapsed);
    for (int k = group.begin; k < group.end; ++k) {
      Point& p = points_[k];
      const V3<S> velocity = motion.linear + cross(motion.angular, p.at - origin);
      p.approach = -dot(velocity, p.normal);
      p.slip = velocity + p.approach * p.normal;
      const V3<S> displacement =
          (anchors > 0 ? before.nearest(p.at, anchors) : V3<S>{zero, zero, zero}) + p.slip * elapsed;
      p.displacement = displacement - p.normal * dot(p.normal, displacement);
    }
  }

  MURO_INLINE void add_forces(S load, unsigned processed) {
    V3<S> force{S(0), S(0), S(0)}, torque = force;
    const FrictionLaw<S> friction(batch_.stiffness, load);
    NormalLaw<S> law(batch_.stiffness, layout_.zeta[0], load);
    for (int group = 0, k = 0; group < layout_.groups; ++group) {
      if (layout_.zeta[group] != law.zeta) law = {batch_.stiffness, layout_.zeta[group], load};
      for (; k < layout_.ends[group]; ++k) {
        const Point& p = points_[k];
        const EffectiveMass<S>& mass = effective_masses_[patch_of(k)];
        V3<S> displacement = p.displacement;
        const S normal = mass.along * law.force(p.depth, p.approach);
        const V3<S> across = friction.force(displacement, p.slip, p.friction * normal * mass.inverse_across);
        const V3<S> sum = normal * p.normal + mass.across * across;
        force += sum;
        torque += cross(p.at - base_, sum);
        if (batch_.tells_contacts) store_vector(forces_, k * force_stride, sum, processed);
        store_rows(anchors_, k * anchor_stride,
                   {p.at.x, p.at.y, p.at.z, displacement.x, displacement.y, displacement.z}, processed);
      }
    }
    store_rows(wrench_, 0, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, processed);
  }

  const KernelBatch& batch_;
  const ContactLayout& layout_;
  const int count_;
  Places<S> contacts_, before_;
  Places<S> poses_[2], twists_[2];  ///< of bases, of links
  Places<S, double> anchors_, wrench_, forces_;
  Mobility<S> body_;
  V3<S> base_;
  Point points_[max_contacts];
  EffectiveMass<S> effective_masses_[one_patch ? 1 : max_contacts];  ///< of each patch
};

unsigned apply_forces(const KernelBatch& batch, const KernelRobot* const* robots, int count) {
  if (batch.patch_of) {
    for (int i = 0; i < count; ++i) RobotContacts<double, false>(batch, robots + i, 1).run();
    return 0;
  }
  return in_lanes(
      count, [&]<class S>(int first, int used) { return RobotContacts<S, true>(batch, robots + first, used).run(); });
}

}  // namespace

namespace MURO_ISA {
extern const SceneryKernels scenery_kernels;
const SceneryKernels scenery_kernels{&apply_forces};
}  // namespace MURO_ISA

}  // namespace muro::penalty
