// SPDX-License-Identifier: MIT
// A model with all models nested in it, as one set of bodies and joints in one frame.
#pragma once

#include <map>
#include <sdf/Joint.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <set>

#include "library.hpp"
#include "muro/geometry.hpp"

namespace muro::sdf {

struct Body {
  const ::sdf::Link* link = nullptr;  ///< null: the world, to which joints fix the robot
  std::string name;                   ///< name of the part of the robot
  Pose pose;                          ///< in the frame of the outermost model
  int parent_joint = -1;
  std::vector<int> child_joints;  ///< in the order of the file
  bool is_caster_ball = false;    ///< rolls in a ball joint: here it is fixed and slides without friction
  std::vector<int> attached;      ///< bodies fixed to this one, as no joint leads to them
  FileLocation location;
};

struct Joint {
  const ::sdf::Joint* definition = nullptr;
  std::string scope;  ///< "arm::": model that contains the joint
  std::string name;   ///< name of the part of the robot
  int parent = -1;    ///< -1: the world
  int child = -1;
  Pose pose;              ///< in the frame of the outermost model
  bool left_out = false;  ///< whether it would close a chain
  FileLocation location;
};

struct Assembly {
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::set<std::string> names;                ///< names of bodies and joints
  std::map<std::string, int> joints_by_name;  ///< "arm::elbow": index in `joints`
  std::map<std::string, int> bodies_by_name;  ///< "arm::hand"
  int base = 0;

  /// Returns `name`, followed by `suffix` as often as needed to be unique.
  std::string unique(std::string name, std::string_view suffix) {
    while (!names.insert(name).second) name += suffix;
    return name;
  }
};

/// Collects all links of a model, and also its joints if `with_joints`. Poses follow SDFormat's frame semantics.
Assembly assemble(const ::sdf::Model& model, bool with_joints, const SourceFiles& sources, Problems& problems);

/// Finds the base, and the parent joint of each body. A model that is no tree is changed to one, with warnings.
void make_tree(Assembly& assembly, const ::sdf::Model& model, Problems& problems);

/// Returns the muro name of an SDFormat name: "arm::hand" is arm.hand, and characters that are not allowed are _.
std::string plain_name(std::string_view name);

Pose pose_of(const ignition::math::Pose3d& p);

}  // namespace muro::sdf
