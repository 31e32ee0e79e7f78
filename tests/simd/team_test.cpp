// SPDX-License-Identifier: MIT
// Purpose of lanes: a team that is moved eight robots at a time drives exactly as each robot drives alone.
#include <gtest/gtest.h>

#include <cstdlib>

#include "each_isa.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

/// Rovers and four-legged robots on a plane, far from each other. Neither number is a multiple of the lanes.
struct Team : test::Scene {
  static constexpr int rovers = 21, walkers = 11;

  /// Adds all robots, or one alone.
  explicit Team(const std::string& motion, int only = -1) {
    add_ground();
    const std::string models = MURO_TEST_SOURCE_DIR "/examples/models/";
    const RobotTree rover = read_model(models + "rover.urdf"), walker = read_model(models + "quadruped.urdf");
    std::vector<Item> rolling, walking;
    for (int i = 0; i < rovers + walkers; ++i) {
      if (only >= 0 && i != only) continue;
      const bool rolls = i < rovers;
      const RobotTree& model = rolls ? rover : walker;
      const int row = i / 8;
      const Vec3 place(4 * (i % 8), 4 * row, model.standing_height() + 0.01 * (i % 5));
      const RobotView& robot = add("robot_" + std::to_string(i), model, {place, from_rpy(0.02, 0.01, 0.7 * i)},
                                   {{0.1 * (i % 3), 0, 0}, {0, 0, 0.1}});
      (rolls ? rolling : walking).push_back({&robot, robot.base()});
    }
    if (!rolling.empty()) use(motion, 1000, rolling, {{"joints", "velocity"}});
    if (!walking.empty()) use(motion, 1000, walking, {{"joints", "position"}});
    use_contacts();
    build();
  }

  /// Drives with new joint targets ten times a second.
  void drive(double seconds) {
    for (int k = 0; k < int(10 * seconds); ++k) {
      for (const RobotView* r : world().robots()) {
        const double i = std::stod(std::string(r->name.substr(6)));
        for (const Link& f : r->links) {
          if (f.joint == JointKind::fixed) continue;
          const bool rolls = i < rovers;
          const double wave = std::sin(0.9 * k + i + 2.0 * double(&f - &r->links.front()));
          if (f.mimic < 0)
            world().value(f.joint_object, rolls ? keys::joint_velocity_target : keys::joint_position_target) =
                rolls ? 5 + 3 * wave : 0.3 * wave;
        }
      }
      run_for(0.1);
    }
  }
  std::uint64_t hash_of(int robot) { return world().hash(*world().find_robot("robot_" + std::to_string(robot))); }
  Vec3 place_of(int robot) { return pose(*world().find_robot("robot_" + std::to_string(robot))).position; }
};

struct WithIsa {
  explicit WithIsa(lane::Isa isa) {
    if (const char* now = std::getenv("MURO_ISA")) before = now;
    setenv("MURO_ISA", isa == lane::Isa::base ? "base" : isa == lane::Isa::avx2 ? "avx2" : "avx512", 1);
  }
  ~WithIsa() { before.empty() ? unsetenv("MURO_ISA") : setenv("MURO_ISA", before.c_str(), 1); }
  std::string before;
};

class LanesOfATeam : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(, LanesOfATeam, testing::Values("motion.simplified", "motion.articulated"),
                         [](const auto& motion) { return motion.param.substr(7); });

TEST_P(LanesOfATeam, EveryRobotMovesAsItDoesAloneWithAnyInstructionSet) {
  std::vector<std::uint64_t> alone;
  for (int i = 0; i < Team::rovers + Team::walkers; ++i) {
    Team one(GetParam(), i);
    const Vec3 start = one.place_of(i);
    one.drive(1);
    alone.push_back(one.hash_of(i));
    if (i < Team::rovers) {
      EXPECT_GT((one.place_of(i) - start).norm(), 0.05) << "rover " << i << " does not drive";
    }
  }
  for (const lane::Isa isa : lane_test::each_isa()) {
    const WithIsa set(isa);
    Team team(GetParam());
    team.drive(1);
    for (int i = 0; i < Team::rovers + Team::walkers; ++i)
      EXPECT_EQ(team.hash_of(i), alone[std::size_t(i)]) << "robot " << i << ", instruction set " << int(isa);
  }
}

}  // namespace
}  // namespace muro
