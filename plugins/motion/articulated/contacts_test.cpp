// SPDX-License-Identifier: MIT
// Contacts and friction of single bodies, compared with closed forms.
#include "articulated_testing.hpp"

namespace muro::articulated::testing {
namespace {

/// Returns the frequency (Hz) at which contacts of a robot of `mass` (kg) have `stiffness` (N/m).
double frequency_of(double stiffness, double mass) { return std::sqrt(stiffness / mass) / (2 * M_PI); }

TEST(ABlockOnASlope, IsHeldByFrictionAndDoesNotCreep) {
  for (const double stiffness : {1e4, 1e5, 1e6})
    for (const double degrees : {5.0, 20.0, 28.0}) {
      const double slope = degrees * M_PI / 180;
      World w;
      w.add_ground(0.6, {Vec3::Zero(), from_rpy(0, -slope, 0)});
      const Quat along = from_rpy(0, -slope, 0);
      const RobotView& r = w.add("r", test::block(3, {0.3, 0.2, 0.1}, 0.6), {along * Vec3(0, 0, 0.05), along});
      w.start({{"frequency", frequency_of(stiffness, 3)}});
      w.run_for(4);
      const Vec3 before = w.pose(r).position;
      w.run_for(1);
      EXPECT_LT((w.pose(r).position - before).norm(), degrees < 28 ? 1e-6 : 2e-6)
          << stiffness << " N/m, " << degrees << " degrees";
    }
}

TEST(ABlockOnASlope, SlidesWithTheAccelerationOfCoulomb) {
  for (const double stiffness : {1e4, 1e6}) {
    const double slope = 40 * M_PI / 180;
    World w;
    w.add_ground(0.5, {Vec3::Zero(), from_rpy(0, -slope, 0)});
    const Quat along = from_rpy(0, -slope, 0);
    const RobotView& r = w.add("r", test::block(3, {0.3, 0.2, 0.1}, 0.5), {along * Vec3(0, 0, 0.05), along});
    w.start({{"frequency", frequency_of(stiffness, 3)}});
    w.run_for(0.3);
    const Vec3 before = w.twist(r).linear;
    w.run_for(0.5);
    const double expected = g * (std::sin(slope) - 0.5 * std::cos(slope)) * 0.5;
    EXPECT_NEAR((w.twist(r).linear - before).norm(), expected, 2e-3 * expected) << stiffness << " N/m";
  }
}

/// The foot bears much less than the contacts of its robot are made for, and its overlap from the landing decreases
/// slowly.
TEST(ALightFoot, ThatADriveHasPutDownStaysDown) {
  World w;
  w.add_ground();
  const RobotView& r = w.add("r", test::tree_of([](RobotBuilder& b) {
                               const Shape ball = Shape::sphere(0.02);
                               b.base("trunk");
                               b.set(keys::inertial, test::solid_box(12, {0.3, 0.3, 0.3}));
                               b.prismatic("leg", Vec3::UnitZ(), {.lower = -1, .upper = 1, .effort = 100});
                               b.body("foot");
                               b.set(keys::inertial, test::solid_box(0.2, {0.04, 0.04, 0.04}));
                               b.set_array(keys::collision_shapes, std::span<const Shape>(&ball, 1));
                             }),
                             {{0, 0, 0.03}, Quat::Identity()});
  w.start({{"joints", std::string("effort")}, {"base", std::string("fixed")}});
  for (const double effort : {27.0, 10.0, 50.0}) {
    w.of("r/leg", keys::joint_effort_target) = -effort;
    for (int k = 0; k < 1000; ++k) {
      w.run_for(0.001);
      if (k > 100) {
        ASSERT_NEAR(w.contact_force(r).z(), effort + 0.2 * g, 0.1 * effort) << effort << " N, step " << k;
      }
    }
  }
}

/// Three links of one body: the base, and two feet on fixed joints, at its front and its back.
TEST(LinksOfOneBody, AreToldTheWrenchOfTheirOwnContacts) {
  for (const int robots : {1, 8}) {  // one robot alone, and a pack
    World w;
    w.add_ground();
    const RobotTree tree = test::tree_of([](RobotBuilder& b) {
      const Shape box = Shape::box({0.1, 0.2, 0.1});
      b.base("trunk");
      b.set(keys::inertial, test::solid_box(3, {0.6, 0.2, 0.1}));
      const auto foot = [&](const char* name, double x) {
        b.translation({x, 0, -0.1});
        b.body(name);
        b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
        b.end();
      };
      b.fork();
      foot("front_foot", 0.2);
      foot("rear_foot", -0.25);
    });
    for (int i = 0; i < robots; ++i) w.add("r" + std::to_string(i), tree, {{0, 1.0 * i, 0.15}, Quat::Identity()});
    w.start();
    w.run_for(1);
    for (int i = 0; i < robots; ++i) {
      const std::string name = "r" + std::to_string(i);
      const Wrench front = w.world().value(name + "/front_foot", keys::contact_wrench),
                   rear = w.world().value(name + "/rear_foot", keys::contact_wrench);
      EXPECT_NEAR(front.force.z() + rear.force.z(), 3 * g, 1e-3);
      EXPECT_NEAR(0.2 * front.force.z() - front.torque.y(), 0.25 * rear.force.z() + rear.torque.y(), 1e-3)
          << "they balance about the trunk";
      EXPECT_GT(front.force.z(), g) << i;
      EXPECT_GT(rear.force.z(), g) << i;
    }
  }
}

/// The robots are a pack, and one of them is in the air.
TEST(ABodyOffItsMiddle, IsToldTheWrenchThatHoldsIt) {
  World w;
  w.add_ground();
  const double mass = 2, off = 0.06;
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    const Shape box = Shape::box({0.4, 0.3, 0.1});
    b.base("body");
    Inertia inertia = test::solid_box(mass, {0.4, 0.3, 0.1});
    inertia.com = {off, 0, 0};
    b.set(keys::inertial, inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
  });
  constexpr int flying = 3;
  for (int i = 0; i < 8; ++i)
    w.add("r" + std::to_string(i), tree, {{1.0 * i, 0, i == flying ? 20 : 0.05}, Quat::Identity()});
  w.start();
  w.run_for(1);
  for (int i = 0; i < 8; ++i) {
    const Wrench wrench = w.world().value("r" + std::to_string(i) + "/body", keys::contact_wrench);
    const double weight = i == flying ? 0 : mass * g;
    EXPECT_NEAR(wrench.force.z(), weight, 1e-6 * mass * g) << i;
    EXPECT_NEAR(wrench.torque.y(), -off * weight, 1e-3) << i;
    EXPECT_NEAR(wrench.torque.x(), 0, 1e-3) << i;
  }
}

TEST(Friction, IsACone) {
  for (const double degrees : {0.0, 20.0, 45.0, 70.0}) {
    const double angle = degrees * M_PI / 180, mass = 2, mu = 0.5;
    const Vec3 way(std::cos(angle), std::sin(angle), 0);
    World w;
    w.add_ground(mu);
    const RobotView& r = w.add("r", test::block(mass, {0.2, 0.2, 0.02}, mu), {{0, 0, 0.01}, Quat::Identity()});
    Wrench& push = w.push(r);
    w.start();
    w.run_for(0.5);
    push.force = 0.98 * mu * mass * g * way;
    w.run_for(1);
    EXPECT_LT(w.twist(r).linear.norm(), 1e-5) << degrees << " degrees: it holds";
    push.force = 1.3 * mu * mass * g * way;
    w.run_for(0.1);
    const Vec3 before = w.twist(r).linear;
    w.run_for(0.5);
    const Vec3 gained = w.twist(r).linear - before;
    EXPECT_NEAR(gained.dot(way), 0.3 * mu * g * 0.5, 0.01 * 0.3 * mu * g * 0.5) << degrees << " degrees";
    EXPECT_LT((gained - gained.dot(way) * way).norm(), 0.01 * gained.norm()) << "straight along the push";
  }
}

TEST(ABall, ReboundsToTheSquareOfItsRestitution) {
  for (const double e : {0.3, 0.6, 0.9}) {
    World w;
    w.add_ground();
    const RobotView& r = w.add("r", test::ball(1, 0.1, 0.5, e), {{0, 0, 1.1}, Quat::Identity()});
    w.start();
    double highest = 0;
    bool has_fallen = false;
    for (int k = 0; k < 1200; ++k) {
      w.run_for(0.001);
      has_fallen = has_fallen || w.twist(r).linear.z() > 0;
      if (has_fallen && (highest == 0 || w.twist(r).linear.z() > -0.5))
        highest = std::max(highest, w.pose(r).position.z() - 0.1);
      if (has_fallen && w.twist(r).linear.z() < 0) break;
    }
    EXPECT_NEAR(highest, e * e, 0.01) << e << "; of a fall of 1 m, at whose end a step goes 4 mm";
  }
}

TEST(ABall, IsNoDeeperInABoxThanItFliesInAStepAtAnyRebound) {
  for (const char* collision : {"collision.native", "collision.fcl"}) {
    World w;
    const Shape floor = test::with(Shape::box({1, 1, 0.5}), 0.5);
    w.world().add_scenery("floor", {{0, 0, -0.25}, Quat::Identity()}, std::span<const Shape>(&floor, 1));
    const RobotView& r = w.add("r", test::ball(1, 0.1, 0.5, 0.8), {{0, 0, 0.3}, Quat::Identity()});
    w.use("motion.articulated", 1000, w.all_robots());
    w.use_kinematics();
    w.use("scene.bvh", 0);
    w.use(collision, 0);
    w.use("contact.penalty", 0);
    w.build();
    int rebounds = 0;
    double before = 0;
    for (int k = 0; k < 3000 && rebounds < 4; ++k) {
      w.run_for(0.001);
      const double v = w.twist(r).linear.z();
      EXPECT_LT(0.1 - w.pose(r).position.z(), 1.2e-3 * std::abs(before)) << collision << ", " << rebounds;
      rebounds += before < 0 && v > 0;
      before = v;
    }
    EXPECT_EQ(rebounds, 4) << collision;
  }
}

TEST(ABall, RollsDownASlope) {
  const double slope = 0.2;
  World w;
  w.add_ground(0.8, {Vec3::Zero(), from_rpy(0, -slope, 0)});
  const Quat along = from_rpy(0, -slope, 0);
  const RobotView& r = w.add("r", test::ball(2, 0.1, 0.8), {along * Vec3(0, 0, 0.1), along});
  w.start();
  w.run_for(1);
  const double expected = 5.0 / 7 * g * std::sin(slope);
  EXPECT_NEAR(w.twist(r).linear.norm(), expected, 0.01 * expected);
  EXPECT_NEAR(w.twist(r).angular.norm() * 0.1, w.twist(r).linear.norm(), 0.01 * expected) << "without slip";
}

/// A robot that no force moves, and a block that motion.articulated moves.
struct Moved : World {
  const RobotView* mover;
  const RobotView* block;
  Moved(const Vec3& size, const Vec3& at, const Vec3& block_at, double friction) {
    add_ground(friction);
    mover = &add("mover", test::block(10, size, friction), {at, Quat::Identity()});
    const std::vector<Item> kinematic = all_robots();
    block = &add("block", test::block(1, {0.2, 0.2, 0.2}, friction), {block_at, Quat::Identity()});
    use("motion.point", 1000, kinematic);
    use("motion.articulated", 1000, {all_robots().back()});
    use_contacts();
    build();
  }
  void command(const Vec3& velocity) { world().value(mover->base(), keys::command_twist).linear = velocity; }
};

TEST(AKinematicRobot, PushesABlock) {
  Moved s({0.2, 0.4, 0.4}, {0, 0, 0.2}, {0.3, 0, 0.1}, 0.3);
  s.command({0.5, 0, 0});
  s.run_for(3);
  EXPECT_NEAR(s.twist(*s.block).linear.x(), 0.5, 1e-3);
  EXPECT_NEAR(s.pose(*s.block).position.x() - s.pose(*s.mover).position.x(), 0.2, 2e-3);
}

TEST(AKinematicRobot, DragsABlockByFriction) {
  Moved s({6, 1, 0.2}, {0, 0, 0.1}, {0, 0, 0.3}, 0.3);
  s.run_for(0.5);
  s.command({1, 0, 0});
  s.run_for(0.2);
  EXPECT_NEAR(s.twist(*s.block).linear.x(), 0.3 * g * 0.2, 0.02 * 0.3 * g * 0.2) << "it slips";
  s.run_for(0.8);
  EXPECT_NEAR(s.twist(*s.block).linear.x(), 1, 1e-6) << "it goes with what carries it";
}

}  // namespace
}  // namespace muro::articulated::testing
