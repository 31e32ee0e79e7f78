// SPDX-License-Identifier: MIT
// The components of the reader, each tested alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <numbers>

#include "muro/algorithm.hpp"
#include "plugins/common/model_file/inertia.hpp"
#include "plugins/common/model_file/mesh_path.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "recording_builder.hpp"
#include "urdfdom_parse.hpp"

namespace muro::urdf {
namespace {

namespace fs = std::filesystem;
using model_file::check_tensor;
using model_file::find_mesh;
using model_file::MeshPath;
using model_file::TensorError;
using model_file::uniform_density_inertia;
using Lines = std::vector<std::string>;

/// A folder that is removed after the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (fs::temp_directory_path() / "muro_urdf_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TemporaryFolder() { fs::remove_all(path_); }
  fs::path add(const std::string& file) const {
    fs::create_directories((path_ / file).parent_path());
    std::ofstream(path_ / file) << "solid\nendsolid\n";
    return path_ / file;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { setenv(name, value.c_str(), 1); }
  ~Environment() { unsetenv(name_); }

 private:
  const char* name_;
};

TEST(UrdfMeshPath, APackageIsAFolderAboveOrBesideTheModel) {
  const TemporaryFolder folder;
  const std::string mesh = folder.add("rover_description/meshes/wheel.stl");
  EXPECT_EQ(find_mesh("package://rover_description/meshes/wheel.stl", folder.path() / "rover_description/urdf").path,
            mesh);
  EXPECT_EQ(find_mesh("package://rover_description/meshes/wheel.stl", folder.path() / "other/urdf").path, mesh);
  EXPECT_EQ(find_mesh("package://rover_description/meshes/wheel.stl", folder.path()).path, mesh);
  EXPECT_EQ(find_mesh("model://rover_description/meshes/wheel.stl", folder.path()).path, mesh);
  EXPECT_EQ(find_mesh("package://nobody/meshes/wheel.stl", folder.path()).path, "");
}

TEST(UrdfMeshPath, PackagesAreFoundInWorkspacesOfRosAndGazebo) {
  const TemporaryFolder folder, model;
  const std::string ros = folder.add("src/first/m.stl"), ament = folder.add("install/share/second/m.stl");
  const std::string gazebo = folder.add("models/third/m.stl");
  const Environment one("ROS_PACKAGE_PATH", "/no/where:" + (folder.path() / "src").string());
  const Environment two("AMENT_PREFIX_PATH", (folder.path() / "install").string());
  const Environment three("GAZEBO_MODEL_PATH", (folder.path() / "models").string() + "::");
  EXPECT_EQ(find_mesh("package://first/m.stl", model.path()).path, ros);
  EXPECT_EQ(find_mesh("package://second/m.stl", model.path()).path, ament);
  EXPECT_EQ(find_mesh("model://third/m.stl", model.path()).path, gazebo);
  EXPECT_EQ(find_mesh("package://third/m.stl", model.path()).path, gazebo) << "as Gazebo reads URDF";
  const MeshPath none = find_mesh("package://fourth/m.stl", model.path());
  EXPECT_EQ(none.path, "");
  EXPECT_NE(std::find(none.searched.begin(), none.searched.end(), folder.path() / "install/share/fourth/m.stl"),
            none.searched.end());
}

TEST(UrdfMeshPath, ResourcesAreFoundByTheVariablesOfAllGazebos) {
  const TemporaryFolder folder, model;
  const std::string mesh = folder.add("chair/m.stl"), loose = folder.add("media/x.stl");
  for (const char* variable : {"GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH"}) {
    const Environment set(variable, "/no/where:" + folder.path().string());
    EXPECT_EQ(find_mesh("model://chair/m.stl", model.path()).path, mesh) << variable;
    EXPECT_EQ(find_mesh("media/x.stl", model.path()).path, loose) << variable;
  }
  const Environment set("GAZEBO_RESOURCE_PATH", folder.path().string());
  EXPECT_EQ(find_mesh("file://media/x.stl", model.path()).path, loose);
  EXPECT_EQ(find_mesh("model://chair/m.stl", model.path()).path, "");
}

TEST(UrdfMeshPath, APackageIsKnownByItsPackageXmlWhereverItLies) {
  const TemporaryFolder folder, model;
  const auto package = [](const fs::path& file, const std::string& name) {
    std::ofstream(file) << "<package format='3'>\n  <name> " << name << " </name>\n</package>\n";
  };
  const std::string here = folder.add("robot-main/meshes/m.stl");
  package(folder.add("robot-main/package.xml"), "robot_description");
  EXPECT_EQ(find_mesh("package://robot_description/meshes/m.stl", folder.path() / "robot-main/urdf").path, here);
  const std::string deep = folder.add("src/vendor/arm_description/m.stl");
  package(folder.add("src/vendor/arm_description/package.xml"), "arm_description");
  const Environment set("ROS_PACKAGE_PATH", (folder.path() / "src").string());
  EXPECT_EQ(find_mesh("package://arm_description/m.stl", model.path()).path, deep);
  EXPECT_EQ(find_mesh("package://vendor_description/m.stl", model.path()).path, "");
}

TEST(UrdfMeshPath, AFolderThatTheUserNamesGoesBeforeAllOthers) {
  const TemporaryFolder folder;
  folder.add("arm/m.stl");
  const std::string named = folder.add("elsewhere/m.stl");
  const model_file::Packages packages = {{"arm", folder.path() / "elsewhere"}};
  EXPECT_EQ(find_mesh("package://arm/m.stl", folder.path(), packages).path, named);
  const MeshPath missing = find_mesh("package://arm/n.stl", folder.path(), packages);
  EXPECT_EQ(missing.searched, std::vector<fs::path>{folder.path() / "elsewhere/n.stl"});
  EXPECT_EQ(model_file::advice_for_missing("package://arm/n.stl", missing),
            "package `arm` is found, but not this file in it");
}

TEST(UrdfMeshPath, FilesAreRelativeToTheModelOrAbsoluteInAnyWriting) {
  const TemporaryFolder folder;
  const std::string mesh = folder.add("meshes/the wheel.stl");
  const fs::path urdf = folder.path() / "urdf";
  EXPECT_EQ(find_mesh("../meshes/the wheel.stl", urdf).path, mesh);
  EXPECT_EQ(find_mesh("..\\meshes\\the wheel.stl", urdf).path, mesh);
  EXPECT_EQ(find_mesh(mesh, urdf).path, mesh);
  EXPECT_EQ(find_mesh("file://" + folder.path().string() + "/meshes/the%20wheel.stl", urdf).path, mesh);
  EXPECT_EQ(find_mesh("C:\\Users\\me\\meshes\\the wheel.stl", folder.path()).path, mesh);
  EXPECT_EQ(find_mesh("file:///C:/Users/me/meshes/the%20wheel.stl", folder.path()).path, mesh);
}

TEST(UrdfMeshPath, APathOfAnotherComputerIsLookedForByItsEnd) {
  const TemporaryFolder folder;
  const std::string mesh = folder.add("meshes/visual/hand.stl");
  folder.add("hand.stl");
  const fs::path urdf = folder.path() / "urdf";
  fs::create_directory(urdf);
  for (const char* name : {"/home/me/ws/src/arm/meshes/visual/hand.stl", "file:///opt/arm/meshes/visual/hand.stl",
                           "D:\\arm\\meshes\\visual\\hand.stl"}) {
    const MeshPath found = find_mesh(name, urdf);
    EXPECT_EQ(found.path, mesh) << name;
    EXPECT_TRUE(found.elsewhere) << name;
  }
  EXPECT_FALSE(find_mesh(mesh, urdf).elsewhere);
  EXPECT_EQ(find_mesh("/home/me/arm/meshes/visual/foot.stl", urdf).path, "");
}

TEST(UrdfMeshPath, WhereAPackageIsNowhereTheFoldersAboveTheModelAreTakenForIt) {
  const TemporaryFolder folder;
  const std::string mesh = folder.add("clone/meshes/hand.stl");
  folder.add("other/arm/package.xml");
  const fs::path urdf = folder.path() / "clone/urdf";
  fs::create_directory(urdf);
  const MeshPath found = find_mesh("package://arm_description/meshes/hand.stl", urdf);
  EXPECT_EQ(found.path, mesh);
  EXPECT_TRUE(found.elsewhere);
  const model_file::Packages packages = {{"arm_description", folder.path() / "other/arm"}};
  EXPECT_EQ(find_mesh("package://arm_description/meshes/hand.stl", urdf, packages).path, "");
}

TEST(UrdfMeshPath, ANameInOtherCaseIsFoundAndReported) {
  const TemporaryFolder folder;
  const std::string mesh = folder.add("Wheel.STL");
  const MeshPath found = find_mesh("wheel.stl", folder.path());
  EXPECT_EQ(found.path, mesh);
  EXPECT_TRUE(found.other_case);
  EXPECT_FALSE(find_mesh("Wheel.STL", folder.path()).other_case);
}

TEST(UrdfMeshPath, AMeshIsInternedWithItsScale) {
  const TemporaryFolder folder;
  const std::string mesh = folder.add("wheel.stl");
  const auto robot = recorded(
      "<robot name='r'><link name='a'><visual><geometry><mesh filename='wheel.stl' scale='1 -2 3'/>"
      "</geometry></visual></link></robot>",
      folder.path());
  const Shape& shape = robot.visuals.at("a").at(0);
  EXPECT_EQ(shape.kind, ShapeKind::mesh);
  EXPECT_EQ(robot.texts.at(std::size_t(shape.mesh)), mesh);
  EXPECT_EQ(shape.size, Vec3(1, -2, 3));
}

TEST(UrdfInertia, UniformDensityGivesTheTextbookTensor) {
  using std::numbers::pi;
  const Shape box = Shape::box({1, 2, 3}), sphere = Shape::sphere(0.5), cylinder = Shape::cylinder(0.3, 2);
  const auto one = [](const Shape& s, double mass) { return uniform_density_inertia(std::span(&s, 1), mass); };
  EXPECT_NEAR(one(box, 6).ixx, 6 * (4 + 9) / 12.0, 1e-12);
  EXPECT_NEAR(one(sphere, 3).izz, 0.4 * 3 * 0.25, 1e-12);
  EXPECT_NEAR(one(cylinder, 5).izz, 0.5 * 5 * 0.09, 1e-12);
  EXPECT_NEAR(one(cylinder, 5).ixx, 5 * (3 * 0.09 + 4) / 12, 1e-12);
  // two equal balls on a bar without mass: Steiner's theorem
  Shape balls[] = {sphere, sphere};
  balls[0].origin.position = {2, 0, 0};
  balls[1].origin.position = {-2, 0, 0};
  const Inertia dumbbell = uniform_density_inertia(balls, 2);
  EXPECT_NEAR(dumbbell.ixx, 2 * 0.4 * 0.25, 1e-12);
  EXPECT_NEAR(dumbbell.iyy, 2 * (0.4 * 0.25 + 4), 1e-12);
  // a ball of water of 1 m radius
  EXPECT_NEAR(uniform_density_inertia({}, 4000 * pi / 3).iyy, 0.4 * 4000 * pi / 3, 1e-9);
}

TEST(UrdfInertia, ATensorIsCheckedByItsPrincipalMoments) {
  const auto error = [](double xx, double yy, double zz, double xy) {
    return check_tensor(Inertia{.ixx = xx, .iyy = yy, .izz = zz, .ixy = xy}.tensor()).error;
  };
  EXPECT_EQ(error(1, 1, 1, 0), TensorError::none);
  EXPECT_EQ(error(1, 2, 3, 0), TensorError::none);  // a flat plate
  EXPECT_EQ(error(1, 1, 2.5, 0), TensorError::violates_triangle_inequality);
  EXPECT_EQ(error(1, 1, 1, 0.9), TensorError::violates_triangle_inequality);
  EXPECT_EQ(error(1, 1, 1, 1.1), TensorError::not_positive_definite);
  EXPECT_EQ(error(0, 0, 0, 0), TensorError::not_positive_definite);
  EXPECT_EQ(error(-1, 1, 1, 0), TensorError::not_positive_definite);
}

TEST(UrdfParse, WhatUrdfdomPrintsBecomesReports) {
  RecordingBuilder builder;
  Problems problems = Problems::reported_to(builder);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  EXPECT_EQ(parse_with_urdfdom("<robot/>", problems), nullptr);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(builder.problems, Lines{"error 0:0 urdfdom: No name given for the robot."});
}

TEST(UrdfParse, WhatUrdfdomComplainsAboutIsCorrectedBefore) {
  const std::string joint = "<parent link='a'/><child link='b'/>";
  const std::string shape = "<geometry><sphere radius=' 1 '/></geometry>";
  const Lines odd = {
      "<link name='b'><inertial/><visual/></link><joint name='j' type='revolute'>" + joint + "</joint>",
      "<link name='b'><visual>" + shape + "<material/></visual></link><joint name='j' type='prismatic'>" + joint +
          "<limit/><dynamics/><safety_controller/><calibration rising='x'/><mimic/></joint>",
      "<link name='b'><visual>" + shape +
          "<material name='%n'/></visual></link>"
          "<joint name='j' type='planar'>" +
          joint + "<limit/><mimic/></joint>",
      "<material/><material name='m'/><link name='b'/><joint name='j' type='floating'>" + joint + "</joint>"};
  for (const std::string& part : odd) {
    testing::internal::CaptureStderr();
    const auto robot = recorded("<robot version='7'><link name='a'/>" + part + "</robot>");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_FALSE(robot.calls.empty());
    for (const std::string& problem : robot.problems) EXPECT_EQ(problem.find("urdfdom"), problem.npos) << problem;
  }
}

TEST(UrdfText, FilesThatCannotBeReadAreErrorsWithTheirPath) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      model_file::load_file(path, ".urdf");
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const TemporaryFolder folder;
  EXPECT_EQ(message("/no/where.urdf"), "there is no file /no/where.urdf");
  EXPECT_EQ(message(folder.path()), folder.path().string() + " is not a file; give the path of a .urdf file");
  const std::string huge = folder.add("huge.urdf");
  fs::resize_file(huge, 65u << 20);  // sparse
  EXPECT_EQ(message(huge), huge + " has 65 MiB, and a model may have 64; keep meshes in files of their own");
}

TEST(UrdfText, NamesInMessagesAreShortAndPrintable) {
  EXPECT_EQ(quote("a\tb\x1b[31m"), "`a\\x09b\\x1b[31m`");
  EXPECT_EQ(quote(std::string(300, 'x')), "`" + std::string(256, 'x') + "...`");
  std::string umlauts;
  for (int i = 0; i < 200; ++i) umlauts += "\xc3\xa4";
  EXPECT_EQ(quote("x" + umlauts), "`x" + umlauts.substr(0, 254) + "...`");
}

}  // namespace
}  // namespace muro::urdf
