// SPDX-License-Identifier: MIT
// What a plugin says of itself. Written once, beside the code; the same text is what `muro plugins
// info` prints, what the scenario is checked against and what the reference pages are made from.
#pragma once

#include "muro/features.hpp"
#include "muro/parameter.hpp"

namespace muro {

/// What an algorithm is for. The kind decides when it runs: see kind_infos.
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

/// What holds for all algorithms of a kind.
struct KindInfo {
  Kind kind;
  std::string_view name;
  int connect_order;       ///< who creates properties connects before who asks whether they are used
  bool may_run_on_demand;  ///< somebody reads what it writes, so it can run when asked
  double default_rate;     ///< Hz, when a scenario names none; 0: on demand; below 0: it must name one
  bool is_single = false;  ///< an object has at most one of this kind: the results of two would mix or add up
};

/// In the order in which kinds run within one instant t: the state of t is completed, seen, answered and recorded, then
/// forces are found and motion carries the state to the next instant.
inline constexpr KindInfo kind_infos[] = {
    {Kind::kinematics, "kinematics", 1, true, 0, true},
    {Kind::scene, "scene", 2, true, 0, true},
    {Kind::sensor, "sensor", 6, true, -1},
    {Kind::sensor_error, "sensor_error", 7, true, 0},
    {Kind::controller, "controller", 8, false, -1},
    {Kind::drive, "drive", 5, true, 0},
    {Kind::recorder, "recorder", 9, false, -1},
    {Kind::view, "view", 10, false, -1},
    {Kind::level, "level", 1, false, -1},
    {Kind::collision, "collision", 3, true, 0, true},
    {Kind::contact, "contact", 4, true, 0, true},
    {Kind::motion, "motion", 0, false, 1000},
};

/// The place of a kind within an instant, from 0.
constexpr int order_of(Kind kind) {
  int place = 0;
  while (kind_infos[place].kind != kind) ++place;
  return place;
}
constexpr const KindInfo& info_of(Kind kind) { return kind_infos[order_of(kind)]; }
constexpr std::string_view name_of(Kind kind) { return info_of(kind).name; }

/// The place of a kind among those that look for properties by name. Controllers bind what they are told to write and
/// read there, so they come first: motions and contact algorithms ask what is written and read. All others keep the
/// order in which they connect, recorders and views last, who find what any of them has made.
constexpr int by_name_order(Kind kind) { return kind == Kind::controller ? -1 : info_of(kind).connect_order; }

/// What an algorithm is able to do and what it needs: capability flags, as of an FMU (FMI 3.0, section 2.4). The
/// conformance suite holds each to its flags.
enum Capability : std::uint32_t {
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
  runs_alone = 64,
};

/// A property that an algorithm uses, by name, for the reader and for advice in error messages.
struct PropertyUse {
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
  std::span<const PropertyUse> reads{};
  std::span<const PropertyUse> writes{};
  std::uint32_t capabilities = 0;  ///< Capability, or-ed
  Features features = 0;           ///< of a motion: what of a robot and its commands it makes use of
};

/// One model reader.
struct ReaderDescription {
  std::string_view id;  ///< "reader.urdf"
  std::string_view version;
  std::string_view summary;
  std::span<const std::string_view> extensions{};  ///< ".urdf"
};

}  // namespace muro
