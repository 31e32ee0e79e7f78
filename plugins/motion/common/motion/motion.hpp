// SPDX-License-Identifier: MIT
#pragma once

#include "muro/toolkit/accelerations.hpp"

namespace muro {

/// The way in which a motion moves the base of an item; see Accelerations::connect_by_name.
struct MovedBase {
  BaseMotion how = BaseMotion::kinematic;
  Inertia inertia{};           ///< of the body that is the base, in its frame; for BaseMotion::by_forces
  bool keeps_applied = false;  ///< the motion writes the wrenches that act on links
};

/// The base class of motions. A motion binds and moves its items; this class writes their accelerations where a sensor
/// reads them. `Base`: Algorithm, or PerRobotAlgorithm<Robot>.
template <class Base = Algorithm>
class Motion : public Base {
 public:
  void connect_by_name(Connector& c) final {
    bind_by_name(c);
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const MovedBase base = moved_base(i);
      accelerations_.connect_by_name(c, i, base.how, base.inertia, base.keeps_applied);
    }
  }

  void step(const Step& step, Range range) final {
    if (!prepare(step, range)) return;
    accelerations_.begin_step(range);
    move(step, range);
    if (accelerations_.empty()) return;
    for (std::uint32_t i = range.begin; i < range.end; ++i)
      if (moves(i)) accelerations_.end_step(i, step.dt);
    refine_accelerations(step, range);
  }

 protected:
  /// `vertices`: see Accelerations.
  explicit Motion(MeshVertices vertices = {}) : accelerations_(std::move(vertices)) {}

  /// Binds what is found by how others use it; see Algorithm::connect_by_name. [setup]
  virtual void bind_by_name(Connector& c) { static_cast<void>(c); }
  /// Returns how the base of item `i` moves. Called after bind_by_name. [setup]
  virtual MovedBase moved_base(std::uint32_t i) const {
    static_cast<void>(i);
    return {};
  }
  /// Does the work before robots move: a phase of its own, or the watch. False: this call moves no robot. [step]
  virtual bool prepare(const Step& step, Range range) {
    static_cast<void>(step), static_cast<void>(range);
    return true;
  }
  /// Carries the items of `range` from `step.time` to `step.time + step.dt`. [step]
  virtual void move(const Step& step, Range range) = 0;
  /// Whether this motion moves item `i` at present: false only in worlds, whose steps the host does not filter. [step]
  virtual bool moves(std::uint32_t i) const {
    static_cast<void>(i);
    return true;
  }
  /// Replaces accelerations that the motion knows better than differences of velocities do. [step]
  virtual void refine_accelerations(const Step& step, Range range) {
    static_cast<void>(step), static_cast<void>(range);
  }

 private:
  Accelerations accelerations_;
};

}  // namespace muro
