// SPDX-License-Identifier: MIT
// humanoid.urdf against the data of ROBOTIS OP3, DARwIn-OP and the XM430-W350, and standing on its feet.
#include <gtest/gtest.h>

#include "examples/models/stand_testing.hpp"

namespace muro::models {
namespace {

const std::string crouch =
    "joints: {l_sho_roll: -1.3, r_sho_roll: 1.3, l_hip_pitch: -0.4, l_knee: 0.8, l_ank_pitch: -0.4, r_hip_pitch: -0.4, "
    "r_knee: 0.8, r_ank_pitch: -0.4}";

std::string moved(const std::string& motion, const std::string& parameters) {
  return crouch + ", motion: {use: " + motion + ", " + parameters + "}";
}

TEST(Humanoid, HasTheMassesAndMomentsOfOp3) {
  const host::BuiltScenario b = built("humanoid.urdf", "");
  struct Row {
    const char* body;
    double mass, xx, yy, zz;  // kg, 1e-6 kg m^2; 0: not in the table
  };
  // op3_description of ROBOTIS-OP3-Common
  const Row rows[] = {{"head_pan_link", 0.012, 0, 0, 0},       {"head_tilt_link", 0.136, 106, 87, 45},
                      {"_sho_pitch_link", 0.012, 0, 0, 0},     {"_sho_roll_link", 0.178, 228, 30, 235},
                      {"_el_link", 0.041, 62, 12, 69},         {"_hip_yaw_link", 0.012, 0, 0, 0},
                      {"_hip_roll_link", 0.179, 47, 125, 109}, {"_thigh_link", 0.115, 105, 96, 25},
                      {"_shin_link", 0.040, 37, 28, 15},       {"_ank_pitch_link", 0.179, 47, 125, 109},
                      {"_foot_link", 0.069, 40, 79, 116}};
  for (const Row& row : rows)
    for (const char* side : {"l", "r"}) {
      const std::string body = row.body[0] == '_' ? side + std::string(row.body) : row.body;
      SCOPED_TRACE(body);
      const Inertia i = inertia_of(b, body);
      EXPECT_NEAR(i.mass, row.mass, 1e-12);
      EXPECT_TRUE(is_possible(i));
      if (row.xx == 0) continue;
      EXPECT_NEAR(i.ixx, 1e-6 * row.xx, 1e-12);
      EXPECT_NEAR(i.iyy, 1e-6 * row.yy, 1e-12);
      EXPECT_NEAR(i.izz, 1e-6 * row.zz, 1e-12);
    }
  EXPECT_NEAR(mass_of(b), 3.147, 1e-12);
}

TEST(Humanoid, HasTrunkAndPelvisThatAreTogetherOp3sTrunk) {
  const host::BuiltScenario b = built("humanoid.urdf", "");
  const Inertia trunk = inertia_of(b, "base_link"), pelvis = inertia_of(b, "pelvis_link");
  EXPECT_TRUE(is_possible(trunk));
  EXPECT_TRUE(is_possible(pelvis));
  const Vec3 at = pelvis.com + link_of(b, "pelvis_link").origin.position;
  const double mass = trunk.mass + pelvis.mass;
  EXPECT_NEAR(mass, 1.349, 1e-12);
  const Vec3 com = (trunk.mass * trunk.com + pelvis.mass * at) / mass;
  EXPECT_LT((com - Vec3(-0.015, 0, 0.066)).norm(), 1e-6);
  const auto about_com = [&](const Inertia& i, const Vec3& centre) {
    const Vec3 d = centre - com;
    return Mat3(i.tensor() + i.mass * (d.squaredNorm() * Mat3::Identity() - d * d.transpose()));
  };
  const Vec3 moments = (about_com(trunk, trunk.com) + about_com(pelvis, at)).diagonal();
  EXPECT_LT((moments - 1e-6 * Vec3(3405, 2969, 3173)).norm(), 1e-7);
}

TEST(Humanoid, Has21JointsWithTheRangesOfDarwinAndTheServosOfOp3) {
  const host::BuiltScenario b = built("humanoid.urdf", "");
  struct Row {
    const char* joint;
    double low, high;  // rad, of the left side
    Vec3 axis;
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const double eighth = 0.785;  // the shoulder of DARwIn-OP hangs at 45 degrees
  const Row rows[] = {{"head_pan", -1.81, 1.81, z},   {"head_tilt", -0.36, 0.94, y},
                      {"_sho_pitch", -2.85, 3.14, y}, {"_sho_roll", -0.77 - eighth, 2.25 - eighth, x},
                      {"_el", -1.63, 1.18, x},        {"_hip_yaw", -0.69, 2.5, z},
                      {"_hip_roll", -1.0, 0.93, x},   {"_hip_pitch", -1.68, 0.5, y},
                      {"_knee", -0.03, 2.25, y},      {"_ank_pitch", -1.39, 1.22, y},
                      {"_ank_roll", -1.02, 0.6, x}};
  const World& world = b.simulation->world();
  std::size_t joints = 0;
  for (const Link& link : robot_of(b).links) {
    if (link.joint == JointKind::fixed) continue;
    ++joints;
    EXPECT_EQ(link.limits.effort, 4.1) << "N m at stall, XM430-W350";
    EXPECT_NEAR(link.limits.velocity, 46 * 2 * M_PI / 60, 1e-4) << "46 rpm";
    const std::string name = std::string(world.object_name(link.joint_object)).substr(2);
    SCOPED_TRACE(name);
    if (name == "waist_yaw") continue;
    const bool right = name.starts_with("r_");
    const auto* row = std::find_if(std::begin(rows), std::end(rows), [&](const Row& r) {
      return name == r.joint || (name[1] == '_' && name.substr(1) == r.joint);
    });
    ASSERT_NE(row, std::end(rows));
    EXPECT_EQ(link.axis, row->axis);
    // joints about y are alike on both sides, the others are mirrored
    const bool mirrored = right && row->axis != y;
    EXPECT_NEAR(link.limits.lower, mirrored ? -row->high : row->low, 1e-12);
    EXPECT_NEAR(link.limits.upper, mirrored ? -row->low : row->high, 1e-12);
  }
  EXPECT_EQ(joints, 21u);
}

TEST(Humanoid, StandsAsTallOnItsSolesAsItsOffsetsSay) {
  host::BuiltScenario b = built("humanoid.urdf", "");
  b.simulation->refresh();
  const auto at = [&](const char* body) {
    return b.simulation->world().value(b.simulation->world().object("r/" + std::string(body)), keys::pose).position;
  };
  EXPECT_NEAR(at("base_link").z(), 0.0285 + 0.11015 + 0.110 + 0.0305, 1e-9);
  // legs straight below the hips, feet flat and 90 mm apart
  for (const auto& [side, y] : {std::pair{"l_sole", 0.045}, {"r_sole", -0.045}})
    EXPECT_LT((at(side) - Vec3(0.0025, y, 0)).norm(), 2e-4) << side;
  EXPECT_NEAR(at("camera_link").z() - at("base_link").z(), 0.1365 + 0.0285 + 0.04975, 1e-9);
  EXPECT_NEAR(at("camera_link").y(), 0, 1e-9);
}

TEST(Humanoid, StandsInACrouchInEveryMotionByForces) {
  const std::string servo = "joints: position, stiffness: 24.9, damping: 0.68";  // MX-64, P 32
  host::BuiltScenario mujoco = built("humanoid.urdf", moved("motion.mujoco", servo));
  EXPECT_TRUE(stands(mujoco, 2)) << "mujoco";
  host::BuiltScenario bullet = built("humanoid.urdf", moved("motion.bullet", servo));
  EXPECT_TRUE(stands(bullet, 1)) << "bullet";
  host::BuiltScenario simplified = built("humanoid.urdf", moved("motion.simplified", "joints: position"));
  EXPECT_TRUE(stands(simplified, 2)) << "simplified";
  host::BuiltScenario ode = built("humanoid.urdf", moved("motion.ode", servo));
  EXPECT_TRUE(stands(ode, 0.4)) << "ode";
}

TEST(SlowHumanoid, StandsInACrouchForLong) {
  for (const char* motion : {"motion.bullet", "motion.mujoco", "motion.ode"}) {
    host::BuiltScenario b = built("humanoid.urdf", moved(motion, "joints: position, stiffness: 24.9, damping: 0.68"));
    EXPECT_TRUE(stands(b, 5)) << motion;
  }
}

TEST(Humanoid, FallsWhenItsServosAreOff) {
  for (const char* motion : {"motion.simplified", "motion.bullet", "motion.mujoco", "motion.ode"}) {
    host::BuiltScenario b = built("humanoid.urdf", moved(motion, "joints: passive"));
    EXPECT_FALSE(stands(b, motion == std::string("motion.simplified") ? 1.5 : 0.6, 0.05)) << motion;
  }
}

TEST(Humanoid, IsWeighedByTheFourCellsOfItsSoles) {
  host::BuiltScenario b =
      built("humanoid.urdf", moved("motion.mujoco", "joints: position") +
                                 ", left: {use: sensor.foot, on: l_foot_link, rate: 200}, right: {use: sensor.foot, "
                                 "on: r_foot_link, rate: 200}, imu: {use: sensor.imu, on: imu_link, rate: 200}");
  b.simulation->run_for(1);
  const World& world = b.simulation->world();
  double force = 0;
  for (const char* sole : {"r/left", "r/right"}) {
    const std::span<const double> cells = world.values(world.object(sole), keys::foot_cells);
    EXPECT_EQ(cells.size(), 4u);
    for (const double cell : cells) {
      EXPECT_GT(cell, 0.5) << sole;
      force += cell;
    }
  }
  EXPECT_NEAR(force, 3.147 * 9.81, 0.3);
}

TEST(Humanoid, DoesNotTouchItself) {
  // self-collision pushes joints away from where drives hold them
  for (const auto& [pose, motion] : {std::pair<std::string, std::string>{"joints: {}", "bullet"},
                                     {crouch, "bullet"},
                                     {"joints: {}", "articulated"},
                                     {crouch, "articulated"}}) {
    host::BuiltScenario b = built("humanoid.urdf", pose + ", at: {z: 1}, motion: {use: motion." + motion +
                                                       ", base: fixed, joints: position, self_collision: true}");
    const World& world = b.simulation->world();
    std::vector<std::pair<const Link*, double>> start;
    for (const Link& link : robot_of(b).links)
      if (link.joint != JointKind::fixed)
        start.emplace_back(&link, world.value(link.joint_object, keys::joint_position));
    b.simulation->run_for(0.2);
    for (const auto& [link, q] : start)
      EXPECT_NEAR(world.value(link->joint_object, keys::joint_position), q, 2e-3)
          << world.object_name(link->joint_object) << " at motion." << motion;
  }
}

}  // namespace
}  // namespace muro::models
