// SPDX-License-Identifier: MIT
// Robots of motion.simplified on heightmaps, by collision.native and contact.penalty.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "muro/toolkit/heightmap.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/collision_scene.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

constexpr double g = 9.81;
using Height = std::function<double(double, double)>;

/// A heightmap of 12 m by 12 m with cells of 0.5 m, and robots on it with gravity.
struct OnTerrain : test::Scene {
  test::ScratchFolder folder;
  std::vector<const RobotView*> robots;

  explicit OnTerrain(const Height& height, double length = 12) {
    constexpr std::uint32_t nodes = 25;
    std::vector<float> values(nodes * nodes);
    const Heightmap map{values, nodes, nodes, {length, length, 1}};
    for (std::uint32_t r = 0; r < nodes; ++r)
      for (std::uint32_t c = 0; c < nodes; ++c)
        values[r * nodes + c] = float(height(map.node(c, r).x(), map.node(c, r).y()));
    Shape ground{.kind = ShapeKind::heightmap, .size = {length, length, 1}};
    ground.mesh = world().intern(folder.file(
        "ground.r32", std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float))));
    world().add_scenery("terrain", {}, std::span(&ground, 1));
  }
  void add_body(const Shape& shape, const Pose& pose, const Twist& twist = {}) {
    robots.push_back(
        &add("r" + std::to_string(robots.size()), test::single_body(shape, test::unit_inertia), pose, twist));
  }
  void start(unsigned threads = 1) {
    use("motion.simplified", 1000, all_robots());
    use_contacts();
    set_threads(threads);
    build();
  }
  /// Returns the energy (J).
  double energy(const RobotView& r) {
    const Twist& t = twist(r);
    return 0.5 * t.linear.squaredNorm() + 0.05 * t.angular.squaredNorm() + g * pose(r).position.z();
  }
};

const std::pair<Shape, Quat> bodies[] = {{Shape::box({0.5, 0.4, 0.3}), Quat::Identity()},
                                         {Shape::sphere(0.25), Quat::Identity()},
                                         {Shape::cylinder(0.25, 0.3), Quat::Identity()},
                                         {Shape::cylinder(0.25, 0.3), from_rpy(M_PI / 2, 0, 0)},
                                         {Shape::capsule(0.2, 0.4), from_rpy(0, M_PI / 2, 0)}};

double lowest(const Shape& shape, const Quat& turn) {
  const Vec3 up = turn.conjugate() * Vec3::UnitZ();
  if (shape.kind == ShapeKind::sphere) return shape.size.x();
  if (shape.kind == ShapeKind::box) return 0.5 * shape.size.dot(up.cwiseAbs());
  const double end = 0.5 * shape.size.z() * std::abs(up.z());
  return end + (shape.kind == ShapeKind::capsule ? 1 : std::hypot(up.x(), up.y())) * shape.size.x();
}

TEST(CollisionNativeOnTerrain, BodiesRestAndRollOnASlopeOf20DegreesAsOnAPlane) {
  const double angle = 20 * M_PI / 180;
  const Quat tilt = from_rpy(0, angle, 0);  // it falls along x
  for (const auto& [shape, turn] : bodies) {
    Pose ends[2];
    for (const bool terrain : {false, true}) {
      OnTerrain scene(terrain ? Height([&](double x, double) { return -std::tan(angle) * x; })
                              : Height([](double, double) { return -50; }));
      if (!terrain) scene.add_ground(0.8, {Vec3::Zero(), tilt});
      scene.add_body(shape, {tilt * Vec3(-4, 0.13, lowest(shape, turn)), tilt * turn});
      scene.start();
      scene.run_for(1.5);
      ends[terrain] = scene.pose(*scene.robots[0]);
    }
    EXPECT_LT((ends[1].position - ends[0].position).norm(), 1e-3)
        << int(shape.kind) << ": " << ends[0].position.transpose();
    EXPECT_LT(ends[1].orientation.angularDistance(ends[0].orientation), 1e-2) << int(shape.kind);
  }
}

TEST(CollisionNativeOnTerrain, BodiesOnBumpyGroundGainNoEnergyAndComeToRestOnIt) {
  for (const auto& [shape, turn] : bodies) {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> bump(0, 0.08);
    OnTerrain scene([&](double, double) { return bump(engine); });
    scene.add_body(shape, {{-2, 0.3, 0.5}, turn}, {{1.5, 0.4, 0}, Vec3::Zero()});
    scene.start();
    const RobotView& r = *scene.robots[0];
    double least = scene.energy(r), gain = 0;
    for (int k = 0; k < 400; ++k) {
      scene.run_for(0.01);
      least = std::min(least, scene.energy(r));
      gain = std::max(gain, scene.energy(r) - least);
    }
    EXPECT_LT(gain, 0.05) << int(shape.kind) << ": J, of 6";
    EXPECT_GT(scene.pose(r).position.z(), 0.12) << int(shape.kind);
    EXPECT_LT(scene.pose(r).position.z(), 0.4) << int(shape.kind);
  }
}

TEST(CollisionNativeOnTerrain, ABallRollsOverTheRimAndFalls) {
  OnTerrain scene([](double, double) { return 0; }, 4);
  scene.add_body(Shape::sphere(0.25), {{1, 0, 0.25}, Quat::Identity()}, {{2, 0, 0}, {0, 8, 0}});
  scene.start();
  scene.run_for(2);
  const Pose end = scene.pose(*scene.robots[0]);
  EXPECT_GT(end.position.x(), 3);
  EXPECT_LT(end.position.z(), -5);
}

TEST(CollisionNativeOnTerrain, TheNumberOfThreadsChangesNoBit) {
  std::vector<Pose> ends[2];
  for (const bool threaded : {false, true}) {
    OnTerrain scene([](double x, double y) { return 0.2 * std::sin(x) * std::cos(y); });
    for (int i = 0; i < 40; ++i) {
      const auto& [shape, turn] = bodies[i % 5];
      scene.add_body(shape, {{-4.5 + 1.1 * (i % 8), -3 + 1.2 * (i / 8), 0.6}, turn}, {{0.5, 0.1, 0}, Vec3::Zero()});
    }
    scene.start(threaded ? 3 : 1);
    scene.run_for(1);
    for (const RobotView* r : scene.robots) ends[threaded].push_back(scene.pose(*r));
  }
  for (std::size_t i = 0; i < ends[0].size(); ++i) {
    EXPECT_EQ(ends[0][i].position, ends[1][i].position);
    EXPECT_EQ(ends[0][i].orientation.coeffs(), ends[1][i].orientation.coeffs());
  }
}

}  // namespace
}  // namespace muro
