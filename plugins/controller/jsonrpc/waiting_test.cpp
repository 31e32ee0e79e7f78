// SPDX-License-Identifier: MIT
// Requests that take time, and the order in which those of a client are carried out.
#include <gtest/gtest.h>

#include "service_testing.hpp"

namespace muro::jsonrpc {
namespace {

using testing::Dialogue;
using testing::request;

/// Returns the ids of the replies in their order, with "!" after the ids of errors.
std::string ids_of(const std::string& lines) {
  std::istringstream text(lines);
  std::string ids;
  for (std::string line; std::getline(text, line);) {
    const Json reply = Json::parse(line);
    ids += reply.at("id").dump() + (reply.contains("error") ? "! " : " ");
  }
  return ids;
}

TEST(Waiting, EndsAtTheNextStepOrAfterSomeTime) {
  Dialogue d;
  EXPECT_EQ(d.say(request("wait")), "");
  d.next_step();
  EXPECT_EQ(d.heard(), R"({"jsonrpc":"2.0","result":{"time":20000000,"seconds":0.02},"id":1})"
                       "\n");
  d.say(request("wait", "[0.04]"));
  d.next_step();
  EXPECT_EQ(d.heard(), "");
  d.next_step();
  EXPECT_EQ(ids_of(d.heard()), "1 ");
}

TEST(Waiting, CountsInABatchFromTheInstantOfTheRequestBefore) {
  Dialogue d;
  d.say(R"([{"jsonrpc":"2.0","id":1,"method":"set","params":["rover:flag",1]},)"
        R"({"jsonrpc":"2.0","id":2,"method":"set","params":["rover:flag",2]},)"
        R"({"jsonrpc":"2.0","id":3,"method":"wait","params":[0.02]}])");
  d.run.now += 1;  // hosts give this time after an instant
  d.run.complete();
  d.run.now -= 1;
  EXPECT_EQ(d.scene.flag, 2);
  EXPECT_EQ(d.heard(), "");
  d.next_step();
  EXPECT_EQ(Json::parse(d.heard()).size(), 3u);
}

TEST(Waiting, HoldsBackWhatTheSameClientAsksForAfterwards) {
  Dialogue d;
  d.service.connected(1);
  d.say(request("wait", "[0.04]", 1));
  EXPECT_EQ(d.say(request("time", "{}", 2)), "");
  EXPECT_EQ(ids_of(d.say(request("time", "{}", 3), 1)), "3 ") << "another client goes on";
  d.next_step();
  EXPECT_EQ(d.heard(), "");
  d.next_step();
  EXPECT_EQ(ids_of(d.heard()), "1 2 ");
}

TEST(Waiting, LetsEachRequestSeeWhatThoseBeforeItDid) {
  Dialogue d;
  d.say(request("set", R"(["rover:flag",42])", 1));
  EXPECT_EQ(d.say(request("get", R"(["rover:flag"])", 2)), "");
  d.run.complete();
  EXPECT_EQ(ids_of(d.heard()), "1 ");
  EXPECT_FALSE(d.service.is_waiting()) << "the next line begins in a step";
  d.next_step();
  EXPECT_NE(d.heard().find(R"("rover/base:flag":42)"), std::string::npos);
}

TEST(Waiting, AnswersABatchWhenAllOfItIsDone) {
  Dialogue d;
  EXPECT_EQ(
      d.say(
          R"([{"jsonrpc":"2.0","id":1,"method":"set","params":["rover:flag",42]},)"
          R"({"jsonrpc":"2.0","method":"set","params":["rover:flag",43]},)"
          R"({"jsonrpc":"2.0","id":2,"method":"wait"},{"jsonrpc":"2.0","id":3,"method":"get","params":["rover:flag"]}])"
          "\n"),
      "");
  EXPECT_EQ(d.outlet.answers, 0u);
  d.next_step();
  EXPECT_EQ(d.scene.flag, 43);
  d.next_step();
  EXPECT_EQ(d.outlet.answers, 1u);
  const Json replies = Json::parse(d.heard());
  ASSERT_EQ(replies.size(), 3u);
  EXPECT_EQ(replies[2]["result"]["values"]["rover/base:flag"], 43);
}

TEST(Waiting, EndsAPauseRequestWhenTimeStands) {
  Dialogue d;
  EXPECT_EQ(d.say(request("pause")), "");
  EXPECT_TRUE(d.run.paused);
  d.attend();
  EXPECT_EQ(ids_of(d.heard()), "1 ");
  EXPECT_EQ(ids_of(d.say(request("resume"))), "1 ");
  EXPECT_FALSE(d.run.paused);
}

TEST(Waiting, EndsAStepWhenTheTimeHasCome) {
  Dialogue d;
  d.attend();
  EXPECT_EQ(d.say(request("step", R"({"seconds":0.04})", 1)), "");
  EXPECT_EQ(d.run.pause_at, 40'000'000);
  d.next_step();
  EXPECT_EQ(d.heard(), "");
  d.run.now = 40'000'000;
  d.attend();
  EXPECT_EQ(ids_of(d.heard()), "1 ");
  d.say(request("step", R"({"steps":3})", 2));
  EXPECT_EQ(d.run.pause_at, 100'000'000);
}

TEST(Waiting, IsRefusedWhereAnotherPausesOrResumes) {
  Dialogue d;
  d.service.connected(1);
  d.attend();
  d.say(request("step", R"({"seconds":1})", 1));
  d.next_step();
  d.say(request("pause", "{}", 2), 1);
  d.attend();
  EXPECT_EQ(ids_of(d.heard()), "1! ");
  EXPECT_EQ(ids_of(d.heard(1)), "2 ");
  d.say(request("step", R"({"seconds":1})", 3));
  d.say(request("resume", "{}", 4), 1);
  d.next_step();
  EXPECT_EQ(ids_of(d.heard()), "3! ");
}

TEST(Waiting, EndsWhereTheTimeIsSetAnew) {
  Dialogue d;
  d.service.connected(1);
  d.say(request("wait", "[10]", 1));
  d.say(request("reset", "{}", 2), 1);
  d.run.complete();
  d.service.time_was_set(0);
  EXPECT_EQ(ids_of(d.heard()), "1! ");
  EXPECT_EQ(ids_of(d.heard(1)), "2 ");
}

TEST(Waiting, IsBounded) {
  Dialogue d;
  d.say(request("wait", "[10]"));
  for (std::size_t i = 0; i < Conversation::most_lines; ++i) ASSERT_EQ(d.say(request("time")), "");
  const std::string reply = d.say(request("time", "{}", 77));
  EXPECT_EQ(Json::parse(reply)["error"]["code"], -32003);
  EXPECT_EQ(ids_of(reply), "77! ");
}

TEST(Waiting, IsAnsweredToAClientThatSaysNothingMore) {
  Dialogue d;
  d.say(request("wait"));
  d.service.disconnected(0);
  EXPECT_EQ(d.service.clients(), 1u);
  d.next_step();
  EXPECT_EQ(ids_of(d.heard()), "1 ");
  d.next_step();
  EXPECT_EQ(d.service.clients(), 0u);
  EXPECT_EQ(d.outlet.ended, std::vector<std::uint32_t>{0});
}

TEST(Waiting, IsForgottenForTheFirstOfManyWhoLeave) {
  Dialogue d;
  for (std::uint32_t i = 1; i <= 100; ++i) {
    d.service.connected(i);
    d.say(request("wait", "[1000]"), i);
    d.service.disconnected(i);
  }
  EXPECT_EQ(d.service.clients(), 17u);
}

TEST(Waiting, EndsTheConnectionOfAClientThatTakesNoReplies) {
  Dialogue d;
  d.outlet.is_full = true;
  d.say(request("time"));
  EXPECT_EQ(d.outlet.ended, std::vector<std::uint32_t>{0});
  EXPECT_EQ(d.outlet.answers, 1u);
  d.say(request("time"));
  EXPECT_EQ(d.outlet.answers, 2u);
}

TEST(Pauses, EndWithTheClientThatHasAskedForThem) {
  for (const char* method : {"pause", "step"}) {
    Dialogue d;
    d.service.connected(1);
    d.say(request(method, method[0] == 's' ? R"({"steps":1})" : "{}"));
    d.next_step();
    d.attend();
    EXPECT_EQ(ids_of(d.heard()), "1 ");
    EXPECT_EQ(Json::parse(d.say(request("time"), 1))["result"]["paused_by"], 0) << method;
    d.service.disconnected(1);
    EXPECT_TRUE(d.run.paused) << "it was not that client";
    d.service.disconnected(0);
    EXPECT_FALSE(d.run.paused) << method;
  }
}

TEST(Pauses, StayWhereTheClientWantsIt) {
  Dialogue d;
  d.say(request("pause", R"({"keep":true})"));
  d.next_step();
  d.attend();
  d.service.disconnected(0);
  EXPECT_TRUE(d.run.paused);
}

TEST(Pauses, StayWhereOthersHavePausedBefore) {
  Dialogue d;
  d.run.paused = true;
  d.say(request("pause"));
  d.attend();
  d.service.disconnected(0);
  EXPECT_TRUE(d.run.paused);
}

TEST(Pauses, EndWhenAllIsAnsweredThatWasSaidBeforeTheEnd) {
  Dialogue d;
  d.say(request("wait"));
  d.say(request("pause", "{}", 2));
  d.say(request("get", R"(["rover:flag"])", 3));
  d.service.disconnected(0);
  d.next_step();
  EXPECT_TRUE(d.run.paused);
  d.attend();
  EXPECT_EQ(ids_of(d.heard()), "1 2 3 ");
  d.attend();
  EXPECT_FALSE(d.run.paused);
}

TEST(ClientsThatDoNotRead, HaveNothingComputed) {
  Dialogue d;
  d.outlet.is_slow = true;
  EXPECT_EQ(d.say(request("time")), "");
  d.settle();
  EXPECT_EQ(d.heard(), "");
  d.outlet.is_slow = false;
  d.next_step();
  EXPECT_EQ(ids_of(d.heard()), "1 ");
}

TEST(ClientsThatDoNotRead, LoseUpdatesAndAreToldHowMany) {
  Dialogue d;
  d.say(request("subscribe", R"({"properties":"rover:flag","rate":50})"));
  d.service.send_updates();
  d.heard();
  d.outlet.is_slow_for_updates = true;
  for (int i = 0; i < 3; ++i) d.next_step(), d.service.send_updates();
  EXPECT_EQ(d.heard(), "");
  d.outlet.is_slow_for_updates = false;
  d.next_step(), d.service.send_updates();
  EXPECT_EQ(Json::parse(d.heard())["params"]["dropped"], 3);
}

TEST(ClientsThatDoNotRead, AreNotReadFrom) {
  Dialogue d;
  d.outlet.is_slow = true;
  for (std::size_t i = 0; i < Conversation::most_lines / 8; ++i) d.say(request("time"));
  EXPECT_TRUE(d.outlet.held[0]);
  d.outlet.is_slow = false;
  d.settle();
  EXPECT_FALSE(d.outlet.held[0]);
}

TEST(ClientsThatDoNotRead, AreDisconnectedWhenTheyGoOnAsking) {
  Dialogue d;
  d.outlet.is_slow = true;
  for (std::size_t i = 0; i < Conversation::most_lines; ++i) d.say(request("time"));
  EXPECT_TRUE(d.outlet.ended.empty());
  d.say(request("time"));
  EXPECT_EQ(d.outlet.ended, std::vector<std::uint32_t>{0});
}

TEST(Batches, GoOnInTheNextStepWhereTheyTakeLong) {
  Dialogue d;
  d.service.set_time_in_a_step(std::chrono::milliseconds(5));
  d.scene.ranges.assign(100'000, 1.0 / 3);
  d.service.connected(1);
  std::string batch;
  for (int i = 1; i <= 4; ++i) batch += (batch.empty() ? "[" : ",") + request("get", R"(["rover:ranges"])", i);
  EXPECT_EQ(d.say(batch + "]\n"), "") << "it takes more than 5 ms";
  EXPECT_EQ(d.say(request("time"), 1), "") << "there is no time left in this step";
  d.next_step();
  EXPECT_EQ(ids_of(d.heard(1)), "1 ") << "others come first";
  d.settle();
  EXPECT_EQ(Json::parse(d.heard()).size(), 4u);
}

TEST(Batches, FollowEachOtherAtOnceWhereTimeDoesNotCount) {
  Dialogue d;
  d.scene.ranges.assign(100'000, 1.0 / 3);
  std::string batch;
  for (int i = 1; i <= 4; ++i) batch += (batch.empty() ? "[" : ",") + request("get", R"(["rover:ranges"])", i);
  EXPECT_EQ(Json::parse(d.say(batch + "]\n")).size(), 4u);
}

}  // namespace
}  // namespace muro::jsonrpc
