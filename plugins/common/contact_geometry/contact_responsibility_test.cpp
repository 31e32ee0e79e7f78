// SPDX-License-Identifier: MIT
#include "contact_responsibility.hpp"

#include <gtest/gtest.h>

namespace muro {
namespace {

constexpr std::uint64_t kinematic = kinematic_world, simplified = keys::contact_for_all, world = 7, other_world = 9;

// The table in contact_responsibility.hpp, row by row.
TEST(ContactResponsibility, FollowsItsTable) {
  const auto algorithm = ContactResolver::contact_algorithm;
  for (const std::uint64_t other : {kinematic, simplified, world})
    EXPECT_EQ(contact_resolver(kinematic, other), ContactResolver::nobody) << other;
  for (const std::uint64_t other : {kinematic, simplified, world})
    EXPECT_EQ(contact_resolver(simplified, other), algorithm) << other;
  EXPECT_EQ(contact_resolver(world, kinematic), ContactResolver::world);
  EXPECT_EQ(contact_resolver(world, world), ContactResolver::world);
  EXPECT_EQ(contact_resolver(world, simplified), algorithm);
  EXPECT_EQ(contact_resolver(world, other_world), algorithm);
}

TEST(ContactResponsibility, TwoRobotsThatForcesMoveAgree) {
  for (const std::uint64_t a : {simplified, world, other_world})
    for (const std::uint64_t b : {simplified, world, other_world})
      EXPECT_EQ(contact_resolver(a, b), contact_resolver(b, a)) << a << " " << b;
}

TEST(ContactResponsibility, NumbersOfWorldsAreNoReservedValues) {
  for (const std::uint64_t hash : {0ull, 1ull, 2ull, 99ull}) EXPECT_TRUE(is_in_world(number_of_world(hash))) << hash;
  EXPECT_FALSE(is_in_world(contact_world_of(true)));
  EXPECT_TRUE(is_moved_by_forces(contact_world_of(true)));
  EXPECT_FALSE(is_moved_by_forces(contact_world_of(false)));
}

}  // namespace
}  // namespace muro
