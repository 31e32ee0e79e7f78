// SPDX-License-Identifier: MIT
#include "pair_kernel.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "muro/scene.hpp"
#include "plugins/common/lanes/vectors.hpp"

namespace muro::penalty {
namespace {

constexpr Stiffness pair_stiffness{2 * M_PI * 50, 0.001};
constexpr double pair_elapsed = 0.001;

/// Contacts between bodies of their own.
struct PairScene {
  std::vector<Contact> contacts;
  std::vector<Pose> poses;
  std::vector<Twist> twists;
  std::vector<std::array<double, 4>> patches;
  std::vector<PairPoint> points;

  /// `speed`, m/s, decides which branch of the law contacts are in: at rest, sliding, approaching, parting.
  PairScene(std::mt19937& random, int count, double speed, bool with_lag) {
    std::normal_distribution<double> g;
    const auto vector = [&](double most) { return Vec3(most * g(random), most * g(random), most * g(random)); };
    for (int i = 0; i < count; ++i) {
      Contact& c = contacts.emplace_back();
      c.point = vector(3);
      c.normal = vector(1).normalized();
      c.depth = 1e-3 * std::abs(g(random));
      c.surface.friction = 0.8;
      for (int side = 0; side < 2; ++side) {
        poses.push_back({c.point + vector(0.2), Quat::Identity()});
        twists.push_back({vector(speed), vector(speed)});
      }
      const double across = 1 + std::abs(g(random));
      patches.push_back({2 + std::abs(g(random)), across, 1 / across, 3 * std::abs(g(random))});
    }
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      PairPoint& p = points.emplace_back();
      p.contact = contacts[i].point.data();
      p.pose = poses[2 * i].position.data(), p.twist = twists[2 * i].linear.data();
      p.other_pose = poses[2 * i + 1].position.data(), p.other_twist = twists[2 * i + 1].linear.data();
      p.patch = patches[i].data();
      if (with_lag) p.lag = 0.5 * double(i % 2), p.other_lag = 0.5;
      if (i % 4 > 0) Vec3::Map(p.turn) = contacts[i].normal.cross(vector(0.05));
      Vec3::Map(p.displacement) = vector(1e-4);
      p.overlap = i % 3 == 0 ? 0.5 * contacts[i].depth : 0;
      p.zeta = i % 2 == 0 ? 1 : 0.3;
    }
  }
};

void compute(const PairKernels& kernels, PairPoint* points, int count, bool with_lag) {
  kernels.move(points, count, pair_stiffness.h, with_lag);
  kernels.push(points, count, pair_stiffness, pair_elapsed);
}

TEST(PairKernel, AgreesWithTheModelContactByContact) {
  std::mt19937 random(3);
  for (int round = 0; round < 300; ++round) {
    const bool with_lag = round % 2 == 1;
    const PairScene scene(random, 1 + round % 21, std::pow(10, -4 + round % 6), with_lag);
    std::vector<PairPoint> points = scene.points;
    compute(pair_kernels_for(lane::best_isa()), points.data(), int(points.size()), with_lag);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Contact& c = scene.contacts[i];
      const Vec3 own = scene.twists[2 * i].at(c.point - scene.poses[2 * i].position),
                 other = scene.twists[2 * i + 1].at(c.point - scene.poses[2 * i + 1].position), motion = own - other;
      const auto& [along, across, inverse_across, load] = scene.patches[i];
      const double approach = -motion.dot(c.normal);
      const PairPoint& start = scene.points[i];
      const double turning = (scene.twists[2 * i].angular - scene.twists[2 * i + 1].angular).dot(c.normal);
      const Vec3 turn = Vec3::Map(start.turn), slip = motion + approach * c.normal + turning * turn;
      const double ahead = pair_stiffness.h * c.normal.dot(start.lag * own - start.other_lag * other);
      const double depth = c.depth - start.overlap + (with_lag ? ahead : 0);
      const double normal = along * law::NormalLaw<double>(pair_stiffness, start.zeta, load).force(depth, approach);
      Vec3 displacement = Vec3::Map(start.displacement) + slip * pair_elapsed;
      displacement -= c.normal * c.normal.dot(displacement);
      lane::V3<double> spring = plain(displacement);
      const lane::V3<double> friction = law::FrictionLaw<double>(pair_stiffness, load)
                                            .force(spring, plain(slip), c.surface.friction * normal * inverse_across,
                                                   law::speed_of_ends(plain(Vec3(turning * turn))));
      const Vec3 force = normal * c.normal + across * vector_of(friction);
      ASSERT_NEAR(points[i].approach, approach, 1e-12 * (1 + std::abs(approach))) << round;
      ASSERT_LT((Vec3::Map(points[i].force) - force).norm(), 1e-9 * (1 + force.norm())) << round;
      ASSERT_NEAR(points[i].moment, across * turn.dot(vector_of(friction)), 1e-9 * (1 + force.norm())) << round;
      ASSERT_LT((Vec3::Map(points[i].displacement) - vector_of(spring)).norm(), 1e-12) << round;
    }
  }
}

TEST(PairKernel, GivesEachContactTheBitsThatItHasAlone) {
  std::mt19937 random(4);
  for (int round = 0; round < 200; ++round) {
    const bool with_lag = round % 2 == 1;
    const PairScene scene(random, 1 + round % 21, std::pow(10, -4 + round % 6), with_lag);
    std::vector<PairPoint> alone = scene.points;
    for (PairPoint& p : alone) compute(pair_kernels_for(lane::Isa::base), &p, 1, with_lag);
    for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512}) {
      if (isa > lane::best_isa()) continue;
      std::vector<PairPoint> together = scene.points;
      compute(pair_kernels_for(isa), together.data(), int(together.size()), with_lag);
      ASSERT_EQ(std::memcmp(together.data(), alone.data(), alone.size() * sizeof(PairPoint)), 0) << round;
    }
  }
}

}  // namespace
}  // namespace muro::penalty
