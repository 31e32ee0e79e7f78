// SPDX-License-Identifier: MIT
// For `settings: model`: the MJCF file of the robots of a world, and where their links and joints are in it.
#pragma once

#include <map>
#include <vector>

#include "mujoco_library.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::mujoco {

/// What an actuator of the file follows, of a joint; see the drives of reader.mjcf.
struct ModelDrive {
  DriveMode mode = DriveMode::passive;
  int actuator = -1;  ///< none
};

/// A file as MuJoCo compiles it.
struct CompiledFile {
  Model model;
  std::vector<ModelDrive> drives;    ///< one per joint
  std::vector<std::string> scenery;  ///< of each geom: what it is called in the scene where the file is its world
};

/// A robot of the file.
struct ModelRobotSource {
  static constexpr int none = -1;
  std::vector<int> bodies, joints;  ///< of each link, in MuJoCo; none
  std::vector<In<double>> targets;  ///< of each link's joint: what its actuator follows
  std::vector<ModelDrive> drives;   ///< the same
  int root = 0;                     ///< its body right under the world's
  bool is_free = false;             ///< its root moves freely
  std::vector<int> activations;     ///< of its actuators
};

class ModelSource {
 public:
  /// Finds the file, and binds what actuators follow. Throws Error where the robots are not all of one file, or the
  /// file has changed since they were read. [setup]
  void connect(Connector& c);

  bool is_used() const { return !path_.empty(); }
  /// Whether the file is the scene's world: what stands still in it is scenery.
  bool in_world() const { return in_world_; }
  const std::string& path() const { return path_; }
  const ModelRobotSource& robot(const std::string& name) const { return robots_.at(name); }
  /// How many bodies the file has, and geoms of the world's body.
  int bodies() const { return bodies_; }
  int world_geoms() const { return world_geoms_; }
  /// s: what the file's `timestep` says.
  double time_step() const { return time_step_; }

 private:
  ModelRobotSource robot_of(Connector& c, const Item& item, const Parameters& p, const CompiledFile& file);
  void check_gravity(const Connector& c, const mjModel& m) const;

  std::string path_;
  bool in_world_ = false;
  int bodies_ = 0, world_geoms_ = 0;
  double time_step_ = 0;
  std::map<std::string, ModelRobotSource, std::less<>> robots_;
};

/// Has the parser process compile a file with `more` elements at its end. Throws Error with MuJoCo's reason.
CompiledFile compile_file(const std::string& path, const std::string& more);

}  // namespace muro::mujoco
