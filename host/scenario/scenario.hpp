// SPDX-License-Identifier: MIT
// The contents of a scenario file, before a simulation is built from them. docs/guide/scenario.md describes the format.
#pragma once

#include <functional>
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

/// A pose as a scenario gives it: m, rad.
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
  std::optional<std::uint64_t> seed;  ///< absent: the seed of the scenario
  double clearance = 0.1;             ///< between footprints, m
  int first_copy = 0;                 ///< number of copies that other robots have drawn from the same place and seed
};

/// A rectangle in the plane: a part of a named place.
struct Rectangle {
  double x = 0, y = 0, width = 1, depth = 1;  ///< centre and full lengths along x and y, m
  std::vector<double> headings;               ///< rad; empty: any
};

/// A name and its location.
struct Name {
  std::string text;
  Location location;
};

/// One of the motions between which a robot is handed over.
struct HandoverLevel {
  std::vector<std::string> names;  ///< names of all levels of the robot
  std::uint32_t index = 0;         ///< index of this level
  std::uint32_t start = 0;         ///< index of the level that moves the robot at first
};

/// One use of an algorithm.
struct Subsystem {
  std::string name;
  std::string use;             ///< empty: changes a subsystem of the model that has this name
  bool switched_off = false;   ///< the subsystem of the model that has this name is left out
  bool is_optional = false;    ///< it is in the model, and the scenario does not name it
  bool from_model = false;     ///< it is in the model; the scenario may have changed it
  std::optional<double> rate;  ///< Hz; absent: the default of its kind
  bool on_demand = false;
  std::optional<double> phase;  ///< s; absent: 0, or for a sensor's error the phase of the sensor
  std::string on;               ///< name of the robot's object that carries it
  Location on_location;
  std::map<std::string, ParameterInput> parameters;
  std::map<std::string, std::string> parameter_places;  ///< for parameters in another file, or on the command line
  std::vector<Name> alternatives;                       ///< algorithms that have parameters under their name
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
  std::string mesh;     ///< path of a mesh or a heightmap
  std::string texture;  ///< path of a picture on its surface; empty: none
};

/// A file that describes a world.
struct WorldFile {
  std::string path;
  Location location;
};

/// The subsystems of each robot of a template. Most robots have the same subsystems, which are stored once.
class SubsystemsOfRobots {
 public:
  /// Adds a robot with the list of index `list` in `lists`.
  void add(std::size_t list) { list_of_robot_.push_back(std::uint32_t(list)); }
  std::size_t add_list(std::vector<Subsystem> list) {
    lists_.push_back(std::move(list));
    return lists_.size() - 1;
  }
  const std::vector<Subsystem>& operator[](std::size_t robot) const { return lists_[list_of_robot_[robot]]; }
  /// Returns the index in `lists` of a robot's list.
  std::size_t list_of(std::size_t robot) const { return list_of_robot_[robot]; }
  /// Number of robots.
  std::size_t size() const { return list_of_robot_.size(); }
  /// All different lists.
  const std::vector<std::vector<Subsystem>>& lists() const { return lists_; }

 private:
  std::vector<std::vector<Subsystem>> lists_;
  std::vector<std::uint32_t> list_of_robot_;
};

/// Values of joints in the scenario that replace those of the model.
struct JointDynamics {
  Name joints;                       ///< one joint, or `arm_*`: all that begin with this name
  std::optional<double> damping{};   ///< N m s/rad or N s/m
  std::optional<double> friction{};  ///< N m or N
  std::optional<double> armature{};  ///< kg m^2 or kg
};

/// A material in the scenario that replaces one of the model.
struct MaterialChange {
  Name name;
  RobotTree::Material material;
};

/// Materials of some robots of a template.
struct MaterialVariant {
  int first = 0, last = 0;  ///< first and last robot
  std::vector<MaterialChange> changes;
};

struct RobotTemplate {
  std::string name;
  Location location;        ///< location of its model, or of the whole template
  std::string model;        ///< path; empty for a body in the scenario, and for a model of the world file
  bool from_world = false;  ///< its model is that of the same name in the world file
  std::optional<Shape> shape;
  std::string mesh;       ///< path, for a shape that is a mesh
  std::string texture;    ///< path of a picture on the shape; empty: none
  double mass = 0;        ///< kg, of a body in the scenario
  bool numbered = false;  ///< names of robots end in their index
  int count = 1;
  Placement placement;
  Vec3 linear_velocity = Vec3::Zero();          ///< at the start, world axes, m/s
  Vec3 angular_velocity = Vec3::Zero();         ///< rad/s
  std::vector<std::pair<Name, double>> joints;  ///< positions at the start
  std::vector<JointDynamics> dynamics;          ///< in the order of the file
  std::vector<MaterialChange> materials;        ///< for all its robots
  std::vector<MaterialVariant> material_variants;
  SubsystemsOfRobots subsystems;          ///< variants are merged already
  std::vector<UnknownSubsystem> unknown;  ///< mistakes, if the model has no subsystems of these names
};

struct Scenario {
  std::string file;
  std::vector<std::string> files;  ///< the scenario and its included files
  std::string name;
  std::uint64_t seed = 1;
  double duration = 10;                         ///< s
  unsigned threads = 1;                         ///< 0: all of the machine
  std::map<std::string, PluginChoice> plugins;  ///< by name of an algorithm or reader, or by file type
  std::map<std::string, std::string> packages;  ///< absolute folders, by NAME in package://NAME and model://NAME
  std::optional<WorldFile> world_file;
  std::optional<FrictionRule> friction_rule;
  std::optional<Vec3> gravity;  ///< absent: that of the world file, or 9.81 m/s^2 downwards
  std::map<std::string, std::vector<Rectangle>> places;
  std::vector<SceneryObject> objects;
  std::vector<RobotTemplate> robots;
  std::vector<Subsystem> algorithms;      ///< algorithms of the whole scene
  std::vector<std::string> switched_off;  ///< scene-wide defaults that are not added
  /// Each sequence: names such as "collision" or "rovers.motion", in the order in which they run.
  std::vector<std::vector<Name>> sequences;
};

inline constexpr unsigned max_threads = 1024;

/// Returns the name of copy `index`: "rover_3", or "rover" when copies are not numbered.
std::string instance_name(const std::string& name, bool numbered, std::size_t index);

/// Reads a scenario with its includes and overrides. `complete`, if given, adds to its tree before overrides change it.
/// Throws SetupError with every problem found.
Scenario read_scenario(const std::string& path, const std::vector<std::string>& overrides,
                       const std::function<void(Node& root)>& complete = {});

}  // namespace muro::host
