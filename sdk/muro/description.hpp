// SPDX-License-Identifier: MIT
// Description of a plugin, written once, beside the code: `muro plugins info` prints it, scenarios are checked against
// it, and the reference pages are made from it.
#pragma once

#include "muro/features.hpp"
#include "muro/parameter.hpp"

namespace muro {

/// Purpose of an algorithm. The kind decides when it runs: see kind_infos.
enum class Kind : std::uint8_t {
  motion,        ///< moves a robot: reads commands and wrenches, writes pose, twist and joints
  kinematics,    ///< computes poses of bodies from base and joints
  scene,         ///< builds the spatial index
  sensor,        ///< perceives
  sensor_error,  ///< makes the device's reading from the true reading
  controller,    ///< commands a robot
  recorder,      ///< writes files
  drive,         ///< makes targets of joints from commands of the base
  collision,     ///< finds where bodies touch
  contact,       ///< computes the forces of contacts
  view,          ///< shows the scene
  level,         ///< decides which of its motions moves a robot
};

/// Part of a kind in an instant t. The first half of the instant completes the state of t, observes it and answers it
/// with commands; the second half carries it to the next instant.
enum class InstantPart : std::uint8_t {
  completes,  ///< first half: derives from the state what all others read
  observes,   ///< first half: reads, and writes nothing that moves a robot
  commands,   ///< first half: may write commands
  switches,   ///< second half: says which motion moves a robot, before forces are found
  forces,  ///< second half: on demand, it runs for the motions only; a reader in between sees the last step's results
  moves,   ///< second half: carries the state to the next instant
};

/// Facts that hold for all algorithms of a kind.
struct KindInfo {
  Kind kind;
  std::string_view name;
  InstantPart part;
  int connect_order;       ///< an algorithm that creates properties connects before one that asks whether they are used
  bool may_run_on_demand;  ///< it may run when a reader needs what it writes
  double default_rate;     ///< Hz, without a rate in the scenario; 0: on demand; below 0: the scenario must give one
  bool is_single = false;  ///< an object has at most one of this kind: the results of two would mix or add up
};

/// The kinds in the order in which they run within one instant.
inline constexpr KindInfo kind_infos[] = {
    {Kind::kinematics, "kinematics", InstantPart::completes, 1, true, 0, true},
    {Kind::scene, "scene", InstantPart::completes, 2, true, 0, true},
    {Kind::sensor, "sensor", InstantPart::observes, 6, true, -1},
    {Kind::sensor_error, "sensor_error", InstantPart::observes, 7, true, 0},
    {Kind::controller, "controller", InstantPart::commands, 8, false, -1},
    {Kind::drive, "drive", InstantPart::commands, 5, true, 0},
    {Kind::recorder, "recorder", InstantPart::observes, 9, false, -1},
    {Kind::view, "view", InstantPart::commands, 10, false, -1},
    {Kind::level, "level", InstantPart::switches, 1, false, -1},
    {Kind::collision, "collision", InstantPart::forces, 3, true, 0, true},
    {Kind::contact, "contact", InstantPart::forces, 4, true, 0, true},
    {Kind::motion, "motion", InstantPart::moves, 0, false, 1000},
};

/// The place of a kind within an instant, from 0.
constexpr int order_of(Kind kind) {
  int place = 0;
  while (kind_infos[place].kind != kind) ++place;
  return place;
}
constexpr const KindInfo& info_of(Kind kind) { return kind_infos[order_of(kind)]; }
constexpr std::string_view name_of(Kind kind) { return info_of(kind).name; }

/// The place of a kind in the order of Algorithm::connect_by_name. Controllers come first, since they bind there what a
/// user has them read and write, and motions and contact algorithms ask what is read and written. The others follow in
/// the order in which they connect; recorders and views come last and find all properties.
constexpr int by_name_order(Kind kind) { return kind == Kind::controller ? -1 : info_of(kind).connect_order; }

/// Abilities and needs of an algorithm: capability flags, as of an FMU (FMI 3.0, section 2.4). The conformance suite
/// checks them.
enum Capability : std::uint32_t {
  deterministic = 1,    ///< same state, same parameters, same seed: same bits
  batched = 2,          ///< one instance serves many robots; items are independent of each other
  allocation_free = 4,  ///< no allocation in a step after warm-up
  restorable = 8,       ///< all state is in properties: snapshot, restore and reset work
  needs_gpu = 16,
  /// One instance is a world that its robots share and that sees all other robots. Robots with the same parameter
  /// `world` are in one world, whatever their other parameters; it moves before motions that see no other robot.
  world = 32,
  /// Runs while nothing else runs, on the thread that runs the simulation; it may read all properties: see
  /// inspection.hpp.
  runs_alone = 64,
};

/// A property that an algorithm uses, by name, for the reader and for advice in error messages. May grow at its end.
struct PropertyUse {
  std::string_view key;
  std::string_view doc;
  std::string_view when{};  ///< "parameter=value": only then; empty: always
};

/// Description of an algorithm. May grow at its end.
struct Description {
  std::string_view id;  ///< "motion.point": family, dot, name
  Kind kind = Kind::motion;
  std::string_view version;  ///< semantic
  std::string_view summary;  ///< one line
  Rows<Parameter> parameters{};
  Rows<PropertyUse> reads{};
  Rows<PropertyUse> writes{};
  std::uint32_t capabilities = 0;  ///< Capability, or-ed
  Features features = 0;           ///< of a motion: what of a robot and its commands it uses
};

/// Description of a model reader. May grow at its end.
struct ReaderDescription {
  std::string_view id;  ///< "reader.urdf"
  std::string_view version;
  std::string_view summary;
  std::span<const std::string_view> extensions{};  ///< ".urdf"
};

}  // namespace muro
