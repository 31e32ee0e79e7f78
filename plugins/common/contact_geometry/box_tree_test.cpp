// SPDX-License-Identifier: MIT
#include "box_tree.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/support/randoms.hpp"

namespace {

using namespace muro;
using namespace muro::contact_geometry;
using test::Randoms;

Aabb random_box(Randoms& random, double world) {
  const Vec3 middle = random.direction() * random.uniform(0, world);
  const Vec3 half(random.length(), random.length(), random.length());
  return {middle - half, middle + half};
}

std::set<std::uint32_t> found(const BoxTree& tree, std::span<const Aabb> boxes, const Aabb& probe) {
  std::set<std::uint32_t> items;
  each_near(tree.view(), probe, [&](std::uint32_t i) {
    if (!boxes[i].overlaps(probe)) return;
    EXPECT_TRUE(items.insert(i).second) << "visited twice: " << i;
  });
  return items;
}

std::set<std::uint32_t> brute_force(std::span<const Aabb> boxes, std::span<const std::uint32_t> members,
                                    const Aabb& probe) {
  std::set<std::uint32_t> items;
  for (const std::uint32_t i : members)
    if (boxes[i].overlaps(probe)) items.insert(i);
  return items;
}

TEST(BoxTree, FindsWhatASearchThroughAllBoxesFinds) {
  Randoms random(1);
  for (const int count : {0, 1, 2, 3, 10, 100, 1000}) {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> members;
    for (int i = 0; i < count; ++i) {
      boxes.push_back(random_box(random, 20));
      if (i % 5 != 3) members.push_back(std::uint32_t(i));
    }
    BoxTree tree;
    tree.build(boxes, members);
    for (int i = 0; i < 200; ++i) {
      const Aabb probe = random_box(random, 20);
      EXPECT_EQ(found(tree, boxes, probe), brute_force(boxes, members, probe));
    }
  }
}

TEST(BoxTree, AMovedTreeFindsWhatANewOneFindsAndKnowsWhenItDegrades) {
  Randoms random(2);
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < 300; ++i) {
    boxes.push_back(random_box(random, 20));
    members.push_back(i);
  }
  BoxTree tree;
  tree.build(boxes, members);
  int rebuilt = 0;
  for (int round = 0; round < 40; ++round) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      if (random.below(3) > 0) continue;
      const Vec3 shift = random.direction();
      boxes[i].low += shift;
      boxes[i].high += shift;
      tree.move(i, boxes[i]);
    }
    if (tree.is_degraded()) {
      tree.rebuild();
      ++rebuilt;
      EXPECT_FALSE(tree.is_degraded());
    }
    BoxTree fresh;
    fresh.build(boxes, members);
    for (int i = 0; i < 20; ++i) {
      const Aabb probe = random_box(random, 25);
      EXPECT_EQ(found(tree, boxes, probe), found(fresh, boxes, probe));
      EXPECT_EQ(found(tree, boxes, probe), brute_force(boxes, members, probe));
    }
  }
  EXPECT_GE(rebuilt, 1);
  EXPECT_LE(rebuilt, 10);
}

/// Returns the depth of the deepest node; that of the root is 0.
int depth_of(const Bvh& tree, std::uint32_t node = 0) {
  const BvhNode& n = tree.nodes[node];
  return n.count > 0 ? 0 : 1 + std::max(depth_of(tree, n.first), depth_of(tree, n.first + 1));
}

TEST(BoxTree, StaysShallowEnoughForASearchOnAFixedStack) {
  std::vector<Aabb> same(5000, Aabb{Vec3::Zero(), Vec3::Ones()}), growing;
  std::vector<std::uint32_t> members;
  for (int i = 0; i < 300; ++i) {  // each box is nine times as far away as the one before
    const double x = std::pow(9.0, i);
    growing.push_back({Vec3(x, 0, 0), Vec3(1.5 * x, 1, 1)});
  }
  for (std::uint32_t i = 0; i < same.size(); ++i) members.push_back(i);
  BoxTree tree;
  tree.build(same, members);
  EXPECT_LT(depth_of(tree.view()), 60);
  tree.build(growing, std::span(members).first(growing.size()));
  EXPECT_LT(depth_of(tree.view()), 60);
  EXPECT_EQ(found(tree, growing, growing[250]), (std::set<std::uint32_t>{250}));
}

TEST(BoxTree, EveryBoxLiesWithinItsLeafAndEveryNodeWithinItsParent) {
  Randoms random(4);
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> members;
  for (std::uint32_t i = 0; i < 500; ++i) {
    boxes.push_back(random_box(random, 20));
    members.push_back(i);
  }
  BoxTree tree;
  tree.build(boxes, members);
  const Bvh view = tree.view();
  std::size_t items = 0;
  for (const BvhNode& n : view.nodes)
    if (n.count > 0) {
      items += n.count;
      for (std::uint32_t i = 0; i < n.count; ++i) EXPECT_TRUE(n.bounds.contains(boxes[view.items[n.first + i]]));
    } else {
      EXPECT_TRUE(n.bounds.contains(view.nodes[n.first].bounds));
      EXPECT_TRUE(n.bounds.contains(view.nodes[n.first + 1].bounds));
    }
  EXPECT_EQ(items, boxes.size());
}

}  // namespace
