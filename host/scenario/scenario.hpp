// SPDX-License-Identifier: MIT
// The contents of a scenario file, before a simulation is built from them. docs/scenario.md describes the format.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/algorithm_setup.hpp"
#include "core/registry.hpp"
#include "core/robot_tree.hpp"
#include "host/scenario/problems.hpp"
#include "muro/shape.hpp"
#include "muro/toolkit/pair_surface.hpp"

namespace muro::host {

/// A pose as a scenario states it: m, rad.
struct PoseInput {
  double x = 0, y = 0;
  std::optional<double> z;  ///< absent: the object stands on the ground
  double roll = 0, pitch = 0, yaw = 0;
};

/// The poses of the copies of an object or robot.
struct Placement {
  enum class Kind { list, grid, random };
  Kind kind = Kind::list;
  Location location;
  std::vector<PoseInput> poses;  ///< list: of each copy; grid: of its centre; random: the first gives the height

  int columns = 1, rows = 1;            ///< grid
  double spacing_x = 1, spacing_y = 1;  ///< m

  std::string area;                   ///< random: name under world.places
  std::optional<std::uint64_t> seed;  ///< absent: the scenario's
  double clearance = 0.1;             ///< between footprints, m
  int first_copy = 0;                 ///< so many have been drawn from the same place and seed for other robots
};

/// A rectangle in the plane: one of those that a named place consists of.
struct Rectangle {
  double x = 0, y = 0, width = 1, depth = 1;  ///< centre and full lengths along x and y, m
  std::vector<double> headings;               ///< rad; empty: any
};

/// A name and where it is written.
struct Name {
  std::string text;
  Location location;
};

/// One of the motions between which a robot is handed over.
struct HandoverLevel {
  std::vector<std::string> names;  ///< of all levels of the robot
  std::uint32_t index = 0;         ///< of this one
  std::uint32_t start = 0;         ///< of the one that moves the robot at first
};

/// One use of an algorithm.
struct Subsystem {
  std::string name;
  std::string use;             ///< empty: changes what the model brings under this name
  bool switched_off = false;   ///< what the model brings under this name is left out
  bool is_optional = false;    ///< the model brings it, and the scenario does not name it
  bool from_model = false;     ///< the model brings it; the scenario may have changed it
  std::optional<double> rate;  ///< Hz; absent: the default of its kind
  bool on_demand = false;
  std::optional<double> phase;  ///< s; absent: 0, and for a sensor's error that of the sensor
  std::string on;               ///< name of the robot's object on which it is mounted
  Location on_location;
  std::map<std::string, ParameterInput> parameters;
  std::map<std::string, std::string> parameter_places;  ///< of those in another file, or on the command line
  std::vector<Name> alternatives;                       ///< algorithms for which it lists parameters under their name
  std::optional<HandoverLevel> level;
  std::shared_ptr<const Subsystem> shadow;  ///< another motion that moves a shadow of the robot
  Location location;
};

struct SceneryObject {
  std::string name;
  Location location;
  bool numbered = false;  ///< names of copies end in their index
  Placement placement;
  Shape shape;
  std::string mesh;     ///< path, of a mesh or a heightmap
  std::string texture;  ///< path of a picture on its surface; empty: none
};

/// A file that describes a world.
struct WorldFile {
  std::string path;
  Location location;
};

/// The subsystems of each robot of a template. Most robots have the same, which are kept once.
class SubsystemsOfRobots {
 public:
  /// Those of the next robot: the list of this number in `lists`.
  void add(std::size_t list) { list_of_robot_.push_back(std::uint32_t(list)); }
  std::size_t add_list(std::vector<Subsystem> list) {
    lists_.push_back(std::move(list));
    return lists_.size() - 1;
  }
  const std::vector<Subsystem>& operator[](std::size_t robot) const { return lists_[list_of_robot_[robot]]; }
  /// The number in `lists` of that of a robot.
  std::size_t list_of(std::size_t robot) const { return list_of_robot_[robot]; }
  /// Robots.
  std::size_t size() const { return list_of_robot_.size(); }
  /// All that differ.
  const std::vector<std::vector<Subsystem>>& lists() const { return lists_; }

 private:
  std::vector<std::vector<Subsystem>> lists_;
  std::vector<std::uint32_t> list_of_robot_;
};

/// What the scenario says of joints in place of their model.
struct JointDynamics {
  Name joints;                       ///< one, or `arm_*`: all whose names begin so
  std::optional<double> damping{};   ///< N m s/rad or N s/m
  std::optional<double> friction{};  ///< N m or N
  std::optional<double> armature{};  ///< kg m^2 or kg
};

/// What the scenario says of a material in place of the model of a robot.
struct MaterialChange {
  Name name;
  RobotTree::Material material;
};

/// Materials of some robots of a template.
struct MaterialVariant {
  int first = 0, last = 0;  ///< robots
  std::vector<MaterialChange> changes;
};

struct RobotTemplate {
  std::string name;
  Location location;        ///< of its model, or of the whole template
  std::string model;        ///< path; empty for a body described in place, and for a model of the world file
  bool from_world = false;  ///< the model of the world file that has its name
  std::optional<Shape> shape;
  std::string mesh;       ///< path, of a shape that is a mesh
  std::string texture;    ///< path of a picture on the shape; empty: none
  double mass = 0;        ///< of a body described in place, kg
  bool numbered = false;  ///< names of robots end in their index
  int count = 1;
  Placement placement;
  Vec3 linear_velocity = Vec3::Zero();          ///< at the start, world axes, m/s
  Vec3 angular_velocity = Vec3::Zero();         ///< rad/s
  std::vector<std::pair<Name, double>> joints;  ///< positions at the start
  std::vector<JointDynamics> dynamics;          ///< in the order of the file
  std::vector<MaterialChange> materials;        ///< of all its robots
  std::vector<MaterialVariant> material_variants;
  SubsystemsOfRobots subsystems;          ///< variants are merged already
  std::vector<UnknownSubsystem> unknown;  ///< mistakes, where the model brings nothing of these names
};

struct Scenario {
  std::string file;
  std::vector<std::string> files;  ///< it and what it includes
  std::string name;
  std::uint64_t seed = 1;
  double duration = 10;                         ///< s
  unsigned threads = 1;                         ///< 0: all that the machine has
  std::map<std::string, PluginChoice> plugins;  ///< by name of an algorithm or reader, or by type of files
  std::map<std::string, std::string> packages;  ///< absolute folders, by the name in package://NAME and model://NAME
  std::optional<WorldFile> world_file;
  std::optional<FrictionRule> friction_rule;
  std::optional<Vec3> gravity;  ///< absent: that of the world file, else 9.81 m/s^2 downwards
  std::map<std::string, std::vector<Rectangle>> places;
  std::vector<SceneryObject> objects;
  std::vector<RobotTemplate> robots;
  std::vector<Subsystem> algorithms;      ///< of the whole scene
  std::vector<std::string> switched_off;  ///< scene-wide defaults that are not added
  /// Each: names such as "collision" or "rovers.motion", in the order in which they run.
  std::vector<std::vector<Name>> sequences;
};

inline constexpr unsigned max_threads = 1024;

/// The name of copy `index`: "rover_3", or "rover" when copies are not numbered.
std::string instance_name(const std::string& name, bool numbered, std::size_t index);

/// Reads a scenario with its includes and overrides. Throws SetupError with every problem found.
Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace muro::host
