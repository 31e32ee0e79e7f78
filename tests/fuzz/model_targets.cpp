// SPDX-License-Identifier: MIT
// Models and worlds: the host can use whatever a reader accepts.
#include "core/robot_tree.hpp"
#include "core/world_model.hpp"
#include "muro/algorithm.hpp"
#include "plugins/reader/sdf/read.hpp"
#include "plugins/reader/urdf/read.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

void check(RobotTree& tree) {
  for (const auto& problem : tree.problems()) outcome(problem.text);
  if (!tree.usable()) return;
  tree.close();
  if (!tree.usable()) return;
  for (const auto& flat : tree.links()) {
    require(flat.link.origin.position.allFinite(), "a link is nowhere");
    require(std::abs(flat.link.origin.orientation.norm() - 1) < 1e-9, "a rotation is none");
  }
}

}  // namespace

void read_as_urdf(Bytes bytes) {
  RobotTree tree;
  try {
    urdf::read_text(text_of(bytes), "/nowhere", tree);
  } catch (const Error& e) {
    return outcome(e.what());
  }
  check(tree);
}

/// Reads SDFormat as a model and as a world.
void read_as_sdf(Bytes bytes) {
  RobotTree tree;
  try {
    sdf::read_text(text_of(bytes), "/nowhere", tree);
    check(tree);
  } catch (const Error& e) {
    outcome(e.what());
  }
  WorldModel world;
  try {
    sdf::read_world_text(text_of(bytes), "/nowhere", world);
    world.close();
    for (const auto& problem : world.problems()) outcome(problem.text);
  } catch (const Error& e) {
    outcome(e.what());
  }
}

}  // namespace muro::fuzz
