// SPDX-License-Identifier: MIT
// Passive trees of bodies that fall on a plane: no contact gives them energy.
#include "articulated_testing.hpp"
#include "tests/support/randoms.hpp"

namespace muro::articulated::testing {
namespace {

class SmallShapes {
 public:
  explicit SmallShapes(test::Randoms& random) : random_(random) {}
  double length() { return random_.uniform(0.05, 0.3); }
  int below(int n) { return random_.below(n); }

 private:
  test::Randoms& random_;
};

/// Returns a tree of one to five bodies with shapes. Joints swing and slide within their limits, damped or not.
RobotTree random_tree(test::Randoms& random) {
  const int children = random.below(5);
  const double friction = random.uniform(0, 1);
  SmallShapes shapes(random);
  const auto body = [&](RobotBuilder& b, const std::string& name) {
    constexpr ShapeKind kinds[] = {ShapeKind::box, ShapeKind::sphere, ShapeKind::capsule, ShapeKind::cylinder};
    const Shape shape = test::with(test::shape_of(kinds[random.below(4)], shapes), friction);
    b.body(name);
    b.set(keys::inertial, test::solid_box(random.uniform(0.1, 2), {shapes.length(), shapes.length(), shapes.length()}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  };
  int forks = 0;
  return test::tree_of([&](RobotBuilder& b) {
    const Shape shape = test::with(Shape::box({0.2, 0.15, 0.1}), friction);
    b.base("base");
    b.set(keys::inertial, test::solid_box(random.uniform(0.3, 3), {0.2, 0.15, 0.1}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
    for (int i = 0; i < children; ++i) {
      const bool branches = random.below(2) > 0;
      if (branches) b.fork();
      b.translation(random.uniform(0.05, 0.3) * random.direction());
      const JointLimits limits{.lower = random.uniform(-1.5, -0.1),
                               .upper = random.uniform(0.1, 1.5),
                               .damping = random.below(2) * random.uniform(0, 0.1),
                               .friction = random.below(2) * random.uniform(0, 0.1)};
      const std::string number = std::to_string(i);
      if (random.below(4) > 0)
        b.revolute("joint_" + number, random.direction(), limits);
      else
        b.prismatic("joint_" + number, random.direction(), {.lower = -0.1, .upper = 0.1});
      body(b, "body_" + number);
      if (branches) b.end(), ++forks;
    }
    while (forks-- > 0) b.end();
  });
}

struct Gain {
  double worst = 0;  ///< largest gain of energy, relative to the energy at the start
  std::string robot;
  int above = 0;  ///< number of robots that gained more than 0.1 %
};

/// Drops `count` robots, each at a place of its own, and follows them for `seconds`. Compares energies before and after
/// contacts, while the robots fly.
Gain gain_of(unsigned seed, int count, double seconds) {
  World w;
  test::Randoms random(seed);
  w.add_ground(0.7);
  std::vector<const RobotView*> robots;
  for (int i = 0; i < count; ++i) {
    const int column = i % 20, row = i / 20;
    const Vec3 at(6.0 * column, 6.0 * row, random.uniform(1.0, 1.6));
    const Vec3 velocity = random.direction(), spin = random.direction();
    const double speed = random.uniform(0, 2), rate = random.uniform(0, 5);
    const Twist twist{speed * velocity, rate * spin};
    const RobotTree tree = random_tree(random);
    const Quat turned = random.rotation();
    robots.push_back(&w.add("r" + std::to_string(i), tree, {at, turned}, twist));
  }
  w.start({{"joints", std::string("passive")}, {"integrator", std::string("rk4")}});
  w.refresh();
  const auto energy_of = [&](const RobotView& r) {
    const Motion m = motion_of(w, r);
    return m.kinetic + m.potential;
  };
  const auto touches = [&](const RobotView& r) {
    return std::any_of(r.links.begin(), r.links.end(), [&](const Link& link) {
      return !w.world().value(link.object, keys::contact_wrench).force.isZero(0);
    });
  };
  std::vector<double> starts, lowest, gains(robots.size());
  for (const RobotView* r : robots) starts.push_back(energy_of(*r));
  lowest = starts;
  for (int k = 0; k < int(100 * seconds); ++k) {
    w.run_for(0.01);
    w.refresh();
    for (std::size_t i = 0; i < robots.size(); ++i) {
      if (touches(*robots[i])) continue;  // springs of contacts hold some of the energy
      const double energy = energy_of(*robots[i]);
      gains[i] = std::max(gains[i], (energy - lowest[i]) / starts[i]);
      lowest[i] = std::min(lowest[i], energy);
    }
  }
  Gain gain;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    gain.above += gains[i] > 1e-3 ? 1 : 0;
    if (gains[i] <= gain.worst) continue;
    gain.worst = gains[i];
    gain.robot = std::string(robots[i]->name) + " of seed " + std::to_string(seed);
  }
  return gain;
}

TEST(PassiveDrops, GainNoEnergy) {
  const Gain gain = gain_of(1, 300, 1.2);
  EXPECT_LE(gain.worst, 1e-3) << gain.robot << "; " << gain.above << " of 300";
}

/// Each seed drops five hundred robots, together ten thousand.
class ManyPassiveDrops : public ::testing::TestWithParam<unsigned> {};

TEST_P(ManyPassiveDrops, GainNoEnergy) {
  const Gain gain = gain_of(GetParam(), 500, 2.5);
  EXPECT_LE(gain.worst, 1e-3) << gain.robot << "; " << gain.above << " of 500";
}

INSTANTIATE_TEST_SUITE_P(SlowSeeds, ManyPassiveDrops, ::testing::Range(2U, 22U));

}  // namespace
}  // namespace muro::articulated::testing
