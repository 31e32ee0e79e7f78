// SPDX-License-Identifier: MIT
// The contacts of several robots with the scenery: their motion and their forces. SIMD lanes are robots.
#pragma once

#include "contact_run.hpp"
#include "friction_cells.hpp"
#include "rolling_contacts.hpp"

namespace muro::penalty::law {
namespace {

using lane::load_pose, lane::PoseOf;

/// The contacts of as many robots as S has values. Each pass over the contacts stores its results for the next, so that
/// the iterations of a pass do not wait for each other. contact_passes.hpp and line_pass.hpp define the passes.
///
/// Names of these headers are internal, because scenery_kernel.cpp alone includes them. So callers know which registers
/// a function leaves as they are, and keep values there.
template <class S>
class RobotContacts {
 public:
  /// If there are fewer robots than S has values, the first is repeated.
  MURO_INLINE RobotContacts(const KernelBatch& batch, const KernelRobot* const* robots, int count)
      : batch_(batch), lanes_(robots, count) {
    S mass[mass_numbers];
    lanes_.load_mass(mass);
    const PoseOf<S> pose = load_pose(lanes_.places_of(&KernelRobot::base_pose));
    body_ = mobility_of(mass, pose);
    base_ = pose.position;
    if (lanes_.rolling != 0) rolling_.find(lanes_, body_, base_, batch.stiffness.h);
  }

  /// Returns a bit for each robot that is not processed.
  MURO_INLINE unsigned apply_forces() {
    const S patches = contacts_.load(lanes_);
    any_looked_at_ = contacts_.patch_count > 1 || lanes_.changed != 0;
    if (any_looked_at_) looked_at_ = (patches > S(1)) | mask_of<S>(lanes_.changed);
    const SpringStiffness<S> springs = contacts_.find_effective_masses(lanes_, body_);
    const S load = springs.max_eigenvalue_bound(body_);
    switch (cells_.find(lanes_, contacts_, base_, any_looked_at_)) {
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
  template <Cells cells>
  MURO_INLINE unsigned move_and_push(S load) {
    const unsigned left = move_contacts<cells>() & lanes_.used;
    add_forces<cells>(load, lanes_.used & ~left);
    return left;
  }
  [[gnu::noinline]] unsigned push_any(S load) { return move_and_push<Cells::any>(load); }

  // First pass, see contact_passes.hpp.
  /// Finds velocities and tangential displacements of the points. Returns a bit for each robot that may be in an
  /// impact.
  template <Cells cells>
  unsigned move_contacts();
  /// Finds the slips of all points, in the middles of their cells.
  void find_any_slips();
  template <Cells cells>
  void move_any_run(const ContactRun<S>& run, S& may_collide);
  /// Moves the contacts of a run with at most n anchors; any number of anchors if n is max_contacts. Sets `may_collide`
  /// to 1 for robots that may be in an impact.
  template <int n, Cells cells>
  void move_run(const ContactRun<S>& run, S& may_collide);

  // Second pass, see contact_passes.hpp.
  template <Cells cells>
  void add_forces(S load, unsigned processed);
  /// Computes the force of contact k, and writes its anchor for robots `which`. `spins`: some cells spin.
  template <Cells cells>
  ContactForce<S> force_of(int k, const ContactMotion<S>& motion, bool spins, const FrictionLaw<S>& friction,
                           NormalLaw<S>& law, S load, unsigned which);
  template <Cells cells>
  void tell_contact(int k, const ContactForce<S>& push, unsigned which) const;
  static double zeta_of(const KernelContact& x) { return x.zeta; }
  template <Cells cells>
  MURO_INLINE void add(int k, const V3<S>& all, V3<S>& force, V3<S>& torque) const {
    force += all;
    torque += cross(cells == Cells::any ? arms_[k].arm : contacts_.points[k].at - base_, all);
  }
  MURO_INLINE void store_wrench(const V3<S>& force, const V3<S>& torque, unsigned which) const {
    store_rows(lanes_.wrench, 0, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, which);
  }

  // Both passes in one, see line_pass.hpp.
  /// Computes lines and points one after the other. Nothing is stored between velocities and forces.
  void push_lines(S load);
  void push_any_line(const ContactRun<S>& run, const FrictionLaw<S>& friction, NormalLaw<S>& law, S load, V3<S>& force,
                     V3<S>& torque);
  /// Applies the forces of a line or point with at most n anchors; any number of anchors if n is max_contacts.
  template <int n>
  void push_line(const ContactRun<S>& run, const FrictionLaw<S>& friction, NormalLaw<S>& law, S load, V3<S>& force,
                 V3<S>& torque);

  const KernelBatch& batch_;
  const ContactLanes<S> lanes_;
  S largest_spin_{0};
  bool any_spins_ = false;
  RollingContacts<S> rolling_;
  Mobility<S> body_;
  V3<S> base_;
  bool any_looked_at_ = false;
  MaskOf<S> looked_at_;  ///< robots that may be in impacts
  FrictionCells<S> cells_;
  ContactPoints<S> contacts_;
  ContactMotion<S> motions_[max_contacts];
  ContactArm<S> arms_[max_contacts];
};

}  // namespace
}  // namespace muro::penalty::law
