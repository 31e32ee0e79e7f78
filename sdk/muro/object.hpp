// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "muro/value_type.hpp"

namespace muro {

/// An object: a named container of properties. Ids are dense, from 0, and valid for one simulation.
enum class ObjectId : std::uint32_t {};

/// The scene itself; it holds properties that belong to no single thing, such as gravity.
inline constexpr ObjectId world_object{0};
inline constexpr ObjectId no_object{0xffffffffu};

constexpr std::uint32_t index_of(ObjectId id) { return static_cast<std::uint32_t>(id); }

/// A robot of the scene. Ids are dense, from 0, in the order in which robots were added: an index of arrays with an
/// element for each robot.
enum class RobotId : std::uint32_t {};
/// What belongs to no robot: scenery, and objects of the scene.
inline constexpr RobotId no_robot{0xffffffffu};

constexpr std::uint32_t index_of(RobotId id) { return static_cast<std::uint32_t>(id); }

/// A text that the simulation keeps (mesh file, material): see Connector::text, RobotBuilder::intern.
enum class TextId : std::uint32_t {};
inline constexpr TextId no_text{0};

template <>
struct ValueTraits<ObjectId> : detail::ScalarTraits<Scalar::u32> {
  static constexpr std::string_view name = "muro.ObjectId";
};
template <>
struct ValueTraits<TextId> : detail::ScalarTraits<Scalar::u32> {
  static constexpr std::string_view name = "muro.TextId";
};

}  // namespace muro
