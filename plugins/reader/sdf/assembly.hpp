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
  const ::sdf::Link* link = nullptr;  ///< null: the world, on which joints hold the robot
  std::string name;                   ///< as a part of the robot
  Pose pose;                          ///< in the frame of the outermost model
  int parent_joint = -1;
  std::vector<int> child_joints;  ///< in the order of the file
  std::vector<int> attached;      ///< bodies that no joint leads to, held by this one; an error was reported
  At at;
};

struct Bond {
  const ::sdf::Joint* joint = nullptr;
  std::string scope;  ///< "arm::", of the model it stands in
  std::string name;   ///< as a part of the robot
  int parent = -1;    ///< -1: the world
  int child = -1;
  Pose pose;  ///< in the frame of the outermost model
  At at;
};

struct Assembly {
  std::vector<Body> bodies;
  std::vector<Bond> bonds;
  std::set<std::string> names;                ///< of all parts
  std::map<std::string, int> joints_by_name;  ///< "arm::elbow": index of the bond
  std::map<std::string, int> bodies_by_name;  ///< "arm::hand"
  int base = 0;

  /// `wanted`, or `wanted` with `suffix` behind it as often as it takes to be the only one.
  std::string unique(std::string wanted, std::string_view suffix) {
    while (!names.insert(wanted).second) wanted += suffix;
    return wanted;
  }
};

/// All links of a model, and its joints where `with_joints`. Poses are those of SDFormat's frame semantics.
Assembly assemble(const ::sdf::Model& model, bool with_joints, const Sources& sources, Problems& problems);

/// Finds the base and the joint by which each body hangs. What is no tree is reported as an error, and made one.
void make_tree(Assembly& assembly, const ::sdf::Model& model, Problems& problems);

/// A name of SDFormat as one of muro: "arm::hand" is arm.hand, and characters that names do not have are _.
std::string plain_name(std::string_view name);

Pose pose_of(const ignition::math::Pose3d& p);

}  // namespace muro::sdf
