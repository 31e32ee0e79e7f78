// SPDX-License-Identifier: MIT
// Compares the shape pairs with FCL (Pan, Chitta, Manocha: FCL: A general purpose library for collision and proximity
// queries, ICRA 2012), on random shapes of 0.05 to 2 m in random and in axis-parallel places.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>

#include "pairs_testing.hpp"

namespace {

using namespace muro;
using namespace muro::native;
using namespace muro::native::testing;

std::shared_ptr<fcl::CollisionGeometryd> geometry(const TransformedShape& s) {
  switch (s.kind) {
    case ShapeKind::box:
      return std::make_shared<fcl::Boxd>(2 * s.half);
    case ShapeKind::sphere:
      return std::make_shared<fcl::Sphered>(s.radius());
    case ShapeKind::cylinder:
      return std::make_shared<fcl::Cylinderd>(s.radius(), 2 * s.half.z());
    case ShapeKind::capsule:
      return std::make_shared<fcl::Capsuled>(s.radius(), 2 * s.half.z());
    default:
      return std::make_shared<fcl::Halfspaced>(Vec3::UnitZ(), 0);
  }
}

fcl::CollisionObjectd object(const TransformedShape& s) { return {geometry(s), s.axes, s.centre}; }

/// Returns the depth of FCL's deepest contact; 0 when apart. Between a cylinder or capsule and a box, cylinder or
/// capsule it comes from the portal refinement of libccd, which gives a translation that separates, but not the least.
double fcl_depth(const TransformedShape& a, const TransformedShape& b) {
  fcl::CollisionRequestd request(16, true);
  request.gjk_tolerance = 1e-10;
  fcl::CollisionResultd result;
  const auto first = object(a), second = object(b);
  fcl::collide(&first, &second, request, result);
  double depth = 0;
  for (std::size_t i = 0; i < result.numContacts(); ++i)
    depth = std::max(depth, std::abs(result.getContact(i).penetration_depth));
  return depth;
}

struct Pair {
  TransformedShape a, b;
};

/// Makes a random pair. About half of them overlap; a quarter is parallel to the axes of the world.
Pair random_pair(Randoms& random, ShapeKind first, ShapeKind second) {
  const bool parallel = random.below(4) == 0;
  const auto turn = [&] { return parallel ? random.right_angles() : random.rotation(); };
  const Shape a = random.shape(first), b = random.shape(second);
  const Vec3 away = random.direction();
  Pair p{transformed(a, {10 * random.direction(), turn()}), transformed(b, {Vec3::Zero(), turn()})};
  const Vec3 aim = second == ShapeKind::plane ? Vec3(-p.b.axis()) : away;
  const bool exact = second == ShapeKind::plane || (first == ShapeKind::sphere && second == ShapeKind::sphere);
  const double reach = extent(p.a, aim) - p.a.centre.dot(aim) + (second == ShapeKind::plane ? 0 : extent(p.b, -aim));
  p.b.centre = p.a.centre + aim * (reach * random.uniform(0.35, exact ? 1.65 : 1.25));
  return p;
}

class PairsOfKinds : public ::testing::TestWithParam<std::pair<ShapeKind, ShapeKind>> {};

TEST_P(PairsOfKinds, TouchWhereFclSaysSoWithTheLeastDepth) {
  const auto [first, second] = GetParam();
  Randoms random(unsigned(first) * 8 + unsigned(second));
  const int pairs = 800;
  const double band = 1e-6;  // part of the size: closer to touching, the two may disagree
  int touching = 0, as_deep_as_fcl = 0;
  for (int i = 0; i < pairs; ++i) {
    const auto [a, b] = random_pair(random, first, second);
    const double size = size_of(a) + (second == ShapeKind::plane ? 0 : size_of(b));
    Manifold m;
    collide_shapes(a, b, m);
    const double fcl = fcl_depth(a, b);
    if (m.count == 0) {
      EXPECT_LT(fcl, band * size) << "pair " << i;
      continue;
    }
    ++touching;
    const ContactPoint& c = *deepest(m);
    EXPECT_NEAR(c.normal.norm(), 1, 1e-12);
    if (second == ShapeKind::plane) {
      EXPECT_NEAR(c.depth, fcl, 1e-9 * size) << "pair " << i;
      continue;
    }
    EXPECT_LT(c.depth, fcl + band * size) << "pair " << i;
    as_deep_as_fcl += std::abs(c.depth - fcl) < 1e-6 * size;
    // Along the normal the shapes overlap by the depth, and in no direction by less.
    EXPECT_NEAR(depth_along(a, b, c.normal), c.depth, 1e-9 * size) << "pair " << i;
    EXPECT_GE(sampled_depth(a, b), c.depth - 1e-9 * size) << "pair " << i;
  }
  EXPECT_GT(touching, 0.35 * pairs);
  EXPECT_LT(touching, 0.65 * pairs);
  const bool closed_form = first == ShapeKind::sphere || second == ShapeKind::sphere || second == ShapeKind::box;
  if (closed_form && second != ShapeKind::plane) {
    EXPECT_GT(as_deep_as_fcl, 0.9 * touching);  // the rest: boxes where FCL prefers a face
  }
}

std::vector<std::pair<ShapeKind, ShapeKind>> all_pairs() {
  using enum ShapeKind;
  std::vector<std::pair<ShapeKind, ShapeKind>> all;
  for (const ShapeKind a : {box, sphere, cylinder, capsule})
    for (const ShapeKind b : {box, sphere, cylinder, capsule, plane})
      if (a <= b) all.push_back({a, b});
  return all;
}

std::string name_of_pair(const ::testing::TestParamInfo<std::pair<ShapeKind, ShapeKind>>& info) {
  constexpr const char* names[] = {"Box", "Sphere", "Cylinder", "Capsule", "Plane"};
  return std::string(names[int(info.param.first)]) + names[int(info.param.second)];
}

INSTANTIATE_TEST_SUITE_P(All, PairsOfKinds, ::testing::ValuesIn(all_pairs()), name_of_pair);

}  // namespace
