// SPDX-License-Identifier: MIT
#pragma once

#include "muro/value_type.hpp"

namespace muro {

/// Count of a constant that is a single value, where an array would give its number of elements.
inline constexpr std::uint32_t single_value = 0xffffffffu;

/// What the set-up check and a hand-over between motions expect of a property.
enum class Role : std::uint8_t {
  state,    ///< somebody must write what somebody reads
  command,  ///< as state, and somebody must read what is written: a command that no level uses is an error
  /// As state, but it tells of the motion rather than of the robot: it is zero, a list of it empty, whenever a motion
  /// that does not write it moves the robot. Everything else stays as the motion before has left it
  /// (Algorithm::on_handover).
  motion_trait,
};

/// Name, unit and type of a property, without the type in the type system.
struct KeyInfo {
  std::string_view name;  ///< lower case, dotted: "joint.position"
  std::string_view unit;  ///< SI, "1" for none; compared letter by letter between writer and reader
  const ValueType* type = nullptr;
  Role role = Role::state;
  std::string_view doc{};
};

/// A typed property name. Declare one once: `inline constexpr Key<Pose> pose{"pose", "m", "..."};`
template <class T>
struct Key : KeyInfo {
  using value = T;
  constexpr Key(std::string_view name_, std::string_view unit_, std::string_view doc_, Role role_ = Role::state)
      : KeyInfo{name_, unit_, &value_type<T>, role_, doc_} {}
};

}  // namespace muro
