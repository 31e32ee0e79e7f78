// SPDX-License-Identifier: MIT
// Saving of a control library with the C++ header: equal states give equal bytes.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <new>

#include "muro_controller.hpp"

namespace {

/// A state with padding between its members.
struct Padded {
  bool first;
  double second;
};
static_assert(sizeof(Padded) == 16);

/// Returns the saved bytes of a value made in memory full of `filling`.
std::array<std::byte, sizeof(Padded)> saved_from(int filling) {
  alignas(Padded) std::array<std::byte, sizeof(Padded)> memory;
  std::memset(memory.data(), filling, memory.size());
  auto* const value = new (memory.data()) Padded;
  value->first = true;
  value->second = 2.5;
  std::array<std::byte, sizeof(Padded)> room{};
  muro::controller::Saver(room).put(*value);
  return room;
}

TEST(Saver, TakesArrays) {
  const double values[] = {1.5, -2};
  std::array<std::byte, sizeof values> room{};
  muro::controller::Saver(room).put(values);
  EXPECT_EQ(std::memcmp(room.data(), values, sizeof values), 0);
}

TEST(Saver, WritesNothingOfWhatLiesBetweenMembers) {
  const auto one = saved_from(0x55);
  [[maybe_unused]] const auto other = saved_from(0xAA);
  Padded back;
  std::memcpy(&back, one.data(), sizeof back);
  EXPECT_TRUE(back.first);
  EXPECT_EQ(back.second, 2.5);
#ifdef MURO_CAN_CLEAR_PADDING
  EXPECT_EQ(one, other);
#endif
}

}  // namespace
