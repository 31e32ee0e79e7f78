// SPDX-License-Identifier: MIT
#pragma once

#include "muro/extension.hpp"
#include "muro/key.hpp"
#include "muro/robot.hpp"

namespace muro {

enum class Severity : std::uint8_t {
  note,
  warning,
  error,
  lost_collision,  ///< a warning: a collision shape is left out; an error with `--strict`
};

/// Builds a robot's tree depth first (MuRoSimF, Section 2.1). Each call adds one block behind the last block; `fork`
/// opens two branches, each closed by `end`:
///
///     builder.base("chassis");
///     builder.set(keys::inertial, {...});             // a constant of the last part
///     builder.fork();
///       builder.translation({0.1, 0.2, 0});
///       builder.revolute("left_joint", Vec3::UnitY(), {});
///       builder.body("left_wheel");
///     builder.end();
///       builder.translation({0.1, -0.2, 0});
///       ...
///     builder.end();
///
/// Names are unique among the parts of a robot. The host collects misuse and reports it after the reader returns; no
/// call throws. Callable while a ModelReader reads, or from set-up code.
class RobotBuilder {
 public:
  virtual void base(std::string_view name) noexcept = 0;
  virtual void fork() noexcept = 0;
  virtual void end() noexcept = 0;
  /// Shift by `offset`, m, in the current frame.
  virtual void translation(const Vec3& offset) noexcept = 0;
  virtual void rotation(const Quat& turn) noexcept = 0;
  /// A joint; `axis` in the current frame, any length but zero.
  virtual void revolute(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept = 0;
  virtual void prismatic(std::string_view name, const Vec3& axis, const JointLimits& limits) noexcept = 0;
  /// The last joint follows the joint `leader`: q = offset + multiplier * q_leader. May be named before it exists.
  virtual void mimic(std::string_view leader, double multiplier, double offset) noexcept = 0;
  virtual void body(std::string_view name) noexcept = 0;

  /// Keeps a text for the life of the simulation.
  virtual TextId intern(std::string_view text) noexcept = 0;
  /// Reports something in the model to its user; an error makes the model unusable. `line` and `column` count from 1;
  /// 0 when unknown.
  virtual void report(Severity severity, std::string_view text, int line = 0, int column = 0) noexcept = 0;

  /// A constant of the last part (base, joint or body).
  template <class T>
  void set(const Key<T>& key, const T& value) {
    set_raw(key, &value, single_value);
  }
  template <class T>
  void set_array(const Key<T>& key, std::span<const T> values) {
    set_raw(key, values.data(), static_cast<std::uint32_t>(values.size()));
  }

 protected:
  /// `count`: elements of an array, or single_value.
  virtual void set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept = 0;

 public:
  /// Returns the host's extension of this name, version and layout, or null. [setup]
  virtual void* find_extension(const ExtensionId&) noexcept { return nullptr; }

 protected:
  ~RobotBuilder() = default;
};

}  // namespace muro
