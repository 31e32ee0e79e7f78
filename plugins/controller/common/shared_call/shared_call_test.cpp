// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <new>
#include <thread>

#include "shared_memory.hpp"
#include "turn.hpp"

namespace muro {
namespace {

using namespace std::chrono_literals;
using Side = Turn::Side;

struct Sum {
  Turn turn;
  long a = 0, b = 0, sum = 0;
};

/// Adds numbers until `a` is negative.
void add(Sum& s, std::chrono::nanoseconds spin) {
  Patience patience(spin);
  for (;;) {
    while (!s.turn.wait_for(Side::callee, patience, 1s)) continue;
    if (s.a < 0) return;
    s.sum = s.a + s.b;
    s.turn.pass_to(Side::caller);
  }
}

class Calls : public ::testing::TestWithParam<int> {};

TEST_P(Calls, OfAnotherProcessGiveItsResults) {
  const std::chrono::nanoseconds spin(GetParam());
  Patience patience(spin);
  SharedMemory memory;
  ASSERT_TRUE(memory.create("sum") && memory.resize(sizeof(Sum)));
  Sum& s = *new (memory.data()) Sum;
  const pid_t child = fork();
  if (child == 0) {
    SharedMemory theirs;
    if (!theirs.open(memory.descriptor(), sizeof(Sum))) _exit(1);
    add(*reinterpret_cast<Sum*>(theirs.data()), spin);
    _exit(0);
  }
  for (long i = 0; i < 2000; ++i) {
    s.a = i, s.b = 3;
    s.turn.pass_to(Side::callee);
    while (!s.turn.wait_for(Side::caller, patience, 1s)) ASSERT_EQ(waitpid(child, nullptr, WNOHANG), 0);
    ASSERT_EQ(s.sum, i + 3);
  }
  s.a = -1;
  s.turn.pass_to(Side::callee);
  int status = 1;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}
INSTANTIATE_TEST_SUITE_P(Spinning, Calls, ::testing::Values(0, 30'000));

TEST(Turn, IsWaitedForAsLongAsIsSaidAndNoLonger) {
  Turn turn;
  Patience none(0ns), some(1us);
  EXPECT_TRUE(turn.wait_for(Side::caller, none, 0ns));
  EXPECT_FALSE(turn.wait_for(Side::callee, some, 1ms));
  std::thread late([&] {
    std::this_thread::sleep_for(5ms);
    turn.pass_to(Side::callee);
  });
  while (!turn.wait_for(Side::callee, none, 1s)) continue;
  late.join();
  EXPECT_FALSE(turn.wait_for(Side::caller, none, 0ns));
}

TEST(Patience, IsLostWhereLookingDidNotPayAndTriedAgainNowAndThen) {
  Patience patience(50us);
  EXPECT_EQ(patience.spin(), 50us);
  patience.learn(false);
  int tried = 0;
  for (int i = 0; i < 1000; ++i) tried += patience.spin() > 0ns ? 1 : 0;
  EXPECT_GT(tried, 0);
  EXPECT_LT(tried, 10);
  patience.learn(true);
  EXPECT_EQ(patience.spin(), 50us);
}

}  // namespace
}  // namespace muro
