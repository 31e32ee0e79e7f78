// SPDX-License-Identifier: MIT
// `packages:` of a scenario: the folders of package://NAME and model://NAME.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/error.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

constexpr char inertial[] =
    R"(<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>)";

class PackagesOfAScenario : public testing::Test {
 protected:
  PackagesOfAScenario() {
    std::filesystem::create_directories(folder_.path("far/away"));
    std::filesystem::create_directories(folder_.path("elsewhere/chair"));
    folder_.file("far/away/leg.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.file("elsewhere/chair/leg.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_.file("chair.urdf", std::string("<robot name='chair'><link name='seat'>") + inertial +
                                   "<visual><geometry>\n<mesh filename='package://chair/leg.obj'/></geometry></visual>"
                                   "</link></robot>");
    folder_.file("chair.sdf",
                 "<sdf version='1.9'><model name='chair'><link name='seat'><visual name='v'><geometry><mesh>\n"
                 "<uri>model://chair/leg.obj</uri></mesh></geometry></visual></link></model></sdf>");
    folder_.file(
        "yard.world",
        "<sdf version='1.9'><world name='w'><include><uri>model://chair/chair.sdf</uri></include></world></sdf>");
    folder_.file("far/away/chair.sdf",
                 "<sdf version='1.9'><model name='chair'><static>true</static><link name='seat'><visual "
                 "name='v'><geometry><box><size>1 1 1</size></box></geometry></visual></link></model></sdf>");
  }
  BuiltScenario built(const std::string& packages, const std::string& rest) {
    return build(read_scenario(folder_.file("s.yaml", packages + rest), {}), test::plugins());
  }
  /// Returns the mesh of the only visual shape of the robot, or "" if it is not found.
  std::string mesh(const std::string& model, const std::string& packages) {
    const BuiltScenario b = built(packages, "robots: {r: {model: " + model + "}}\n");
    const World& world = b.simulation->world();
    if (!b.notes.empty() && b.notes[0].find("is not found") != std::string::npos) return "";
    return std::string(world.text(world.values(world.robots()[0]->base(), keys::visual_shapes)[0].mesh));
  }
  test::ScratchFolder folder_;
};

TEST_F(PackagesOfAScenario, SayWhereMeshesOfBothFormatsAre) {
  for (const char* model : {"chair.urdf", "chair.sdf"}) {
    EXPECT_EQ(mesh(model, ""), "") << model;
    EXPECT_EQ(mesh(model, "packages: {chair: far/away}\n"), folder_.path("far/away/leg.obj")) << model;
  }
}

TEST_F(PackagesOfAScenario, GoBeforeTheVariables) {
  setenv("ROS_PACKAGE_PATH", folder_.path("elsewhere").c_str(), 1);
  const std::string by_variable = mesh("chair.urdf", ""), by_map = mesh("chair.urdf", "packages: {chair: far/away}\n");
  unsetenv("ROS_PACKAGE_PATH");
  EXPECT_EQ(by_variable, folder_.path("elsewhere/chair/leg.obj"));
  EXPECT_EQ(by_map, folder_.path("far/away/leg.obj"));
}

TEST_F(PackagesOfAScenario, SayWhereTheModelsOfAWorldAre) {
  const BuiltScenario b = built("packages: {chair: far/away}\n", "world: {file: yard.world}\n");
  EXPECT_NE(b.simulation->world().find_object("chair"), no_object);
}

TEST_F(PackagesOfAScenario, AreAskedForByTheMessageAboutAnUnknownOne) {
  const BuiltScenario b = built("", "robots: {r: {model: chair.urdf}}\n");
  ASSERT_FALSE(b.notes.empty());
  EXPECT_NE(b.notes[0].find("chair.urdf:2:1: warning: mesh `package://chair/leg.obj` is not found"), std::string::npos)
      << b.notes[0];
  EXPECT_NE(b.notes[0].find("package `chair` is unknown: add the folder that holds it to ROS_PACKAGE_PATH, or write "
                            "`packages: {chair: FOLDER}` in the scenario"),
            std::string::npos)
      << b.notes[0];
}

TEST_F(PackagesOfAScenario, AreFolders) {
  const auto complaint = [&](const std::string& packages) {
    return test::complaint_of([&] { built("packages: " + packages + "\n", "robots: {r: {model: chair.urdf}}\n"); });
  };
  EXPECT_SAYS(complaint("{chair: nowhere}"),
              "s.yaml:1:19: `packages`: `chair` is " + folder_.path("nowhere") + ", which is no folder");
  EXPECT_SAYS(complaint("{chair: [far]}"), "`packages`: `chair` must be the folder of the package of that name");
}

}  // namespace
}  // namespace muro::host
