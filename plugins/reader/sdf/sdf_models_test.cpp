// SPDX-License-Identifier: MIT
// Robots from the example model and from small SDFormat documents.
#include <gtest/gtest.h>

#include <numbers>

#include "core/world.hpp"
#include "muro/toolkit/rotations.hpp"
#include "reading_testing.hpp"
#include "tests/support/scene.hpp"

namespace muro::sdf {
namespace {

using std::numbers::pi;
using test::ScratchFolder;

std::string example(const std::string& name) { return std::string(MURO_TEST_SOURCE_DIR) + "/examples/models/" + name; }

/// Both files are read through the plugins, as in a scenario.
TEST(SdfModels, TheRoverIsTheOneThatReaderUrdfReads) {
  test::Scene scene;
  const RobotTree sdf_tree = scene.read_model(example("rover.sdf")),
                  urdf_tree = scene.read_model(example("rover.urdf"));
  EXPECT_EQ(lines_of(sdf_tree.problems()), Lines{});
  const RobotView& a = scene.world().add_robot("a", sdf_tree, Pose{});
  const RobotView& b = scene.world().add_robot("b", urdf_tree, Pose{});
  ASSERT_EQ(a.links.size(), b.links.size());
  const auto part = [&](ObjectId id) { return id == no_object ? "" : scene.world().object_name(id).substr(2); };
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    const Link &f = a.links[i], &g = b.links[i];
    SCOPED_TRACE(part(g.object));
    EXPECT_EQ(part(f.object), part(g.object));
    EXPECT_EQ(part(f.joint_object), part(g.joint_object));
    EXPECT_EQ(f.parent, g.parent);
    EXPECT_EQ(f.joint, g.joint);
    EXPECT_TRUE(near(f.origin, g.origin));
    EXPECT_TRUE(f.joint == JointKind::fixed || f.axis.isApprox(g.axis, 1e-12));
    EXPECT_EQ(f.limits.lower, g.limits.lower);
    EXPECT_EQ(f.limits.upper, g.limits.upper);
    EXPECT_EQ(f.limits.velocity, g.limits.velocity);
    EXPECT_EQ(f.limits.effort, g.limits.effort);
    EXPECT_EQ(f.limits.damping, g.limits.damping);
    EXPECT_EQ(f.limits.friction, g.limits.friction);
    const auto &m = scene.world().value(f.object, keys::inertial), &n = scene.world().value(g.object, keys::inertial);
    EXPECT_EQ(m.mass, n.mass);
    EXPECT_TRUE(m.com.isApprox(n.com, 1e-15));
    EXPECT_TRUE(m.tensor().isApprox(n.tensor(), 1e-12));
    for (const auto& key : {keys::collision_shapes, keys::visual_shapes}) {
      const auto of = [&](ObjectId object) {
        const ArrayHeader found = scene.world().store().constant(object, key);
        return std::span<const Shape>(static_cast<const Shape*>(found.data), found.data ? found.size : 0);
      };
      const auto s = of(f.object), t = of(g.object);
      ASSERT_EQ(s.size(), t.size());
      for (std::size_t k = 0; k < s.size(); ++k) {
        EXPECT_EQ(s[k].kind, t[k].kind);
        EXPECT_EQ(s[k].size, t[k].size);
        EXPECT_TRUE(near(s[k].origin, t[k].origin));
        if (key.name == keys::visual_shapes.name) {
          EXPECT_TRUE(s[k].color.isApprox(t[k].color, 1e-6));
          continue;  // such shapes touch nothing
        }
        EXPECT_EQ(s[k].surface.friction, t[k].surface.friction);
        EXPECT_EQ(s[k].surface.restitution, t[k].surface.restitution);
      }
    }
  }
  EXPECT_NEAR(sdf_tree.standing_height(), 0.09, 1e-12);
}

TEST(SdfModels, PosesAreRelativeToAnyFrame) {
  // by hand: f is 1 m in front of a, turned left by 90 degrees; b is 2 m in front of f, so 2 m to the left of it;
  // c is 3 m above b with b's heading; the joint k is at c's origin
  const Robot robot = robot_of(model(
      link("a", "<pose>10 0 0 0 0 0</pose>") +
      "<frame name='f' attached_to='a'><pose degrees='true'>1 0 0 0 0 90</pose></frame>" +
      link("b", "<pose relative_to='f'>2 0 0 0 0 0</pose>") + link("c", "<pose relative_to='b'>0 0 3 0 0 0</pose>") +
      link("d", "<pose relative_to='k' rotation_format='quat_xyzw'>1 0 0 0 0 0 1</pose>") +
      joint("j", "fixed", "a", "b") + joint("k", "fixed", "b", "c") +
      "<joint name='l' type='fixed'><parent>f</parent><child>d</child></joint>"));
  EXPECT_EQ(robot.problems, Lines{});
  const Quat left = from_rpy(0, 0, pi / 2);
  EXPECT_TRUE(near(robot.pose("b"), {{1, 2, 0}, left}));
  EXPECT_TRUE(near(robot.pose("c"), {{1, 2, 3}, left}));
  EXPECT_TRUE(near(robot.pose("d"), {{1, 3, 3}, left}));
}

TEST(SdfModels, TheInertialPoseShiftsTheCentreAndTurnsTheTensor) {
  const Robot robot = robot_of(model(
      "<link name='a'><inertial><pose degrees='1'>1 2 3 0 0 90</pose><mass>2</mass><inertia><ixx>1</ixx><ixy>0</ixy>"
      "<ixz>0</ixz><iyy>2</iyy><iyz>0</iyz><izz>2.5</izz></inertia></inertial></link>"));
  EXPECT_EQ(robot.problems, Lines{});
  const auto inertial = robot.constants("a", keys::inertial).at(0);
  EXPECT_EQ(inertial.mass, 2);
  EXPECT_EQ(inertial.com, Vec3(1, 2, 3));
  EXPECT_TRUE(inertial.tensor().isApprox(Mat3(Vec3(2, 1, 2.5).asDiagonal()), 1e-12)) << inertial.tensor();
}

TEST(SdfModels, LinksWithoutInertiaHaveWhatSdformatGivesThem) {
  const Robot robot = robot_of(model("<link name='a'/>"));
  EXPECT_EQ(
      robot.problems,
      Lines{"warning 3:1 link `a` has no <inertial>; SDFormat's default is used, 1 kg and 1 kg m^2 about each axis"});
  EXPECT_EQ(robot.constants("a", keys::inertial).at(0).mass, 1);
  EXPECT_EQ(robot.constants("a", keys::inertial).at(0).tensor(), Mat3::Identity());
}

TEST(SdfModels, EveryShapeIsReadWithItsPlaceAndSurface) {
  const ScratchFolder folder;
  const std::string mesh = folder.file("meshes/wheel.dae", "x");
  const auto collision = [](const std::string& name, const std::string& geometry, const std::string& more = "") {
    return "<collision name='" + name + "'>" + more + "<geometry>" + geometry + "</geometry></collision>";
  };
  const std::string surface =
      "<surface><bounce><restitution_coefficient>0.3</restitution_coefficient></bounce>"
      "<friction><ode><mu>0.7</mu><mu2>0.7</mu2></ode></friction></surface>";
  const std::string bullet =
      "<surface><friction><bullet><friction>0.2</friction><rolling_friction>0.01</rolling_friction></bullet>"
      "<torsional><coefficient>0.8</coefficient><patch_radius>0.05</patch_radius></torsional></friction></surface>";
  const Robot robot =
      robot_of(model(link("a", collision("c1", "<box><size>1 2 3</size></box>", surface) +
                                   collision("c2", "<sphere><radius>0.5</radius></sphere>", bullet) +
                                   collision("c3", "<cylinder><radius>0.5</radius><length>2</length></cylinder>",
                                             "<pose>1 0 0 0 0 0</pose>") +
                                   collision("c4", "<capsule><radius>0.5</radius><length>2</length></capsule>") +
                                   collision("c5", "<plane><normal>1 0 0</normal><size>1 1</size></plane>") +
                                   collision("c6", "<mesh><uri>meshes/wheel.dae</uri><scale>1 2 3</scale></mesh>"))),
               folder.path(""));
  EXPECT_EQ(robot.problems, Lines{});
  const auto shapes = robot.constants("a", keys::collision_shapes);
  ASSERT_EQ(shapes.size(), 6u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::box);
  EXPECT_EQ(shapes[0].size, Vec3(1, 2, 3));
  EXPECT_EQ(shapes[0].surface.friction, 0.7);
  EXPECT_EQ(shapes[0].surface.restitution, 0.3);
  EXPECT_EQ(shapes[1].kind, ShapeKind::sphere);
  EXPECT_EQ(shapes[1].surface.friction, 0.2);
  EXPECT_EQ(shapes[1].surface.rolling_resistance, 0.01);
  EXPECT_NEAR(shapes[1].surface.spinning_resistance, 3 * M_PI / 16 * 0.8 * 0.05, 1e-12);
  EXPECT_EQ(shapes[0].surface.spinning_resistance, 0);
  EXPECT_EQ(shapes[2].kind, ShapeKind::cylinder);
  EXPECT_EQ(shapes[2].size, Vec3(0.5, 0, 2));
  EXPECT_EQ(shapes[2].origin.position, Vec3(1, 0, 0));
  EXPECT_EQ(shapes[2].surface.friction, 1);  // default of <mu>
  EXPECT_EQ(shapes[3].kind, ShapeKind::capsule);
  EXPECT_EQ(shapes[3].size, Vec3(0.5, 0, 2));
  EXPECT_EQ(shapes[4].kind, ShapeKind::plane);
  EXPECT_TRUE((shapes[4].origin.orientation * Vec3::UnitZ()).isApprox(Vec3::UnitX(), 1e-12));
  EXPECT_EQ(shapes[5].kind, ShapeKind::mesh);
  EXPECT_EQ(shapes[5].size, Vec3(1, 2, 3));
  EXPECT_EQ(robot.tree.texts()[shapes[5].mesh], mesh);
}

TEST(SdfModels, AFrictionBelowZeroHasNoLimit) {
  const Robot robot =
      robot_of(model(link("a",
                          "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry>\n<surface><friction>"
                          "<ode><mu>-1</mu><mu2>-1</mu2></ode></friction></surface></collision>")));
  EXPECT_EQ(robot.constants("a", keys::collision_shapes).at(0).surface.friction, 1e6);
  ASSERT_EQ(robot.problems.size(), 2u) << "one for each direction";
  EXPECT_EQ(robot.problems[0], "note 4:25 a friction of -1 has no limit, as in Gazebo: it is taken as 1e+06");
}

TEST(SdfModels, VisualsHaveTheDiffuseColourAndTheirTransparency) {
  const auto color = [](const std::string& inside) {
    const Robot robot = robot_of(model(
        link("a", "<visual name='v'>" + inside + "<geometry><sphere><radius>1</radius></sphere></geometry></visual>")));
    EXPECT_EQ(robot.problems, Lines{});
    return robot.constants("a", keys::visual_shapes).at(0).color;
  };
  EXPECT_EQ(color(""), Shape{}.color);
  EXPECT_TRUE(color("<material><ambient>1 0 0 1</ambient></material>").isApprox(Eigen::Vector4d(1, 0, 0, 1)));
  EXPECT_TRUE(color("<material><ambient>1 0 0 1</ambient><diffuse>0 0.5 1 "
                    "0.5</diffuse></material><transparency>0.5</transparency>")
                  .isApprox(Eigen::Vector4d(0, 0.5, 1, 0.25)));
}

TEST(SdfModels, NestedModelsArePartsOfTheRobotWithTheirNames) {
  const Robot robot =
      robot_of(model(link("a") + "<model name='arm'><pose>1 0 0 0 0 0</pose>" + link("upper") +
                     "<model name='tool'><pose>0 0 1 0 0 0</pose>" + link("tip", "<pose>0 2 0 0 0 0</pose>") +
                     "</model>" + joint("wrist", "revolute", "upper", "tool::tip", axis("0 1 0")) + "</model>" +
                     joint("shoulder", "prismatic", "a", "arm::upper", axis("0 0 1"))));
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_EQ(robot.blocks(), (Lines{"base a", "translation", "prismatic shoulder", "body arm.upper", "translation",
                                   "revolute arm.wrist", "body arm.tool.tip"}));
  EXPECT_TRUE(near(robot.pose("arm.tool.tip"), {{1, 2, 1}, Quat::Identity()}));
}

TEST(SdfModels, IncludesAreFoundBesideTheFileThatNamesThem) {
  const ScratchFolder folder;
  folder.file(
      "wheel/model.config",
      "<?xml version='1.0'?><model><name>w</name><sdf version='1.4'>old.sdf</sdf><sdf version='1.7'>new.sdf</sdf>"
      "<sdf version='2.0'>future.sdf</sdf></model>");
  folder.file(
      "wheel/new.sdf",
      "<sdf version='1.7'><model name='wheel'><include><uri>../parts/hub.sdf</uri><pose>0 0 1 0 0 0</pose></include>" +
          link("rim") + joint("j", "fixed", "rim", "hub::core") + "</model></sdf>");
  folder.file("parts/hub.sdf", "<sdf version='1.5'><model name='hub'>" + link("core") + "</model></sdf>");
  const std::string main = model(
      link("a") +
      "<include><uri>wheel</uri><name>left</name><pose>0 1 0 0 0 0</pose></include>"
      "<include><uri>model://wheel</uri><name>right</name><pose relative_to='left'>0 -2 0 0 0 0</pose></include>" +
      joint("jl", "continuous", "a", "left::rim", axis("0 1 0")) +
      joint("jr", "continuous", "a", "right::rim", axis("0 1 0")));
  const Robot robot = robot_of(main, folder.path(""));
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_TRUE(near(robot.pose("left.rim"), {{0, 1, 0}, Quat::Identity()}));
  EXPECT_TRUE(near(robot.pose("left.hub.core"), {{0, 1, 1}, Quat::Identity()}));
  EXPECT_TRUE(near(robot.pose("right.hub.core"), {{0, -1, 1}, Quat::Identity()}));
}

TEST(SdfModels, MergedIncludesBringTheirLinksIntoTheModel) {
  const ScratchFolder folder;
  folder.file("hub.sdf", "<sdf version='1.9'><model name='hub'>" + link("core") + "</model></sdf>");
  const Robot robot = robot_of(model(link("a") + "<include merge='true'><uri>hub.sdf</uri></include>" +
                                     joint("j", "revolute", "a", "core", axis("0 1 0"))),
                               folder.path(""));
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_NE(robot.frame("core"), nullptr);
}

/// For these files the versions differ only in the frame of axes.
TEST(SdfModels, VersionsFrom14To19MeanTheSame) {
  for (const char* version : {"1.4", "1.5", "1.6", "1.7", "1.8", "1.9"}) {
    SCOPED_TRACE(version);
    // links are turned, so that frames matter
    const Robot robot = robot_of(
        model(link("a", "<pose>0 0 1 0 0 0</pose>") + link("b", "<pose>0 0 2 0 0 1.5707963267948966</pose>") +
                  joint("j", "revolute", "a", "b", axis("1 0 0", "<limit><lower>-1</lower><upper>2</upper></limit>")),
              version));
    EXPECT_EQ(robot.problems, Lines{});
    ASSERT_NE(robot.joint("j"), nullptr);
    const Link& f = robot.joint("j")->link;
    EXPECT_TRUE(near(f.origin, {{0, 0, 1}, from_rpy(0, 0, pi / 2)}));
    EXPECT_EQ(f.limits.lower, -1);
    EXPECT_EQ(f.limits.upper, 2);
    // up to 1.4 an axis is in the frame of the model, later in that of the joint
    const Vec3 expected = std::string(version) == "1.4" ? Vec3(0, -1, 0) : Vec3(1, 0, 0);
    EXPECT_TRUE(f.axis.isApprox(expected, 1e-9)) << f.axis.transpose();
  }
}

TEST(SdfModels, AxesAreInTheFrameThatTheyName) {
  const auto of = [](const std::string& xyz, const std::string& version) {
    const Robot robot = robot_of(model(link("a") + link("b", "<pose>0 0 0 0 0 1.5707963267948966</pose>") +
                                           joint("j", "revolute", "a", "b", "<axis>" + xyz + "</axis>"),
                                       version));
    EXPECT_EQ(robot.problems, Lines{});
    return Vec3(robot.joint("j")->link.axis);
  };
  EXPECT_TRUE(of("<xyz expressed_in='__model__'>1 0 0</xyz>", "1.7").isApprox(Vec3(0, -1, 0), 1e-9));
  EXPECT_TRUE(of("<xyz expressed_in='a'>1 0 0</xyz>", "1.9").isApprox(Vec3(0, -1, 0), 1e-9));
  EXPECT_TRUE(of("<xyz>2 0 0</xyz>", "1.9").isApprox(Vec3(1, 0, 0), 1e-9));
  EXPECT_TRUE(of("<xyz>1 0 0</xyz><use_parent_model_frame>true</use_parent_model_frame>", "1.6")
                  .isApprox(Vec3(0, -1, 0), 1e-9));
}

TEST(SdfModels, NewerVersionsAreReadAs19WithAWarning) {
  const Robot robot = robot_of(model(link("a"), "1.11"));
  EXPECT_EQ(robot.problems, Lines{"warning 1:1 the file is of SDFormat `1.11` and is read as 1.9"});
  EXPECT_EQ(robot.blocks(), Lines{"base a"});
}

TEST(SdfModels, NamesBecomeNamesOfMuro) {
  const Robot robot = robot_of(
      model(link("left wheel") + link("a/b") + "\n" + joint("left wheel", "fixed", "left wheel", "a/b"), "1.6"));
  EXPECT_EQ(robot.blocks(), (Lines{"base left_wheel", "body a_b"}));
  EXPECT_EQ(robot.problems,
            Lines{"note 4:1 joint `left wheel` has the name of a link; it is called `left wheel_joint`"});
}

TEST(SdfModels, WhereAModelStandsIsTheScenariosBusiness) {
  const Robot robot = robot_of(model("<pose>1 2 3 0 0 0</pose><static>true</static>" + link("a")));
  EXPECT_EQ(robot.problems,
            (Lines{"note 2:1 the <pose> of the model is not used: the scenario says where a robot stands",
                   "note 2:1 the model is static; a robot without a motion stands still"}));
}

}  // namespace
}  // namespace muro::sdf
