// SPDX-License-Identifier: MIT
// Properties that hold for all trees with two legs of any kind and any motion of the joints.
#include <gtest/gtest.h>

#include <random>

#include "walker_testing.hpp"

namespace muro::biped::testing {
namespace {

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vec3 vector(double size) { return {number(-size, size), number(-size, size), number(-size, size)}; }
  Quat turn(double size) { return rotation_of(vector(size)); }

 private:
  std::mt19937 engine_;
};

Shape any_sole(Draw& draw) {
  const double size = draw.number(0.02, 0.1);
  Shape shapes[] = {Shape::box({size, 0.5 * size, 0.2 * size}), Shape::sphere(size), Shape::cylinder(0.5 * size, size),
                    Shape::capsule(0.2 * size, size)};
  Shape shape = shapes[draw.whole(0, 3)];
  shape.origin = {draw.vector(0.05), draw.turn(1)};
  return shape;
}

struct AnyTree {
  RobotTree tree;
  std::vector<std::string> joints;
  std::map<std::string, std::vector<Shape>> soles;  ///< soles of each foot
};

/// Returns two legs of one to seven joints about and along any axes, behind up to two joints that both legs share.
AnyTree any_tree(Draw& draw) {
  AnyTree any;
  any.tree = test::tree_of([&](RobotBuilder& b) {
    const auto joint = [&](const std::string& name) {
      b.translation(draw.vector(0.1));
      b.rotation(draw.turn(0.5));
      if (draw.whole(0, 4) == 0)
        b.prismatic(name, draw.vector(1), {});
      else
        b.revolute(name, draw.vector(1), {});
      b.body("link_" + name);
      any.joints.push_back(name);
    };
    b.base("trunk");
    for (int i = draw.whole(0, 2); i > 0; --i) joint("waist_" + std::to_string(i));
    for (const std::string leg : {"a", "b"}) {
      if (leg == "a") b.fork();
      b.translation({0, leg == "a" ? 0.1 : -0.1, -0.1});
      for (int i = draw.whole(1, 7); i > 0; --i) joint(leg + std::to_string(i));
      b.translation({0, 0, -0.1});
      b.body("foot_" + leg);
      std::vector<Shape>& soles = any.soles["foot_" + leg];
      for (int i = draw.whole(1, 3); i > 0; --i) soles.push_back(any_sole(draw));
      b.set_array(keys::collision_shapes, std::span<const Shape>(soles));
      if (leg == "a") b.end();
    }
    b.end();
  });
  return any;
}

/// Returns the height of a shape above the plane n . x = offset (m), in closed form.
double height_of(const Shape& s, const Pose& link, const Vec3& n, double offset) {
  const Pose at = link * s.origin;
  const Vec3 axes = (at.orientation.conjugate() * n).cwiseAbs();
  const double middle = n.dot(at.position) - offset;
  const double across = std::sqrt(axes.x() * axes.x() + axes.y() * axes.y());
  switch (s.kind) {
    case ShapeKind::box:
      return middle - 0.5 * axes.dot(s.size);
    case ShapeKind::sphere:
      return middle - s.size.x();
    case ShapeKind::cylinder:
      return middle - 0.5 * axes.z() * s.size.z() - across * s.size.x();
    default:
      return middle - 0.5 * axes.z() * s.size.z() - s.size.x();
  }
}

struct RandomWalk : test::Scene {
  Draw draw;
  Pose plane;
  AnyTree any;
  const RobotView* robot;
  std::vector<Vec3> swings;  ///< per joint: amplitude, rad/s, phase

  explicit RandomWalk(unsigned seed, double rate = 100)
      : draw(seed), plane{draw.vector(2), draw.turn(0.7)}, any(any_tree(draw)) {
    add_ground(0.8, plane);
    robot = &add("r", any.tree, plane * Pose{draw.vector(1), draw.turn(0.3)});
    for (std::size_t i = 0; i < any.joints.size(); ++i)
      swings.emplace_back(draw.number(0, 0.5), draw.number(0.5, 6), draw.number(0, 6.28));
    use("motion.biped", rate, all_robots(), {{"feet", Names{"foot_a", "foot_b"}}, {"joints", std::string("position")}});
    use_kinematics();
    build();
  }
  void command(double t) {
    for (std::size_t i = 0; i < swings.size(); ++i)
      world().value("r/" + any.joints[i], keys::joint_position_target) =
          swings[i].x() * std::sin(swings[i].y() * t + swings[i].z());
  }
  double lowest(const std::string& foot) {
    const Vec3 n = plane.orientation * Vec3::UnitZ();
    double least = 1e9;
    for (const Shape& s : any.soles[foot])
      least = std::min(least, height_of(s, world().value("r/" + foot, keys::pose), n, n.dot(plane.position)));
    return least;
  }
};

/// Checks that the trees of these seeds do what the README promises. Counts how often a foot was put down.
void hold(unsigned first, unsigned last, double rate, std::uint64_t& footholds) {
  for (unsigned seed = first; seed <= last; ++seed) {
    RandomWalk w(seed, rate);
    std::uint64_t before = 0;
    Pose stands;
    for (int k = 0; k < 200; ++k) {
      w.command(k / rate);
      w.run_for(1 / rate);
      w.refresh();
      const World& world = w.world();
      const ObjectId base = w.robot->base();
      const double lower = std::min(w.lowest("foot_a"), w.lowest("foot_b"));
      ASSERT_GE(lower, -1e-9) << "seed " << seed << " step " << k;
      ASSERT_LE(lower, 1e-9) << "a foot touches always; seed " << seed << " step " << k;
      const Pose& now = world.value(base, own::stance_pose);
      if (world.value(base, own::stance_footholds) == before) {
        ASSERT_EQ(now.position, stands.position) << "seed " << seed << " step " << k;
        ASSERT_EQ(now.orientation.coeffs(), stands.orientation.coeffs());
      }
      before = world.value(base, own::stance_footholds);
      stands = now;
      const Pose& foot =
          world.value(world.object(world.value(base, own::stance_foot) == 0 ? "r/foot_a" : "r/foot_b"), keys::pose);
      ASSERT_LT((foot.position - now.position).norm(), 1e-12) << "seed " << seed << " step " << k;
      ASSERT_LT((foot.orientation.conjugate() * now.orientation).vec().norm(), 1e-12);
    }
    footholds += before;
  }
}

TEST(AnyTwoLeggedTree, StandsFrozenWithItsSolesAboveThePlane) {
  std::uint64_t footholds = 0;
  hold(1, 120, 100, footholds);
  EXPECT_GT(footholds, 500u) << "feet change";
}

TEST(SlowAnyTwoLeggedTree, StandsFrozenWithItsSolesAboveThePlane) {
  std::uint64_t footholds = 0;
  for (const double rate : {10.0, 100.0, 1000.0}) hold(1000, 2500, rate, footholds);
  EXPECT_GT(footholds, 20000u) << "feet change";
}

TEST(AnyTwoLeggedTree, MovesWithTheDerivativeOfItsPose) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const double dt = 1e-4;
    RandomWalk w(seed, 1 / dt);
    for (int k = 0; k < 100; ++k) {
      const auto before = w.world().value(w.robot->base(), own::stance_footholds);
      const Pose from = w.pose(*w.robot);
      const Twist slow = w.twist(*w.robot);
      w.command(dt * k);
      w.run_for(dt);
      if (k < 2 || w.world().value(w.robot->base(), own::stance_footholds) != before) continue;
      const Pose& to = w.pose(*w.robot);
      const Twist& fast = w.twist(*w.robot);
      const Vec3 linear = (to.position - from.position) / dt - 0.5 * (slow.linear + fast.linear);
      const Vec3 angular =
          rotation_vector_of(to.orientation * from.orientation.conjugate()) / dt - 0.5 * (slow.angular + fast.angular);
      const double speed = fast.linear.norm() + fast.angular.norm();
      // The joints change their velocities from step to step, so the trapezoidal rule is of first order.
      ASSERT_LT(linear.norm() + angular.norm(), 20 * dt * (1 + speed)) << "seed " << seed << " step " << k;
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace muro::biped::testing
