// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "contact_law.hpp"
#include "patch.hpp"
#include "standings.hpp"

namespace muro::penalty {
namespace {

constexpr double omega = 2 * M_PI * 50, h = 0.001, elapsed = 0.001, restitution = 0.4;

/// A vehicle of four bodies on one patch, each body with two contacts; numbers of its own.
struct Vehicle {
  Pose base, bodies[4];
  Twist twist, twists[4];
  StandingMass mass;
  Contact contacts[8];
  Grip grips[8];
  Wrench wrench;

  StandingRobot view() {
    StandingRobot v;
    v.contacts = contacts[0].point.data();
    v.grips = grips[0].point.data();
    v.base_pose = base.position.data();
    v.base_twist = twist.linear.data();
    v.mass = &mass;
    v.wrench = wrench.force.data();
    for (int k = 0; k < 4; ++k) {
      v.body_pose[k] = bodies[k].position.data();
      v.body_twist[k] = twists[k].linear.data();
    }
    return v;
  }
};

/// `speed` (m/s) decides which branch of the law contacts are in: at rest, sliding, meeting, parting.
Vehicle random_vehicle(std::mt19937& random, double speed) {
  std::normal_distribution<double> g;
  const auto vector = [&](double most) { return Vec3(most * g(random), most * g(random), most * g(random)); };
  Vehicle v;
  v.base = {vector(5), rotation_of(vector(1))};
  v.twist = {vector(speed), vector(speed)};
  const Vec3 moments = vector(1).cwiseAbs() + Vec3::Constant(0.02);
  const Mat3 inverse = moments.cwiseInverse().asDiagonal();
  v.mass.inverse_mass = 0.1 + std::abs(g(random));
  std::copy_n(vector(0.05).data(), 3, v.mass.com);
  std::copy_n(inverse.data(), 9, v.mass.inverse_inertia);
  const Vec3 normal = Vec3(0.1 * g(random), 0.1 * g(random), 1).normalized();
  for (int k = 0; k < 4; ++k) {
    v.bodies[k] = {v.base.position + vector(0.2), rotation_of(vector(1))};
    v.twists[k] = {vector(speed), vector(speed)};
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    Contact& c = v.contacts[i];
    c.self = ObjectId{10 + i / 2};
    c.other = ObjectId{1};
    c.point = v.bodies[i / 2].position + vector(0.1);
    c.normal = normal;
    c.depth = 1e-3 * std::abs(g(random));
    c.friction = 0.8;
    c.restitution = restitution;
    v.grips[i] = {i / 2, c.point + vector(0.02), vector(1e-4)};
  }
  return v;
}

StandingWork work() {
  StandingWork w;
  w.contacts = 8;
  w.groups = 4;
  for (int g = 0; g < 4; ++g) w.ends[g] = 2 * (g + 1);
  w.omega = omega;
  w.h = h;
  w.zeta = damping_ratio_of(restitution);
  w.z = std::tanh(w.zeta * omega * h);
  w.elapsed = elapsed;
  w.same_direction = 0.99;
  return w;
}

/// The same by Patch, NormalLaw, FrictionLaw and previous(), contact by contact.
Wrench by_the_laws(const Vehicle& v, std::vector<Grip>& grips) {
  const Mat3 r = v.base.orientation.toRotationMatrix();
  const Mobility body{v.mass.inverse_mass, r * Mat3(v.mass.inverse_inertia) * r.transpose(),
                      v.base.position + r * Vec3(v.mass.com)};
  Patch patch(v.contacts[0].normal, v.contacts[0].point);
  for (const Contact& c : v.contacts) patch.add(c.point);
  const Yield middle = patch.at_middle(body);
  const double along = 1 / (middle.along * patch.count()), across = 1 / (0.5 * middle.across * patch.count());
  const double load = patch.resistance(body, along, across).greatest(body);
  const Stiffness s{omega, h};
  const NormalLaw normal_law(s, damping_ratio_of(restitution), load);
  const FrictionLaw friction_law(s, load);
  const std::vector<Grip> before(std::begin(v.grips), std::end(v.grips));
  Wrench total;
  for (std::size_t i = 0; i < 8; ++i) {
    const Contact& c = v.contacts[i];
    const Vec3 motion = v.twists[i / 2].at(c.point - v.bodies[i / 2].position);
    const double approach = -motion.dot(c.normal);
    const Vec3 slip = motion + approach * c.normal;
    Vec3 stretch = previous(before, i, i / 2, c.point)->stretch + slip * elapsed;
    stretch -= c.normal * c.normal.dot(stretch);
    const double normal = along * normal_law.force(c.depth, approach);
    const Vec3 force = normal * c.normal + across * friction_law.force(stretch, slip, c.friction * normal / across);
    grips.push_back({i / 2, c.point, stretch});
    total.add_force(force, c.point - v.base.position);
  }
  return total;
}

TEST(StandingKernel, AgreesWithTheLawsContactByContact) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    Vehicle v = random_vehicle(random, std::pow(10, -4 + round % 6));
    std::vector<Grip> grips;
    const Wrench expected = by_the_laws(v, grips);
    const StandingRobot view = v.view();
    const StandingRobot* const views[] = {&view};
    ASSERT_EQ(standing_kernels_for(lane::best_isa()).push_one(work(), views), 0u);
    const double scale = 1e-9 * (1 + expected.force.norm() + expected.torque.norm());
    ASSERT_LT((v.wrench.force - expected.force).norm(), scale) << round;
    ASSERT_LT((v.wrench.torque - expected.torque).norm(), scale) << round;
    for (std::size_t i = 0; i < 8; ++i) {
      ASSERT_EQ(v.grips[i].point, grips[i].point);
      ASSERT_EQ(v.grips[i].pair, grips[i].pair);
      ASSERT_LT((v.grips[i].stretch - grips[i].stretch).norm(), 1e-9 * (1 + grips[i].stretch.norm())) << round;
    }
  }
}

TEST(StandingKernel, EightRobotsAtOnceGetTheBitsOfEachAloneWithAnyInstructionSet) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vehicle> drawn;
    for (int k = 0; k < 8; ++k) drawn.push_back(random_vehicle(random, std::pow(10, -4 + (round + k) % 6)));
    if (round % 3 == 0) drawn[5].contacts[6].normal = Vec3::UnitX();  // no patch: this one is left
    for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512}) {
      if (isa > lane::best_isa()) continue;  // this processor cannot run it
      std::vector<Vehicle> together = drawn, alone = drawn;
      StandingRobot together_views[8], alone_views[8];
      const StandingRobot* views[8];
      for (std::size_t k = 0; k < 8; ++k) {
        together_views[k] = together[k].view();
        alone_views[k] = alone[k].view();
        views[k] = &together_views[k];
      }
      const unsigned left = standing_kernels_for(isa).push_eight(work(), views);
      EXPECT_EQ(left, round % 3 == 0 ? 1u << 5 : 0u);
      for (std::size_t k = 0; k < 8; ++k) {
        const StandingRobot* const view[] = {&alone_views[k]};
        ASSERT_EQ(standing_kernels_for(lane::Isa::base).push_one(work(), view), left >> k & 1);
        ASSERT_EQ(std::memcmp(&alone[k].wrench, &together[k].wrench, sizeof(Wrench)), 0) << "robot " << k;
        ASSERT_EQ(std::memcmp(alone[k].grips, together[k].grips, sizeof alone[k].grips), 0) << "robot " << k;
      }
    }
  }
}

}  // namespace
}  // namespace muro::penalty
