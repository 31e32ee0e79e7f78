// SPDX-License-Identifier: MIT
// The meshes are the output of their script, and models with them are complete.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "examples/models/stand_testing.hpp"

namespace muro::models {
namespace {

namespace fs = std::filesystem;

std::map<std::string, std::string> files_of(const fs::path& root) {
  std::map<std::string, std::string> all;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    if (entry.is_regular_file()) all[fs::relative(entry.path(), root).string()] = test::text_of(entry.path().string());
  return all;
}

TEST(Meshes, AreThoseThatTheirScriptWrites) {
  const std::string python = MURO_PYTHON3;
  if (python.empty()) GTEST_SKIP() << "needs python3";
  const test::ScratchFolder scratch;
  const auto result = test::run_command(python + " " + folder + "make_meshes.py " + scratch.path("meshes"));
  ASSERT_EQ(result.exit_code, 0) << result.output;
  const auto written = files_of(scratch.path("meshes")), kept = files_of(folder + "meshes");
  EXPECT_EQ(written.size(), kept.size());
  for (const auto& [name, bytes] : written) EXPECT_TRUE(kept.contains(name) && kept.at(name) == bytes) << name;
}

TEST(Meshes, AreAllShownBySomeModel) {
  std::string models;
  for (const char* model : {"humanoid.urdf", "quadruped_a1.urdf", "soccer_omni.urdf", "rover.urdf"})
    models += test::text_of(folder + model);
  for (const auto& [name, bytes] : files_of(folder + "meshes"))
    if (name.ends_with(".glb")) {
      EXPECT_NE(models.find("\"meshes/" + name + "\""), std::string::npos) << name;
    }
}

TEST(Meshes, AreThereForTheStrictCheck) {
  for (const char* model : {"humanoid.urdf", "quadruped_a1.urdf", "soccer_omni.urdf", "rover.urdf", "rover.sdf"}) {
    const test::ScratchFolder scratch;
    std::string joints;
    if (model == std::string("quadruped_a1.urdf"))
      joints = ", joints: {FR_calf_joint: -1.3, FL_calf_joint: -1.3, RR_calf_joint: -1.3, RL_calf_joint: -1.3}";
    const std::string file = scratch.file("s.yaml", "robots: {r: {model: " + folder + model + joints +
                                                        ", motion: {use: motion.ode, joints: position}}}\n");
    const auto result = test::run_command("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " check --strict " +
                                          file + " 2>&1");
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_NE(result.output.find("nothing is lacking"), std::string::npos) << result.output;
  }
}

}  // namespace
}  // namespace muro::models
