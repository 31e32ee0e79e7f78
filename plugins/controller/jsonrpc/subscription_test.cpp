// SPDX-License-Identifier: MIT
// Updates: their times, their content, and clients that do not read them.
#include <gtest/gtest.h>

#include "service_testing.hpp"

namespace muro::jsonrpc {
namespace {

using testing::Dialogue;

Json subscribe_to(Dialogue& d, const std::string& params) {
  const Json reply = Json::parse(d.say(testing::request("subscribe", params)));
  return reply.contains("result") ? reply["result"] : reply["error"];
}

/// Returns the updates of this step.
std::vector<Json> updates(Dialogue& d) {
  d.service.send_updates();
  std::istringstream lines(d.heard());
  std::vector<Json> all;
  for (std::string line; std::getline(lines, line);) {
    Json message = Json::parse(line);
    EXPECT_EQ(message["method"], "update");
    EXPECT_FALSE(message.contains("id"));
    all.push_back(message["params"]);
  }
  return all;
}

TEST(Subscriptions, ComeAtTheirRateInSimulatedTime) {
  Dialogue d;
  EXPECT_EQ(subscribe_to(d, R"({"properties":["rover:flag"],"rate":20})"),
            Json::parse(R"({"subscription":1,"properties":["rover/base:flag"]})"));
  std::vector<std::int64_t> times;
  for (int i = 0; i < 11; ++i) {
    for (const Json& u : updates(d)) {
      EXPECT_EQ(u["values"], Json::parse(R"({"rover/base:flag":7})"));
      times.push_back(u["time"].get<std::int64_t>() / 1'000'000);
    }
    d.next_step();
  }
  EXPECT_EQ(times, (std::vector<std::int64_t>{0, 60, 100, 160, 200})) << "in the first step after each 50 ms";
}

TEST(Subscriptions, ComeAtEachStepWhereTheRateIsHigher) {
  Dialogue d;
  subscribe_to(d, R"({"properties":["rover:flag"],"rate":1000})");
  for (int i = 0; i < 5; ++i, d.next_step()) EXPECT_EQ(updates(d).size(), 1u);
}

TEST(Subscriptions, ComeOnChangeNotMoreOftenThanAsked) {
  Dialogue d;
  subscribe_to(d, R"({"properties":["rover:flag","rover:ranges"],"on_change":true,"least_period":0.05})");
  EXPECT_EQ(updates(d).size(), 1u) << "the first tells what there is";
  d.next_step();
  d.scene.flag = 8;
  EXPECT_EQ(updates(d).size(), 0u) << "too early";
  d.next_step();
  d.next_step();
  const auto told = updates(d);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["values"]["rover/base:flag"], 8);
  for (int i = 0; i < 5; ++i, d.next_step()) EXPECT_EQ(updates(d).size(), 0u);
  d.scene.ranges[2] = -0.0;
  EXPECT_EQ(updates(d).size(), 1u);
}

TEST(Subscriptions, TellChangesAlsoWhileTheRunIsPaused) {
  Dialogue d;
  subscribe_to(d, R"({"properties":["rover:flag"],"on_change":true})");
  subscribe_to(d, R"({"properties":["rover:flag"],"rate":50})");
  EXPECT_EQ(updates(d).size(), 2u);
  d.attend();
  EXPECT_EQ(updates(d).size(), 0u);
  d.scene.flag = 9;
  const auto told = updates(d);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["subscription"], 1);
}

TEST(Subscriptions, TellHowManyWereDropped) {
  Dialogue d;
  subscribe_to(d, R"({"properties":["rover:flag"],"rate":50})");
  EXPECT_FALSE(updates(d)[0].contains("dropped"));
  d.outlet.is_full_for_updates = true;
  for (int i = 0; i < 3; ++i) {
    d.next_step();
    EXPECT_EQ(updates(d).size(), 0u);
  }
  d.outlet.is_full_for_updates = false;
  d.next_step();
  EXPECT_EQ(updates(d)[0]["dropped"], 3);
  d.next_step();
  EXPECT_FALSE(updates(d)[0].contains("dropped"));
}

TEST(Subscriptions, TellALostChangeWhenThereIsRoom) {
  Dialogue d;
  subscribe_to(d, R"({"properties":["rover:flag"],"on_change":true})");
  updates(d);
  d.scene.flag = 1;
  d.outlet.is_full_for_updates = true;
  for (int i = 0; i < 3; ++i) {
    d.next_step();
    updates(d);
  }
  d.outlet.is_full_for_updates = false;
  d.next_step();
  const auto told = updates(d);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0]["dropped"], 1) << "it was one change, tried several times";
  EXPECT_EQ(told[0]["values"]["rover/base:flag"], 1);
}

TEST(Subscriptions, AreBoundedAndEnd) {
  Dialogue d;
  for (std::size_t i = 0; i < Conversation::most_subscriptions; ++i)
    ASSERT_TRUE(subscribe_to(d, R"({"properties":["rover:flag"],"rate":1})").contains("subscription"));
  EXPECT_EQ(subscribe_to(d, R"({"properties":["rover:flag"],"rate":1})")["code"], -32003);
  EXPECT_NE(d.say(testing::request("unsubscribe", "[7]")).find("result"), std::string::npos);
  EXPECT_NE(d.say(testing::request("unsubscribe", "[7]")).find("-32001"), std::string::npos);
  EXPECT_EQ(subscribe_to(d, R"({"properties":["rover:flag"],"rate":1})")["subscription"], 65)
      << "numbers are not used twice";
  d.service.disconnected(0);
  EXPECT_EQ(updates(d).size(), 0u);
}

TEST(Subscriptions, AreRefusedWithoutATiming) {
  Dialogue d;
  for (const char* params : {R"({"properties":["rover:flag"]})", R"({"properties":["rover:flag"],"rate":0})",
                             R"({"properties":["rover:flag"],"rate":1,"on_change":true})",
                             R"({"properties":["rover:flag"],"rate":1,"least_period":1})", R"({"rate":1})"})
    EXPECT_EQ(subscribe_to(d, params)["code"], -32602) << params;
  EXPECT_EQ(subscribe_to(d, R"({"properties":["rover:state.block"],"rate":1})")["code"], -32002);
  d.scene.ranges.assign(150'000, 0);
  EXPECT_TRUE(subscribe_to(d, R"({"properties":["rover:ranges"],"rate":1})").contains("subscription"));
  EXPECT_EQ(subscribe_to(d, R"({"properties":["rover:ranges"],"rate":1})")["code"], -32003) << "they add up";
}

TEST(Subscriptions, BeginAnewWhereTimeJumps) {
  Dialogue d;
  subscribe_to(d, R"({"properties":["rover:flag"],"rate":1})");
  EXPECT_EQ(updates(d).size(), 1u);
  d.next_step();
  EXPECT_EQ(updates(d).size(), 0u);
  d.service.time_was_set(0);
  EXPECT_EQ(updates(d).size(), 1u);
}

}  // namespace
}  // namespace muro::jsonrpc
