// SPDX-License-Identifier: MIT
#include "scenery_kernel.hpp"

#include "old_anchors.hpp"
#include "plugins/common/contact_geometry/pressure_cells.hpp"
#include "rolling_point.hpp"

namespace muro::penalty {
namespace {

using namespace lane;
using namespace law;

/// The contacts of as many robots as S has values. If one has fewer than another, its last contact is repeated and
/// counts for nothing. Each pass over the contacts stores its results for the next, so that the iterations of a pass do
/// not wait for each other.
template <class S>
class RobotContacts {
 public:
  /// If there are fewer robots than S has values, the first is repeated.
  MURO_INLINE RobotContacts(const KernelBatch& batch, const KernelRobot* const* robots, int count)
      : batch_(batch), robots_(robots), number_(count), used_(first_lanes(count)) {
    Places<S> base_poses, masses;
    double counts[count_of<S>];
    unsigned rolling = 0;
    least_ = max_contacts;
    for (int i = 0; i < count_of<S>; ++i) {
      const KernelRobot& r = *robots[i < count ? i : 0];
      contacts_[i] = r.contacts, last_[i] = r.count - 1, counts[i] = r.count;
      least_ = r.count < least_ ? r.count : least_;
      most_ = r.count > most_ ? r.count : most_;
      groups_ |= r.groups, common_groups_ &= r.groups;
      in_order_ = in_order_ && r.in_order;
      is_uniform_ = is_uniform_ && r.groups == robots[0]->groups && r.count == robots[0]->count;
      has_many_objects_ = has_many_objects_ || r.has_many_objects;
      has_many_materials_ = has_many_materials_ || r.has_many_materials;
      changed_ |= unsigned(r.is_changed) << i;
      rolling |= unsigned(r.rolls) << i;
      listed_.at[i] = r.listed, before_.at[i] = r.before;
      anchors_.at[i] = r.anchors, wrench_.at[i] = r.wrench, forces_.at[i] = r.forces;
      ways_before_.at[i] = r.rolls ? r.ways_before : r.listed, ways_.at[i] = r.ways;
      base_poses.at[i] = r.base_pose, masses.at[i] = r.mass;
      poses_.at[i] = r.pose, twists_.at[i] = r.twist;
      one_pattern_ = one_pattern_ && r.contacts == robots[0]->contacts;
    }
    is_uniform_ = is_uniform_ && in_order_;
    count_ = side_by_side(counts);
    S mass[mass_numbers];
    bool one_mass = true;
    for (int i = 1; i < count_of<S>; ++i) one_mass = one_mass && masses.at[i] == masses.at[0];
    if (one_mass)
      for (int k = 0; k < mass_numbers; ++k) mass[k] = S(masses.at[0][k]);
    else
      load_rows(masses, 0, mass);
    const PoseOf<S> pose = load_pose(base_poses);
    body_ = mobility_of(mass, pose);
    base_ = pose.position;
    if (rolling != 0) find_drift(rolling);
  }

  /// Returns a bit for each robot that is not processed.
  MURO_INLINE unsigned apply_forces() {
    load_contacts();
    const SpringStiffness<S> springs = find_effective_masses();
    const S load = springs.max_eigenvalue_bound(body_);
    switch (find_cells()) {
      case Cells::none:
        return move_and_push<Cells::none>(load);
      case Cells::lines:
        push_lines(load);
        return 0;
      case Cells::any:
        return push_any(load);
    }
    return 0;
  }

 private:
  /// Cells of the robots of the call. none: points alone. lines: points and lines, the groups of all are alike, and
  /// none may be in an impact. any: all others, and robots that roll.
  enum class Cells { none, lines, any };

  template <Cells cells>
  MURO_INLINE unsigned move_and_push(S load) {
    const unsigned left = move_contacts<cells>() & used_;
    add_forces<cells>(load, used_ & ~left);
    return left;
  }
  [[gnu::noinline]] unsigned push_any(S load) { return move_and_push<Cells::any>(load); }

  const KernelRobot& robot(int lane) const { return *robots_[lane < number_ ? lane : 0]; }
  [[gnu::noinline]] void find_drift(unsigned rolling) {
    Places<S> twists;
    for (int i = 0; i < count_of<S>; ++i) twists.at[i] = robot(i).base_twist;
    const TwistOf<S> twist = load_twist(twists);
    any_rolls_ = true;
    rolls_ = mask_of<S>(rolling);
    drift_ = (twist.linear + cross(twist.angular, body_.centre - base_)) * S(0.5 * batch_.stiffness.h);
    reach2_ = square_of_reach(body_);
  }
  /// Motion of a contact.
  struct Moved {
    S approach;          ///< m/s
    V3<S> slip;          ///< m/s, of the middle of its cell
    S spin;              ///< m/s: of the ends of its cell, see law::speed_of_ends
    V3<S> displacement;  ///< m, tangential
  };
  struct Point {
    V3<S> at, normal;
    S depth, friction;
    S patch;  ///< number; -1 in lanes of robots that have fewer contacts
  };
  /// Further data of points of some robots. They are stored apart, so that the points of others take few cache lines.
  struct Detail {
    V3<S> arm;   ///< m, from the base to its place in the middle of the step, when the force acts, as seen from the
                 ///< centre
    V3<S> way;   ///< m: way in the last step, of robots that roll
    V3<S> turn;  ///< m, of a face: slip of the middle of its cell relative to its own, for 1 rad/s about the normal
  };
  /// Contacts of each robot in a patch.
  struct PatchOf {
    V3<S> normal;
    S object;  ///< -1 in lanes of robots that have fewer patches
    EffectiveMass<S> mass;
  };
  /// Contacts `begin` to `end` - 1, of one group in each robot, and their friction anchors of the step before.
  struct Run {
    int begin, end;
    int most_anchors;
    Places<S> poses, twists, anchors;
    int last_anchor[count_of<S>];  ///< -1: none
    bool all_have_anchors;
  };

  MURO_INLINE static S side_by_side(const double (&v)[count_of<S>]) {
    if constexpr (count_of<S> == 1)
      return v[0];
    else
      return load_side_by_side<S>(v);
  }
  /// Passes contact k of each robot to `sink`, with its lane.
  template <class Sink>
  MURO_INLINE void each_contact(int k, const Sink& sink) const {
    if (k < least_)
      for (int i = 0; i < count_of<S>; ++i) sink(i, contacts_[i][k]);
    else
      for (int i = 0; i < count_of<S>; ++i) sink(i, contacts_[i][k < last_[i] ? k : last_[i]]);
  }
  /// Returns a number of each robot's contact k.
  template <class Number>
  MURO_INLINE S of_contacts(int k, const Number& number) const {
    if (one_pattern_ && k < least_) return S(double(number(contacts_[0][k])));
    double v[count_of<S>];
    each_contact(k, [&](int i, const KernelContact& c) { v[i] = double(number(c)); });
    return side_by_side(v);
  }
  /// Whether all robots have a contact k at place k.
  MURO_INLINE bool is_plain(int k) const { return in_order_ && k < least_; }

  MURO_INLINE void load_contact(int k, S (&c)[contact_numbers]) const {
    if (is_plain(k)) return load_rows(listed_, k * contact_stride, c);
    Places<S> at;
    each_contact(k, [&](int i, const KernelContact& x) { at.at[i] = listed_.at[i] + x.place * contact_stride; });
    load_rows(at, 0, c);
  }

  MURO_INLINE void load_contacts() {
    S of_patches(1);  // number of patches in each lane
    for (int k = 0; k < most_; ++k) {
      S c[contact_numbers];
      load_contact(k, c);
      Point& p = points_[k];
      p.at = {c[0], c[1], c[2]}, p.normal = {c[3], c[4], c[5]};
      p.depth = c[6], p.friction = c[7];
      const S object = has_many_objects_ ? of_contacts(k, [](const KernelContact& x) { return x.object; }) : S(0);
      if (k == 0) {
        patches_[0].normal = p.normal, patches_[0].object = object;
        patch_count_ = 1;
      }
      S found(0);
      if (const auto fits = of_patch(patches_[0], p.normal, object);
          k > 0 && (patch_count_ > 1 || bits(fits) != all_lanes<S>)) {
        found = select(fits, S(0), S(-1));
        for (int n = 1; n < patch_count_; ++n) found = select(of_patch(patches_[n], p.normal, object), S(n), found);
        if (const auto fresh = (found < S(0)) & (S(k) < count_); any(fresh)) {
          found = select(fresh, of_patches, found);
          add_patches(fresh, of_patches, p.normal, object);
          of_patches += select(fresh, S(1), S(0));
        }
      }
      p.patch = k < least_ ? found : select(S(k) < count_, found, S(-1));
    }
    any_looked_at_ = patch_count_ > 1 || changed_ != 0;
    if (any_looked_at_) looked_at_ = (of_patches > S(1)) | mask_of<S>(changed_);
  }

  MURO_INLINE static MaskOf<S> of_patch(const PatchOf& patch, const V3<S>& normal, S object) {
    return (dot(patch.normal, normal) > S(same_direction)) & (patch.object == object);
  }
  /// Adds patch `number` in each of the lanes. The contact is its first.
  MURO_INLINE void add_patches(MaskOf<S> lanes, S number, const V3<S>& normal, S object) {
    if (any(lanes & (number == S(patch_count_)))) patches_[patch_count_++] = {normal, S(-1), {}};
    for (int n = 1; n < patch_count_; ++n) {
      const auto here = lanes & (number == S(n));
      patches_[n].normal = select(here, normal, patches_[n].normal);
      patches_[n].object = select(here, object, patches_[n].object);
    }
  }

  /// Returns the lanes in which contacts k - 1 and k belong to one group and one patch.
  MURO_INLINE MaskOf<S> joined(int k) const {
    MaskOf<S> lanes = points_[k].patch == points_[k - 1].patch;
    if (k >= least_) lanes = lanes & (S(k) < count_);
    if (groups_ >> k & 1) {
      unsigned go_on = 0;
      for (int i = 0; i < count_of<S>; ++i) go_on |= (~robot(i).groups >> k & 1) << i;
      lanes = lanes & mask_of<S>(go_on);
    }
    return lanes;
  }
  /// Finds the cells of patches. If there is nothing but points and lines, cells of lines are not found here.
  MURO_INLINE Cells find_cells() {
    const std::uint64_t all = (std::uint64_t(1) << most_) - 1, goes_on = all & ~std::uint64_t(groups_);
    has_cells_ = (all & ~std::uint64_t(common_groups_)) != 0;
    const bool is_even = patch_count_ == 1 && groups_ == common_groups_ && least_ == most_;
    if (!has_cells_) return any_rolls_ ? Cells::any : Cells::none;
    if (is_even && (goes_on & goes_on >> 1) == 0 && !any_rolls_ && !any_looked_at_) return Cells::lines;
    find_any_turns();
    return Cells::any;
  }
  /// Returns the normal of the patch of contact k: that of its first contact.
  MURO_INLINE V3<S> patch_normal(int k) const {
    V3<S> normal = patches_[0].normal;
    for (int n = 1; n < patch_count_; ++n) normal = select(points_[k].patch == S(n), patches_[n].normal, normal);
    return normal;
  }
  /// Finds lines and faces, if groups of the robots differ, are parts of several patches, or are faces.
  [[gnu::noinline]] void find_any_turns() {
    const MaskOf<S> no_lane = S(1) < S(0);
    MaskOf<S> goes_on[max_contacts + 2];  // the patch of contact k - 1 goes on in contact k
    goes_on[0] = goes_on[most_] = goes_on[most_ + 1] = no_lane;
    for (int k = 1; k < most_; ++k) {
      goes_on[k] = joined(k);
      has_faces_ = has_faces_ || any(goes_on[k] & goes_on[k - 1]);
    }
    for (int k = 0; k < most_; ++k) {
      begins_line_[k] = goes_on[k + 1] & !(goes_on[k] | goes_on[k + 2]);
      has_line_[k] = any(begins_line_[k]);
    }
    if (has_faces_) find_faces(goes_on);
  }
  [[gnu::noinline]] void find_faces(const MaskOf<S>* goes_on) {
    contact_geometry::FacePoints<S> faces[max_contacts];
    S distances[max_contacts], farthest[max_contacts];
    V3<S> arms[max_contacts];  // m, from the middle
    const auto of_face = [&](int k) -> MaskOf<S> { return (goes_on[k] | goes_on[k + 1]) & (faces[k].count > S(2)); };
    for (int k = 0; k < most_; ++k) {
      details_[k].turn = {S(0), S(0), S(0)};
      in_face_[k] = S(1) < S(0);
      faces[k] = {};
      faces[k].add(points_[k].at - base_);
      if (k > 0) faces[k].add_where(goes_on[k], faces[k - 1]);
    }
    for (int k = most_ - 2; k >= 0; --k) faces[k] = choose(goes_on[k + 1], faces[k + 1], faces[k]);
    for (int k = 0; k < most_; ++k) {
      arms[k] = points_[k].at - base_ - faces[k].middle();
      distances[k] = farthest[k] = sqrt(dot(arms[k], arms[k]));
      if (k == 0) continue;
      distances[k] += select(goes_on[k], distances[k - 1], S(0));
      farthest[k] = max(farthest[k], select(goes_on[k], farthest[k - 1], S(0)));
    }
    for (int k = most_ - 1; k >= 0; --k) {
      distances[k] = select(goes_on[k + 1], distances[k + 1], distances[k]);
      farthest[k] = select(goes_on[k + 1], farthest[k + 1], farthest[k]);
      const auto here = of_face(k);
      if (!any(here)) continue;
      const S is_disc = of_contacts(k, [](const KernelContact& c) { return c.is_of_disc; });
      const S share = contact_geometry::share_of_cells(faces[k], distances[k], farthest[k], is_disc);
      V3<S>& turn = details_[k].turn;
      turn = select(here, cross(patch_normal(k), arms[k]) * (share - S(1)), turn);
      in_face_[k] = here;
    }
  }
  template <class M>
  MURO_INLINE static contact_geometry::FacePoints<S> choose(M mask, const contact_geometry::FacePoints<S>& a,
                                                            const contact_geometry::FacePoints<S>& b) {
    return {select(mask, a.count, b.count), select(mask, a.sum, b.sum), select(mask, a.xx, b.xx),
            select(mask, a.yy, b.yy),       select(mask, a.zz, b.zz),   select(mask, a.yz, b.yz),
            select(mask, a.zx, b.zx),       select(mask, a.xy, b.xy)};
  }

  /// Divides the effective mass of each patch among its points. Returns the stiffness that holds the robot.
  MURO_INLINE SpringStiffness<S> find_effective_masses() {
    SpringStiffness<S> all;
    const bool plain = patch_count_ == 1;
    for (int n = 0; n < patch_count_; ++n) {
      Patch<S> patch(patches_[n].normal, body_.centre);
      for (int k = n; k < most_; ++k) {
        if (plain && k < least_)
          patch.add(points_[k].at);
        else if (const auto here = points_[k].patch == S(n); any(here))
          patch.add_where(here, points_[k].at);
      }
      EffectiveMass<S>& mass = patches_[n].mass;
      mass = EffectiveMass<S>(patch.at_middle(body_), patch.count);
      const SpringStiffness<S> springs = patch.stiffness(mass.along, mass.across);
      all += plain ? springs : springs.where(patch.count > S(0));
    }
    return all;
  }

  /// Finds velocities and tangential displacements of the points. Returns a bit for each robot that may be in an
  /// impact.
  template <Cells cells>
  MURO_INLINE unsigned move_contacts() {
    S may_collide(0);  // 0 or 1
    if constexpr (cells == Cells::any)
      if (has_cells_) find_any_slips();
    Run run;
    for (run.begin = 0; run.begin < most_; run.begin = run.end) {
      find_end_and_bodies(run);
      find_anchors(run);
      if (run.most_anchors == 1)  // spherical wheels and feet
        move_run<1, cells>(run, may_collide);
      else if (run.most_anchors == 2)  // cylindrical wheels and tracks
        move_run<2, cells>(run, may_collide);
      else
        move_any_run<cells>(run, may_collide);
    }
    if constexpr (cells != Cells::none) any_spins_ = any(largest_spin_ > S(0));
    return bits(may_collide > S(0));
  }
  MURO_INLINE void find_end_and_bodies(Run& run) const {
    run.end = run.begin + 1;
    while (is_joined(run.end)) ++run.end;
    if (one_pattern_ && run.begin < least_) {
      const KernelContact& c = contacts_[0][run.begin];
      for (int i = 0; i < count_of<S>; ++i)
        run.poses.at[i] = poses_.at[i] + c.pose, run.twists.at[i] = twists_.at[i] + c.twist;
    } else {
      each_contact(run.begin, [&](int i, const KernelContact& c) {
        run.poses.at[i] = poses_.at[i] + c.pose, run.twists.at[i] = twists_.at[i] + c.twist;
      });
    }
  }
  MURO_INLINE void find_anchors(Run& run) const {
    run.most_anchors = run.end - run.begin;
    run.all_have_anchors = true;
    if (is_uniform_) return;
    run.most_anchors = 0;
    each_contact(run.begin, [&](int i, const KernelContact& c) {
      const int anchors = c.anchors_end - c.anchors_begin;
      // if there is none, numbers of the contact are read instead
      run.anchors.at[i] =
          anchors > 0 ? before_.at[i] + c.anchors_begin * anchor_stride : listed_.at[i] + c.place * contact_stride;
      run.last_anchor[i] = anchors - 1;
      run.all_have_anchors = run.all_have_anchors && anchors > 0;
      run.most_anchors = anchors > run.most_anchors ? anchors : run.most_anchors;
    });
  }
  template <int n>
  MURO_INLINE void load_anchors(const Run& run, OldAnchors<S, n>& to) const {
    const int anchors = n < max_contacts ? n : run.most_anchors;
    if (is_uniform_) {
      for (int k = 0; k < anchors; ++k) to.load(k, before_, (run.begin + k) * anchor_stride);
    } else {
      Places<S> at = run.anchors;
      for (int k = 0; k < anchors; ++k) {
        to.load(k, at, 0);
        for (int i = 0; i < count_of<S>; ++i)
          at.at[i] += k < run.last_anchor[i] ? anchor_stride : 0;  // repeats the last
      }
    }
    if (any_rolls_) load_ways(run, anchors, to);
  }
  /// Loads the ways of anchors. Ways of robots that do not roll are any numbers.
  template <int n>
  [[gnu::noinline]] void load_ways(const Run& run, int anchors, OldAnchors<S, n>& to) const {
    Places<S> at = ways_before_;
    each_contact(run.begin, [&](int i, const KernelContact& c) {
      if (robot(i).rolls && c.anchors_end > c.anchors_begin) at.at[i] += c.anchors_begin * way_stride;
    });
    for (int k = 0; k < anchors; ++k) {
      to.load_way(k, at, 0);
      for (int i = 0; i < count_of<S>; ++i)
        at.at[i] += robot(i).rolls && (is_uniform_ || k < run.last_anchor[i]) ? way_stride : 0;
    }
  }
  template <Cells cells>
  [[gnu::noinline]] void move_any_run(const Run& run, S& may_collide) {
    move_run<max_contacts, cells>(run, may_collide);
  }
  /// Moves the contacts of a run with at most n anchors; any number of anchors if n is max_contacts.
  template <int n, Cells cells>
  MURO_INLINE void move_run(const Run& run, S& may_collide) {
    const V3<S> origin = load_vector(run.poses);
    const TwistOf<S> motion = load_twist(run.twists);
    const int anchors = n < max_contacts ? n : run.most_anchors;
    OldAnchors<S, n> before;
    load_anchors(run, before);
    const S zero(0), elapsed(batch_.elapsed), impact_speed(batch_.impact_speed);
    const S half_step(batch_.elapsed > 0 ? 0.5 * batch_.stiffness.h / batch_.elapsed : 0);
    const MaskOf<S> have_anchors = having_anchors(run);
    for (int k = run.begin; k < run.end; ++k) {
      const Point& p = points_[k];
      Moved& moved = moved_[k];
      if (cells == Cells::none || (cells == Cells::any && !has_cells_)) find_slip(p, motion, origin, moved);
      V3<S> old{zero, zero, zero}, way = old;
      if (anchors > 0) old = before.nearest(p.at, anchors, way);
      if (!run.all_have_anchors) old = select(have_anchors, old, {zero, zero, zero});
      if constexpr (cells == Cells::any) details_[k].arm = p.at - base_;
      if (cells == Cells::any && any_rolls_) {
        // a point that moves over the body, as on a rim, moves on; other points are new
        const V3<S> none{zero, zero, zero}, last = anchors > 0 ? before.way_of_nearest(p.at, anchors) : none;
        const auto moves_on = (dot(way, way) < reach2_) & have_anchors & rolls_;
        Detail& detail = details_[k];
        detail.arm = select(moves_on, detail.arm + (way_ahead(way, last) * half_step - drift_), detail.arm);
        detail.way = select(moves_on, way, none);
      }
      moved.displacement = displacement_of(p.normal, old, moved.slip);
      if (!any_looked_at_) continue;
      const auto fast = (moved.approach > impact_speed) & looked_at_ & (p.patch >= zero);
      if (!any(fast)) continue;
      const S reach = S(lasting_reach) + S(lasting_slips) * elapsed * sqrt(dot(moved.slip, moved.slip));
      const S distance2 = anchors > 0 ? before.least_distance2(p.at, anchors) : zero;
      const auto lasts = have_anchors & (distance2 < reach * reach);
      may_collide = select(fast, select(lasts, may_collide, S(1)), may_collide);
    }
  }
  MURO_INLINE MaskOf<S> having_anchors(const Run& run) const {
    if (run.all_have_anchors) return S(1) > S(0);
    double last[count_of<S>];
    for (int i = 0; i < count_of<S>; ++i) last[i] = run.last_anchor[i];
    return side_by_side(last) >= S(0);
  }
  /// Returns the tangential displacement. `old`: of the step before.
  MURO_INLINE V3<S> displacement_of(const V3<S>& normal, const V3<S>& old, const V3<S>& slip) const {
    const V3<S> displacement = old + slip * S(batch_.elapsed);
    return displacement - normal * dot(normal, displacement);
  }
  /// Finds the slip of the point, not of the middle of its cell.
  MURO_INLINE static void find_slip(const Point& p, const TwistOf<S>& motion, const V3<S>& origin, Moved& to) {
    const V3<S> velocity = motion.linear + cross(motion.angular, p.at - origin);
    to.approach = -dot(velocity, p.normal);
    to.slip = velocity + to.approach * p.normal;
  }
  /// Returns the change of a vector that changes evenly along a line, from the first end to the middle of its cell.
  MURO_INLINE static V3<S> part_of_line(const V3<S>& first, const V3<S>& second) {
    return contact_geometry::shift_in_line(first, second);
  }
  /// Finds the slips of all points, in the middles of their cells.
  [[gnu::noinline]] void find_any_slips() {
    Run run;
    for (run.begin = 0; run.begin < most_; run.begin = run.end) {
      find_end_and_bodies(run);
      const V3<S> origin = load_vector(run.poses);
      const TwistOf<S> motion = load_twist(run.twists);
      for (int k = run.begin; k < run.end; ++k) {
        Moved& moved = moved_[k];
        find_slip(points_[k], motion, origin, moved);
        moved.spin = S(0);
        if (!has_faces_ || !any(in_face_[k])) continue;
        const V3<S> more = dot(motion.angular, patch_normal(k)) * details_[k].turn;
        moved.slip = select(in_face_[k], moved.slip + more, moved.slip);
        moved.spin = select(in_face_[k], speed_of_ends(more), S(0));
      }
    }
    for (int k = 0; k < most_; ++k) {
      if (has_line_[k]) {
        Moved &first = moved_[k], &second = moved_[k + 1];
        const V3<S> part = part_of_line(first.slip, second.slip);
        const S spin = speed_of_ends(part);
        first.slip = select(begins_line_[k], first.slip + part, first.slip);
        second.slip = select(begins_line_[k], second.slip - part, second.slip);
        first.spin = select(begins_line_[k], spin, first.spin);
        second.spin = select(begins_line_[k], spin, second.spin);
      }
      largest_spin_ = max(moved_[k].spin, largest_spin_);
    }
  }

  /// Force of a contact: along the normal in its point, across it in the middle of its cell.
  struct Push {
    V3<S> along, across;
  };
  template <Cells cells>
  MURO_INLINE Push push_of(int k, const Moved& moved, bool spins, const FrictionLaw<S>& friction, NormalLaw<S>& law,
                           S load, unsigned which) {
    const S none(0);
    if (has_many_materials_) law = {batch_.stiffness, of_contacts(k, zeta_of), load};
    const Point& p = points_[k];
    EffectiveMass<S> mass = patches_[0].mass;
    for (int n = 1; n < patch_count_; ++n) {
      const auto here = p.patch == S(n);
      const EffectiveMass<S>& other = patches_[n].mass;
      mass.along = select(here, other.along, mass.along);
      mass.across = select(here, other.across, mass.across);
      mass.inverse_across = select(here, other.inverse_across, mass.inverse_across);
    }
    V3<S> displacement = moved.displacement;
    const S normal = mass.along * law.force(p.depth, moved.approach);
    const S most = p.friction * normal * mass.inverse_across;
    Push push;
    push.along = normal * p.normal;
    if (cells != Cells::none && spins)
      push.across = mass.across * friction.force(displacement, moved.slip, most, moved.spin);
    else
      push.across = mass.across * friction.force(displacement, moved.slip, most);
    if (cells != Cells::lines && k >= least_) {
      const auto here = S(k) < count_;
      push = {select(here, push.along, {none, none, none}), select(here, push.across, {none, none, none})};
      which &= bits(here);
    }
    store_contact(k, displacement, which);
    if (batch_.tells_contacts) tell_contact<cells>(k, push, which);
    return push;
  }
  static double zeta_of(const KernelContact& x) { return x.zeta; }
  template <Cells cells>
  MURO_INLINE void add_forces(S load, unsigned processed) {
    const S none(0);
    V3<S> force{none, none, none}, torque = force;
    const FrictionLaw<S> friction(batch_.stiffness, load);
    NormalLaw<S> law(batch_.stiffness, of_contacts(0, zeta_of), load);
    if constexpr (cells == Cells::none) {
      for (int k = 0; k < most_; ++k) {
        const Push p = push_of<cells>(k, moved_[k], false, friction, law, load, processed);
        add<cells>(k, p.along + p.across, force, torque);
      }
    } else {
      Push pushes[max_contacts];
      for (int k = 0; k < most_; ++k)
        pushes[k] = push_of<cells>(k, moved_[k], any_spins_, friction, law, load, processed);
      if (has_cells_) move_friction(pushes, torque);
      for (int k = 0; k < most_; ++k) add<cells>(k, pushes[k].along + pushes[k].across, force, torque);
    }
    store_rows(wrench_, 0, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, processed);
  }
  /// Computes lines and points one after the other. Nothing is stored between velocities and forces.
  MURO_INLINE void push_lines(S load) {
    const S none(0);
    V3<S> force{none, none, none}, torque = force;
    const FrictionLaw<S> friction(batch_.stiffness, load);
    NormalLaw<S> law(batch_.stiffness, of_contacts(0, zeta_of), load);
    Run run;
    for (run.begin = 0; run.begin < most_; run.begin = run.end) {
      find_end_and_bodies(run);
      find_anchors(run);
      if (run.most_anchors <= 1)
        push_line<1>(run, friction, law, load, force, torque);
      else if (run.most_anchors == 2)
        push_line<2>(run, friction, law, load, force, torque);
      else
        push_any_line(run, friction, law, load, force, torque);
    }
    store_rows(wrench_, 0, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, used_);
  }
  [[gnu::noinline]] void push_any_line(const Run& run, const FrictionLaw<S>& friction, NormalLaw<S>& law, S load,
                                       V3<S>& force, V3<S>& torque) {
    push_line<max_contacts>(run, friction, law, load, force, torque);
  }
  /// Applies the forces of a line or point with at most n anchors; any number of anchors if n is max_contacts.
  template <int n>
  MURO_INLINE void push_line(const Run& run, const FrictionLaw<S>& friction, NormalLaw<S>& law, S load, V3<S>& force,
                             V3<S>& torque) {
    const V3<S> origin = load_vector(run.poses);
    const TwistOf<S> motion = load_twist(run.twists);
    OldAnchors<S, n> before;
    load_anchors(run, before);
    const int k = run.begin;
    const auto displacement_at = [&](int i, const Moved& moved) __attribute__((always_inline)) {
      V3<S> old{S(0), S(0), S(0)}, way = old;
      if (run.most_anchors > 0) old = before.nearest(points_[i].at, run.most_anchors, way);
      if (!run.all_have_anchors) old = select(having_anchors(run), old, {S(0), S(0), S(0)});
      return displacement_of(points_[i].normal, old, moved.slip);
    };
    Moved a, b;
    find_slip(points_[k], motion, origin, a);
    if (run.end == k + 1) {
      a.displacement = displacement_at(k, a);
      const Push p = push_of<Cells::lines>(k, a, false, friction, law, load, used_);
      return add<Cells::lines>(k, p.along + p.across, force, torque);
    }
    find_slip(points_[k + 1], motion, origin, b);
    const V3<S> part = part_of_line(a.slip, b.slip);
    a.slip += part, b.slip -= part;
    a.spin = b.spin = speed_of_ends(part);
    a.displacement = displacement_at(k, a);
    b.displacement = displacement_at(k + 1, b);
    const bool spins = any(a.spin > S(0));
    const Push first = push_of<Cells::lines>(k, a, spins, friction, law, load, used_);
    const Push second = push_of<Cells::lines>(k + 1, b, spins, friction, law, load, used_);
    const V3<S> moved = part_of_line(first.across, second.across);
    add<Cells::lines>(k, first.along + (first.across + moved), force, torque);
    add<Cells::lines>(k + 1, second.along + (second.across - moved), force, torque);
  }
  template <Cells cells>
  MURO_INLINE void add(int k, const V3<S>& all, V3<S>& force, V3<S>& torque) const {
    force += all;
    torque += cross(cells == Cells::any ? details_[k].arm : points_[k].at - base_, all);
  }
  /// Moves friction of lines from the middles of their cells to the ends, in parts, with the same effect. Friction of
  /// faces has moments about their normals.
  MURO_INLINE void move_friction(Push* pushes, V3<S>& torque) const {
    if (has_faces_) add_moments(pushes, torque);
    for (int k = 0; k + 1 < most_; ++k) {
      if (!has_line_[k]) continue;
      V3<S>&first = pushes[k].across, &second = pushes[k + 1].across;
      const V3<S> part = part_of_line(first, second);
      first = select(begins_line_[k], first + part, first);
      second = select(begins_line_[k], second - part, second);
    }
  }
  /// Adds the moments of friction in faces.
  MURO_INLINE void add_moments(const Push* pushes, V3<S>& torque) const {
    for (int n = 0; n < patch_count_; ++n) {
      S moment(0);
      for (int k = 0; k < most_; ++k)
        if (const auto here = in_face_[k] & (points_[k].patch == S(n)); any(here))
          moment += select(here, dot(details_[k].turn, pushes[k].across), S(0));
      torque += moment * patches_[n].normal;
    }
  }
  /// Whether contacts k - 1 and k are of one group in each robot. They are a line if there are only lines and points.
  MURO_INLINE bool is_joined(int k) const { return k < most_ && !(groups_ >> k & 1); }
  template <Cells cells>
  MURO_INLINE void tell_contact(int k, const Push& push, unsigned which) const {
    const Point& p = points_[k];
    V3<S> torque{S(0), S(0), S(0)};
    if constexpr (cells == Cells::lines) {
      const int other = is_joined(k) ? k - 1 : is_joined(k + 1) ? k + 1 : k;
      if (other != k) torque = cross(part_of_line(p.at, points_[other].at), push.across);
    }
    if (cells == Cells::any && has_cells_) {
      for (const int first : {k - 1, k}) {
        if (first < 0 || !has_line_[first]) continue;
        const V3<S> to_cell = part_of_line(p.at, points_[first == k ? k + 1 : k - 1].at);
        torque = select(begins_line_[first], cross(to_cell, push.across), torque);
      }
      if (has_faces_) torque = select(in_face_[k], dot(details_[k].turn, push.across) * patch_normal(k), torque);
    }
    const V3<S> force = push.along + push.across;
    store_rows(forces_, k * force_stride, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, which);
  }
  MURO_INLINE void store_contact(int k, const V3<S>& displacement, unsigned which) const {
    if (any_rolls_) store_way(k, which & bits(rolls_));
    if (is_plain(k)) return store_anchor(anchors_, k * anchor_stride, k, displacement, which);
    Places<S, double> anchors;
    each_contact(k, [&](int i, const KernelContact& c) { anchors.at[i] = anchors_.at[i] + c.anchor * anchor_stride; });
    store_anchor(anchors, 0, k, displacement, which);
  }
  MURO_INLINE void store_anchor(const Places<S, double>& anchors, int number, int k, const V3<S>& displacement,
                                unsigned which) const {
    const V3<S>&at = points_[k].at, &d = displacement;
    store_rows(anchors, number, {at.x, at.y, at.z, d.x, d.y, d.z}, which);
  }
  [[gnu::noinline]] void store_way(int k, unsigned which) const {
    Places<S, double> ways = ways_;
    each_contact(k, [&](int i, const KernelContact& c) {
      if (which >> i & 1) ways.at[i] += c.anchor * way_stride;
    });
    const V3<S>& way = details_[k].way;
    store_rows(ways, 0, {way.x, way.y, way.z}, which);
  }

  const KernelBatch& batch_;
  const KernelRobot* const* const robots_;
  const int number_;     ///< number of robots
  const unsigned used_;  ///< bits of lanes
  unsigned changed_ = 0, groups_ = 0, common_groups_ = ~0u;
  bool has_cells_ = false;               ///< friction of some points is in the middle of a cell
  bool has_faces_ = false;               ///< some of these cells are of faces; otherwise of lines alone
  bool has_line_[max_contacts];          ///< contacts k and k + 1 are a line in some robots
  MaskOf<S> begins_line_[max_contacts];  ///< in these robots
  MaskOf<S> in_face_[max_contacts];
  S largest_spin_{0};
  bool any_spins_ = false;
  bool any_rolls_ = false;  ///< see KernelRobot
  MaskOf<S> rolls_;
  bool in_order_ = true, has_many_materials_ = false, has_many_objects_ = false;
  bool is_uniform_ = true;  ///< robots are in order, and have equal groups, which have the anchors of their contacts
  const KernelContact* contacts_[count_of<S>];
  bool one_pattern_ = true;   ///< the contacts of all robots are the same
  Places<S> poses_, twists_;  ///< of the bodies of their first contacts
  int last_[count_of<S>];
  int least_ = 0, most_ = 0;  ///< limits of the number of contacts of a robot
  S count_;                   ///< number of contacts of each robot
  Places<S> listed_, before_, ways_before_;
  Places<S, double> anchors_, ways_, wrench_, forces_;
  Mobility<S> body_;
  V3<S> base_;
  V3<S> drift_;  ///< m: way of the centre of mass within half a step
  S reach2_;     ///< m^2: square of the longest way of a point in a step
  bool any_looked_at_ = false;
  MaskOf<S> looked_at_;  ///< robots that may be in impacts
  int patch_count_ = 0;
  PatchOf patches_[max_contacts];
  Point points_[max_contacts];
  Moved moved_[max_contacts];
  Detail details_[max_contacts];
};

unsigned apply_forces(const KernelBatch& batch, const KernelRobot* const* robots, int count) {
  return in_lanes(count, [&]<class S>(int first, int used) {
    return RobotContacts<S>(batch, robots + first, used).apply_forces();
  });
}

}  // namespace

namespace MURO_ISA {
extern const SceneryKernels scenery_kernels;
const SceneryKernels scenery_kernels{&apply_forces};
}  // namespace MURO_ISA

}  // namespace muro::penalty
