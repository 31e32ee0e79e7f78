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
  std::string name;                   ///< as a part of the robot
  Pose pose;                          ///< in the frame of the outermost model
  int parent_joint = -1;
  std::vector<int> child_joints;  ///< in the order of the file
  bool is_caster_ball = false;    ///< rolls in a ball joint: it is fixed there, and slides without friction
  std::vector<int> attached;      ///< bodies without a joint that leads to them, fixed here
  FileLocation location;
};

struct Joint {
  const ::sdf::Joint* definition = nullptr;
  std::string scope;  ///< "arm::", of the model it stands in
  std::string name;   ///< as a part of the robot
  int parent = -1;    ///< -1: the world
  int child = -1;
  Pose pose;              ///< in the frame of the outermost model
  bool left_out = false;  ///< it would close a chain
  FileLocation location;
};

struct Assembly {
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::set<std::string> names;                ///< of bodies and joints
  std::map<std::string, int> joints_by_name;  ///< "arm::elbow": index in `joints`
  std::map<std::string, int> bodies_by_name;  ///< "arm::hand"
  int base = 0;

  /// `name`, followed by `suffix` as often as it takes to be unique.
  std::string unique(std::string name, std::string_view suffix) {
    while (!names.insert(name).second) name += suffix;
    return name;
  }
};

/// All links of a model, and its joints where `with_joints`. Poses are those of SDFormat's frame semantics.
Assembly assemble(const ::sdf::Model& model, bool with_joints, const SourceFiles& sources, Problems& problems);

/// Finds the base and the parent joint of each body. What is no tree is made one, with warnings.
void make_tree(Assembly& assembly, const ::sdf::Model& model, Problems& problems);

/// A name of SDFormat as one of muro: "arm::hand" is arm.hand, and characters that names do not have are _.
std::string plain_name(std::string_view name);

Pose pose_of(const ignition::math::Pose3d& p);

}  // namespace muro::sdf
