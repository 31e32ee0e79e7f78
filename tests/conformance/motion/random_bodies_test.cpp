// SPDX-License-Identifier: MIT
// Ten thousand random convex bodies fall on planes, meshes and heightmaps at several rates. None gains energy.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/conformance/motion/energies.hpp"
#include "tests/support/hills.hpp"
#include "tests/support/randoms.hpp"

namespace muro::conformance {
namespace {

enum class Ground { plane, mesh, heightmap };

double hill(double x, double y) { return 0.15 * std::sin(0.7 * x) * std::cos(0.5 * y); }

constexpr int side = 8;       ///< bodies along each side of the square
constexpr double apart = 12;  ///< m: bodies do not meet
constexpr double half = 0.5 * side * apart;

mesh::Mesh hills_as_mesh() {
  constexpr std::uint32_t cells = 80;
  mesh::Mesh m;
  for (std::uint32_t row = 0; row <= cells; ++row)
    for (std::uint32_t column = 0; column <= cells; ++column) {
      const double x = 2 * half * column / cells - half, y = 2 * half * row / cells - half;
      m.vertices.push_back({x, y, hill(x, y)});
    }
  for (std::uint32_t row = 0; row < cells; ++row)
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t k = row * (cells + 1) + column;
      m.triangles.push_back({k, k + 1, k + cells + 2});
      m.triangles.push_back({k, k + cells + 2, k + cells + 1});
    }
  return m;
}

/// Returns points on an ellipsoid; collision uses their hull.
mesh::Mesh cloud(const Vec3& radii, test::Randoms& random) {
  mesh::Mesh m;
  const int count = 6 + random.below(30);
  for (int i = 0; i < count; ++i) m.vertices.push_back(radii.cwiseProduct(random.direction()));
  for (std::uint32_t i = 0; i + 2 < m.vertices.size(); ++i) m.triangles.push_back({i, i + 1, i + 2});
  return m;
}

class RandomBodies {
 public:
  RandomBodies(const std::string& motion, Ground ground, double rate, unsigned seed)
      : motion_(motion), rate_(rate), random_(seed), trial_(motion, rate) {
    add_ground(ground);
    for (int i = 0; i < side * side; ++i) add_body(i);
    trial_.start();
  }

  /// Returns the largest gain of a body, and a description of it.
  std::pair<double, std::string> run() {
    constexpr int windows = 40;  // of 50 ms
    const int steps = int(0.05 * rate_);
    for (Body& b : bodies_) b.means.push_back({energy_of(b.inertia, trial_.pose(*b.view), trial_.twist(*b.view)), 0});
    for (int k = 0; k < windows; ++k) {
      std::vector<Energies> sums(bodies_.size());
      for (int i = 0; i < steps; ++i) {
        trial_.run_for(1 / rate_);
        for (std::size_t n = 0; n < bodies_.size(); ++n) add_to(sums[n], bodies_[n]);
      }
      for (std::size_t n = 0; n < bodies_.size(); ++n)
        bodies_[n].means.push_back({sums[n].of_body / steps, sums[n].held_by_springs / steps});
    }
    std::pair<double, std::string> worst;
    for (const Body& b : bodies_)
      if (const double gain = gain_of(b.means); gain > worst.first) worst = {gain, b.what};
    return worst;
  }

 private:
  struct Body {
    const RobotView* view = nullptr;
    Inertia inertia;
    std::string what;
    std::vector<Energies> means;
  };

  void add_ground(Ground ground) {
    if (ground == Ground::plane) return trial_.add_ground(1);
    if (ground == Ground::heightmap) return hills_.add_to(trial_);
    Shape shape{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    shape.mesh = trial_.world().intern(folder_.file("hills.obj", mesh::testing::obj_text(hills_as_mesh())));
    trial_.world().add_scenery("hills", {}, std::span<const Shape>(&shape, 1));
  }
  void add_body(int i) {
    const Vec3 size(random_.uniform(0.05, 0.4), random_.uniform(0.05, 0.4), random_.uniform(0.05, 0.4));
    const double mass = std::pow(10, random_.uniform(-1, 2));
    const int kind = random_.below(5);
    Shape shape = kind == 0   ? Shape::box(size)
                  : kind == 1 ? Shape::sphere(0.5 * size.x())
                  : kind == 2 ? Shape::cylinder(0.5 * size.x(), size.z())
                  : kind == 3 ? Shape::capsule(0.5 * size.x(), size.z())
                              : Shape{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    shape.surface = {.friction = random_.uniform(0, 1.5), .restitution = random_.below(2) * random_.uniform(0, 1)};
    const std::string name = "b" + std::to_string(i);
    std::string file;
    if (kind == 4) file = folder_.file(name + ".obj", mesh::testing::obj_text(cloud(0.5 * size, random_)));
    const Vec3 extent = kind == 0 || kind == 4 ? size : Vec3(size.x(), size.x(), kind == 1 ? size.x() : size.z());
    Inertia inertia = solid_box(mass, extent);
    const int column = i % side, row = i / side;
    const Pose at{{apart * (column + 0.5) - half, apart * (row + 0.5) - half, 0.6}, random_.rotation()};
    const Twist twist{random_.uniform(0, 2) * random_.direction(), random_.uniform(0, 10) * random_.direction()};
    const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
      if (!file.empty()) shape.mesh = b.intern(file);
      b.base("body");
      b.set(keys::inertial, inertia);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
    });
    constexpr const char* kinds[] = {"box", "sphere", "cylinder", "capsule", "hull"};
    bodies_.push_back({&trial_.add(name, tree, at, twist),
                       inertia,
                       std::string(kinds[kind]) + " " + name + " of " + text(mass) + " kg, friction " +
                           text(shape.surface.friction) + ", restitution " + text(shape.surface.restitution),
                       {}});
  }
  void add_to(Energies& sum, const Body& b) {
    const Pose& pose = trial_.pose(*b.view);
    sum.of_body += energy_of(b.inertia, pose, trial_.twist(*b.view));
    sum.held_by_springs +=
        held_by_springs(motion_, b.inertia, pose, trial_.world().values(b.view->base(), keys::contacts), rate_);
  }

  const std::string motion_;
  const double rate_;
  test::Randoms random_;
  const test::ScratchFolder folder_;
  const test::Hills hills_{2 * half, 80, hill};
  Trial trial_;
  std::vector<Body> bodies_;
};

using GroundAndRate = std::tuple<std::string, Ground, double>;
class SlowRandomBodies : public ::testing::TestWithParam<GroundAndRate> {};

TEST_P(SlowRandomBodies, ThatFallGainNoEnergy) {
  const auto& [motion, ground, rate] = GetParam();
  constexpr unsigned scenes = 14;  // of 64 bodies, in 12 combinations: 10 752
  for (unsigned seed = 1; seed <= scenes; ++seed) {
    const auto [gain, what] = RandomBodies(motion, ground, rate, seed).run();
    EXPECT_LT(gain, 1e-3) << what << ", seed " << seed;
  }
}

std::string name_of_ground_and_rate(const ::testing::TestParamInfo<GroundAndRate>& test) {
  constexpr const char* grounds[] = {"plane", "mesh", "heightmap"};
  const auto& [motion, ground, rate] = test.param;
  return motion.substr(motion.find('.') + 1) + "_on_a_" + grounds[int(ground)] + "_at_" + std::to_string(int(rate)) +
         "_Hz";
}

INSTANTIATE_TEST_SUITE_P(Motions, SlowRandomBodies,
                         ::testing::Combine(::testing::Values("motion.simplified", "motion.articulated"),
                                            ::testing::Values(Ground::plane, Ground::mesh, Ground::heightmap),
                                            ::testing::Values(250.0, 500.0, 1000.0, 4000.0)),
                         name_of_ground_and_rate);

}  // namespace
}  // namespace muro::conformance
