// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "muro/geometry.hpp"
#include "plugins/controller/common/wire_protocol/group.hpp"

namespace muro::joints {

using wire::Quantity;

/// State of an axis from step to step. All zero: nothing is set.
struct AxisState {
  std::int64_t set_at;   ///< ns
  std::uint32_t client;  ///< client that has set it
  std::uint32_t set_by;  ///< a Quantity; 0: it is not set, or the value was withdrawn
};

/// A property through which an axis is commanded.
struct Target {
  double* place = nullptr;  ///< null: the axis is not commanded in this way
  double lower = 0, upper = 0;
  std::string_view unit;
};

/// One number that clients set and read: a joint, or a component of the velocity of the base.
class Axis {
 public:
  Axis(std::string name, AxisState& state) : name_(std::move(name)), state_(state) {}

  // [setup]
  void set_reading(Quantity q, const double* place, std::string_view unit);
  /// Velocity of the base along one of its own axes: component 0 to 5 of a twist. `twist` is in world axes.
  void set_base_velocity(const Pose* pose, const Twist* twist, std::uint32_t component, std::string_view unit);
  void set_target(Quantity q, const Target& target);
  bool is_idle() const;  ///< whether it can be neither read nor set

  const std::string& name() const { return name_; }
  AxisState& state() const { return state_; }
  /// Quantity to read or set when a request names none; `standard`: there is none.
  Quantity standard_reading() const;
  Quantity standard_target() const;
  /// Returns the unit of a reading; empty when the axis has no such reading.
  std::string_view unit_of_reading(Quantity q) const;
  const Target& target(Quantity q) const { return targets_[std::size_t(q)]; }

  // These functions throw Fault when the axis cannot be read or set in this way. [step]
  double read(Quantity q) const;
  /// Throws Fault when `value` may not be set.
  void check(Quantity q, double value) const;
  void set(Quantity q, double value, wire::Origin origin);
  /// Sets velocities, accelerations and efforts to 0, and a position target to the present position.
  void stop();

 private:
  struct Reading {
    const double* place = nullptr;
    std::string_view unit;
  };
  double base_velocity() const;

  std::string name_;
  AxisState& state_;
  std::array<Reading, wire::quantity_count> readings_;
  std::array<Target, wire::quantity_count> targets_;
  const Pose* base_pose_ = nullptr;
  const Twist* base_twist_ = nullptr;
  std::uint32_t component_ = 0;
};

}  // namespace muro::joints
