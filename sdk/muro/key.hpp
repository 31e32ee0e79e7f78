// SPDX-License-Identifier: MIT
#pragma once

#include "muro/value_type.hpp"

namespace muro {

/// Count of a constant that is a single value, where an array would give its number of elements.
inline constexpr std::uint32_t single_value = 0xffffffffu;

/// Role of a property in the set-up check and in a hand-over between motions. All who declare a key give it one role.
enum class Role : std::uint8_t {
  state,    ///< an error when it is read and not written
  command,  ///< an error when it is read and not written, or written and not read: a command that no level uses
  /// State of the motion rather than of the robot. It is zero, a list of it empty, while a motion that does not write
  /// it moves the robot; all other properties stay as the previous motion has written them (Algorithm::on_handover).
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
