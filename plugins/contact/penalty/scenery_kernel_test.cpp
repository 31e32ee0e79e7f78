// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "friction_anchor.hpp"
#include "muro/scene.hpp"
#include "muro/toolkit/rotations.hpp"
#include "restitution.hpp"
#include "scenery_kernel.hpp"

namespace muro::penalty {
namespace {

constexpr double omega = 2 * M_PI * 50, h = 0.001, elapsed = 0.001, restitution = 0.4;

/// A vehicle of four bodies on one patch, each body with two contacts; numbers of its own.
struct Vehicle {
  Pose base, bodies[4];
  Twist twist, twists[4];
  Contact contacts[8];
  FrictionAnchor anchors[8];
  Wrench wrench;

  KernelRobot view() {
    KernelRobot v;
    v.contacts = contacts[0].point.data();
    v.before = v.anchors = anchors[0].point.data();
    v.base_pose = base.position.data();
    v.base_twist = twist.linear.data();
    v.link_pose = bodies[0].position.data();
    v.link_twist = twists[0].linear.data();
    v.wrench = wrench.force.data();
    return v;
  }
};

/// `speed` (m/s) decides which branch of the law contacts are in: at rest, sliding, approaching, parting.
Vehicle random_vehicle(std::mt19937& random, double speed) {
  std::normal_distribution<double> g;
  const auto vector = [&](double most) { return Vec3(most * g(random), most * g(random), most * g(random)); };
  Vehicle v;
  v.base = {vector(5), rotation_of(vector(1))};
  v.twist = {vector(speed), vector(speed)};
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
    c.surface.friction = 0.8;
    c.surface.restitution = restitution;
    v.anchors[i] = {i / 2, c.point + vector(0.02), vector(1e-4)};
  }
  return v;
}

/// Of all vehicles.
const MassProperties mass{
    .inverse_mass = 0.4, .com = {0.02, -0.01, 0.03}, .inverse_inertia = {1.5, 2.5, 0.9, 0.1, -0.2, 0.3}};

/// Two contacts a body.
const ContactLayout& layout() {
  static const ContactLayout two_each = [] {
    ContactLayout l;
    l.contacts = 8;
    l.groups = 4;
    for (int g = 0; g < 4; ++g) {
      l.ends[g] = std::uint8_t(2 * (g + 1));
      l.zeta[g] = damping_ratio_of(restitution);
      l.bodies[g] = {true, std::ptrdiff_t(g * sizeof(Pose) / sizeof(double)),
                     std::ptrdiff_t(g * sizeof(Twist) / sizeof(double))};
    }
    return l;
  }();
  return two_each;
}

KernelBatch work() {
  return {
      .stiffness = {omega, h}, .elapsed = elapsed, .mass = &mass, .layout = &layout(), .anchors_ends = layout().ends};
}

/// The same in matrices, contact by contact: the model in the plugin's README.
Wrench by_the_model(const Vehicle& v, std::vector<FrictionAnchor>& anchors) {
  const Mat3 r = v.base.orientation.toRotationMatrix();
  const double* const i = mass.inverse_inertia;
  const Mat3 own = (Mat3() << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]).finished();
  const Mat3 inertia = r * own * r.transpose();
  const Vec3 centre = v.base.position + r * Vec3(mass.com), n = v.contacts[0].normal;
  Vec3 middle = Vec3::Zero();
  for (const Contact& c : v.contacts) middle += (c.point - centre) / 8;
  const auto inverse_mass_along = [&](const Vec3& d) {
    return mass.inverse_mass + middle.cross(d).dot(inertia * middle.cross(d));
  };
  const Vec3 u = n.unitOrthogonal();
  const double along = 1 / (8 * inverse_mass_along(n)),
               across = 2 / (8 * (inverse_mass_along(u) + inverse_mass_along(n.cross(u))));
  Mat3 shift = Mat3::Zero(), turn = Mat3::Zero();  // stiffness of the springs
  for (const Contact& c : v.contacts) {
    const Vec3 p = c.point - centre;
    const Mat3 cross = (Mat3() << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0).finished();
    const Mat3 spring = across * Mat3::Identity() + (along - across) * n * n.transpose();
    shift += spring;
    turn += cross * spring * cross.transpose();
  }
  const double load = mass.inverse_mass * shift.norm() + std::sqrt((inertia * turn * inertia * turn).trace());
  const law::NormalLaw<double> normal_law({omega, h}, damping_ratio_of(restitution), load);
  const law::FrictionLaw<double> friction_law({omega, h}, load);
  const std::vector<FrictionAnchor> before(std::begin(v.anchors), std::end(v.anchors));
  Wrench total;
  for (std::size_t k = 0; k < 8; ++k) {
    const Contact& c = v.contacts[k];
    const Vec3 motion = v.twists[k / 2].at(c.point - v.bodies[k / 2].position);
    const double approach = -motion.dot(c.normal);
    const Vec3 slip = motion + approach * c.normal;
    Vec3 displacement = previous<FrictionAnchor>(before, k, k / 2, c.point)->displacement + slip * elapsed;
    displacement -= c.normal * c.normal.dot(displacement);
    const double normal = along * normal_law.force(c.depth, approach);
    lane::V3<double> spring{displacement.x(), displacement.y(), displacement.z()};
    const lane::V3<double> f =
        friction_law.force(spring, {slip.x(), slip.y(), slip.z()}, c.surface.friction * normal / across);
    anchors.push_back({k / 2, c.point, {spring.x, spring.y, spring.z}});
    total.add_force(normal * c.normal + across * Vec3(f.x, f.y, f.z), c.point - v.base.position);
  }
  return total;
}

TEST(SceneryKernel, AgreesWithTheModelContactByContact) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    Vehicle v = random_vehicle(random, std::pow(10, -4 + round % 6));
    std::vector<FrictionAnchor> anchors;
    const Wrench expected = by_the_model(v, anchors);
    const KernelRobot view = v.view();
    const KernelRobot* const views[] = {&view};
    ASSERT_EQ(scenery_kernels_for(lane::best_isa()).apply_forces(work(), views, 1), 0u);
    const double scale = 1e-9 * (1 + expected.force.norm() + expected.torque.norm());
    ASSERT_LT((v.wrench.force - expected.force).norm(), scale) << round;
    ASSERT_LT((v.wrench.torque - expected.torque).norm(), scale) << round;
    for (std::size_t i = 0; i < 8; ++i) {
      ASSERT_EQ(v.anchors[i].point, anchors[i].point);
      ASSERT_EQ(v.anchors[i].pair, anchors[i].pair);
      ASSERT_LT((v.anchors[i].displacement - anchors[i].displacement).norm(),
                1e-9 * (1 + anchors[i].displacement.norm()))
          << round;
    }
  }
}

TEST(SceneryKernel, EightRobotsGetTheBitsOfEachAloneOnAnyIsa) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vehicle> drawn;
    for (int k = 0; k < 8; ++k) drawn.push_back(random_vehicle(random, std::pow(10, -4 + (round + k) % 6)));
    if (round % 3 == 0) drawn[5].contacts[6].normal = Vec3::UnitX();  // no patch: this one is left
    for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512}) {
      if (isa > lane::best_isa()) continue;  // this processor cannot run it
      std::vector<Vehicle> together = drawn, alone = drawn;
      KernelRobot together_views[8], alone_views[8];
      const KernelRobot* views[8];
      for (std::size_t k = 0; k < 8; ++k) {
        together_views[k] = together[k].view();
        alone_views[k] = alone[k].view();
        views[k] = &together_views[k];
      }
      const unsigned left = scenery_kernels_for(isa).apply_forces(work(), views, 8);
      EXPECT_EQ(left, round % 3 == 0 ? 1u << 5 : 0u);
      for (std::size_t k = 0; k < 8; ++k) {
        const KernelRobot* const view[] = {&alone_views[k]};
        ASSERT_EQ(scenery_kernels_for(lane::Isa::base).apply_forces(work(), view, 1), left >> k & 1);
        ASSERT_EQ(std::memcmp(&alone[k].wrench, &together[k].wrench, sizeof(Wrench)), 0) << "robot " << k;
        ASSERT_EQ(std::memcmp(alone[k].anchors, together[k].anchors, sizeof alone[k].anchors), 0) << "robot " << k;
      }
    }
  }
}

TEST(SceneryKernel, OnePatchGivesTheSameBitsWhetherItIsFoundOrTold) {
  std::mt19937 random(3);
  const std::uint8_t patch_of[8] = {};
  KernelBatch told = work();
  told.patch_of = patch_of;
  for (int round = 0; round < 300; ++round) {
    const Vehicle drawn = random_vehicle(random, std::pow(10, -4 + round % 6));
    Vehicle a = drawn, b = drawn;
    const KernelRobot a_view = a.view(), b_view = b.view();
    const KernelRobot *const a_views[] = {&a_view}, *const b_views[] = {&b_view};
    ASSERT_EQ(scenery_kernels_for(lane::best_isa()).apply_forces(work(), a_views, 1), 0u);
    ASSERT_EQ(scenery_kernels_for(lane::best_isa()).apply_forces(told, b_views, 1), 0u);
    ASSERT_EQ(std::memcmp(&a.wrench, &b.wrench, sizeof(Wrench)), 0);
    ASSERT_EQ(std::memcmp(a.anchors, b.anchors, sizeof a.anchors), 0);
  }
}

}  // namespace
}  // namespace muro::penalty
