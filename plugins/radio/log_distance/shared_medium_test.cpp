// SPDX-License-Identifier: MIT
// Senders that share a medium; state and threads with either medium; control code that talks by radio.
#include "radio_testing.hpp"
#include "tests/support/allocation_counter.hpp"

namespace muro::log_distance {
namespace {

const Settings shared = {{"medium", "shared"}, {"obstacles", "ignore"}};

struct Load {
  double throughput = 0;  ///< airtime of received frames, per second
  std::uint64_t sent = 0, received = 0, collisions = 0, no_access = 0;
};

/// A receiver in the middle, with senders around it that always have 50 bytes (1.792 ms) to send.
Load loaded(const std::vector<Vec3>& senders, double seconds) {
  Radios s;
  s.place("receiver", {0, 0, 0});
  for (std::size_t i = 0; i < senders.size(); ++i) s.place("s" + std::to_string(i), senders[i]);
  s.start(500, shared);
  for (int k = 0; k < 500 * seconds; ++k) {
    for (std::size_t i = 1; i < s.radios.size(); ++i) s.send(i, "x", -1, 50);
    s.run_for(0.002);
  }
  Load load;
  for (std::size_t i = 1; i < s.radios.size(); ++i)
    load.sent += s.counters(i).sent, load.no_access += s.counters(i).lost_access;
  load.received = s.counters(0).received;
  load.collisions = s.counters(0).lost_collision;
  load.throughput = double(load.received) * 1.792e-3 / seconds;
  return load;
}

TEST(RadioMedium, IsSharedByThoseWhoHearEachOther) {
  const Load one = loaded({{3, 0, 0}}, 4);
  // a frame takes 1.792 ms, the turnaround 0.192 ms, the back-off 3.5 slots of 0.32 ms on average
  EXPECT_NEAR(one.throughput, 1.792 / (1.792 + 0.192 + 1.12), 0.02);
  EXPECT_EQ(one.collisions, 0u);
  const Load four = loaded({{3, 0, 0}, {-3, 0, 0}, {0, 3, 0}, {0, -3, 0}}, 4);
  EXPECT_GT(four.throughput, 0.4);
  EXPECT_LT(four.throughput, 1) << "never above capacity";
  EXPECT_GT(four.no_access, 0u);
  EXPECT_LE(four.received + four.collisions, four.sent);
  EXPECT_LT(double(four.collisions), 0.4 * double(four.sent)) << "who begins within the turnaround of another collides";
}

TEST(RadioMedium, SuffersFromSendersThatAreHiddenFromEachOther) {
  const Load heard = loaded({{20, 0, 0}, {20, 1, 0}}, 4), hidden = loaded({{20, 0, 0}, {-20, 0, 0}}, 4);
  EXPECT_GT(hidden.sent, heard.sent) << "they do not wait for each other";
  EXPECT_GT(double(hidden.collisions) / double(hidden.sent), 3 * double(heard.collisions) / double(heard.sent));
}

TEST(RadioMedium, LetsTheStrongerOfTwoThroughByCapture) {
  const Load near_far = loaded({{3, 0, 0}, {-30, 0, 0}}, 2);  // 30 dB apart, hidden from each other
  EXPECT_GT(near_far.received, near_far.collisions);
  EXPECT_GT(near_far.collisions, 50u) << "the farther one is lost";
}

TEST(RadioMedium, LosesBitsToOverlapByModulationToo) {
  Radios s;
  s.place("receiver", {0, 0, 0});
  s.place("a", {20, 0, 0});
  s.place("b", {-20, 0, 0});
  Settings settings = shared;
  settings["modulation"] = "802.15.4";
  s.start(500, settings);
  for (int k = 0; k < 1000; ++k) {
    for (std::size_t i = 1; i < 3; ++i) s.send(i, "x", -1, 50);
    s.run_for(0.002);
  }
  EXPECT_GT(s.counters(0).lost_collision, 50u);
  EXPECT_EQ(s.counters(0).lost_error, 0u) << "noise alone is 20 dB below";
  EXPECT_GT(s.counters(0).received, 50u);
}

/// Robots that all send at 50 Hz, with all causes of loss.
struct Crowd : Radios {
  explicit Crowd(const char* medium, unsigned threads = 1, int robots = 60) : Radios(9) {
    for (int i = 0; i < robots; ++i) {
      const double angle = 2.399963 * i, radius = 4 * std::sqrt(i);
      place("r" + std::to_string(i), {radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (int i = 0; i < 6; ++i) wall("wall" + std::to_string(i), Shape::box({5, 0.2, 2}), {8.0 * i - 20, 3, 0.5});
    set_threads(threads);
    start(200, {{"medium", medium},
                {"shadowing_sigma", 4.0},
                {"modulation", "802.15.4"},
                {"noise_floor", -95.0},
                {"queue", std::int64_t(3)},
                {"keep", 0.02}});
  }
  void talk(int steps) {
    for (int k = 0; k < steps; ++k) {
      for (std::size_t i = 0; i < radios.size(); ++i)
        if ((now_step_ + i) % 4 == 0) send(i, std::string(1 + (now_step_ + i) % 15, 'x'));
      run_for(0.005);
      ++now_step_;
    }
  }
  std::size_t now_step_ = 0;
};

TEST(RadioMedium, GivesTheSameBitsOnAnyNumberOfThreads) {
  for (const char* medium : {"separate", "shared"}) {
    const auto hash = [&](unsigned threads) {
      Crowd s(medium, threads);
      s.talk(60);
      EXPECT_GT(s.counters(0).received, 10u);
      return s.state_hash();
    };
    const std::uint64_t one = hash(1);
    EXPECT_EQ(hash(2), one) << medium;
    EXPECT_EQ(hash(4), one) << medium;
  }
}

TEST(SlowRadioMedium, GivesAThousandRobotsTheSameBitsToo) {
  for (const char* medium : {"separate", "shared"}) {
    const auto hash = [&](unsigned threads) {
      Crowd s(medium, threads, 1000);
      s.talk(12);
      return s.state_hash();
    };
    EXPECT_EQ(hash(4), hash(1)) << medium;
  }
}

TEST(RadioMedium, GoesOnFromASnapshotAndBeginsAnewAfterAReset) {
  for (const char* medium : {"separate", "shared"}) {
    Crowd s(medium);
    s.talk(31);
    const Snapshot middle = s.snapshot();
    s.talk(40);
    const std::uint64_t end = s.state_hash();
    s.restore(middle);
    s.now_step_ = 31;
    s.talk(40);
    EXPECT_EQ(s.state_hash(), end) << medium;
    s.reset();
    s.now_step_ = 0;
    s.talk(71);
    EXPECT_EQ(s.state_hash(), end) << medium;
  }
}

TEST(RadioMedium, AllocatesNothingOnceWarm) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const char* medium : {"separate", "shared"}) {
    Crowd s(medium, 1, 20);
    s.talk(800);
    const std::uint64_t before = test::allocations();
    ASSERT_GT(before, 0u);
    s.talk(50);
    EXPECT_EQ(test::allocations() - before, 0u) << medium;
  }
#endif
}

/// Returns what is logged when two robots talk by control code at 10 Hz.
std::string logged(double rate, double keep) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {5, 0, 0});
  std::vector<Item> bases;
  for (const Item& item : s.radios) bases.push_back({item.robot, item.robot->base()});
  s.use("controller.library", 10, bases, {{"library", std::string(CONTROLLERS "/talk.so")}});
  std::string all;
  s.set_log([&](LogLevel, std::string_view line) { all += std::string(line) + "\n"; });
  s.start(rate, {{"keep", keep}, {"obstacles", "ignore"}});
  return all;
}

TEST(RadioControlCode, IsWarnedWhenItIsTooSlowToReadAll) {
  const std::string warning = logged(100, 0);
  EXPECT_SAYS(warning,
              "robot `a`: input `radio.received` of `talk` is read at 10 Hz, but `a/radio` lists a message for 0.01 s "
              "alone: those that come and go in between are missed; set `keep: 0.1` at the radio");
  EXPECT_EQ(std::count(warning.begin(), warning.end(), '\n'), 1) << "once: " << warning;
  EXPECT_SAYS(logged(100, 0.09), "lists a message for 0.09 s");
  EXPECT_EQ(logged(100, 0.1), "");
  EXPECT_EQ(logged(100, 0.0951), "") << "until the step after";
  EXPECT_EQ(logged(10, 0), "");
  EXPECT_EQ(logged(5, 0), "") << "listed until the next step of the radio";
}

TEST(RadioControlCode, TalksByTypedPortsInC) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {5, 0, 0});
  for (const Item& item : s.radios)
    s.use("controller.library", 10, {{item.robot, item.robot->base()}},
          {{"library", std::string(CONTROLLERS "/talk.so")}});
  s.start(100, {{"keep", 0.1}, {"obstacles", "ignore"}});
  s.run_for(1.05);
  const Twist& shown = s.world().value(s.radios[0].robot->base(), keys::command_twist);
  EXPECT_EQ(shown.linear.y(), 1) << "from b";
  EXPECT_EQ(shown.linear.z(), 1) << "each message once: it is kept for the period of the control code";
  // at 0.9 s b has reported what it heard until then: the messages that a sent at 0, 0.1, ... 0.8 s
  EXPECT_EQ(shown.linear.x(), 9);
  EXPECT_EQ(s.counters(0).lost_overrun, 0u);
}

}  // namespace
}  // namespace muro::log_distance
