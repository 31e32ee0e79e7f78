// SPDX-License-Identifier: MIT
#include "mesh.hpp"

#include <gtest/gtest.h>

#include "files_testing.hpp"

namespace {

using namespace muro;
using namespace muro::mesh;

TEST(Mesh, ABoxIsClosedAndConvexUntilATriangleIsMissingTurnedOrDoubled) {
  const Mesh whole = mesh::testing::box({0, 0, 0}, {1, 2, 3});
  EXPECT_TRUE(is_closed(whole));
  EXPECT_TRUE(is_convex(whole));
  EXPECT_NEAR(volume_of(whole), 6, 1e-12);
  Mesh open = whole;
  open.triangles.pop_back();
  EXPECT_FALSE(is_closed(open));
  Mesh turned = whole;
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_FALSE(is_closed(turned));
  Mesh doubled = whole;
  doubled.triangles.insert(doubled.triangles.end(), whole.triangles.begin(), whole.triangles.end());
  EXPECT_FALSE(is_closed(doubled));
  Mesh inward = whole;
  for (Triangle& t : inward.triangles) std::swap(t[0], t[1]);
  EXPECT_TRUE(is_closed(inward));
  EXPECT_FALSE(is_convex(inward));
  EXPECT_NEAR(volume_of(inward), -6, 1e-12);
}

TEST(Mesh, ADentMakesItConcave) {
  Mesh dented = mesh::testing::box({0, 0, 0}, {1, 1, 1});
  dented.vertices[7] = {0.7, 0.7, 0.7};
  EXPECT_TRUE(is_closed(dented));
  EXPECT_FALSE(is_convex(dented));
}

TEST(Mesh, TidyMakesASoupOfTrianglesOneSurface) {
  const Mesh whole = mesh::testing::box({0, 0, 0}, {1, 1, 1});
  Mesh soup;
  for (const Triangle& t : whole.triangles) {
    const auto n = std::uint32_t(soup.vertices.size());
    for (const std::uint32_t c : t) soup.vertices.push_back(whole.vertices[c]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  EXPECT_FALSE(is_closed(soup));
  soup.triangles.push_back({0, 1, 1});
  soup.vertices.push_back({9, 9, 9});
  clean(soup);
  EXPECT_EQ(soup.vertices.size(), 8u);
  EXPECT_EQ(soup.triangles.size(), 12u);
  EXPECT_TRUE(is_closed(soup));
}

}  // namespace
