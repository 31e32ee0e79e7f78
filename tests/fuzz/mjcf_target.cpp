// SPDX-License-Identifier: MIT
// MJCF as a model and as a world, read by the parser process.
#include "core/robot_tree.hpp"
#include "core/world_model.hpp"
#include "plugins/common/parser_process/ask.hpp"
#include "plugins/common/parser_process/builder_calls/replay.hpp"
#include "tests/fuzz/target.hpp"

namespace muro::fuzz {

namespace {

/// Reads the file with the parser process.
template <class Builder>
void read_mjcf(const char* service, const std::string& path, Builder& builder) {
  parser_process::Writer request;
  request.text(path);
  builder_calls::replay(
      parser_process::ask({service, "model " + path, "libmujoco-dev", "look at the file"}, request.bytes()).reader(),
      builder);
}

}  // namespace

void read_as_mjcf(Bytes bytes) {
  const std::string path = file_with(bytes, "robot.xml");
  try {
    RobotTree tree;
    read_mjcf("mjcf model", path, tree);
    for (const auto& problem : tree.problems()) outcome(problem.text);
    if (tree.usable()) tree.close();
    for (const auto& flat : tree.links())
      require(!tree.usable() || flat.link.origin.position.allFinite(), "a link is nowhere");
  } catch (const Error& e) {
    outcome(e.what());
  }
  try {
    WorldModel world;
    read_mjcf("mjcf world", path, world);
    world.close();
    for (const auto& problem : world.problems()) outcome(problem.text);
  } catch (const Error& e) {
    outcome(e.what());
  }
}

}  // namespace muro::fuzz
