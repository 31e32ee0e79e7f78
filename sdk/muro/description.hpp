// SPDX-License-Identifier: MIT
// What a plugin says of itself. Written once, beside the code; the same text is what `muro plugins
// info` prints, what the scenario is checked against and what the reference pages are made from.
#pragma once

#include "muro/features.hpp"
#include "muro/parameter.hpp"

namespace muro {

/// What an algorithm is for. The kind gives its place among the algorithms that run at one instant:
/// see `order_of`.
enum class Kind : std::uint8_t {
  motion,        ///< moves a robot: reads commands and wrenches, writes pose, twist and joints
  kinematics,    ///< poses of bodies from base and joints
  scene,         ///< the spatial index
  sensor,        ///< what a robot perceives
  sensor_error,  ///< from the true reading to the device's
  controller,    ///< what commands a robot
  recorder,      ///< what writes files
  drive,         ///< from commands of the base to targets of joints
  collision,     ///< where bodies touch
  contact,       ///< what forces come from it
  view,          ///< what shows the scene
  level,         ///< what decides which of its motions moves a robot
};

/// The order of kinds within one instant t: the state of t is completed, seen, answered and recorded,
/// then forces are found and motion carries the state to the next instant.
constexpr int order_of(Kind kind) {
  constexpr Kind order[] = {Kind::kinematics, Kind::scene,     Kind::sensor,   Kind::sensor_error,
                            Kind::controller, Kind::drive,     Kind::recorder, Kind::view,
                            Kind::level,      Kind::collision, Kind::contact,  Kind::motion};
  int place = 0;
  while (order[place] != kind) ++place;
  return place;
}

constexpr std::string_view name_of(Kind kind) {
  constexpr std::string_view names[] = {"motion",   "kinematics", "scene",     "sensor",  "sensor_error", "controller",
                                        "recorder", "drive",      "collision", "contact", "view",         "level"};
  return names[static_cast<int>(kind)];
}

/// What an algorithm promises; the conformance suite holds it to its word.
enum Promise : std::uint32_t {
  deterministic = 1,    ///< same state, same parameters, same seed: same bits
  batched = 2,          ///< one instance serves many robots; items are independent of each other
  allocation_free = 4,  ///< no allocation in a step after warm-up
  restorable = 8,       ///< all state is in properties: snapshot, restore and reset work
  needs_gpu = 16,
  /// One instance is a world that its robots share and that sees all others. Robots whose parameter `world` is the same
  /// are in one, whatever their other parameters; it moves before motions that see nobody.
  world = 32,
  /// Runs while nothing else does, on the thread that runs the simulation; it may look at all properties: see
  /// inspection.hpp.
  alone = 64,
};

/// A property that an algorithm uses, by name, for the reader and for advice in error messages.
struct Use {
  std::string_view key;
  std::string_view doc;
  std::string_view when{};  ///< "parameter=value": only then; empty: always
};

/// One algorithm.
struct Description {
  std::string_view id;  ///< "motion.point": kind or family, dot, name
  Kind kind = Kind::motion;
  std::string_view version;  ///< semantic
  std::string_view summary;  ///< one line
  std::span<const Parameter> parameters{};
  std::span<const Use> reads{};
  std::span<const Use> writes{};
  std::uint32_t promises = 0;  ///< Promise, or-ed
  Features features = 0;       ///< of a motion: what of a robot and its commands it makes use of
};

/// The place of an algorithm in an instant: that of its kind, worlds before all other motions, since they read where
/// those are.
constexpr int order_of(const Description& d) {
  return 2 * order_of(d.kind) + (d.kind == Kind::motion && (d.promises & Promise::world) == 0 ? 1 : 0);
}

/// One model reader.
struct ReaderDescription {
  std::string_view id;  ///< "reader.urdf"
  std::string_view version;
  std::string_view summary;
  std::span<const std::string_view> extensions{};  ///< ".urdf"
};

}  // namespace muro
