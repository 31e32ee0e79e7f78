// SPDX-License-Identifier: MIT
// Robots of one structure and different masses: each gets the same bits in a pack as alone, in packs of any number,
// with each instruction set.
#include <cstdlib>

#include "articulated_testing.hpp"
#include "muro/simd/isa.hpp"

namespace muro::articulated::testing {
namespace {

struct InstructionSet {
  explicit InstructionSet(const char* name) {
    if (const char* now = std::getenv("MURO_ISA")) before = now;
    setenv("MURO_ISA", name, 1);
  }
  ~InstructionSet() { before.empty() ? unsetenv("MURO_ISA") : setenv("MURO_ISA", before.c_str(), 1); }
  std::string before;
};

/// Returns a trunk with two arms, one of which follows the other, and a foot on a slide.
RobotTree robot_of(double scale, double restitution = 0) {
  Shape trunk = test::with(Shape::box({0.3, 0.2, 0.1}), 0.6), ball = test::with(Shape::sphere(0.06), 0.6);
  trunk.surface.restitution = ball.surface.restitution = restitution;
  return test::tree_of([&](RobotBuilder& b) {
    b.base("trunk");
    b.set(keys::inertial, test::solid_box(3 * scale, {0.3, 0.2, 0.1}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&trunk, 1));
    for (const char* side : {"left", "right"}) {
      const bool left = side[0] == 'l';
      b.fork();
      b.translation({0, left ? 0.15 : -0.15, 0});
      b.revolute(side, Vec3(0.3, left ? 1 : -1, 0.1), {.lower = -1, .upper = 1, .damping = 0.02, .friction = 0.03});
      if (!left) b.mimic("left", 0.7, 0.1);
      b.body(left ? "left_arm" : "right_arm");
      b.set(keys::inertial, Inertia{.mass = 0.4, .com = {0.1, 0, 0}, .ixx = 1e-3, .iyy = 4e-3, .izz = 4e-3});
      b.end();
    }
    b.translation({0, 0, -0.1});
    b.prismatic("foot", Vec3::UnitZ(), {.lower = -0.05, .upper = 0.05, .effort = 60});
    b.body("foot_link");
    b.set(keys::inertial, test::round_body(0.2 * scale, 0.06));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&ball, 1));
    b.end();
    b.end();
  });
}

/// Returns the hashes of robots number `first` to `first` + `count` - 1 after 0.6 s on the ground. With restitution
/// they are thrown at it, all at the same instant, some at an angle. Then every third lies under a plate that moves to
/// and fro on it.
std::vector<std::uint64_t> hashes_of(int first, int count, double restitution) {
  World w;
  w.add_ground(0.6);
  const bool is_thrown = restitution > 0;
  for (int i = first; i < first + count; ++i) {
    const Pose above = {{2.0 * i, 0, 0.2 + 0.02 * i}, from_rpy(0.1 * i, 0.05, 0.3 * i)};
    const Twist falls = {{0.1 * i, 0, 0}, {0.5, 0.2 * i, 1}},
                skids = {{i % 2 * 0.3 * i, 0, -2}, {0, 0, i % 2 * 0.5 * i}};
    if (is_thrown)
      w.add("r" + std::to_string(i), robot_of(1 + 0.13 * i, restitution), {{2.0 * i, 0, 0.22}, from_rpy(0.1, 0.2, 0)},
            skids);
    else
      w.add("r" + std::to_string(i), robot_of(1 + 0.13 * i), above, falls);
  }
  w.start({{"joints", std::string("position")}, {"effort_joints", std::vector<std::string>{"foot"}}}, [&] {
    for (int i = first; is_thrown && i < first + count; ++i) {
      if (i % 3 != 0) continue;
      w.add("plate" + std::to_string(i), test::block(1, {0.6, 0.6, 0.1}, 0.6), {{2.0 * i, 0, 0.32}, Quat::Identity()});
      w.use("motion.point", 1000, {w.all_robots().back()});
    }
  });
  for (int i = first; i < first + count; ++i) {
    w.of("r" + std::to_string(i) + "/left", keys::joint_position_target) = 0.8 - 0.2 * i;
    w.of("r" + std::to_string(i) + "/foot", keys::joint_effort_target) = -20;
  }
  for (int n = 0; n < 6; ++n) {
    for (const RobotView* r : w.world().robots())
      if (r->name.starts_with("plate"))
        w.world().value(r->base(), keys::command_twist).linear = Vec3(n % 2 ? -0.1 : 0.1, 0.05, n < 3 ? -0.4 : 0.2);
    w.run_for(0.1);
  }
  std::vector<std::uint64_t> hashes;
  for (const RobotView* r : w.world().robots())
    if (r->name.starts_with("r")) hashes.push_back(w.world().hash(*r));
  return hashes;
}

/// Returns the hash of a robot on its box, with rolling resistance between them, beside `others` on boxes without.
std::uint64_t hash_beside(int others, double resistance, bool is_last) {
  World w;
  Shape box = test::with(Shape::box({1, 1, 0.5}), 0.6);
  const auto put = [&](const std::string& name, double x, double own) {
    box.surface.rolling_resistance = box.surface.spinning_resistance = own;
    w.world().add_scenery(name + "_box", {{x, 0, -0.25}, Quat::Identity()}, std::span<const Shape>(&box, 1));
    w.add(name, robot_of(1), {{x, 0, 0.2}, from_rpy(0.1, 0.05, 0.3)}, {{0.1, 0, 0}, {0.5, 0.2, 1}});
  };
  box.surface.rolling_resistance = 0.01;  // this box is in all worlds, so that all have the same properties
  w.world().add_scenery("far_box", {{-9, 0, 0}, Quat::Identity()}, std::span<const Shape>(&box, 1));
  if (!is_last) put("r", 0, resistance);
  for (int i = 0; i < others; ++i) put("o" + std::to_string(i), 2 + 2 * i, resistance > 0 ? 0 : 0.01);
  if (is_last) put("r", 0, resistance);
  w.start({{"joints", std::string("position")}, {"effort_joints", std::vector<std::string>{"foot"}}});
  w.run_for(0.6);
  return w.world().hash(*w.world().find_robot("r"));
}

TEST(PacksOfRobots, OnOtherGroundsMoveAsEachDoesAlone) {
  for (const double resistance : {0.0, 0.01}) {
    const std::uint64_t alone = hash_beside(0, resistance, true);
    for (const int others : {1, 3, 7})
      for (const bool is_last : {false, true})
        EXPECT_EQ(hash_beside(others, resistance, is_last), alone) << resistance << " m, " << others << " others";
  }
}

void expect_the_same_bits(double restitution) {
  std::vector<std::uint64_t> alone;
  {
    const InstructionSet base("base");
    for (int i = 0; i < 8; ++i) alone.push_back(hashes_of(i, 1, restitution)[0]);
  }
  const std::pair<lane::Isa, const char*> sets[] = {
      {lane::Isa::base, "base"}, {lane::Isa::avx2, "avx2"}, {lane::Isa::avx512, "avx512"}};
  const lane::Isa best = lane::best_isa();
  for (const auto& [isa, name] : sets) {
    if (isa > best) continue;  // this processor cannot run it
    const InstructionSet set(name);
    for (const int count : {2, 3, 5, 8}) {
      const std::vector<std::uint64_t> together = hashes_of(0, count, restitution);
      for (std::size_t i = 0; i < together.size(); ++i)
        EXPECT_EQ(together[i], alone[i]) << "robot " << i << " of " << count << ", " << name;
    }
  }
}

TEST(PacksOfRobots, OfDifferentMassesMoveAsEachDoesAlone) { expect_the_same_bits(0); }

TEST(PacksOfRobots, ThatReboundWithFrictionAndAreSqueezedMoveAsEachDoesAlone) { expect_the_same_bits(0.3); }

}  // namespace
}  // namespace muro::articulated::testing
