// SPDX-License-Identifier: MIT
// What the checks learn about a model before urdfdom reads it.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "document.hpp"
#include "muro/base/limits.hpp"
#include "muro/geometry.hpp"
#include "plugins/common/model_file/joint_spring.hpp"
#include "plugins/common/model_file/mesh_path.hpp"
#include "plugins/reader/common/sdf_devices/subsystem.hpp"

namespace muro::urdf {

/// Where files that a model names are looked for.
struct Places {
  std::filesystem::path folder;  ///< of the model
  model_file::Packages packages;
};

/// The surface of a link, from <gazebo reference="link"> or <contact> of the link; URDF itself has no word for it.
struct Surface {
  std::optional<double> friction;
  std::optional<double> restitution;
  std::optional<double> rolling_resistance;   ///< m
  std::optional<double> spinning_resistance;  ///< m
};

// Rotations are those of <origin rpy="...">, worked out here: the bits of urdfdom's depend on the processor.

struct JointInfo {
  Location location;
  Element* xml = nullptr;
  Quat rotation = Quat::Identity();
  std::string type, parent, child;
  bool moves = false;                ///< revolute, continuous, prismatic: becomes a joint of the robot
  std::optional<double> armature{};  ///< kg m^2 or kg; URDF itself has no word for it
  std::optional<model_file::JointSpring> spring{};
};

struct LinkInfo {
  Location location;
  bool bare = false;                      ///< nothing but a frame: no inertial, no shape
  std::string parent_joint;               ///< empty for the root
  std::vector<std::string> child_joints;  ///< in the order of the file
  Surface surface;
  Quat inertial_rotation = Quat::Identity();
  struct ShapeInfo {
    Quat rotation;
    Location location;     ///< of <box>, <mesh>, ...
    bool is_capsule;       ///< urdfdom has it as a cylinder
    std::string material;  ///< its name; empty: none
  };
  std::vector<ShapeInfo> collisions, visuals;  ///< in the order of the file
};

struct ModelInfo {
  std::map<std::string, LinkInfo> links;
  std::map<std::string, JointInfo> joints;
  std::vector<std::string> joint_order;  ///< as in the file
  std::string root;
  std::vector<sdf_devices::Subsystem> subsystems;  ///< sensors, drives and parameters of motions
};

/// Of Drake's <drake:rotor_inertia> and <drake:gear_ratio>: what the joint feels stays within the range of inertias.
inline constexpr double max_rotor_value = 1e7;

/// Stands for "no limit" in the text that urdfdom reads, which knows no infinity.
inline constexpr double no_limit = std::numeric_limits<double>::max();

/// Of the <origin> of a joint, an inertial, a collision or a visual that has passed its check.
Quat origin_rotation(const Element& owner);

// The checks. Each reports what it finds and changes the document so that urdfdom accepts the rest.

/// Removes elements of xacro, with a warning. False, with an error reported, when the file is the source of a robot
/// that xacro has yet to make.
bool take_macros(Element& robot, Problems& problems);
/// Reads the inertia of rotors from <drake:rotor_inertia> and <drake:gear_ratio> of actuators, as Drake does.
void take_rotors(Element& robot, ModelInfo& model, Problems& problems);
/// Reads friction and restitution from <contact> of links.
void take_surfaces(Element& robot, ModelInfo& model, Problems& problems);
/// Those from anywhere below <gazebo reference="link">.
void take_surface(Element& gazebo, const std::string& owner, Surface& surface, Problems& problems);
/// Reads all of <gazebo>: surfaces, gravity, springs, sensors, plugins. After take_surfaces, before which it goes.
void take_gazebo(Element& robot, ModelInfo& model, Problems& problems);
/// Removes everything that is not link, joint or material.
void remove_others(Element& robot);
void check_materials(Element& robot, Problems& problems);
void check_links(Element& robot, ModelInfo& model, Problems& problems);
void check_joints(Element& robot, ModelInfo& model, Problems& problems);
/// Finds the root. Every link hangs on it by exactly one way: joints that close a chain are left out, and links without
/// a joint that leads to them are fixed to the root, with warnings.
void check_tree(Element& robot, ModelInfo& model, Problems& problems);
/// Removes what follows no joint. After check_tree, which may take joints away.
void check_mimics(ModelInfo& model, Problems& problems);

}  // namespace muro::urdf
