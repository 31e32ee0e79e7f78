// SPDX-License-Identifier: MIT
// Robots that touch each other and have different motions: for every pair of motions by forces.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {
namespace {

using Pair = std::tuple<std::string, std::string>;

/// Returns pairs with motion.simplified, whose contacts are those of contact.penalty, or pairs of the others alone.
std::vector<Pair> pairs(bool with_simplified) {
  std::vector<std::string> moved;
  for (const std::string& id : motions())
    if ((description_of(id).features & feature_contact) != 0) moved.push_back(id);
  std::vector<Pair> all;
  for (const std::string& a : moved)
    for (const std::string& b : moved)
      if ((a == "motion.simplified" || b == "motion.simplified") == with_simplified) all.emplace_back(a, b);
  return all;
}

std::string name_of_pair(const ::testing::TestParamInfo<Pair>& test) {
  std::string name = std::get<0>(test.param) + "_and_" + std::get<1>(test.param);
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

struct Ball {
  double mass, radius;
  Vec3 position, velocity, spin = Vec3::Zero();
};

/// Bodies, each with a motion of its own. Two with one motion are in one of its worlds, unless `world` differs.
struct PairScene : test::Scene {
  struct Body {
    const RobotView* robot;
    double mass, moment;
  };
  std::vector<Body> bodies;

  explicit PairScene(const Vec3& gravity = Vec3::Zero()) { world().set(world_object, keys::gravity, gravity); }

  void add_body(const std::string& motion, const RobotTree& tree, const Inertia& inertia, const Pose& at,
                const Twist& twist = {}, std::map<std::string, ParameterInput> parameters = {}) {
    const std::string name = "r" + std::to_string(bodies.size());
    bodies.push_back({&add(name, tree, at, twist), inertia.mass, inertia.ixx});
    if ((description_of(motion).capabilities & Capability::world) == 0) parameters.clear();
    use(motion, 1000, {{bodies.back().robot, bodies.back().robot->base()}}, std::move(parameters));
  }
  void add_ball(const std::string& motion, const Ball& b, double friction, double restitution,
                const std::string& world = "", int substeps = 1) {
    add_body(motion, ball(b.mass, b.radius, friction, restitution), {.mass = b.mass, .ixx = moment(b)},
             {b.position, Quat::Identity()}, {b.velocity, b.spin},
             {{"world", world}, {"substeps", std::int64_t(substeps)}});
  }
  void start() {
    use_contacts();
    build();
  }
  static double moment(const Ball& b) { return 0.4 * b.mass * b.radius * b.radius; }

  Vec3 momentum() {
    Vec3 sum = Vec3::Zero();
    for (const Body& b : bodies) sum += b.mass * twist(*b.robot).linear;
    return sum;
  }
  /// Returns the angular momentum about the origin; bodies are balls.
  Vec3 angular_momentum() {
    Vec3 sum = Vec3::Zero();
    for (const Body& b : bodies)
      sum += b.mass * pose(*b.robot).position.cross(twist(*b.robot).linear) + b.moment * twist(*b.robot).angular;
    return sum;
  }
  double energy() {
    double sum = 0;
    for (const Body& b : bodies)
      sum +=
          0.5 * b.mass * twist(*b.robot).linear.squaredNorm() + 0.5 * b.moment * twist(*b.robot).angular.squaredNorm();
    return sum;
  }
};

class EveryPair : public ::testing::TestWithParam<Pair> {
 protected:
  std::string first() const { return std::get<0>(GetParam()); }
  std::string second() const { return std::get<1>(GetParam()); }
};

/// A collision of two balls in two worlds, and the quantities that it must keep.
struct Collision {
  Vec3 before, angular_before;
  double energy_before;

  PairScene scene;
  Collision(const std::string& a, const std::string& b, const Ball& x, const Ball& y, double friction,
            double restitution, int substeps = 1) {
    scene.add_ball(a, x, friction, restitution, "left", substeps);
    scene.add_ball(b, y, friction, restitution, "right");
    scene.start();
    before = scene.momentum();
    angular_before = scene.angular_momentum();
    energy_before = scene.energy();
    const double size = 2 * scene.bodies[0].mass;  // kg m/s
    for (int k = 0; k < 100; ++k) {
      scene.run_for(0.01);
      EXPECT_LT((scene.momentum() - before).norm(), 1e-9 * size) << "after " << k << " hundredths of a second";
      EXPECT_LT((scene.angular_momentum() - angular_before).norm(), 1e-9 * size) << "m^2/s; at " << k;
      EXPECT_LE(scene.energy(), energy_before * (1 + 1e-3)) << "springs hold some of it; at " << k;
    }
    EXPECT_LE(scene.energy(), energy_before * (1 + 1e-9)) << "no energy is gained";
  }
  Vec3 velocity(std::size_t i) { return scene.twist(*scene.bodies[i].robot).linear; }
};

TEST_P(EveryPair, KeepsItsMomentaAndReboundsInAHeadOnCollision) {
  for (const double e : {0.0, 0.5, 0.9}) {
    Collision c(first(), second(), {2, 0.1, {-0.3, 0, 0}, {1, 0, 0}}, {1, 0.1, {0.3, 0, 0}, {-0.5, 0, 0}}, 0, e);
    const double seen = (c.velocity(1).x() - c.velocity(0).x()) / 1.5;
    // Two bodies whose motions take impacts at their instant exchange an impulse. Otherwise contact.penalty has
    // springs, with 0.135 instead of 0; where twists lag behind poses, it loses the last half step of a contact.
    const auto takes_impacts = [](const std::string& motion) {
      return motion == "motion.simplified" || motion == "motion.articulated";
    };
    const bool impulse = takes_impacts(first()) && takes_impacts(second());
    EXPECT_NEAR(seen, e == 0 && !impulse ? 0.135 : e, impulse ? 1e-9 : 0.07)
        << first() << " and " << second() << " with restitution " << e;
  }
}

TEST_P(EveryPair, KeepsItsMomentaInAnObliqueCollisionWithFriction) {
  Collision c(first(), second(), {2, 0.1, {-0.3, 0.05, 0.02}, {1, 0, 0}, {1, 2, 3}},
              {1, 0.15, {0.3, 0, 0}, {-0.5, 0.1, 0}, {0, -1, 2}}, 0.4, 0.5);
  EXPECT_GT((c.velocity(0) - Vec3(1, 0, 0)).norm(), 0.1) << "there was an impact";
}

TEST_P(EveryPair, KeepsItsMomentaWhereOneEngineTakesSubsteps) {
  Collision c(first(), second(), {2, 0.1, {-0.3, 0.05, 0.02}, {1, 0, 0}, {1, 2, 3}},
              {1, 0.15, {0.3, 0, 0}, {-0.5, 0.1, 0}, {0, -1, 2}}, 0.4, 0.5, 4);
}

TEST_P(EveryPair, ComesToRestOneOnTheOther) {
  // One body stands on the other for 60 s. The lower one stands on the ground of its own motion.
  PairScene m({0, 0, -9.81});
  m.add_ground();
  const Vec3 low(0.4, 0.4, 0.2), high(0.2, 0.2, 0.2);
  m.add_body(first(), block(4, low, 0.8), solid_box(4, low), {{0, 0, 0.1}, Quat::Identity()}, {},
             {{"world", std::string("low")}});
  m.add_body(second(), block(1, high, 0.8), solid_box(1, high), {{0.03, 0.02, 0.3}, from_rpy(0, 0, 0.3)}, {},
             {{"world", std::string("high")}});
  m.start();
  m.run_for(2);
  const Pose before = m.pose(*m.bodies[1].robot);
  EXPECT_NEAR(before.position.z(), 0.3, 2e-3);
  m.run_for(58);
  const Pose after = m.pose(*m.bodies[1].robot);
  EXPECT_LT((after.position - before.position).norm(), 2e-3) << after.position.transpose();
  EXPECT_LT(after.orientation.angularDistance(before.orientation), 0.02);
}

/// Returns how deep a box of one motion sinks into a board of another motion that lies on the ground, m.
double sunk_into_a_board(const std::string& low, const std::string& high, double board, double load) {
  PairScene m({0, 0, -9.81});
  m.add_ground();
  const Vec3 flat(0.8, 0.6, 0.02), box(0.3, 0.3, 0.2);
  m.add_body(low, block(board, flat, 0.8), solid_box(board, flat), {{0, 0, 0.01}, Quat::Identity()}, {},
             {{"world", std::string("low")}});
  m.add_body(high, block(load, box, 0.8), solid_box(load, box), {{0.03, 0.02, 0.12}, from_rpy(0, 0, 0.3)}, {},
             {{"world", std::string("high")}});
  m.start();
  m.run_for(3);
  return 0.11 - (m.pose(*m.bodies[1].robot).position.z() - m.pose(*m.bodies[0].robot).position.z());
}

TEST_P(EveryPair, CarriesALoadOfTenTimesItsMass) {
  for (const auto& [board, load] : {std::pair(1.0, 10.0), std::pair(10.0, 1.0)})
    EXPECT_NEAR(sunk_into_a_board(first(), second(), board, load), 0, 2.05e-4) << load << " kg on " << board;
}

TEST_P(EveryPair, CarriesALoadOfAThousandTimesItsMass) {
  // The force that holds a body up in an engine is not visible outside.
  if (description_of(first()).capabilities & Capability::world) return;
  EXPECT_NEAR(sunk_into_a_board(first(), second(), 0.1, 100), 0, 2.05e-4);
}

TEST_P(EveryPair, SlidesOneOnTheOtherWithTheFrictionOfTheMaterials) {
  PairScene m({0, 0, -9.81});
  m.add_ground();
  const Vec3 slab(4, 1, 0.2), box(0.2, 0.2, 0.1);
  m.add_body(first(), block(100, slab, 0.4), solid_box(100, slab), {{1, 0, 0.1}, Quat::Identity()}, {},
             {{"world", std::string("low")}});
  m.add_body(second(), block(1, box, 0.4), solid_box(1, box), {{0, 0, 0.25}, Quat::Identity()},
             {{2, 0.5, 0}, Vec3::Zero()}, {{"world", std::string("high")}});
  m.start();
  m.run_for(0.1);  // they have sunk in
  const Vec3 before = m.twist(*m.bodies[1].robot).linear;
  m.run_for(0.2);
  const Vec3 change = m.twist(*m.bodies[1].robot).linear - before;
  EXPECT_NEAR(change.norm(), 0.4 * 9.81 * 0.2, 0.02 * 0.4 * 9.81 * 0.2);
  EXPECT_GT(-change.normalized().dot(before.normalized()), 0.999) << "straight against the slip";
  EXPECT_LT(m.twist(*m.bodies[0].robot).linear.norm(), 1e-3) << "friction on the ground holds the slab";
  m.run_for(1);
  EXPECT_LT(m.twist(*m.bodies[1].robot).linear.norm(), 1e-3) << "it has come to rest";
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryPair, ::testing::ValuesIn(pairs(true)), name_of_pair);
INSTANTIATE_TEST_SUITE_P(SlowConformance, EveryPair, ::testing::ValuesIn(pairs(false)), name_of_pair);

}  // namespace
}  // namespace muro::conformance
