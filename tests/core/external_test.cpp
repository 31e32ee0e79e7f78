// SPDX-License-Identifier: MIT
// External inputs: recorded and replayed inputs, clients that time waits for, lateness of paced runs, placing.
#include <gtest/gtest.h>

#include <thread>

#include "core/external/input_log.hpp"
#include "core/external/lockstep_clients.hpp"
#include "core/schedule/scheduler.hpp"
#include "core/world.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

struct Sink final : InputSink {
  struct Entry {
    std::string channel;
    std::uint64_t epoch;
    std::int64_t time;
    std::uint32_t kind, source;
    std::string bytes;
  };
  void take(const RecordedInput& i) noexcept override {
    entries.push_back(
        {std::string(i.channel), i.epoch, i.time, i.input.kind, i.input.source, std::string(i.input.bytes)});
  }
  std::vector<RecordedInput> recorded() const {
    std::vector<RecordedInput> all;
    for (const Entry& e : entries) all.push_back({e.channel, e.epoch, e.time, {e.kind, e.source, e.bytes}});
    return all;
  }
  std::vector<Entry> entries;
};

/// The input log of an empty simulation.
struct EmptyLog {
  World world;
  Scheduler scheduler;
  InputLog log{world, scheduler};
};

TEST(InputsFromOutside, ComeBackAtTheirInstantsInAReplay) {
  Sink sink;
  EmptyLog first;
  InputLog& live = first.log;
  ASSERT_TRUE(live.set_sink(&sink));
  InputChannel* laser = live.channel("laser");
  InputChannel* drive = live.channel("drive");
  EXPECT_FALSE(laser->is_replayed());
  laser->record(10, {1, 0, "BM"});
  laser->record(10, {1, 2, "GD"});
  drive->record(20, {1, 0, "go"});
  live.begin_epoch();
  laser->record(5, {2, 0, ""});

  EmptyLog again_empty;
  InputLog& replay = again_empty.log;
  ASSERT_TRUE(replay.set_recording(sink.recorded()));
  InputChannel* again = replay.channel("laser");
  EXPECT_TRUE(again->is_replayed());
  ExternalInput input;
  EXPECT_FALSE(again->replay(9, input));
  ASSERT_TRUE(again->replay(10, input));
  EXPECT_EQ(input.bytes, "BM");
  ASSERT_TRUE(again->replay(10, input));
  EXPECT_EQ(input.bytes, "GD");
  EXPECT_EQ(input.source, 2u);
  EXPECT_FALSE(again->replay(10, input));
  EXPECT_FALSE(again->replay(11, input)) << "what is of the next epoch waits for it";
  replay.begin_epoch();
  ASSERT_TRUE(again->replay(5, input));
  EXPECT_EQ(input.kind, 2u);
  std::string_view channel;
  EXPECT_EQ(replay.unused(channel), 1u);
  EXPECT_EQ(channel, "drive");
}

TEST(InputsFromOutside, AreRecordedOnceMoreFromAReplay) {
  Sink sink, second;
  EmptyLog first;
  InputLog& live = first.log;
  ASSERT_TRUE(live.set_sink(&sink));
  live.channel("laser")->record(10, {1, 2, "GD"});
  live.record({live.own_channel().name(), 0, 20, {0, 0, "place"}});

  EmptyLog again_empty;
  InputLog& replay = again_empty.log;
  ASSERT_TRUE(replay.set_recording(sink.recorded()));
  ASSERT_TRUE(replay.set_sink(&second));
  ExternalInput input;
  ASSERT_TRUE(replay.channel("laser")->replay(10, input));
  ASSERT_TRUE(replay.own_channel().replay(20, input));
  EXPECT_EQ(replay.count(), 0u) << "none of them is a live one";
  ASSERT_EQ(second.entries.size(), sink.entries.size());
  for (std::size_t i = 0; i < sink.entries.size(); ++i) {
    EXPECT_EQ(second.entries[i].channel, sink.entries[i].channel);
    EXPECT_EQ(second.entries[i].time, sink.entries[i].time);
    EXPECT_EQ(second.entries[i].source, sink.entries[i].source);
    EXPECT_EQ(second.entries[i].bytes, sink.entries[i].bytes);
  }
}

TEST(InputsFromOutside, OfARecordingFitTheScenarioOrAreRefusedBeforeTheRun) {
  const auto complaint = [](const RecordedInput& input) {
    EmptyLog empty;
    empty.log.channel("laser");
    const RecordedInput good{"laser", 0, 5, {1, 0, "BM"}}, all[] = {good, input};
    EXPECT_TRUE(empty.log.set_recording(all));
    return test::complaint_of([&] { empty.log.check_recording(); });
  };
  EXPECT_EQ(complaint({"laser", 0, 7, {1, 0, "GD"}}), "no complaint");
  EXPECT_EQ(complaint({"simulation", 0, 7, {5, 0, ""}}), "no complaint");
  EXPECT_EQ(complaint({"laser_2", 0, 7, {1, 0, "GD"}}),
            "the recording has an input of channel `laser_2`, which no algorithm of the scenario takes; there are the "
            "channels `laser`");
  EXPECT_EQ(complaint({"simulation", 0, 7, {6, 0, ""}}),
            "the recording cannot be replayed: kind 6 of channel `simulation` is none of 0 to 5");
}

TEST(InputsFromOutside, AreAllShownWhereAScenarioIsOnlyLookedAt) {
  const RecordedInput all[] = {{"laser", 0, 5, {1, 0, "BM"}}, {"laser", 2, 1, {2, 0, ""}}};
  ExternalInput input;
  EmptyLog run;
  ASSERT_TRUE(run.log.set_recording(all));
  EXPECT_FALSE(run.log.channel("laser")->replay(-1, input)) << "a run takes them at their times";
  EmptyLog look;
  look.log.show_all();
  ASSERT_TRUE(look.log.set_recording(all));
  InputChannel* const laser = look.log.channel("laser");
  ASSERT_TRUE(laser->replay(-1, input));
  EXPECT_EQ(input.bytes, "BM");
  ASSERT_TRUE(laser->replay(-1, input));
  EXPECT_EQ(input.kind, 2u);
  EXPECT_FALSE(laser->replay(-1, input));
}

TEST(InputsFromOutside, HaveOneRecorderOneRecordingAndOneUserOfEachChannel) {
  Sink sink;
  EmptyLog empty;
  InputLog& log = empty.log;
  EXPECT_TRUE(log.set_sink(&sink));
  EXPECT_FALSE(log.set_sink(&sink));
  EXPECT_NE(log.channel("a"), nullptr);
  EXPECT_EQ(log.channel("a"), nullptr);
  EXPECT_EQ(log.channel("simulation"), nullptr) << "the name of the simulation's own inputs";
  EXPECT_TRUE(log.set_recording({}));
  EXPECT_FALSE(log.set_recording({}));
}

using Outcome = LockstepStream::Outcome;

struct AClientInLockstep : testing::Test {
  LockstepClients clients;
  LockstepStream& laser = clients.join("pilot", "laser", 0.05);
  LockstepStream& drive = clients.join("pilot", "drive", 0.05);
  void connect_both() {
    laser.set_connected(true);
    drive.set_connected(true);
  }
};

TEST_F(AClientInLockstep, IsWaitedForWhileItIsOwedNothing) {
  connect_both();
  EXPECT_EQ(laser.wait(0), Outcome::timed_out);
  laser.message_arrived();
  EXPECT_EQ(laser.wait(0), Outcome::go_on) << "it is owed an answer";
  EXPECT_EQ(drive.wait(0), Outcome::go_on) << "on whatever stream";
  laser.message_answered();
  EXPECT_EQ(drive.wait(0), Outcome::timed_out) << "now it is its turn, on whatever stream";
}

TEST_F(AClientInLockstep, IsNamedWhereAWaitForItTakesLongAndMoreRarelyEachTime) {
  std::vector<std::string> notes;
  clients.say = [&](const std::string& note) { notes.push_back(note); };
  clients.patience = 0.001;
  laser.wait(2'500'000'000);
  ASSERT_FALSE(notes.empty());
  EXPECT_LE(notes.size(), 7U) << "at 1, 2, 4, 8, 16 and 32 ms of 50";
  EXPECT_EQ(notes[0],
            "the run stands at 2.5 s and waits in lockstep for `pilot` on `laser`, which has not connected "
            "yet; it goes on when that sends a message, or after 0.05 s");
  notes.clear();
  connect_both();
  clients.patience = 1e-9;
  drive.wait(0);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("for `pilot` on `drive`, which has all its answers"), std::string::npos) << notes[0];
}

TEST_F(AClientInLockstep, EndsTheWaitByAMessageFromAnotherThread) {
  connect_both();
  std::thread client([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    drive.message_arrived();
  });
  EXPECT_EQ(laser.wait(0), Outcome::go_on);
  client.join();
}

TEST_F(AClientInLockstep, IsNotWaitedForOnceItHasNotAnsweredInTimeUntilItSpeaks) {
  connect_both();
  EXPECT_EQ(laser.wait(0), Outcome::timed_out);
  EXPECT_EQ(laser.wait(1), Outcome::go_on);
  laser.message_arrived();
  laser.message_answered();
  EXPECT_EQ(laser.wait(2), Outcome::timed_out);
}

TEST_F(AClientInLockstep, IsNotWaitedForWhenItHasLeftButWhenItIsExpected) {
  EXPECT_EQ(laser.wait(0), Outcome::timed_out) << "nobody has connected yet";
  connect_both();
  laser.message_arrived();
  laser.set_connected(false);
  EXPECT_EQ(laser.wait(0), Outcome::timed_out) << "what it was owed there is void, and the drive stream is open";
  drive.set_connected(false);
  EXPECT_EQ(laser.wait(0), Outcome::go_on);
}

TEST_F(AClientInLockstep, IsOwedItsAnswersAlsoWhenItComesForOneThatHasLeftWithoutThem) {
  connect_both();
  laser.message_arrived();
  laser.set_connected(false);
  laser.set_connected(true);
  laser.message_arrived();
  laser.message_answered();
  EXPECT_EQ(laser.wait(0), Outcome::go_on) << "that was the answer for the one before";
  laser.message_answered();
  EXPECT_EQ(laser.wait(0), Outcome::timed_out);
}

TEST_F(AClientInLockstep, WithASubscriptionIsWaitedForOnItsOtherStreamsOnly) {
  connect_both();
  laser.set_subscribed(true);
  EXPECT_EQ(laser.wait(0), Outcome::timed_out) << "the drive stream is silent";
  drive.set_connected(false);
  laser.message_arrived();
  laser.message_answered();
  EXPECT_EQ(laser.wait(0), Outcome::go_on);
}

TEST_F(AClientInLockstep, EndsAWaitWhenTheRunEndsOrIsAReplay) {
  connect_both();
  clients.is_stopping = [] { return true; };
  EXPECT_EQ(laser.wait(0), Outcome::stopping);
  clients.is_replayed = [] { return true; };
  EXPECT_EQ(laser.wait(0), Outcome::go_on);
}

TEST(LatenessOfInstants, IsCountedInBinsOfPowersOfTwo) {
  Lateness late;
  for (const double us : {0.5, 1.0, 1.5, 3.0, 1000.0}) late.add(1e-6 * us);
  EXPECT_EQ(late.instants, 5u);
  EXPECT_EQ(late.histogram[0], 1u) << "below 1 us";
  EXPECT_EQ(late.histogram[1], 2u) << "1 to 2 us";
  EXPECT_EQ(late.histogram[2], 1u) << "2 to 4 us";
  EXPECT_EQ(late.histogram[10], 1u) << "512 to 1024 us";
  EXPECT_DOUBLE_EQ(late.longest, 1e-3);
  EXPECT_NEAR(late.mean(), 1006e-6 / 5, 1e-12);
  EXPECT_DOUBLE_EQ(late.quantile(0.5), 2e-6);
  EXPECT_DOUBLE_EQ(late.quantile(0.99), 1e-3);
}

TEST(APacedRun, LastsAsLongAsItIsToldAndCountsItsInstants) {
  test::Scene s;
  s.add("box", test::single_body(Shape::box({1, 1, 1}), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  s.use("motion.point", 100, s.all_robots());
  s.build();
  s.set_pacing({2});
  const auto start = std::chrono::steady_clock::now();
  s.run_for(0.2);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(wall, 0.095 - 1e-3) << "the last of 20 instants is due after 0.19 s / 2";
  EXPECT_EQ(s.scheduler().pacer().lateness().instants, 20u);
}

}  // namespace
}  // namespace muro
