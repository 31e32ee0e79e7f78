// SPDX-License-Identifier: MIT
// The MJCF file of the robots of a world for `settings: model`, and the numbers of their links and joints in it.
#pragma once

#include <map>
#include <vector>

#include "mujoco_library.hpp"
#include "muro/toolkit/joint_drives.hpp"

namespace muro::mujoco {

/// The drive of a joint by an actuator of the file; see the drives of reader.mjcf.
struct ModelDrive {
  DriveMode mode = DriveMode::passive;
  int actuator = -1;  ///< -1: none
};

/// A file that MuJoCo has compiled.
struct CompiledFile {
  Model model;
  std::vector<ModelDrive> drives;    ///< one per joint
  std::vector<std::string> scenery;  ///< one per geom: its name in the scene when the file is the scene's world
};

/// A robot of the file.
struct ModelRobotSource {
  static constexpr int none = -1;
  std::vector<int> bodies, joints;  ///< numbers in MuJoCo for each link; or none
  std::vector<In<double>> targets;  ///< target of each link's actuator
  std::vector<ModelDrive> drives;   ///< drive of each link's joint
  int root = 0;                     ///< its body directly below the world's
  bool is_free = false;             ///< its root moves freely
  std::vector<int> activations;     ///< indices of its actuators' activations
};

class ModelSource {
 public:
  /// Finds the file and connects the targets of actuators. Throws Error when the robots are not all from one file, or
  /// the file has changed since they were read. [setup]
  void connect(Connector& c);

  bool is_used() const { return !path_.empty(); }
  /// Whether the file is the scene's world: its bodies at rest are scenery.
  bool in_world() const { return in_world_; }
  const std::string& path() const { return path_; }
  const ModelRobotSource& robot(const std::string& name) const { return robots_.at(name); }
  /// Number of bodies in the file, and number of geoms of the world's body.
  int bodies() const { return bodies_; }
  int world_geoms() const { return world_geoms_; }
  /// s: the file's `timestep`.
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

/// Compiles a file, with `more` elements at its end, in the parser process. Throws Error with MuJoCo's reason.
CompiledFile compile_file(const std::string& path, const std::string& more);

}  // namespace muro::mujoco
