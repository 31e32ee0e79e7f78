// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "friction_anchor.hpp"
#include "muro/scene.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/contact_geometry/pressure_cells.hpp"
#include "plugins/common/lanes/vectors.hpp"
#include "restitution.hpp"
#include "scenery_kernel.hpp"

namespace muro::penalty {
namespace {

constexpr double omega = 2 * M_PI * 50, h = 0.001, elapsed = 0.001, restitution = 0.4;

constexpr MassProperties light{
    .inverse_mass = 0.4, .com = {0.02, -0.01, 0.03}, .inverse_inertia = {1.5, 2.5, 0.9, 0.1, -0.2, 0.3}};
constexpr MassProperties heavy{
    .inverse_mass = 0.01, .com = {-0.1, 0.05, 0.2}, .inverse_inertia = {0.03, 0.02, 0.05, 0.001, 0, -0.002}};

/// A vehicle of four bodies with at most two contacts each, or of two bodies with four each. It owns its numbers.
struct Vehicle {
  Pose base, bodies[4];
  Twist twist, twists[4];
  int count = 8;
  Contact contacts[8];
  int object_of[8] = {};  ///< of the scenery
  FrictionAnchor before[16], anchors[8];
  AnchorDetail details_before[16], details[8];
  int anchors_before[4] = {2, 2, 2, 2};  ///< of each body, in `before`
  const MassProperties* mass = &light;
  bool is_changed = false;
  Wrench wrench;
  KernelContact known[8];

  std::size_t per_body = 2;  ///< contacts
  bool has_discs = false, rolls = false;

  std::size_t body_of(std::size_t contact) const { return contact / per_body; }

  KernelRobot view() {
    KernelRobot v;
    int ends[4], end = 0;
    for (std::size_t b = 0; b < 4; ++b) ends[b] = end += anchors_before[b];
    for (std::size_t k = 0; k < std::size_t(count); ++k) {
      const std::size_t body = body_of(k);
      known[k] = {.pose = bodies[body].position.data() - bodies[0].position.data(),
                  .twist = twists[body].linear.data() - twists[0].linear.data(),
                  .zeta = damping_ratio_of(contacts[k].surface.restitution),
                  .place = std::uint8_t(k),
                  .anchor = std::uint8_t(k),
                  .anchors_begin = std::uint8_t(ends[body] - anchors_before[body]),
                  .anchors_end = std::uint8_t(ends[body]),
                  .object = std::uint8_t(object_of[k]),
                  .is_of_disc = has_discs};
      if (k == 0 || body_of(k - 1) != body) v.groups |= 1u << k;
    }
    v.count = std::uint8_t(count);
    v.contacts = known;
    v.has_many_materials = v.has_many_objects = true;
    v.is_changed = is_changed;
    v.rolls = rolls;
    v.listed = contacts[0].point.data();
    v.before = before[0].point.data();
    v.anchors = anchors[0].point.data();
    v.ways_before = details_before[0].way.data();
    v.ways = details[0].way.data();
    v.pose = bodies[0].position.data();
    v.twist = twists[0].linear.data();
    v.base_pose = base.position.data();
    v.base_twist = twist.linear.data();
    v.mass = &mass->inverse_mass;
    v.wrench = wrench.force.data();
    return v;
  }
};

/// `speed` (m/s) decides which branch of the law contacts are in: at rest, sliding, approaching, parting. `uneven`: it
/// stands on several objects with any normals, and has more and fewer contacts and friction anchors.
Vehicle random_vehicle(std::mt19937& random, double speed, bool uneven) {
  std::normal_distribution<double> g;
  const auto vector = [&](double most) { return Vec3(most * g(random), most * g(random), most * g(random)); };
  const auto number = [&](int least, int most) { return std::uniform_int_distribution<int>(least, most)(random); };
  Vehicle v;
  if (number(0, 2) == 0) {
    v.per_body = 4;
    v.has_discs = number(0, 1) == 1;
    v.anchors_before[0] = v.anchors_before[1] = 4;
    v.anchors_before[2] = v.anchors_before[3] = 0;
  }
  v.rolls = number(0, 1) == 1;
  v.base = {vector(5), rotation_of(vector(1))};
  v.twist = {vector(speed), vector(speed)};
  const Vec3 normal = Vec3(0.1 * g(random), 0.1 * g(random), 1).normalized();
  const Vec3 normals[] = {normal, Vec3(1, 0.1 * g(random), 0).normalized(), Vec3(0.5, -0.5, 1).normalized()};
  for (int k = 0; k < 4; ++k) {
    v.bodies[k] = {v.base.position + vector(0.2), rotation_of(vector(1))};
    v.twists[k] = {vector(speed), vector(speed)};
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    Contact& c = v.contacts[i];
    c.self = ObjectId{10 + std::uint32_t(v.body_of(i))};
    c.other = ObjectId{1};
    c.point = v.bodies[v.body_of(i)].position + vector(0.1);
    c.normal = uneven ? normals[number(0, 2)] : normal;
    c.depth = 1e-3 * std::abs(g(random));
    c.surface.friction = 0.8;
    c.surface.restitution = uneven && number(0, 1) == 1 ? 0 : restitution;
    v.object_of[i] = uneven ? number(0, 1) : 0;
  }
  if (uneven) {
    v.count = number(1, 8);
    v.mass = number(0, 1) == 1 ? &light : &heavy;
    for (int& n : v.anchors_before) n = number(0, 4);
  }
  std::size_t end = 0;
  for (std::size_t b = 0; b < 4; ++b)
    for (int i = 0; i < v.anchors_before[b]; ++i) {
      const Vec3& near = v.contacts[(v.per_body * b + std::size_t(i) % v.per_body) % 8].point;
      const Vec3 from = vector(0.02);
      const Vec3 displacement = vector(1e-4);
      v.details_before[end].way = vector(number(0, 1) == 1 ? 3e-3 : 0.05) - from;
      v.before[end++] = {b, near + from, displacement};
    }
  return v;
}

KernelBatch work() {
  return {.stiffness = {omega, h}, .elapsed = elapsed, .impact_speed = std::numeric_limits<double>::infinity()};
}

/// Returns the wrench by the model in the plugin's README, in matrices, contact by contact.
Wrench by_the_model(const Vehicle& v, std::vector<Vec3>& displacements) {
  const auto count = std::size_t(v.count);
  const Mat3 r = v.base.orientation.toRotationMatrix();
  const double* const i = v.mass->inverse_inertia;
  const Mat3 own = (Mat3() << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2]).finished();
  const Mat3 inertia = r * own * r.transpose();
  const Vec3 centre = v.base.position + r * Vec3(v.mass->com);
  // a contact belongs to the patch of the first one with its normal and object
  std::vector<std::size_t> first(count);
  for (std::size_t k = 0; k < count; ++k)
    for (first[k] = 0; v.object_of[first[k]] != v.object_of[k] ||
                       v.contacts[first[k]].normal.dot(v.contacts[k].normal) < std::cos(8 * M_PI / 180);)
      ++first[k];
  std::vector<double> along(count), across(count);
  Mat3 shift = Mat3::Zero(), turn = Mat3::Zero();  // stiffness of the springs
  for (std::size_t k = 0; k < count; ++k) {
    Vec3 middle = Vec3::Zero();
    double points = 0;
    for (std::size_t other = 0; other < count; ++other) {
      if (first[other] != first[k]) continue;
      middle += v.contacts[other].point - centre;
      ++points;
    }
    middle /= points;
    const auto inverse_mass_along = [&](const Vec3& d) {
      return v.mass->inverse_mass + middle.cross(d).dot(inertia * middle.cross(d));
    };
    const Vec3 n = v.contacts[first[k]].normal, u = n.unitOrthogonal();
    along[k] = 1 / (points * inverse_mass_along(n));
    across[k] = 2 / (points * (inverse_mass_along(u) + inverse_mass_along(n.cross(u))));
    const Vec3 p = v.contacts[k].point - centre;
    const Mat3 cross = (Mat3() << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0).finished();
    const Mat3 spring = across[k] * Mat3::Identity() + (along[k] - across[k]) * n * n.transpose();
    shift += spring;
    turn += cross * spring * cross.transpose();
  }
  const double load = v.mass->inverse_mass * shift.norm() + std::sqrt((inertia * turn * inertia * turn).trace());
  const law::FrictionLaw<double> friction_law({omega, h}, load);
  Wrench total;
  const auto are_joined = [&](std::size_t a, std::size_t b) {
    return v.body_of(a) == v.body_of(b) && first[a] == first[b];
  };
  std::vector<Vec3> shifts(count, Vec3::Zero());
  std::vector<std::size_t> other_end(count);  // of a line; other contacts have themselves
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin + 1; end < count && are_joined(end - 1, end);) ++end;
    contact_geometry::find_shifts(
        int(end - begin), v.has_discs, [&](int k) { return plain(v.contacts[begin + std::size_t(k)].point); },
        [&](int k, const lane::V3<double>& way) { shifts[begin + std::size_t(k)] = vector_of(way); });
    for (std::size_t k = begin; k < end; ++k) other_end[k] = end == begin + 2 ? 2 * begin + 1 - k : k;
  }
  const auto motion_of = [&](std::size_t k) {
    return v.twists[v.body_of(k)].at(v.contacts[k].point - v.bodies[v.body_of(k)].position);
  };
  const auto slip_of = [&](std::size_t k) {
    const Vec3 &motion = motion_of(k), &n = v.contacts[k].normal;
    return Vec3(motion - n * n.dot(motion));
  };
  std::vector<std::tuple<std::size_t, Vec3, Vec3>> line_friction;
  for (std::size_t k = 0; k < count; ++k) {
    const Contact& c = v.contacts[k];
    const Vec3 &to_cell = shifts[k], &of_patch = v.contacts[first[k]].normal;
    const std::size_t body = v.body_of(k);
    const law::NormalLaw<double> normal_law({omega, h}, damping_ratio_of(c.surface.restitution), load);
    const bool is_line = other_end[k] != k;
    const double approach = -motion_of(k).dot(c.normal);
    const Vec3 spin = is_line ? Vec3(0.25 * (slip_of(other_end[k]) - slip_of(k)))
                              : Vec3(v.twists[body].angular.dot(of_patch) * of_patch.cross(to_cell));
    const Vec3 slip = slip_of(k) + spin;
    Vec3 displacement = slip * elapsed, arm = c.point - v.base.position;
    const int known = std::accumulate(v.anchors_before, v.anchors_before + 4, 0);
    if (const auto* const before = previous<FrictionAnchor>({v.before, std::size_t(known)}, k, body, c.point);
        before && v.anchors_before[body] > 0) {
      displacement += before->displacement;
      const Vec3 way = c.point - before->point;
      if (v.rolls &&
          way.squaredNorm() * inertia.trace() < 3 * v.mass->inverse_mass) {  // it is the same point, and moves on
        const Vec3 bend = way - v.details_before[before - v.before].way;
        const bool goes_round = bend.squaredNorm() < 0.25 * way.squaredNorm();
        arm += 0.5 * ((goes_round ? Vec3(way + 1.6 * bend) : way) - h * v.twist.at(centre - v.base.position));
      }
    }
    displacement -= c.normal * c.normal.dot(displacement);
    const double normal = along[k] * normal_law.force(c.depth, approach);
    lane::V3<double> spring{displacement.x(), displacement.y(), displacement.z()};
    const lane::V3<double> f =
        friction_law.force(spring, {slip.x(), slip.y(), slip.z()}, c.surface.friction * normal / across[k],
                           law::speed_of_ends(plain(spin)));
    displacements.emplace_back(spring.x, spring.y, spring.z);
    const Vec3 friction = across[k] * Vec3(f.x, f.y, f.z);
    total.add_force(normal * c.normal + friction, arm);
    if (is_line)  // friction acts at a quarter of the way to the other end; both ends move on
      line_friction.emplace_back(k, arm, friction);
    else
      total.torque += of_patch * of_patch.dot(to_cell.cross(friction));
  }
  for (const auto& [k, arm, friction] : line_friction)
    for (const auto& [end, other_arm, unused] : line_friction)
      if (end == other_end[k]) total.torque += 0.25 * (other_arm - arm).cross(friction);
  return total;
}

TEST(SceneryKernel, AgreesWithTheModelContactByContactOnEvenAndUnevenGround) {
  std::mt19937 random(1);
  for (int round = 0; round < 4000; ++round) {
    Vehicle v = random_vehicle(random, std::pow(10, -4 + round % 6), round % 2 == 1);
    std::vector<Vec3> displacements;
    const Wrench expected = by_the_model(v, displacements);
    const KernelRobot view = v.view();
    const KernelRobot* const views[] = {&view};
    ASSERT_EQ(scenery_kernels_for(lane::best_isa()).apply_forces(work(), views, 1), 0u);
    const double scale = 1e-9 * (1 + expected.force.norm() + expected.torque.norm());
    ASSERT_LT((v.wrench.force - expected.force).norm(), scale) << round;
    ASSERT_LT((v.wrench.torque - expected.torque).norm(), scale) << round;
    for (std::size_t i = 0; i < displacements.size(); ++i) {
      ASSERT_EQ(v.anchors[i].point, v.contacts[i].point);
      ASSERT_LT((v.anchors[i].displacement - displacements[i]).norm(), 1e-9 * (1 + displacements[i].norm())) << round;
    }
  }
}

/// Compares eight drawn vehicles together on `isa` with each of them alone.
void expect_the_same_bits(const std::vector<Vehicle>& drawn, const KernelBatch& batch, lane::Isa isa) {
  std::vector<Vehicle> together = drawn, alone = drawn;
  KernelRobot together_views[8], alone_views[8];
  const KernelRobot* views[8];
  for (std::size_t k = 0; k < 8; ++k) {
    together_views[k] = together[k].view();
    alone_views[k] = alone[k].view();
    views[k] = &together_views[k];
  }
  const unsigned left = scenery_kernels_for(isa).apply_forces(batch, views, 8);
  for (std::size_t k = 0; k < 8; ++k) {
    const KernelRobot* const view[] = {&alone_views[k]};
    ASSERT_EQ(scenery_kernels_for(lane::Isa::base).apply_forces(batch, view, 1), left >> k & 1) << "robot " << k;
    ASSERT_EQ(std::memcmp(&alone[k].wrench, &together[k].wrench, sizeof(Wrench)), 0) << "robot " << k;
    ASSERT_EQ(std::memcmp(alone[k].anchors, together[k].anchors, sizeof alone[k].anchors), 0) << "robot " << k;
    ASSERT_EQ(std::memcmp(alone[k].details, together[k].details, sizeof alone[k].details), 0) << "robot " << k;
  }
}

TEST(SceneryKernel, EightRobotsGetTheBitsOfEachAloneOnAnyIsa) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    std::vector<Vehicle> drawn;
    for (int k = 0; k < 8; ++k) {
      drawn.push_back(random_vehicle(random, std::pow(10, -4 + (round + k) % 6), (round + k) % 3 > 0));
      drawn.back().is_changed = (round + k) % 4 == 0;
    }
    KernelBatch batch = work();
    if (round % 2 == 1) batch.impact_speed = 0.03;
    for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512})
      if (isa <= lane::best_isa()) {  // else this processor cannot run it
        ASSERT_NO_FATAL_FAILURE(expect_the_same_bits(drawn, batch, isa)) << round;
      }
  }
}

TEST(SceneryKernel, LeavesRobotsThatMayBeInAnImpactToOthers) {
  std::mt19937 random(4);
  KernelBatch batch = work();
  batch.impact_speed = 0.03;
  const auto is_left = [&](Vehicle v) {
    const KernelRobot view = v.view();
    const KernelRobot* const views[] = {&view};
    const Wrench before = v.wrench;
    const bool left = scenery_kernels_for(lane::best_isa()).apply_forces(batch, views, 1) != 0;
    EXPECT_EQ(left, std::memcmp(&before, &v.wrench, sizeof before) == 0);
    return left;
  };
  Vehicle v = random_vehicle(random, 0, false);
  for (Twist& t : v.twists) t = {-0.04 * v.contacts[0].normal, Vec3::Zero()};
  ASSERT_EQ(v.per_body, 2u);
  for (std::size_t i = 0; i < 8; ++i) v.before[i].point = v.contacts[i].point;
  EXPECT_FALSE(is_left(v));
  v.is_changed = true;
  EXPECT_FALSE(is_left(v));  // its anchors say that the contacts were there
  v.before[6].point += Vec3(0, 0, 2e-3);
  v.before[7].point += Vec3(0, 0, 0.5);
  v.contacts[7].point += Vec3(0, 0, 0.5);
  EXPECT_TRUE(is_left(v));
  v.is_changed = false;
  EXPECT_FALSE(is_left(v));
  v.object_of[0] = 1;
  EXPECT_TRUE(is_left(v));
  for (Twist& t : v.twists) t.linear *= 0.5;
  EXPECT_FALSE(is_left(v));
  v.is_changed = true;
  v.anchors_before[3] = 0;
  EXPECT_FALSE(is_left(v));
  for (Twist& t : v.twists) t.linear *= 2;
  EXPECT_TRUE(is_left(v));
}

}  // namespace
}  // namespace muro::penalty
