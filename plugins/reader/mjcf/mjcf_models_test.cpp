// SPDX-License-Identifier: MIT
// Robots from MJCF files, compared with MuJoCo's own kinematics of the same file.
#include <random>

#include "muro/toolkit/joint_drives.hpp"
#include "plugins/common/mesh/mesh.hpp"
#include "plugins/common/parser_process/builder_calls/model_constants.hpp"
#include "reading_testing.hpp"

namespace muro::mjcf {
namespace {

struct Data {
  explicit Data(const mjModel& m) : d(mj_makeData(&m)) {}
  ~Data() { mj_deleteData(d); }
  Data(const Data&) = delete;
  mjData* d;
};

/// A humanoid: nested default classes, several joints for one body with different anchors, fromto, degrees, references.
const std::string humanoid = R"(<mujoco model="humanoid">
<compiler angle="degree" inertiafromgeom="true"/>
<default>
  <joint type="hinge" damping="0.2" armature="0.01" limited="true"/>
  <geom condim="3" friction="0.7 0.01 0.002" density="900"/>
  <default class="big"><joint damping="5" armature="0.02"/><default class="bigger"><joint armature="0.03"/></default></default>
</default>
<worldbody>
 <geom name="floor" type="plane" size="10 10 1"/>
 <body name="torso" pos="0 0 1.4" euler="0 10 0">
  <freejoint name="root"/>
  <camera name="eye" pos="0.1 0 0.3" xyaxes="0 -1 0 0 0 1"/>
  <geom name="chest" type="capsule" fromto="0 -0.07 0 0 0.07 0" size="0.07"/>
  <geom name="head" type="sphere" pos="0 0 0.19" size="0.09"/>
  <body name="lower_waist" pos="-0.01 0 -0.26" quat="1 0 -0.002 0">
   <joint name="abdomen_z" class="big" axis="0 0 1" pos="0 0 0.065" range="-45 45"/>
   <joint name="abdomen_y" class="bigger" axis="0 1 0" pos="0.02 0 0.065" range="-75 30"/>
   <geom type="box" size="0.06 0.05 0.04"/>
   <body name="pelvis" pos="0 0 -0.165" quat="1 0 -0.002 0">
    <joint name="abdomen_x" class="big" axis="1 0 0" pos="0 0 0.1" range="-35 35" ref="10"/>
    <geom type="capsule" fromto="-0.02 -0.07 0 -0.02 0.07 0" size="0.09"/>
    <body name="right_thigh" pos="0 -0.1 -0.04">
     <joint name="hip_x" axis="1 0 0" range="-25 5"/>
     <joint name="hip_z" axis="0 0 1" range="-60 35"/>
     <joint name="hip_y" axis="0 1 0" range="-110 20"/>
     <geom type="capsule" fromto="0 0 0 0 0.01 -0.34" size="0.06"/>
     <body name="right_shin" pos="0 0.01 -0.403">
      <joint name="knee" pos="0 0 0.02" axis="0 -1 0" range="-160 -2"/>
      <joint name="telescope" type="slide" axis="0 0.1 1" range="-0.1 0.2" ref="0.05"/>
      <geom type="cylinder" fromto="0 0 0 0 0 -0.3" size="0.049"/>
      <site name="foot" pos="0 0 -0.35" euler="0 0 30"/>
     </body>
    </body>
   </body>
  </body>
 </body>
</worldbody>
<actuator>
 <motor name="abdomen_z" joint="abdomen_z" gear="100" ctrllimited="true" ctrlrange="-0.4 0.4"/>
 <position name="knee_servo" joint="knee" kp="20" gear="3" forcelimited="true" forcerange="-30 50"/>
 <velocity joint="telescope" kv="3"/>
</actuator>
</mujoco>)";

TEST(MjcfModels, LinksStandWhereMuJoCoPutsTheBodies) {
  const Robot robot = robot_of(humanoid);
  const Compiled compiled = compile(humanoid, "/nowhere/robot.xml");
  ASSERT_TRUE(compiled.model) << compiled.error;
  const mjModel& m = *compiled.model;
  const Data data(m);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-1, 1);
  for (int k = 0; k < 20; ++k) {
    std::map<std::string, double> positions;
    mj_resetData(&m, data.d);
    for (int j = 1; j < m.njnt; ++j) {
      const double q = angle(random);
      data.d->qpos[m.jnt_qposadr[j]] = q;
      positions[name_of(m, m.name_jntadr, j)] = q;
    }
    mj_kinematics(&m, data.d);
    const Pose torso = pose_of(data.d->xpos + 3, data.d->xquat + 4);
    for (int b = 1; b < m.nbody; ++b)
      EXPECT_TRUE(near(torso * robot.pose(name_of(m, m.name_bodyadr, b), positions),
                       pose_of(data.d->xpos + 3 * b, data.d->xquat + 4 * b), 1e-12))
          << name_of(m, m.name_bodyadr, b);
    mjtNum quaternion[4];
    mju_mat2Quat(quaternion, data.d->site_xmat);
    EXPECT_TRUE(near(torso * robot.pose("foot", positions), pose_of(data.d->site_xpos, quaternion), 1e-12));
  }
}

TEST(MjcfModels, MassesInertiasAndJointsAreThoseOfTheCompiler) {
  const Robot robot = robot_of(humanoid);
  const Compiled compiled = compile(humanoid, "/nowhere/robot.xml");
  const mjModel& m = *compiled.model;
  for (int b = 1; b < m.nbody; ++b) {
    const auto inertia = robot.constants(name_of(m, m.name_bodyadr, b), keys::inertial);
    ASSERT_EQ(inertia.size(), 1u);
    EXPECT_EQ(inertia[0].mass, m.body_mass[b]);
    const Mat3 axes = quaternion_of(m.body_iquat + 4 * b).toRotationMatrix();
    const Mat3 principal = axes.transpose() * inertia[0].tensor() * axes;
    EXPECT_NEAR((principal.diagonal() - vector_of(m.body_inertia + 3 * b)).norm(), 0, 1e-15);
  }
  const JointLimits knee = robot.joint("knee")->link.limits;
  EXPECT_NEAR(knee.lower, -160 * M_PI / 180, 1e-12);
  EXPECT_NEAR(knee.upper, -2 * M_PI / 180, 1e-12);
  EXPECT_EQ(knee.damping, 0.2);
  EXPECT_EQ(knee.armature, 0.01);
  EXPECT_EQ(knee.effort, 3 * 50);
  EXPECT_EQ(robot.joint("abdomen_z")->link.limits.effort, 40);
  EXPECT_EQ(robot.joint("abdomen_y")->link.limits.damping, 5);
  EXPECT_EQ(robot.joint("abdomen_y")->link.limits.armature, 0.03);
  EXPECT_TRUE(std::isinf(robot.joint("hip_x")->link.limits.effort));
  EXPECT_NEAR(robot.constants("abdomen_x", keys::initial_joint_position)[0], 10 * M_PI / 180, 1e-12);
}

TEST(MjcfModels, ActuatorsAreDriveModesAndOtherJointsPassive) {
  const Robot robot = robot_of(humanoid);
  const auto mode = [&](const char* joint) { return DriveMode(robot.constants(joint, keys::joint_drive).at(0)); };
  EXPECT_EQ(mode("abdomen_z"), DriveMode::effort);
  EXPECT_EQ(mode("knee"), DriveMode::position);
  EXPECT_EQ(mode("telescope"), DriveMode::velocity);
  EXPECT_EQ(mode("hip_x"), DriveMode::passive);
  // the servo acts on gear times the position, so kp is multiplied by gear twice
  EXPECT_EQ(robot.constants("knee", keys::joint_drive_stiffness).at(0), 20 * 3 * 3);
  EXPECT_EQ(robot.constants("knee", keys::joint_drive_damping).at(0), 0);
  EXPECT_TRUE(robot.constants("telescope", keys::joint_drive_stiffness).empty());
}

TEST(MjcfModels, GeomsAreShapesWithFullLengthsAndSurfaces) {
  const Robot robot = robot_of(R"(<mujoco><worldbody><body name="b"><freejoint/>
<geom type="capsule" fromto="0 0 0 0 0 0.4" size="0.1" condim="6" friction="0.7 0.01 0.002"/>
<geom type="cylinder" size="0.2 0.3" condim="4" friction="0.6 0.02 0.003"/>
<geom type="box" size="1 2 3" condim="1"/>
<geom type="sphere" size="0.5" contype="0" conaffinity="0" rgba="0 1 0 0.5"/>
<geom type="sphere" size="0.6" group="3"/></body></worldbody></mujoco>)");
  const auto shapes = robot.constants("b", keys::collision_shapes);
  ASSERT_EQ(shapes.size(), 4u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::capsule);
  EXPECT_NEAR((shapes[0].size - Vec3(0.1, 0, 0.4)).norm(), 0, 1e-15);
  EXPECT_NEAR((shapes[0].origin.position - Vec3(0, 0, 0.2)).norm(), 0, 1e-15);
  EXPECT_EQ(shapes[0].surface.friction, 0.7);
  EXPECT_EQ(shapes[0].surface.spinning_resistance, 0.01);
  EXPECT_EQ(shapes[0].surface.rolling_resistance, 0.002);
  EXPECT_EQ(shapes[1].size, Vec3(0.2, 0, 0.6));
  EXPECT_EQ(shapes[1].surface.spinning_resistance, 0.02);
  EXPECT_EQ(shapes[1].surface.rolling_resistance, 0);
  EXPECT_EQ(shapes[2].size, Vec3(2, 4, 6));
  EXPECT_EQ(shapes[2].surface.friction, 0);
  const auto visuals = robot.constants("b", keys::visual_shapes);
  ASSERT_EQ(visuals.size(), 4u);
  EXPECT_EQ(visuals[3].color, Eigen::Vector4d(0, 1, 0, 0.5));
}

/// A tetrahedron far from its own centre, as an STL and as an OBJ file.
const std::string obj = "v 1 0 0\nv 1.3 0 0\nv 1 0.2 0\nv 1.1 0.1 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

TEST(MjcfModels, MeshesStandWhereTheFileHasThem) {
  // the compiler moves a mesh to its centre and turns it: compares its vertices in the world with those of the file
  const test::ScratchFolder folder;
  std::filesystem::create_directory(folder.path("meshes"));
  folder.file("meshes/tet.obj", obj);
  folder.file("part.xml", R"(<mujocoinclude><asset><mesh name="tet" file="some/folder/tet.obj" scale="2 2 2"
    refpos="0.1 0.2 0.3" refquat="0.8 0 0.6 0"/><mesh name="other" file="tet.obj" scale="1 -2 3"/></asset></mujocoinclude>)");
  const std::string text = R"(<mujoco><compiler meshdir="meshes" strippath="true"/><include file="part.xml"/>
<worldbody><body name="b" pos="1 2 3"><freejoint/>
<geom type="mesh" mesh="tet" pos="0.5 0.25 0.125" quat="0.6 0.8 0 0"/><geom type="mesh" mesh="other"/></body></worldbody></mujoco>)";
  const std::string path = folder.file("robot.xml", text);
  const Robot robot = robot_of(text, path);
  const auto shapes = robot.constants("b", keys::collision_shapes);
  ASSERT_EQ(shapes.size(), 2u) << joined(robot.problems);
  const Compiled compiled = compile(text, path);
  const mjModel& m = *compiled.model;
  for (int g = 0; g < 2; ++g) {
    const Shape& s = shapes[std::size_t(g)];
    EXPECT_EQ(robot.tree.texts()[s.mesh], folder.path("meshes/tet.obj"));
    const mesh::Mesh file = mesh::load(folder.path("meshes/tet.obj"), s.size);
    const Pose pose = pose_of(m.geom_pos + 3 * g, m.geom_quat + 4 * g);
    ASSERT_GE(m.mesh_vertnum[m.geom_dataid[g]], 4);
    for (int v = 0; v < m.mesh_vertnum[m.geom_dataid[g]]; ++v) {
      const float* const vertex = m.mesh_vert + 3 * (m.mesh_vertadr[m.geom_dataid[g]] + v);
      const Vec3 expected = pose * Vec3(vertex[0], vertex[1], vertex[2]);
      double nearest = 1;
      for (const auto& found : file.vertices)
        nearest = std::min(nearest, (s.origin * Vec3(found.template cast<double>()) - expected).norm());
      EXPECT_LT(nearest, 5e-6) << "geom " << g << ", vertex " << v;
    }
  }
}

TEST(MjcfModels, ABaseThatJointsHoldHangsOnALinkWorld) {
  const Robot robot = robot_of(mujoco(R"(<body name="cart" pos="0 0 1"><joint type="slide" axis="1 0 0"/>
<geom type="box" size="0.1 0.1 0.1"/><body name="pole"><joint type="hinge" axis="0 1 0"/><geom size="0.1"/></body></body>)"));
  EXPECT_EQ(robot.links(), (Lines{"world", "cart", "pole"}));
  EXPECT_EQ(robot.joints(), (Lines{"cart_joint", "pole_joint"}));
  EXPECT_TRUE(near(robot.pose("cart", {{"cart_joint", 0.5}}), {{0.5, 0, 1}, Quat::Identity()}));
  EXPECT_TRUE(has_line(robot.problems,
                       "note 3: body `cart` is held by joints in the world; to have that, set "
                       "`base: fixed` in the motion"))
      << joined(robot.problems);
}

TEST(MjcfModels, CamerasAreLinksThatLookAlongX) {
  const Robot robot = robot_of(humanoid);
  // the camera looks along x of the torso, with z up
  EXPECT_TRUE(near(robot.pose("eye"), {{0.1, 0, 0.3}, Quat::Identity()}));
}

TEST(MjcfModels, NamesOfPartsAreUnique) {
  const Robot robot = robot_of(mujoco(R"(<body name="a b"><freejoint/><geom size="1"/><site name="a b"/>
<body name="arm"><joint name="arm"/><joint axis="0 1 0"/><geom size="1"/><body><geom size="1"/></body></body></body>)"));
  EXPECT_EQ(robot.links(), (Lines{"a_b", "arm_body", "arm", "body_3", "a_b_site"})) << joined(robot.problems);
  EXPECT_EQ(robot.joints(), (Lines{"arm_joint", "arm_joint_joint"}));
}

}  // namespace
}  // namespace muro::mjcf
