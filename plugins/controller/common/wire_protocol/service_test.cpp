// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/service.hpp"

#include <gtest/gtest.h>

#include "plugins/controller/common/wire_protocol/number_text.hpp"
#include "plugins/controller/common/wire_protocol/service_testing.hpp"

namespace muro::wire {
namespace {

std::string number_text(double number) {
  std::string text;
  add_number(text, number);
  return text;
}

TEST(TextDialogue, AnswersEachRequestWithOneLine) {
  Bench b(text_protocol());
  EXPECT_EQ(b.ask("info\n"), "info bench 1 100 arm gripper\n");
  EXPECT_EQ(b.ask("info gripper\r\n"), "info gripper 1\n");
  EXPECT_EQ(b.ask("set arm 0.1 -2.5e-1\n"), "ok 0\n");
  EXPECT_EQ(b.ask("get\n"), "state 0 0.1 -0.25\n");
  EXPECT_EQ(b.ask("\tget   arm\tposition \r"), "state 0 0.1 -0.25\n");
  EXPECT_EQ(b.ask("position gripper +3\n"), "ok 0\n");
  EXPECT_EQ(b.ask("get gripper\n"), "state 0 3\n");
  EXPECT_EQ(b.ask("time\n"), "time 0\n");
  EXPECT_EQ(b.ask("stop gripper\n"), "ok 0\n");
  EXPECT_EQ(b.ask("get gripper\n"), "state 0 0\n");
  EXPECT_EQ(b.ask("get arm\n"), "state 0 0.1 -0.25\n");
  EXPECT_EQ(b.ask("stop\n"), "ok 0\n");
  EXPECT_EQ(b.ask("get arm\n"), "state 0 0 0\n");
  EXPECT_EQ(b.ask("\n"), "") << "an empty line is no request";
  EXPECT_EQ(b.ask(" \t\n"), "");
  EXPECT_EQ(b.answers, b.messages) << "all are through, for lockstep";
}

TEST(TextDialogue, RefusesWhatItDoesNotUnderstandAndChangesNothing) {
  Bench b(text_protocol());
  b.ask("set arm 1 2\n");
  EXPECT_EQ(b.ask("gte arm\n"),
            "error 1 no request `gte` (did you mean `get`?); there are: info get set position velocity acceleration "
            "effort stop wait report time\n");
  EXPECT_EQ(b.ask("set\n"), "error 2 a field is missing: set GROUP NUMBER...\n");
  EXPECT_EQ(b.ask("set arm 1\n"), "error 2 not so many\n");
  EXPECT_EQ(b.ask("set arm 1 2 3\n"), "error 2 not so many\n");
  EXPECT_EQ(b.ask("time now\n"), "error 2 `now` is a field too many: time\n");
  EXPECT_EQ(b.ask("get griper\n"),
            "error 3 no group `griper` (did you mean `gripper`?); there are: `arm`, `gripper`\n");
  EXPECT_EQ(b.ask("get arm speed\n"),
            "error 4 `speed` is none of `standard`, `position`, `velocity`, `acceleration`, `effort`, `setpoint`\n");
  for (const char* number : {"nan", "inf", "-infinity", "1e999", "0x10", "1,5", "1.5.2", "++1", "+-1", "-", "one"})
    EXPECT_EQ(b.ask(std::string("set arm 0 ") + number + "\n").substr(0, 9), "error 5 `") << number;
  EXPECT_EQ(b.ask("set arm 0 11\n"), "error 6 not that far\n");
  EXPECT_EQ(b.ask("wait -1\n"), "error 6 `-1` is no time to wait; allowed is 0 to 1e9 s\n");
  EXPECT_EQ(b.ask("report 101\n"), "error 6 reports come at most at 100 Hz, the rate of the controller\n");
  EXPECT_EQ(b.ask("effort arm 0 0\n"), "error 7 it takes positions\n");
  EXPECT_EQ(b.ask("wait 1 arm effort\n"), "error 7 it has no effort\n");
  EXPECT_EQ(b.ask("set \x1b[31m\xff\n"), "error 3 no group `\\x1b[31m\\xff`; there are: `arm`, `gripper`\n");
  EXPECT_EQ(b.ask("get arm\n"), "state 0 1 2\n");
  EXPECT_EQ(b.replies, b.messages);
  EXPECT_EQ(b.answers, b.messages);
}

TEST(TextDialogue, AnswersAWaitWhenItIsOver) {
  Bench b(text_protocol());
  EXPECT_EQ(b.ask("wait\n"), "");
  EXPECT_EQ(b.answers, 0u);
  EXPECT_EQ(b.run(), "state 0.01 0 0\n");
  EXPECT_EQ(b.ask("wait 0\n"), "") << "the next run at the earliest";
  EXPECT_EQ(b.run(), "state 0.02 0 0\n");
  EXPECT_EQ(b.ask("wait 0.025 gripper\n"), "");
  EXPECT_EQ(b.run(2), "");
  EXPECT_EQ(b.run(), "state 0.05 0\n");
  EXPECT_EQ(b.answers, 3u);
}

TEST(TextDialogue, AWaitOfWholePeriodsEndsAtThatRun) {
  Bench b(text_protocol());
  const auto run_at_30_hz = [&](std::int64_t k) {
    b.sent.clear();
    b.service.begin_step(k * 1'000'000'000 / 30, 1.0 / 30);
    return !b.sent[1].empty();
  };
  for (std::int64_t begin = 1; begin <= 3; ++begin)
    for (std::int64_t periods = 1; periods <= 60; ++periods) {
      run_at_30_hz(begin);
      b.ask("wait " + number_text(double(periods) / 30) + "\n");
      for (std::int64_t k = 1; k < periods; ++k) EXPECT_FALSE(run_at_30_hz(begin + k)) << periods;
      EXPECT_TRUE(run_at_30_hz(begin + periods)) << periods << " periods after " << begin;
    }
}

TEST(TextDialogue, CarriesOutWhatComesBehindAWaitAfterIt) {
  Bench b(text_protocol());
  for (const char* line : {"wait 0.02\n", "set arm 1 2\n", "wait 0.01\n", "get arm\n"}) EXPECT_EQ(b.ask(line), "");
  EXPECT_EQ(b.run(), "");
  EXPECT_EQ(b.run(), "state 0.02 0 0\nok 0.02\n");
  EXPECT_EQ(b.run(), "state 0.03 1 2\nstate 0.03 1 2\n");
  EXPECT_EQ(b.answers, 4u);
}

TEST(TextDialogue, OfAClientThatLeavesOwesNothing) {
  Bench b(text_protocol());
  b.ask("wait 1\n");
  b.ask("get\n");
  b.service.disconnected(1);
  EXPECT_EQ(b.answers, 2u);
  EXPECT_FALSE(b.service.is_connected(1));
  EXPECT_EQ(b.run(200), "");
}

TEST(TextDialogue, EndsWithAClientThatFloodsBehindAWait) {
  Bench b(text_protocol());
  b.ask("wait 1000\n");
  for (int i = 0; i < 1100; ++i) b.ask("get\n");
  EXPECT_EQ(b.disconnected, std::vector<std::uint32_t>{1});
  b.service.disconnected(1);
  EXPECT_EQ(b.answers, b.messages);
}

TEST(TextDialogue, ReportsAtTheRateThatIsAskedFor) {
  Bench b(text_protocol());
  EXPECT_EQ(b.ask("report 30 gripper\n"), "ok 0\n");
  EXPECT_TRUE(b.service.is_reporting());
  EXPECT_EQ(b.run(10), "report 0.04 gripper 0\nreport 0.07 gripper 0\nreport 0.1 gripper 0\n")
      << "at the first runs of the controller after 33.3, 66.7 and 100 ms";
  EXPECT_EQ(b.ask("report 0\n"), "ok 0.1\n");
  EXPECT_FALSE(b.service.is_reporting());
  EXPECT_EQ(b.run(10), "");
}

TEST(TextDialogue, ReportsUnaskedWhereTheScenarioSaysSo) {
  Bench b(text_protocol(), 50);
  EXPECT_EQ(b.run(4), "report 0.02 arm 0 0\nreport 0.04 arm 0 0\n");
}

TEST(TextDialogue, WritesTimesExactly) {
  std::string text;
  for (const std::int64_t time :
       {0ll, 1ll, 1'250'000'000ll, 33'333'333ll, 4'600'000'000'000'000'000ll, -1'500'000'000ll}) {
    add_seconds(text, time);
    text += ' ';
  }
  EXPECT_EQ(text, "0 0.000000001 1.25 0.033333333 4600000000 -1.5 ");
}

}  // namespace
}  // namespace muro::wire
