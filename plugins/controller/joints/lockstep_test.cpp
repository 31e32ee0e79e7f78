// SPDX-License-Identifier: MIT
// Time that waits for clients, and runs without them from a recording.
#include <gtest/gtest.h>

#include <random>
#include <thread>

#include "joints_testing.hpp"
#include "tests/support/files.hpp"

namespace muro::joints {
namespace {

/// Drives a rover to x = 1 m by the velocity that it reads. Takes random time over each message.
void drive_home(std::uint16_t port, unsigned seed) {
  Client client(port);
  std::mt19937 random(seed);
  const auto think = [&] {
    if (seed != 0 && random() % 8 == 0) ::usleep(useconds_t(random() % 2000));
  };
  double x = 0, last = 0;
  for (int i = 0; i < 80; ++i) {
    const std::vector<double> state = numbers_of(client.ask_running("wait 0.02"));
    if (state.size() != 4) return;
    x += state[1] * (state[0] - last);
    last = state[0];
    think();
    client.ask_running("set base " + std::to_string(2 * (1 - x)) + " 0 " + std::to_string(0.1 * (i % 5)));
    think();
  }
}

const Texts in_lockstep{"tcp=0", "lockstep={robot}", "timeout=20"};

/// Runs two rovers, each with a client, for 2 s. Returns the hash.
std::uint64_t hash_of_run(unsigned seed, const std::string& recording = "") {
  Rovers s({{"stream", in_lockstep}}, 2);
  if (!recording.empty()) s.use("recorder.inputs", 50, {}, {{"file", recording}});
  s.build();
  std::thread first(drive_home, s.port("rover_0/joints"), seed);
  std::thread second(drive_home, s.port("rover_1/joints"), 3 * seed);
  s.run_for(2);
  first.join();
  second.join();
  s.finish();
  EXPECT_NEAR(s.pose(*s.rovers[0]).position.x(), 0.9, 0.3) << "it was driven";
  return s.state_hash();
}

TEST(LockstepOfJoints, GivesEqualHashesWhateverTheDelaysOfClients) {
  const std::uint64_t first = hash_of_run(0);
  EXPECT_EQ(hash_of_run(1), first);
  EXPECT_EQ(hash_of_run(2), first);
}

TEST(LockstepOfJoints, ARecordedRunGivesTheSameHashWithoutItsClients) {
  const test::ScratchFolder folder;
  const std::uint64_t live = hash_of_run(1, folder.path("inputs.csv"));
  Rovers s({{"stream", in_lockstep}}, 2);
  s.use("controller.replay", 50, {}, {{"file", folder.path("inputs.csv")}});
  s.build();
  EXPECT_EQ(test::tcp_port_in(s.log), 0) << "nothing is opened";
  s.run_for(2);
  EXPECT_EQ(s.state_hash(), live);
}

TEST(LockstepOfJoints, ARunOfManyClientsWithoutLockstepIsReplayedToTheBit) {
  const test::ScratchFolder folder;
  const Settings settings = stream_at("tcp=0", {{"timeout", 0.05}});
  std::uint64_t live = 0;
  {
    Rovers s(settings, 2);
    s.use("recorder.inputs", 50, {}, {{"file", folder.path("inputs.csv")}});
    s.build();
    std::mt19937 random(7);
    for (int round = 0; round < 20; ++round) {
      Client a(s.port("rover_0/joints")), b(s.port("rover_1/joints"));
      for (int i = 0; i < 10; ++i) {
        (random() % 2 ? a : b)
            .say("set base " + std::to_string(random() % 100) + " 0 1\nwait 0.0" + std::to_string(random() % 9) +
                 "\nrubbish\n");
        s.run_for(0.001 * (random() % 50));
        ::usleep(useconds_t(random() % 300));
      }
    }
    s.run_until(10'000'000'000);
    s.finish();
    live = s.state_hash();
    EXPECT_GT(s.pose(*s.rovers[0]).position.norm(), 1);
  }
  Rovers s(settings, 2);
  s.use("controller.replay", 50, {}, {{"file", folder.path("inputs.csv")}});
  s.build();
  s.run_until(10'000'000'000);
  EXPECT_EQ(s.state_hash(), live);
}

TEST(LockstepOfJoints, AClientThatComesBackIsOwedWhatItAsksFor) {
  Rovers s({{"stream", Texts{"tcp=0", "lockstep=driver", "timeout=2"}}});
  s.build();
  Client client(s.port("rover_0/joints"));
  client.say("wait 1000\n");
  s.run_for(0.1);
  client.close();
  Client again(s.port("rover_0/joints"));
  again.say("wait 0.1\nwait 1000\n");
  ::usleep(20'000);  // both clients are connected when the next step begins
  s.run_until(210'000'000);
  EXPECT_EQ(again.wait_line(), "state 0.2 0 0 0");
}

TEST(LockstepOfJoints, TimeStandsWhileAClientAsksAndSets) {
  Rovers s({{"stream", in_lockstep}});
  s.build();
  std::vector<std::string> replies;
  std::thread driver([&] {
    Client client(s.port("rover_0/joints"));
    for (const char* line : {"time", "set base 1 0 0", "get", "wait", "time", "wait 0.1", "set base 0 0 0", "time"})
      replies.push_back(client.ask_running(line));
  });
  s.run_for(0.5);
  driver.join();
  EXPECT_EQ(replies, (Texts{"time 0", "ok 0", "state 0 0 0 0", "state 0.02 1 0 0", "time 0.02", "state 0.12 1 0 0",
                            "ok 0.12", "time 0.12"}));
  EXPECT_NEAR(s.pose(*s.rovers[0]).position.x(), 0.12, 1e-12);
}

}  // namespace
}  // namespace muro::joints
