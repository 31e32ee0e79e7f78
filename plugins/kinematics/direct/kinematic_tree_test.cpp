// SPDX-License-Identifier: MIT
#include "kinematic_tree.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "muro/toolkit/rotations.hpp"

namespace muro::kinematics {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;

class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  Vec3 vector(double limit) { return {number(-limit, limit), number(-limit, limit), number(-limit, limit)}; }
  Pose pose() { return {vector(1), rotation_of(vector(2))}; }

 private:
  std::mt19937 engine_;
};

/// Returns a tree of `n` links with all kinds of joints; a third of the origins is not rotated, as in most models.
std::vector<Link> random_tree(Draw& draw, int n) {
  std::vector<Link> links(1);
  for (int i = 1; i < n; ++i) {
    Link link;
    link.parent = draw.integer(std::max(0, i - 3), i - 1);
    link.joint = JointKind(draw.integer(0, 2));
    link.origin = draw.pose();
    if (draw.integer(0, 2) == 0) link.origin.orientation = Quat::Identity();
    link.axis = draw.integer(0, 1) == 0 ? Vec3(Vec3::Unit(draw.integer(0, 2))) : Vec3(draw.vector(1).normalized());
    links.push_back(link);
  }
  return links;
}

Isometry3d matrix(const Pose& p) {
  Isometry3d m = Isometry3d::Identity();
  m.linear() = Eigen::Quaterniond(p.orientation).toRotationMatrix();
  m.translation() = p.position;
  return m;
}

/// Returns the 4 x 4 matrices of all links, one after the other.
std::vector<Isometry3d> by_matrices(const std::vector<Link>& links, const Pose& base, const std::vector<double>& q) {
  std::vector<Isometry3d> all{matrix(base)};
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Link& link = links[i];
    Isometry3d moved = Isometry3d::Identity();
    if (link.joint == JointKind::revolute) moved.linear() = AngleAxisd(q[i], link.axis).toRotationMatrix();
    if (link.joint == JointKind::prismatic) moved.translation() = q[i] * link.axis;
    all.push_back(all[std::size_t(link.parent)] * matrix(link.origin) * moved);
  }
  return all;
}

struct Result {
  std::vector<Pose> poses;
  std::vector<Twist> twists;
};

/// Robots of one structure, each with its own joint positions.
struct Team {
  std::vector<Link> links;
  std::vector<Result> robots;                 ///< the result of link 0 is given
  std::vector<std::vector<double>> q, rates;  ///< one for each link

  void compute(lane::Isa isa, int at_once) {
    const KinematicTree tree = kinematic_tree(links);
    std::vector<StateOffsets> offsets;
    for (std::ptrdiff_t i = 0; i + 1 < std::ptrdiff_t(links.size()); ++i) offsets.push_back({7 * i, 6 * i, i, i});
    std::vector<RobotState> states;
    for (std::size_t k = 0; k < robots.size(); ++k) {
      double* const poses = robots[k].poses[0].position.data();
      double* const twists = robots[k].twists[0].linear.data();
      states.push_back({poses, twists, poses + 7, twists + 6, q[k].data() + 1, rates[k].data() + 1});
    }
    const int all = int(robots.size());
    for (int k = 0; k < all; k += at_once)
      kernels_for(isa).forward_kinematics(tree.links.data(), offsets.data(), int(offsets.size()),
                                          &states[std::size_t(k)], std::min(at_once, all - k));
  }
};

Result forward_kinematics_of(const std::vector<Link>& links, const Pose& base, const Twist& moving,
                             const std::vector<double>& q, const std::vector<double>& rates) {
  Team one{links, {{std::vector<Pose>(links.size()), std::vector<Twist>(links.size())}}, {q}, {rates}};
  one.robots[0].poses[0] = base;
  one.robots[0].twists[0] = moving;
  one.compute(lane::best_isa(), 1);
  return one.robots[0];
}

TEST(KinematicTree, GivesTheSameBitsWithAnyInstructionSet) {
  Draw draw(4);
  for (int round = 0; round < 60; ++round) {
    Team team{random_tree(draw, draw.integer(1, 25)), {}, {}, {}};
    const std::size_t n = team.links.size();
    for (std::size_t k = 0; k < 8; ++k) {
      team.robots.push_back({std::vector<Pose>(n), std::vector<Twist>(n)});
      team.robots[k].poses[0] = draw.pose();
      team.robots[k].twists[0] = {draw.vector(2), draw.vector(2)};
      std::vector<double> q, rates;
      for (std::size_t i = 0; i < n; ++i) {
        q.push_back(round == 0 ? draw.number(-1e8, 1e8) : draw.number(-9, 9));
        rates.push_back(draw.number(-2, 2));
      }
      team.q.push_back(q);
      team.rates.push_back(rates);
    }
    Team alone = team;
    alone.compute(lane::Isa::base, 1);
    for (const lane::Isa isa : {lane::Isa::base, lane::Isa::avx2, lane::Isa::avx512}) {
      if (isa > lane::best_isa()) continue;  // this processor cannot run it
      for (const int at_once : {8, 7, 5, 3, 1}) {
        Team together = team;
        together.compute(isa, at_once);
        for (std::size_t k = 0; k < 8; ++k) {
          const Result &a = alone.robots[k], &b = together.robots[k];
          ASSERT_EQ(std::memcmp(a.poses.data(), b.poses.data(), n * sizeof(Pose)), 0) << "robot " << k;
          ASSERT_EQ(std::memcmp(a.twists.data(), b.twists.data(), n * sizeof(Twist)), 0) << "robot " << k;
        }
      }
    }
  }
}

TEST(KinematicTree, PosesAreProductsOfMatrices) {
  Draw draw(1);
  for (int round = 0; round < 200; ++round) {
    const std::vector<Link> links = random_tree(draw, draw.integer(1, 25));
    const Pose base = draw.pose();
    std::vector<double> q, still(links.size(), 0.0);
    for (std::size_t i = 0; i < links.size(); ++i) q.push_back(draw.number(-7, 7));
    const std::vector<Isometry3d> expected = by_matrices(links, base, q);
    const Result got = forward_kinematics_of(links, base, {}, q, still);
    for (std::size_t i = 0; i < links.size(); ++i)
      ASSERT_LT((matrix(got.poses[i]).matrix() - expected[i].matrix()).cwiseAbs().maxCoeff(), 1e-11)
          << "link " << i << " of round " << round;
  }
}

TEST(KinematicTree, TwistsAreTheDerivativesOfPoses) {
  Draw draw(2);
  const double h = 1e-5;
  for (int round = 0; round < 100; ++round) {
    const std::vector<Link> links = random_tree(draw, 12);
    const Pose base = draw.pose();
    const Twist moving{draw.vector(2), draw.vector(2)};
    std::vector<double> q, rates;
    for (std::size_t i = 0; i < links.size(); ++i) {
      q.push_back(draw.number(-3, 3));
      rates.push_back(draw.number(-2, 2));
    }
    const auto at = [&](double t) {
      std::vector<double> moved = q;
      for (std::size_t i = 0; i < q.size(); ++i) moved[i] += rates[i] * t;
      return by_matrices(
          links, {base.position + t * moving.linear, Quat(rotation_of(t * moving.angular) * base.orientation)}, moved);
    };
    const std::vector<Isometry3d> before = at(-h), after = at(h);
    const Result got = forward_kinematics_of(links, base, moving, q, rates);
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Vec3 linear = (after[i].translation() - before[i].translation()) / (2 * h);
      const AngleAxisd turn(after[i].linear() * before[i].linear().transpose());
      ASSERT_LT((got.twists[i].linear - linear).norm(), 1e-6) << "link " << i << " of round " << round;
      ASSERT_LT((got.twists[i].angular - turn.angle() * turn.axis() / (2 * h)).norm(), 1e-6) << "link " << i;
    }
  }
}

TEST(KinematicTree, AgreesWithTheClosedFormOfAPlanarArmWithThreeJoints) {
  const double l1 = 0.5, l2 = 0.4, l3 = 0.2;
  std::vector<Link> links(5);
  const double lengths[] = {0, l1, l2};
  for (std::size_t i = 1; i <= 3; ++i) {
    links[i].parent = std::int32_t(i) - 1;
    links[i].joint = JointKind::revolute;
    links[i].axis = Vec3::UnitZ();
    links[i].origin.position.x() = lengths[i - 1];
  }
  links[4].parent = 3;  // the tip
  links[4].origin.position.x() = l3;
  Draw draw(3);
  for (int round = 0; round < 100; ++round) {
    const double a = draw.number(-3, 3), b = draw.number(-3, 3), c = draw.number(-3, 3);
    const double da = draw.number(-3, 3), db = draw.number(-3, 3), dc = draw.number(-3, 3);
    const Result r = forward_kinematics_of(links, {}, {}, {0, a, b, c, 0}, {0, da, db, dc, 0});
    EXPECT_NEAR(r.poses[4].position.x(), l1 * std::cos(a) + l2 * std::cos(a + b) + l3 * std::cos(a + b + c), 1e-14);
    EXPECT_NEAR(r.poses[4].position.y(), l1 * std::sin(a) + l2 * std::sin(a + b) + l3 * std::sin(a + b + c), 1e-14);
    EXPECT_NEAR(std::remainder(yaw_of(r.poses[4].orientation) - (a + b + c), 2 * M_PI), 0, 1e-14);
    const double ab = da + db, abc = ab + dc;
    EXPECT_NEAR(r.twists[4].linear.x(),
                -l1 * da * std::sin(a) - l2 * ab * std::sin(a + b) - l3 * abc * std::sin(a + b + c), 1e-13);
    EXPECT_NEAR(r.twists[4].linear.y(),
                l1 * da * std::cos(a) + l2 * ab * std::cos(a + b) + l3 * abc * std::cos(a + b + c), 1e-13);
    EXPECT_NEAR(r.twists[4].angular.z(), abc, 1e-14);
  }
}

TEST(KinematicTree, FoldsFixedJoints) {
  std::vector<Link> links(4);
  for (std::size_t i = 1; i < 4; ++i) {
    links[i].parent = std::int32_t(i) - 1;
    links[i].origin.position = {1, 0, 0};
  }
  links[2].joint = JointKind::revolute;
  const KinematicTree tree = kinematic_tree(links);
  EXPECT_EQ(tree.links[0].parent, 0);
  EXPECT_EQ(tree.links[1].parent, 0) << "hangs on a fixed joint, so on the base";
  EXPECT_EQ(Vec3(tree.links[1].offset), Vec3(2, 0, 0));
  EXPECT_EQ(tree.links[2].parent, 2);
  EXPECT_TRUE(tree == kinematic_tree(links));
  links[3].origin.position.x() = 2;
  EXPECT_FALSE(tree == kinematic_tree(links));
}

}  // namespace
}  // namespace muro::kinematics
