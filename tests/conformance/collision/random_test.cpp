// SPDX-License-Identifier: MIT
// Random pairs of shapes in every collision algorithm, compared with collision.native. Its depth is the smallest motion
// that separates a pair.
#include <random>

#include "muro/base/bounds.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/collision/touching.hpp"
#include "tests/support/randoms.hpp"

namespace muro {
namespace {

using test::CollisionScene;

const ShapeKind kinds[] = {ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule};

class Randoms {
 public:
  explicit Randoms(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 direction() {
    const double z = uniform(-1, 1), angle = uniform(-M_PI, M_PI), r = std::sqrt(1 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }
  Quat rotation(bool none) {
    if (none) return Quat::Identity();
    return rotation_of(Vec3(uniform(0, M_PI) * direction()));
  }
  double length() { return 0.1 * std::pow(20.0, uniform(0, 1)); }  // 0.1 to 2 m
  Shape shape(ShapeKind kind) { return test::shape_of(kind, *this); }

 private:
  std::mt19937_64 engine_;
};

double size_of(const Shape& s) { return half_extents(s).norm(); }

struct Pair {
  Shape robot, scenery;
  Pose at, place;
  double size() const { return size_of(robot) + size_of(scenery); }
};

/// Pairs near each other, a quarter of them parallel to the axes; all far from other pairs.
std::vector<Pair> pairs_of(ShapeKind a, ShapeKind b, int count, unsigned seed) {
  Randoms random(seed);
  std::vector<Pair> pairs;
  for (int i = 0; i < count; ++i) {
    Pair p{random.shape(a), random.shape(b), {}, {}};
    const bool parallel = i % 4 == 0;
    const int column = i % 20, row = i / 20;
    p.place = {{10.0 * column, 10.0 * row, 0}, random.rotation(parallel)};
    const double near = half_extents(p.robot).minCoeff() + half_extents(p.scenery).minCoeff();
    p.at = {p.place.position + random.uniform(0.7, 1.2) * near * random.direction(), random.rotation(parallel)};
    pairs.push_back(p);
  }
  return pairs;
}

/// Returns the contacts of each pair.
std::vector<std::vector<Contact>> contacts_of(const std::string& algorithm, const std::vector<Pair>& pairs) {
  CollisionScene scene(algorithm);
  std::vector<const RobotView*> robots;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    scene.add_scenery("s" + std::to_string(i), pairs[i].scenery, pairs[i].place);
    robots.push_back(&scene.add_dynamic("r" + std::to_string(i), pairs[i].robot, pairs[i].at));
  }
  scene.finish_setup();
  scene.step_once();
  std::vector<std::vector<Contact>> all;
  for (const RobotView* r : robots) all.push_back(scene.contacts(*r));
  return all;
}

/// Moves robots apart until they overlap by a hundredth of their size at most.
void make_shallow(std::vector<Pair>& pairs) {
  const auto contacts = contacts_of("collision.native", pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (contacts[i].empty()) continue;
    const Contact& c = test::deepest(contacts[i]);
    pairs[i].at.position += std::max(0.0, c.depth - 0.005 * pairs[i].size()) * c.normal;
  }
}

struct EveryCollisionAtRandom : ::testing::TestWithParam<std::string> {
  /// Checks that no pair is missed or invented, except where it overlaps by less than `bound`, and that depths agree.
  void expect_agreement(ShapeKind a, ShapeKind b, bool shallow, double bound) {
    std::vector<Pair> pairs = pairs_of(a, b, 200, unsigned(8 * int(a) + int(b)));
    if (shallow) make_shallow(pairs);
    const auto ours = contacts_of(GetParam(), pairs), native = contacts_of("collision.native", pairs);
    int touching = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const double size = pairs[i].size();
      const double known = native[i].empty() ? 0 : test::deepest(native[i]).depth / size;
      const double found = ours[i].empty() ? 0 : test::deepest(ours[i]).depth / size;
      touching += known > 0 && found > 0;
      EXPECT_NEAR(found, known, bound) << "kinds " << int(a) << ' ' << int(b) << ", pair " << i;
      worst = std::max(worst, std::abs(found - known));
      if (!shallow || native[i].size() != 1 || ours[i].size() != 1) continue;
      const Contact &n = native[i][0], &o = ours[i][0];
      EXPECT_LT((n.normal - o.normal).norm(), 0.1) << "kinds " << int(a) << ' ' << int(b) << ", pair " << i;
    }
    EXPECT_GT(touching, 100);
  }
  void record_worst() const {
    std::ostringstream text;
    text << worst;
    RecordProperty("worst", text.str());
  }
  double worst = 0;  ///< largest difference of depths, as a fraction of the size
};

TEST_P(EveryCollisionAtRandom, AgreesWithNativeOnPairsThatOverlapALittle) {
  for (const ShapeKind a : kinds)
    for (const ShapeKind b : kinds) expect_agreement(a, b, true, test::accuracy_of(GetParam()).shallow);
  record_worst();
}

TEST_P(EveryCollisionAtRandom, AgreesWithNativeOnPairsThatOverlapDeeply) {
  for (const ShapeKind a : kinds)
    for (const ShapeKind b : kinds) expect_agreement(a, b, false, test::accuracy_of(GetParam()).deep);
  record_worst();
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryCollisionAtRandom, ::testing::ValuesIn(test::algorithms_of("collision")),
                         test::name_of);

}  // namespace
}  // namespace muro
