// SPDX-License-Identifier: MIT
// Tests of `settings: model`: a scene read from MJCF follows raw MuJoCo on the same file.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::mujoco_model {
namespace {

/// An arm with servos, a motor, a spring, a tendon, an equality constraint, an anchor off its link, and joints that do
/// not begin at 0. A ball with rolling friction and a box fall on a plane and a table with their own contact
/// parameters.
std::string yard(const std::string& option) {
  return "<mujoco><compiler angle='degree'/><option timestep='0.002' " + option + R"(/>
<default><joint damping="0.05" armature="0.01"/><geom friction="0.8 0.01 0.001"/>
 <default class="soft"><geom solref="0.05 0.7" margin="0.003"/></default></default>
<worldbody>
<geom name="floor" type="plane" size="5 5 1" friction="0.9 0.02 0.002" solref="0.01 1.2"/>
<body name="arm" pos="0 0 1.2" euler="0 0 15"><geom type="box" size="0.05 0.05 0.05"/>
 <body name="upper" pos="0 0 0.1">
  <joint name="shoulder" axis="0 1 0" range="-40 60" limited="true" stiffness="2" frictionloss="0.1"/>
  <joint name="swivel" axis="0 0 1" pos="0.02 0.01 0" ref="20"/>
  <geom type="capsule" fromto="0 0 0 0.4 0 0" size="0.04"/>
  <body name="lower" pos="0.4 0 0">
   <joint name="elbow" axis="0 1 0" pos="0.01 0 0.02"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
   <body name="hand" pos="0.3 0 0"><joint name="reach" type="slide" axis="1 0 0" range="-0.1 0.2" limited="true"/>
    <geom type="box" size="0.05 0.04 0.03"/></body>
  </body>
 </body>
</body>
<body name="ball" pos="0.5 1 0.3"><freejoint/><geom size="0.1" condim="6"/></body>
<body name="box" pos="-1 0.1 0.6" euler="20 30 40"><freejoint/><geom class="soft" type="box" size="0.1 0.15 0.2"/></body>
<body name="table" pos="-1 0 0"><geom name="top" type="box" size="0.3 0.3 0.1" pos="0 0 0.1"/></body>
</worldbody>
<tendon><fixed name="cable" stiffness="3" damping="0.2"><joint joint="elbow" coef="1"/><joint joint="reach" coef="3"/></fixed></tendon>
<equality><joint joint1="reach" joint2="elbow" polycoef="0 0.05 0 0 0"/></equality>
<actuator><position joint="shoulder" kp="40" gear="2"/><motor joint="swivel" gear="3" ctrllimited="true" ctrlrange="-1 1"/>
<velocity joint="elbow" kv="4"/></actuator></mujoco>)";
}

double wave(double t) { return 0.4 * std::sin(5 * t); }

struct Raw {
  explicit Raw(const std::string& path) {
    char error[500] = "";
    m = mj_loadXML(path.c_str(), nullptr, error, sizeof error);
    EXPECT_TRUE(m) << error;
    d = mj_makeData(m);
  }
  ~Raw() {
    mj_deleteData(d);
    mj_deleteModel(m);
  }
  Raw(const Raw&) = delete;
  double position(const char* joint, int k = 0) const {
    return d->qpos[m->jnt_qposadr[mj_name2id(m, mjOBJ_JOINT, joint)] + k];
  }
  Pose pose(const char* body) const {
    const int b = mj_name2id(m, mjOBJ_BODY, body), q = m->jnt_qposadr[m->body_jntadr[b]];
    return {{d->qpos[q], d->qpos[q + 1], d->qpos[q + 2]},
            Quat(d->qpos[q + 3], d->qpos[q + 4], d->qpos[q + 5], d->qpos[q + 6])};
  }
  mjModel* m = nullptr;
  mjData* d = nullptr;
};

/// A file that is read as the world, with all its trees as robots.
struct Yard : test::Scene {
  /// `limits_of_joints`: changes the limits that the file gives for every joint.
  explicit Yard(const std::string& path, const std::vector<std::string>& left_out = {},
                const std::function<void(JointLimits&)>& limits_of_joints = {}) {
    const WorldModel model = read_world(path);
    if (model.gravity()) world().set(world_object, keys::gravity, *model.gravity());
    for (auto s : model.scenery()) {
      for (std::vector<Shape>* shapes : {&s.collisions, &s.visuals})
        for (Shape& shape : *shapes)
          if (shape.mesh != no_text) shape.mesh = world().intern(model.texts()[shape.mesh]);
      world().add_scenery(s.name, s.pose, s.collisions, s.visuals);
    }
    for (const auto& robot : model.models()) {
      if (std::find(left_out.begin(), left_out.end(), robot.name) != left_out.end()) continue;
      RobotTree tree = robot.tree;
      for (std::size_t i = 0; limits_of_joints && i < tree.links().size(); ++i) {
        if (tree.links()[i].joint < 0) continue;
        JointLimits limits = tree.links()[i].link.limits;
        limits_of_joints(limits);
        tree.set_limits(i, limits);
      }
      const RobotView& view = add(robot.name, tree, robot.pose);
      std::map<std::string, ParameterInput> parameters = {{"settings", "model"}};
      parameters["base"] = robot.name == "arm" ? "fixed" : "free";
      use("motion.mujoco", 500, {{&view, view.base()}}, std::move(parameters));
    }
  }
  double& joint(const std::string& name, const Key<double>& key) { return world().value(world().object(name), key); }
  Pose& pose_of(const char* robot) { return world().value(world().find_robot(robot)->base(), keys::pose); }
};

/// Returns the largest difference of any coordinate in 1 s.
double largest_difference(const std::string& option) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("yard.xml", yard(option));
  Raw raw(path);
  Yard scene(path);
  scene.build();
  double largest = 0;
  for (int k = 0; k < 500; ++k) {
    const double target = wave(0.002 * k);
    raw.d->ctrl[0] = 2 * target;
    raw.d->ctrl[1] = target / 3;
    raw.d->ctrl[2] = target;
    scene.joint("arm/shoulder", keys::joint_position_target) = target;
    scene.joint("arm/swivel", keys::joint_effort_target) = target;
    scene.joint("arm/elbow", keys::joint_velocity_target) = target;
    mj_step(raw.m, raw.d);
    scene.run_for(0.002);
    for (const char* name : {"shoulder", "swivel", "elbow", "reach"})
      largest = std::max(largest,
                         std::abs(scene.joint("arm/" + std::string(name), keys::joint_position) - raw.position(name)));
    for (const char* name : {"ball", "box"}) {
      const Pose a = scene.pose_of(name), b = raw.pose(name);
      largest = std::max({largest, (a.position - b.position).norm(), a.orientation.angularDistance(b.orientation)});
    }
  }
  EXPECT_GT(std::abs(raw.position("swivel") - 20 * M_PI / 180), 1e-3) << "the arm has not moved";
  EXPECT_LT(raw.pose("ball").position.z(), 0.15) << "the ball has not fallen";
  EXPECT_LT(raw.pose("box").position.z(), 0.5) << "the box has not fallen";
  return largest;
}

TEST(MujocoModel, AWorldFollowsRawMuJoCoForOneSecond) { EXPECT_LT(largest_difference(""), 1e-6); }

TEST(MujocoModel, OtherOptionsOfTheFileAreFollowedToo) {
  EXPECT_LT(largest_difference("cone='elliptic' solver='CG' iterations='30' impratio='5' gravity='0.5 0 -9'"), 1e-6);
  EXPECT_LT(largest_difference("integrator='RK4'"), 1e-6);
  EXPECT_LT(largest_difference("integrator='implicit' solver='PGS' noslip_iterations='2'"), 1e-6);
}

TEST(MujocoModel, DynamicsOfJointsMayBeOthersThanThoseOfTheFile) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("yard.xml", yard(""));
  Raw raw(path), as_it_is(path);
  for (int j = 0; j < raw.m->njnt; ++j) {
    if (raw.m->jnt_type[j] == mjJNT_FREE) continue;
    const int dof = raw.m->jnt_dofadr[j];
    raw.m->dof_armature[dof] = 0.2;
    raw.m->dof_damping[dof] = 0.5;
    raw.m->dof_frictionloss[dof] = 0.05;
  }
  Yard scene(path, {}, [](JointLimits& l) { l.armature = 0.2, l.damping = 0.5, l.friction = 0.05; });
  scene.build();
  for (int k = 0; k < 500; ++k) {
    mj_step(raw.m, raw.d);
    mj_step(as_it_is.m, as_it_is.d);
    scene.run_for(0.002);
    for (const char* name : {"shoulder", "swivel", "elbow", "reach"})
      ASSERT_NEAR(scene.joint("arm/" + std::string(name), keys::joint_position), raw.position(name), 1e-6)
          << name << " in step " << k;
  }
  EXPECT_GT(std::abs(raw.position("shoulder") - as_it_is.position("shoulder")), 1e-3);
}

/// Returns 9 x 7 nodes of rolling hills in MuJoCo's binary format of height fields.
std::string hills() {
  constexpr std::int32_t rows = 9, columns = 7;
  std::string bytes(8 + 4 * rows * columns, '\0');
  std::memcpy(bytes.data(), &rows, 4);
  std::memcpy(bytes.data() + 4, &columns, 4);
  for (int k = 0; k < rows * columns; ++k) {
    const int row = k / columns, column = k % columns;
    const auto height = float(3 + std::sin(0.9 * row) * std::cos(1.1 * column));
    std::memcpy(bytes.data() + 8 + 4 * k, &height, 4);
  }
  return bytes;
}

TEST(MujocoModel, BodiesOnAHeightFieldFollowRawMuJoCoForOneSecond) {
  const test::ScratchFolder folder;
  folder.file("hills.bin", hills());
  const std::string path = folder.file("yard.xml", R"(<mujoco><option timestep="0.002"/>
<asset><hfield name="h" file="hills.bin" size="2 3 0.4 0.1"/></asset>
<worldbody><geom name="hills" type="hfield" hfield="h" pos="0.1 0 0.2" euler="0 0 20"/>
<body name="ball" pos="0.3 0.4 0.8"><freejoint/><geom size="0.1" condim="6"/></body>
<body name="box" pos="-0.6 0.1 1" euler="20 30 40"><freejoint/><geom type="box" size="0.1 0.15 0.2"/></body>
</worldbody></mujoco>)");
  Raw raw(path);
  Yard scene(path);
  scene.build();
  for (int k = 0; k < 500; ++k) {
    mj_step(raw.m, raw.d);
    scene.run_for(0.002);
    for (const char* name : {"ball", "box"})
      ASSERT_LT((scene.pose_of(name).position - raw.pose(name).position).norm(), 1e-6) << name << " in step " << k;
  }
  EXPECT_GT(raw.d->ncon, 0);
  EXPECT_LT(raw.pose("ball").position.z(), 0.75) << "the ball has landed";
}

const char* const hopper = R"(<mujoco><option timestep="0.002"/><worldbody>FLOOR
<body name="torso" pos="0 0 0.9"><freejoint/><geom type="box" size="0.2 0.1 0.1"/>
<body name="leg" pos="0.05 0 -0.1"><joint name="hip" axis="0 1 0" damping="0.5"/><geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05"/>
<body name="foot" pos="0 0 -0.4"><joint name="knee" axis="0 1 0" damping="0.5"/><geom type="capsule" fromto="0 0 0 0.2 0 -0.1" size="0.04"/></body></body></body>
</worldbody><actuator><motor joint="hip" gear="5"/><position joint="knee" kp="30"/></actuator></mujoco>)";

std::string hopper_with(const std::string& floor) {
  std::string text = hopper;
  return text.replace(text.find("FLOOR"), 5, floor);
}

/// Adds a tree that is not the first.
std::string with_other(std::string text) {
  return text.insert(text.find("</worldbody>"), "<body name='other' pos='0 0 1'><freejoint/><geom size='1'/></body>");
}

TEST(MujocoModel, ARobotOnSceneryOfTheScenarioFollowsRawMuJoCo) {
  // a file that is read as a robot loses its floor; the floor of the scene replaces it
  const test::ScratchFolder folder;
  const std::string with_floor =
      folder.file("floor.xml", hopper_with("<geom type='plane' size='1 1 1' friction='0.8 0 0'/>"));
  const std::string path =
      folder.file("hopper.xml", with_other(hopper_with("<geom type='box' size='9 9 0.5' pos='0 0 1'/>")));
  Raw raw(with_floor);
  test::Scene scene;
  scene.add_ground(0.8);
  const RobotView& robot = scene.add("r", scene.read_model(path), {{0, 0, 0.9}, Quat::Identity()});
  Wrench& push = scene.push(robot);
  scene.use("motion.mujoco", 500, scene.all_robots(), {{"settings", "model"}});
  scene.build();
  scene.world().value(scene.world().object("r/knee"), keys::joint_position_target) = 0.5;
  scene.world().value(scene.world().object("r/hip"), keys::joint_effort_target) = 2;
  raw.d->ctrl[0] = 2.0 / 5;
  raw.d->ctrl[1] = 0.5;
  push.force = {3, 1, 0};
  push.torque = {0, 0.5, 0.2};
  const int torso = mj_name2id(raw.m, mjOBJ_BODY, "torso");
  // the torso's centre of mass is its origin
  const mjtNum wrench[] = {3, 1, 0, 0, 0.5, 0.2};
  std::copy_n(wrench, 6, raw.d->xfrc_applied + 6 * torso);
  for (int k = 0; k < 500; ++k) {
    mj_step(raw.m, raw.d);
    scene.run_for(0.002);
    ASSERT_LT((scene.pose(robot).position - raw.pose("torso").position).norm(), 1e-6) << k;
    ASSERT_NEAR(scene.world().value(scene.world().object("r/hip"), keys::joint_position), raw.position("hip"), 1e-6);
  }
  EXPECT_LT(scene.pose(robot).position.z(), 0.8);
  // contact forces are reported: on average the floor carries most of the weight
  double force = 0;
  for (const char* name : {"r/torso", "r/leg", "r/foot"})
    force += scene.world().value(scene.world().object(name), keys::contact_wrench).force.z();
  double expected = 0;
  for (int i = 0; i < raw.d->ncon; ++i) {
    mjtNum local[6];
    mj_contactForce(raw.m, raw.d, i, local);
    expected += raw.d->contact[i].geom1 == 0 ? local[0] * raw.d->contact[i].frame[2] : 0;
  }
  EXPECT_NEAR(force, expected, 1e-3 * std::abs(expected) + 1e-6);
}

TEST(MujocoModel, TreesThatAreNoRobotsStandStillAndAreScenery) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("yard.xml", R"(<mujoco><worldbody><geom type="plane" size="1 1 1"/>
<body name="crate" pos="0 0 1"><freejoint/><geom type="box" size="0.2 0.2 0.1"/></body>
<body name="ball" pos="0 0 1.3"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>)");
  Yard scene(path, {"crate"});
  const Shape top = Shape::box({0.4, 0.4, 0.2});
  scene.world().add_scenery("crate.crate", {{0, 0, 1}, Quat::Identity()}, std::span<const Shape>(&top, 1));
  scene.build();
  scene.run_for(2);
  EXPECT_NEAR(scene.pose_of("ball").position.z(), 1.2, 2e-3);
}

TEST(MujocoModel, AContactOfTwoRobotsIsInTheListsOfBoth) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("yard.xml", R"(<mujoco><worldbody><geom type="plane" size="1 1 1"/>
<body name="crate" pos="0 0 0.1"><freejoint/><geom type="box" size="0.2 0.2 0.1"/></body>
<body name="ball" pos="0 0 0.3"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>)");
  Yard scene(path);
  scene.use("recorder.contacts", 500, {}, {{"file", folder.path("contacts.csv")}});
  scene.build();
  scene.run_for(2);
  const auto force_on = [&](const char* robot, const char* other) {
    const ObjectId body = scene.world().find_robot(other)->base();
    double sum = 0;
    for (const ContactWrench& c :
         scene.world().values(scene.world().find_robot(robot)->base(), keys::contact_wrenches_of_motion))
      if (c.other == body) sum += c.wrench.force.z();
    return sum;
  };
  const double weight = 1000 * 4.0 / 3 * M_PI * 0.001 * 9.81;
  EXPECT_NEAR(force_on("ball", "crate"), weight, 0.01 * weight);
  EXPECT_NEAR(force_on("crate", "ball"), -weight, 0.01 * weight);
}

TEST(MujocoModel, RobotsThatNoForceMovesAreTouched) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("ball.xml",
                                       "<mujoco><worldbody><body name='ball' pos='0 0 1'><freejoint/><geom size='0.1'/>"
                                       "</body></worldbody></mujoco>");
  test::Scene scene;
  const RobotView& plate = scene.add("plate", test::tree_of([](RobotBuilder& b) {
                                       b.base("plate");
                                       Shape shapes[] = {Shape::box({1, 1, 0.2}), Shape::sphere(0.05)};
                                       shapes[1].origin.position.x() = 3;
                                       b.set_array<Shape>(keys::collision_shapes, shapes);
                                     }),
                                     {{0, 0, 0.4}, Quat::Identity()});
  const RobotView& ball = scene.add("ball", scene.read_model(path), {{0, 0, 1}, Quat::Identity()});
  scene.use("motion.point", 500, {{&plate, plate.base()}});
  scene.use("motion.mujoco", 500, {{&ball, ball.base()}}, {{"settings", "model"}});
  scene.build();
  scene.run_for(2);
  EXPECT_NEAR(scene.pose(ball).position.z(), 0.6, 2e-3);
  EXPECT_NEAR(scene.world().value(ball.base(), keys::contact_wrench).force.z(), 1000 * 4.0 / 3 * M_PI * 0.001 * 9.81,
              1e-3);
}

TEST(MujocoModel, ASnapshotGoesOnBitForBit) {
  const test::ScratchFolder folder;
  Yard scene(folder.file("yard.xml", yard("")));
  scene.build();
  scene.joint("arm/shoulder", keys::joint_position_target) = 0.3;
  scene.run_for(0.3);
  const Snapshot snapshot = scene.snapshot();
  scene.run_for(0.2);
  const Pose box = scene.pose_of("box");
  const double shoulder = scene.joint("arm/shoulder", keys::joint_position);
  scene.restore(snapshot);
  scene.run_for(0.2);
  EXPECT_EQ(scene.pose_of("box").position, box.position);
  EXPECT_EQ(scene.pose_of("box").orientation.coeffs(), box.orientation.coeffs());
  EXPECT_EQ(scene.joint("arm/shoulder", keys::joint_position), shoulder);
}

/// Returns the message of a scene that cannot be made.
template <class Make>
std::string message_of(Make make) {
  try {
    make();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(MujocoModel, WhatCannotHaveAModelsSettingsIsTold) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("hopper.xml", hopper_with(""));
  const std::string of_others = message_of([] {
    test::Scene scene;
    scene.add("block", test::block(2, {0.2, 0.2, 0.1}, 0.5));
    scene.use("motion.mujoco", 500, scene.all_robots(), {{"settings", "model"}});
    scene.build();
  });
  EXPECT_NE(of_others.find("`block` was not read from an MJCF file"), std::string::npos) << of_others;
  const std::string of_two = message_of([&] {
    test::Scene scene;
    scene.add("a", scene.read_model(path));
    scene.add("b", scene.read_model(path), {{3, 0, 0}, Quat::Identity()});
    scene.use("motion.mujoco", 500, scene.all_robots(), {{"settings", "model"}});
    scene.build();
  });
  EXPECT_NE(
      of_two.find("`a` and `b` are in one world with `settings: model`, which is one MJCF file; give each another "
                  "`world`"),
      std::string::npos)
      << of_two;
  const std::string of_fixed = message_of([&] {
    test::Scene scene;
    scene.add("a", scene.read_model(path));
    scene.use("motion.mujoco", 500, scene.all_robots(), {{"settings", "model"}, {"base", "fixed"}});
    scene.build();
  });
  EXPECT_NE(of_fixed.find("moves freely in its MJCF file"), std::string::npos) << of_fixed;
}

TEST(MujocoModel, TheFilesOwnInertiasAreNotSaidToBeMuros) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("yard.xml", yard(""));
  const auto notes_with = [&](const char* settings) {
    std::string notes;
    test::Scene scene;
    scene.set_log([&](LogLevel, std::string_view text) { notes += std::string(text) + "\n"; });
    const RobotView& arm = scene.add("arm", scene.read_model(path));
    scene.use("motion.mujoco", 500, {{&arm, arm.base()}},
              {{"settings", std::string(settings)}, {"base", std::string("fixed")}});
    scene.build();
    return notes;
  };
  EXPECT_SAYS(notes_with("muro"), "what they lack was added to `arm/shoulder_body`");
  EXPECT_EQ(notes_with("model").find("what they lack was added"), std::string::npos) << "the compiler took the file";
}

TEST(MujocoModel, TwoRobotsOfOneFileHaveWorldsOfTheirOwn) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("hopper.xml", hopper_with(""));
  test::Scene scene;
  scene.add_ground(0.8);
  for (const char* name : {"a", "b"}) {
    const RobotView& r =
        scene.add(name, scene.read_model(path), {{name[0] == 'a' ? 0.0 : 3.0, 0, 0.9}, Quat::Identity()});
    scene.use("motion.mujoco", 500, {{&r, r.base()}}, {{"settings", "model"}, {"world", name}});
  }
  scene.use_contacts();
  scene.build();
  scene.run_for(0.5);
  const auto position = [&](const char* name) { return scene.pose(*scene.world().find_robot(name)).position; };
  EXPECT_LT(position("a").z(), 0.9);
  EXPECT_NEAR((position("b") - position("a") - Vec3(3, 0, 0)).norm(), 0, 1e-9);
}

TEST(MujocoModel, AHeightmapOfTheSceneIsAHeightFieldBesideTheFile) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("balls.xml", R"(<mujoco><option timestep="0.002"/><worldbody>
<body name="low" pos="-1.1 0.4 0.5"><freejoint/><geom size="0.1"/></body>
<body name="high" pos="0.9 -0.3 1.5"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>)");
  // -0.2 m to the left, 0.8 m to the right, with a pose that lifts it by 0.3 m; the values are not within 0 to 1
  const std::int32_t counts[] = {2, 6};
  const float values[] = {-0.1f, -0.1f, -0.1f, 0.4f, 0.4f, 0.4f, -0.1f, -0.1f, -0.1f, 0.4f, 0.4f, 0.4f};
  std::string bytes(sizeof counts + sizeof values, '\0');
  std::memcpy(bytes.data(), counts, sizeof counts);
  std::memcpy(bytes.data() + sizeof counts, values, sizeof values);
  Yard scene(path);
  Shape hills{.kind = ShapeKind::heightmap, .size = {4, 3, 2}};
  hills.mesh = scene.world().intern(folder.file("hills.bin", bytes));
  scene.world().add_scenery("hills", {{0, 0, 0.3}, Quat::Identity()}, std::span<const Shape>(&hills, 1));
  scene.build();
  scene.run_for(3);
  EXPECT_NEAR(scene.pose_of("low").position.z(), 0.3 - 0.2 + 0.1, 5e-3);
  EXPECT_NEAR(scene.pose_of("high").position.z(), 0.3 + 0.8 + 0.1, 5e-3);
}

}  // namespace
}  // namespace muro::mujoco_model
