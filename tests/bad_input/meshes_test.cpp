// SPDX-License-Identifier: MIT
// Collision meshes that cannot be read, as a user would give them to the program. The exit code is 2 and there is one
// message, with the scenario's line, the body, the file, the cause and what to do, whichever algorithm reads the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "muro_program.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

bool is_there(const std::string& plugin) {
  static const std::string all = "\n" + test::run_command(muro_program + " plugins list").output;
  return all.find("\n" + plugin + " ") != all.npos;
}

/// Returns binary glTF of 22 bytes whose header gives a length of 2 GB.
std::string glb_of_two_gigabytes() {
  std::string bytes = "glTF";
  for (const std::uint32_t word : {2u, 0x7fffffffu, 0x7ffffff0u, 0x4e4f534au})
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  return bytes + "{}";
}

constexpr const char* tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n";

std::string collision_of_meshes() {
  for (const char* collision : {"collision.bullet", "collision.fcl", "collision.ode"})
    if (is_there(collision)) return std::string("algorithms: {collision: {use: ") + collision + "}}\n";
  return "";
}

/// Returns a scenario with a rock that is a mesh. Balls touch it and sensors see it, each with another engine.
std::string scenario_of(const std::string& file) {
  std::string text = "world: {objects: {rock: {shape: {mesh: " + file + "}}}}\nrobots:\n";
  const std::string laser = is_there("laser.embree") ? ", lidar: {use: laser.embree, rate: 10}" : "",
                    camera = is_there("camera.opengl") ? ", eye: {use: camera.opengl, rate: 10}" : "";
  for (const char* motion : {"simplified", "bullet", "ode", "mujoco"})
    if (is_there(std::string("motion.") + motion))
      text += std::string("  ") + motion + ": {shape: {sphere: 0.5}, mass: 1, at: {z: 9}, motion: {use: motion." +
              motion + "}" + laser + camera + "}\n";
  return text + collision_of_meshes();
}

/// Returns a robot of one link whose `element` is a mesh.
std::string urdf_with(const std::string& element, const std::string& mesh) {
  return "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
         "ixz='0' iyz='0'/></inertial><" +
         element + "><geometry><mesh filename='" + mesh + "'/></geometry></" + element + "></link></robot>";
}

/// Returns the only line that `check` and `run` print, without the folder's path. Both must exit with code 2.
std::string complaint_about(const test::ScratchFolder& folder, const std::string& scenario,
                            const std::string& environment = "") {
  const std::string path = folder.file("s.yaml", scenario);
  const auto check = test::run_command(environment + " " + muro_program + " check " + path),
             run = test::run_command(environment + " " + muro_program + " run --duration 0.01 " + path);
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(check.output, run.output);
  EXPECT_EQ(std::count(run.output.begin(), run.output.end(), '\n'), 1) << run.output;
  std::string text = run.output;
  const std::string root = folder.path("");
  for (std::size_t at = 0; (at = text.find(root)) != text.npos;) text.erase(at, root.size());
  return text;
}

void expect_words(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), text.npos) << text;
}

TEST(ACollisionMesh, ThatSaysItIsLongerThanItIsEndsTheSetUp) {
  const test::ScratchFolder folder;
  folder.file("rock.glb", glb_of_two_gigabytes());
  const std::string text = complaint_about(folder, scenario_of("rock.glb"));
  expect_words(text, {"s.yaml:", "cannot be connected: `rock`: mesh rock.glb cannot be read: ", "; "});
}

TEST(ACollisionMesh, ThatTheParserProcessDiesOfEndsTheSetUp) {
  const test::ScratchFolder folder;
  folder.file("rock.obj", tetrahedron);
  expect_words(complaint_about(folder, scenario_of("rock.obj"), "MURO_PARSER_SECONDS=0.0001"),
               {"s.yaml:", "`rock`: mesh rock.obj cannot be read: that took more than ",
                "MURO_PARSER_SECONDS=SECONDS allows more", "; the file is probably damaged: write it anew"});
}

TEST(ACollisionMesh, OfARobotThatCannotBeReadIsLeftOut) {
  if (!is_there("reader.urdf")) return;
  const test::ScratchFolder folder;
  folder.file("rock.glb", glb_of_two_gigabytes());
  folder.file("pointer.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n");
  folder.file("empty.dae", "");
  for (const char* mesh : {"rock.glb", "pointer.stl", "empty.dae"}) {
    folder.file("r.urdf", urdf_with("collision", mesh));
    for (const char* motion : {"simplified", "bullet"}) {
      if (!is_there(std::string("motion.") + motion)) continue;
      const std::string path =
          folder.file("s.yaml",
                      "robots: {r: {model: r.urdf, count: 3, place: {grid: {count: [3, 1], spacing: [3, 3]}}, "
                      "motion: {use: motion." +
                          std::string(motion) + "}, lidar: {use: laser.raycast, rate: 10}}}\n");
      const auto run = test::run_command(muro_program + " run --duration 0.01 " + path);
      EXPECT_EQ(run.exit_code, 0) << run.output;
      expect_words(run.output, {"r.urdf: warning: mesh ", mesh, "; it is left out, so that nothing touches link base"});
      const auto strict = test::run_command(muro_program + " run --strict --duration 0.01 " + path);
      EXPECT_EQ(strict.exit_code, 2) << strict.output;
      expect_words(strict.output, {"--strict lets no collision shape be left out"});
    }
  }
}

TEST(ACollisionMesh, ThatIsNotThereEndsTheSetUp) {
  const test::ScratchFolder folder;
  EXPECT_EQ(
      complaint_about(folder, scenario_of("rock.stl")),
      "s.yaml:1:40: mesh file rock.stl does not exist; correct its path, which starts at the folder of this file\n");
}

TEST(ACollisionMesh, OfARobotThatIsNotThereIsLeftOut) {
  if (!is_there("reader.urdf")) return;
  const test::ScratchFolder folder;
  folder.file("r.urdf", urdf_with("collision", "rock.stl"));
  const std::string path = folder.file("s.yaml", "robots: {r: {model: r.urdf, motion: {use: motion.simplified}}}\n");
  const auto result = test::run_command(muro_program + " check " + path);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  expect_words(result.output, {"r.urdf:1:152: warning: mesh `rock.stl` is not found and left out, so that nothing "
                               "touches the links there; looked for ",
                               "; correct its path"});
}

/// A comparison of each triangle with each other one would take minutes.
TEST(ACollisionMesh, OfManyTrianglesAtOnePlaceIsDrawnInTime) {
  if (!is_there("laser.zbuffer")) return;
  const test::ScratchFolder folder;
  std::string text = tetrahedron;
  for (int i = 0; i < 100000; ++i) text += "f 1 3 2\n";
  folder.file("rock.obj", text);
  const std::string path = folder.file("s.yaml",
                                       "world: {objects: {rock: {shape: {mesh: rock.obj}}}}\n"
                                       "robots: {ball: {shape: {sphere: 0.5}, mass: 1, at: {z: 9}, "
                                       "motion: {use: motion.point}, lidar: {use: laser.zbuffer, rate: 10}}}\n");
  const auto result = test::run_command(muro_program + " check " + path);
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST(AVisualMesh, ThatCannotBeReadIsAWarning) {
  if (!is_there("camera.opengl")) return;
  const test::ScratchFolder folder;
  folder.file("rock.glb", glb_of_two_gigabytes());
  folder.file("r.urdf", urdf_with("visual", "rock.glb"));
  const std::string path = folder.file("s.yaml",
                                       "robots: {r: {model: r.urdf, motion: {use: motion.simplified}, "
                                       "eye: {use: camera.opengl, rate: 10}}}\n");
  const auto result = test::run_command(muro_program + " check " + path);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  expect_words(result.output, {"`r/base`: mesh ", "rock.glb cannot be read: ", "; it is not drawn\n"});
}

}  // namespace
}  // namespace muro
