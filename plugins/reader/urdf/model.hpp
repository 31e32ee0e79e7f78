// SPDX-License-Identifier: MIT
// Results of the checks of a model before urdfdom reads it.
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

/// Folders in which files of a model are searched.
struct Places {
  std::filesystem::path folder;  ///< folder of the model
  model_file::Packages packages;
};

/// Surface of a link, from <gazebo reference="link"> or <contact> of the link. URDF has no element for it.
struct Surface {
  std::optional<double> friction;
  std::optional<double> restitution;
  std::optional<double> rolling_resistance;   ///< m
  std::optional<double> spinning_resistance;  ///< m
};

// Rotations of <origin rpy="..."> are computed here: the bits of urdfdom's rotations depend on the processor.

struct JointInfo {
  Location location;
  Element* xml = nullptr;
  Quat rotation = Quat::Identity();
  std::string type, parent, child;
  bool moves = false;                ///< revolute, continuous or prismatic: becomes a joint of the robot
  std::optional<double> armature{};  ///< kg m^2 or kg; URDF has no element for it
  std::optional<model_file::JointSpring> spring{};
};

struct LinkInfo {
  Location location;
  bool bare = false;                      ///< whether it is only a frame: no inertial, no shape
  std::string parent_joint;               ///< empty for the root
  std::vector<std::string> child_joints;  ///< in the order of the file
  Surface surface;
  Quat inertial_rotation = Quat::Identity();
  struct ShapeInfo {
    Quat rotation;
    Location location;     ///< location of <box>, <mesh>, ...
    bool is_capsule;       ///< whether it is a capsule, which urdfdom reads as a cylinder
    std::string material;  ///< name of the material; empty: none
  };
  std::vector<ShapeInfo> collisions, visuals;  ///< in the order of the file
};

struct ModelInfo {
  std::map<std::string, LinkInfo> links;
  std::map<std::string, JointInfo> joints;
  std::vector<std::string> joint_order;  ///< names in the order of the file
  std::string root;
  std::vector<sdf_devices::Subsystem> subsystems;  ///< sensors, drives and parameters of motions
};

/// Limit of <drake:rotor_inertia> and <drake:gear_ratio>; it keeps the reflected inertia within the range of inertias.
inline constexpr double max_rotor_value = 1e7;

/// Value that means "no limit" in the text for urdfdom, which cannot read infinity.
inline constexpr double no_limit = std::numeric_limits<double>::max();

/// Returns the rotation of the <origin> of a joint, inertial, collision or visual that has passed its check.
Quat origin_rotation(const Element& owner);

// The checks. Each reports its problems and changes the document so that urdfdom accepts the rest.

/// Removes elements of xacro, with a warning. Reports an error and returns false if xacro has to process the file
/// first.
bool take_macros(Element& robot, Problems& problems);
/// Reads the inertia of rotors from <drake:rotor_inertia> and <drake:gear_ratio> of actuators, as Drake does.
void take_rotors(Element& robot, ModelInfo& model, Problems& problems);
/// Reads friction and restitution from <contact> of links.
void take_surfaces(Element& robot, ModelInfo& model, Problems& problems);
/// Reads friction and restitution from all elements below <gazebo reference="link">.
void take_surface(Element& gazebo, const std::string& owner, Surface& surface, Problems& problems);
/// Reads all of <gazebo>: surfaces, gravity, springs, sensors, plugins. Overrides take_surfaces: call it later.
void take_gazebo(Element& robot, ModelInfo& model, Problems& problems);
/// Removes all elements that are not link, joint or material.
void remove_others(Element& robot);
void check_materials(Element& robot, Problems& problems);
void check_links(Element& robot, ModelInfo& model, Problems& problems);
void check_joints(Element& robot, ModelInfo& model, Problems& problems);
/// Finds the root and makes a tree, with warnings: joints that close a chain are left out, and links to which no joint
/// leads are fixed to the root.
void check_tree(Element& robot, ModelInfo& model, Problems& problems);
/// Removes <mimic> elements without a valid leader. Call it after check_tree, which may remove joints.
void check_mimics(ModelInfo& model, Problems& problems);

}  // namespace muro::urdf
