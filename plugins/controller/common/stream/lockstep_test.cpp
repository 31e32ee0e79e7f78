// SPDX-License-Identifier: MIT
// Streams in lockstep, recorded and replayed.
#include <thread>

#include "core/external/lockstep_clients.hpp"
#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

struct LockstepRun : testing::Test {
  test::ScratchFolder folder;
  const std::string path = folder.path("lockstep.sock");
  const std::string text = "unix=" + path;
  LockstepClients clients;

  /// Asks `count` questions, each after the answer to the one before.
  static void ask(Peer& peer, int count, std::size_t wait_us) {
    for (int i = 0; i < count; ++i) {
      usleep(useconds_t(wait_us * std::size_t(i % 3)));
      EXPECT_TRUE(peer.say("question " + std::to_string(i) + "\n"));
      for (int k = 0; k < 50000 && std::count(peer.heard.begin(), peer.heard.end(), '\n') <= i; ++k) {
        usleep(20);
        peer.hear();
      }
    }
  }
  std::vector<Heard> run(const std::vector<std::string_view>& texts, FakeInputs& inputs, std::size_t wait_us) {
    LockstepClients of_this_run;
    Echo echo(inputs, texts, &of_this_run);
    std::thread client([&] {
      usleep(useconds_t(3 * wait_us));
      Peer peer = Peer::unix_socket(path);
      ask(peer, 20, wait_us);
    });
    while (echo.count(Event::Kind::disconnected) == 0) echo.step();
    client.join();
    return echo.heard;
  }
};

TEST_F(LockstepRun, IsTheSameWhateverTheClientsSpeed) {
  for (const bool is_timed : {false, true}) {
    std::vector<std::string_view> texts = {text, "lockstep=client"};
    if (is_timed) texts.insert(texts.end(), {"timed=true", "baud=100000"});
    FakeInputs slow, fast;
    const std::vector<Heard> first = run(texts, slow, 700);
    const std::vector<Heard> second = run(texts, fast, 0);
    ASSERT_EQ(first.size(), 22);
    EXPECT_EQ(first, second);
    EXPECT_EQ(slow.inputs, fast.inputs);
    if (!is_timed) {
      for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(first[i + 1].time, std::int64_t(i) * 1'000'000);
    } else {
      // 11 bytes each way take 1.1 ms each; the next step after that takes the message
      EXPECT_EQ(first[1].time, 2'000'000);
      EXPECT_EQ(first[2].time, first[1].time + 4'000'000);
    }

    FakeInputs recorded;
    recorded.inputs = slow.inputs;
    recorded.replays = true;
    Echo replay(recorded, texts, &clients);
    EXPECT_TRUE(replay.stream.is_replayed());
    for (int i = 0; i < 200; ++i) replay.step();
    EXPECT_EQ(replay.heard, first);
    std::string_view channel;
    EXPECT_EQ(recorded.unused(channel), 0);
  }
}

TEST_F(LockstepRun, TakesOneMessageAStep) {
  FakeInputs inputs;
  Echo echo(inputs, {text, "lockstep=client"}, &clients);
  Peer peer = Peer::unix_socket(path);
  EXPECT_TRUE(peer.say("a\nb\nc\n"));
  for (int i = 0; i < 3; ++i) echo.step();
  ASSERT_EQ(echo.heard.size(), 4);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(echo.heard[i + 1].time, std::int64_t(i) * 1'000'000);
}

TEST_F(LockstepRun, EndsWhenTheClientSaysNothing) {
  FakeInputs inputs;
  Echo echo(inputs, {text, "lockstep=client", "timeout=0.05"}, &clients);
  Peer peer = Peer::unix_socket(path);
  EXPECT_TRUE(peer.say("a\n"));
  echo.step();
  const std::string complaint = test::complaint_of<Error>([&] { echo.step(); });
  EXPECT_SAYS(complaint, "client `client`, for which time waits, said nothing on stream `rover_3/echo`");
  EXPECT_SAYS(complaint, "for 0.05 s");
  ASSERT_EQ(inputs.inputs.size(), 3);
  EXPECT_EQ(inputs.inputs.back(), (FakeInputs::Input{1'000'000, 3, 0, ""}));

  FakeInputs recorded;
  recorded.inputs = inputs.inputs;
  recorded.replays = true;
  Echo replay(recorded, {text, "lockstep=client", "timeout=0.05"}, &clients);
  replay.step();
  EXPECT_EQ(test::complaint_of<Error>([&] { replay.step(); }), complaint);
}

TEST_F(LockstepRun, GoesOnWithoutTheClientWhereThatIsAllowed) {
  FakeInputs inputs;
  Echo echo(inputs, {text, "lockstep=client", "timeout=0.05", "on_timeout=go_on"}, &clients);
  for (int i = 0; i < 10; ++i) echo.step();
  EXPECT_SAYS(inputs.why_not_repeatable, "said nothing");
  EXPECT_EQ(inputs.inputs.size(), 1);
}

TEST(Recording, HoldsWhatCameAndWhen) {
  FakeInputs inputs;
  std::vector<Heard> live;
  {
    Echo echo(inputs, {"tcp=0"});
    for (int i = 0; i < 3; ++i) {
      Peer peer = Peer::tcp(echo.port());
      EXPECT_TRUE(peer.say("a " + std::to_string(i) + "\nb\n"));
      EXPECT_TRUE(echo.run_until([&] { return peer.hear().size() == 6; }));
    }
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == 3; }));
    live = echo.heard;
  }
  EXPECT_EQ(inputs.inputs.size(), live.size());
  FakeInputs recorded;
  recorded.inputs = inputs.inputs;
  recorded.replays = true;
  Echo replay(recorded, {"tcp=0"});
  EXPECT_EQ(replay.stream.address().port, 0);  // nothing was opened
  while (replay.time <= live.back().time) replay.step();
  EXPECT_EQ(replay.heard, live);
  EXPECT_TRUE(replay.stream.send(0, "to nobody"));
}

TEST(Recording, OpensNothingWhereAScenarioIsOnlyLookedAt) {
  FakeInputs inputs;
  inputs.opens = false;
  Echo echo(inputs, {"tcp=0"});
  EXPECT_EQ(echo.port(), 0);
  for (int i = 0; i < 10; ++i) echo.step();
  EXPECT_TRUE(echo.heard.empty());
  FakeReport report;
  echo.stream.finish();
}

TEST(Recording, NeedsAName) {
  FakeInputs inputs;
  Echo echo(inputs, {"tcp=0"});
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo other(inputs, {"tcp=0"}); }), "two streams have the name");
}

}  // namespace

}  // namespace muro::stream
