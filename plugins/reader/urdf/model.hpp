// SPDX-License-Identifier: MIT
// What the checks learn about a model before urdfdom reads it.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "document.hpp"
#include "muro/geometry.hpp"

namespace muro::urdf {

/// The surface of a link, from <gazebo reference="link">; URDF itself has no word for it.
struct Surface {
  std::optional<double> friction;
  std::optional<double> restitution;
};

// Rotations are those of <origin rpy="...">, worked out here: the bits of urdfdom's depend on the processor.

struct JointInfo {
  Location location;
  Quat rotation = Quat::Identity();
  std::string type, parent, child;
  bool moves = false;  ///< revolute, continuous, prismatic: becomes a joint of the robot
};

struct LinkInfo {
  Location location;
  bool bare = false;                      ///< nothing but a frame: no inertial, no shape
  std::string parent_joint;               ///< empty for the root
  std::vector<std::string> child_joints;  ///< in the order of the file
  Surface surface;
  Quat inertial_rotation = Quat::Identity();
  std::vector<Quat> collision_rotations, visual_rotations;  ///< in the order of the file
};

struct ModelInfo {
  std::map<std::string, LinkInfo> links;
  std::map<std::string, JointInfo> joints;
  std::vector<std::string> joint_order;  ///< as in the file
  std::string root;
};

/// Stands for "no limit" in the text that urdfdom reads, which knows no infinity.
inline constexpr double no_limit = std::numeric_limits<double>::max();

/// Of the <origin> of a joint, an inertial, a collision or a visual that has passed its check.
Quat origin_rotation(const Element& owner);

// The checks. Each reports what it finds and changes the document so that urdfdom accepts the rest.

/// True, with an error reported, when the file is the source of a macro language.
bool has_macros(Element& robot, Problems& problems);
/// Reads friction and restitution and removes everything that is not link, joint or material.
void take_surfaces(Element& robot, ModelInfo& model, Problems& problems);
void check_materials(Element& robot, Problems& problems);
void check_links(Element& robot, ModelInfo& model, Problems& problems);
void check_joints(Element& robot, ModelInfo& model, Problems& problems);
/// Finds the root; every link hangs on it by exactly one way, or errors are reported.
void check_tree(ModelInfo& model, Problems& problems);

}  // namespace muro::urdf
