// SPDX-License-Identifier: MIT
#include "host/scenario/features/unsupported_features.hpp"

#include <gtest/gtest.h>

#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string urban = MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml";
const std::string muro_program =
    std::string("cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

std::vector<UnsupportedFeatures> unsupported(const std::vector<std::string>& overrides = {}) {
  return find_unsupported_features(build(read_scenario(urban, overrides), test::plugins()));
}

TEST(UnsupportedFeatures, WhatADescriptionFileSaysOfFeaturesIsWhatThePluginSays) {
  int motions = 0;
  for (const CatalogEntry& o : test::plugins().catalog()) {
    if (o.kind != "motion") {
      EXPECT_FALSE(o.features) << o.id;
      continue;
    }
    ++motions;
    ASSERT_TRUE(o.features) << o.id;
    EXPECT_EQ(*o.features, test::plugins().algorithm(o.id).description->features) << o.id;
  }
  EXPECT_GE(motions, 3);
}

TEST(UnsupportedFeatures, TheUrbanTeamHasNone) { EXPECT_TRUE(unsupported().empty()); }

TEST(UnsupportedFeatures, AKinematicLevelIsToldInOneShortLine) {
  const auto point = unsupported({"robots.rovers.motion.use=motion.point"});
  ASSERT_EQ(point.size(), 1u) << "one for twenty robots";
  EXPECT_EQ(point[0].robots, "rovers");
  EXPECT_EQ(point[0].motion, "motion.point");
  EXPECT_EQ(point[0].location.line, 14);
  EXPECT_EQ(text_of(point[0], Detail::brief), "forces and contacts do not move it");
  EXPECT_EQ(text_of(point[0], Detail::full),
            "forces and contacts do not move it; therefore not supported either: joint_effort_limits (4 joints), "
            "joint_damping (4 joints), joint_friction (4 joints), gyroscopic, contact, friction");
  const auto drive = unsupported({"robots.rovers.motion.use=motion.differential_drive"});
  ASSERT_EQ(drive.size(), 1u);
  EXPECT_EQ(text_of(drive[0], Detail::brief), "forces and contacts do not move it");
}

TEST(UnsupportedFeatures, EachMotionOfATemplateIsToldOnce) {
  const auto mixed =
      unsupported({"robots.rovers[0-4].motion.use=motion.differential_drive",
                   "robots.rovers[5-6].motion.use=motion.point", "robots.rovers[8].motion.use=motion.point"});
  ASSERT_EQ(mixed.size(), 2u);
  EXPECT_EQ(mixed[0].motion, "motion.differential_drive");
  EXPECT_EQ(mixed[1].motion, "motion.point");
}

TEST(UnsupportedFeatures, LinkDynamicsAreNotSupportedByALevelOfOneBody) {
  const test::ScratchFolder folder;
  const std::string file =
      folder.file("arm.yaml", "robots:\n  arm: {model: " MURO_TEST_SOURCE_DIR
                              "/examples/models/arm.urdf, motion: {use: motion.simplified, base: fixed}}\n");
  const auto all = find_unsupported_features(build(read_scenario(file, {}), test::plugins()));
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(text_of(all[0], Detail::brief).rfind("moving links do not push back on the base (", 0), 0u)
      << text_of(all[0], Detail::full);
}

TEST(UnsupportedFeatures, ANoteOfARunIsAnErrorWithStrict) {
  const std::string point = " examples/urban/urban.yaml --set robots.rovers.motion.use=motion.point";
  const std::string what =
      "`motion.point` does not support all features that `rovers` uses: forces and contacts do not move it\n";
  const auto run = test::run_command(muro_program + " run --duration 0.01" + point);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_EQ(run.output.rfind("examples/urban/urban.yaml:14:13: note: " + what, 0), 0u) << run.output;
  const auto strict = test::run_command(muro_program + " run --strict --duration 0.01" + point);
  EXPECT_EQ(strict.exit_code, 2);
  EXPECT_EQ(strict.output,
            "examples/urban/urban.yaml:14:13: " + what +
                "--strict allows no unsupported features; choose a motion that supports them, or leave --strict out\n");
  EXPECT_EQ(test::run_command(muro_program + " check --strict examples/urban/urban.yaml").exit_code, 0);
}

TEST(UnsupportedFeatures, ACollisionMeshThatIsNotFoundIsAnErrorWithStrict) {
  const test::ScratchFolder folder;
  const std::string mesh = "<geometry><mesh filename='gone.stl'/></geometry>",
                    inertial =
                        "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>"
                        "</inertial>";
  const auto model = [&](const std::string& name, const std::string& inside) {
    folder.file(name + ".urdf", "<robot name='r'><link name='l'>" + inertial + "\n" + inside + "</link></robot>");
    return folder.file(name + ".yaml", "world: {objects: {ground: {shape: plane}}}\nrobots: {r: {model: " + name +
                                           ".urdf, motion: {use: motion.simplified}}}\n");
  };
  const std::string touched = model("touched", "<collision>" + mesh + "</collision>"),
                    seen = model("seen", "<visual>" + mesh +
                                             "</visual><collision><geometry><box size='1 1 1'/>"
                                             "</geometry></collision>");
  for (const char* command : {" check ", " run --duration 0.01 "}) {
    const auto lenient = test::run_command(muro_program + command + touched);
    EXPECT_EQ(lenient.exit_code, 0) << lenient.output;
    EXPECT_NE(lenient.output.find("touched.urdf:2:22: warning: mesh `gone.stl` is not found"), std::string::npos)
        << lenient.output;
    const auto strict = test::run_command(muro_program + command + "--strict " + touched);
    EXPECT_EQ(strict.exit_code, 2);
    EXPECT_NE(strict.output.find("touched.urdf:2:22: mesh `gone.stl` is not found and left out, so that nothing "
                                 "touches the links there"),
              std::string::npos)
        << strict.output;
    EXPECT_NE(
        strict.output.find("--strict lets no collision shape be left out; mend the files or their paths, or leave "
                           "--strict out\n"),
        std::string::npos)
        << strict.output;
    EXPECT_EQ(test::run_command(muro_program + command + "--strict " + seen).exit_code, 0) << "it is only seen";
  }
}

TEST(UnsupportedFeatures, TheFeaturesOfAMotionAreShown) {
  const auto info = test::run_command(muro_program + " plugins info motion.differential_drive");
  EXPECT_NE(info.output.find("\nfeatures      [\"joints\",\"velocity_targets\","), std::string::npos) << info.output;
}

}  // namespace
}  // namespace muro::host
