// SPDX-License-Identifier: MIT
// Records as CSV and JSON, correct and wrong ones.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "host/tools/identify/record.hpp"

namespace muro::host {
namespace {

std::string csv(const std::string& head = "# p_gain: 200\n# mass: 0.5\n# length: 0.1\n# supply_voltage: 7.4\n",
                const std::string& columns = "time,position,goal\n", const std::string& line_10 = "") {
  std::string text = head + columns;
  for (int i = 0; i < 30; ++i)
    text += i == 10 && !line_10.empty() ? line_10 : std::to_string(0.01 * i) + "," + std::to_string(0.1 * i) + ",1\n";
  return text;
}

std::string json(const std::string& entry_10 = "", const std::string& motor = "xl330") {
  std::string text =
      "{\"mass\": 0.49, \"length\": 0.1, \"kp\": 100, \"vin\": 7.4, \"motor\": \"" + motor + "\",\n\"entries\": [\n";
  for (int i = 0; i < 30; ++i)
    text +=
        (i == 10 && !entry_10.empty()
             ? entry_10
             : "{\"position\": 0.5, \"load\": " + std::to_string(i < 5 ? 65536 - 177 : 885) +
                   ", \"input_volts\": 7.1, \"goal_position\": 1, \"torque_enable\": " + (i < 20 ? "true" : "false") +
                   ", \"timestamp\": " + std::to_string(0.005 * i) + "}") +
        (i < 29 ? ",\n" : "\n");
  return text + "]}";
}

TEST(MotorRecordFile, CsvHasConstantsAndColumns) {
  const MotorRecord r = parse_motor_record(csv(), "a.csv", {});
  EXPECT_EQ(r.p_gain, 200);
  EXPECT_EQ(r.load.gravity_torque(), 9.81 * 0.5 * 0.1);
  ASSERT_EQ(r.samples.size(), 30u);
  EXPECT_EQ(r.samples[3].position, 0.3);
  EXPECT_EQ(r.samples[3].supply_voltage, 7.4);
  const MotorRecord by_hand =
      parse_motor_record(csv(""), "a.csv", {.p_gain = 3, .supply_voltage = 12, .mass = 1, .length = 2});
  EXPECT_EQ(by_hand.p_gain, 3);
  EXPECT_EQ(by_hand.samples[0].supply_voltage, 12);
}

TEST(MotorRecordFile, CsvTakesOtherSeparatorsAndMoreColumns) {
  std::string text = "# p_gain: 8\n# inertia: 0.01\nposition;note;time;goal;supply_voltage;torque_enable;duty\r\n";
  for (int i = 0; i < 25; ++i)
    text += "0.5;\"x\";" + std::to_string(0.01 * i) + ";1;11.1;" + (i < 9 ? "true" : "0") + ";-0.25\r\n";
  const MotorRecord r = parse_motor_record(text, "a.csv", {});
  EXPECT_TRUE(r.samples[8].torque_enable);
  EXPECT_FALSE(r.samples[9].torque_enable);
  EXPECT_EQ(r.samples[9].duty, -0.25);
  EXPECT_EQ(r.samples[9].supply_voltage, 11.1);
}

TEST(MotorRecordFile, JsonHasLoadsOf16BitsWithoutSign) {
  const MotorRecord r = parse_motor_record(json(), "a.json", {});
  EXPECT_TRUE(r.has_duty);
  EXPECT_EQ(r.samples[0].duty, -0.2);
  EXPECT_EQ(r.samples[6].duty, 1);
  EXPECT_FALSE(r.samples[25].torque_enable);
  EXPECT_EQ(r.samples[25].supply_voltage, 7.1);
  EXPECT_FALSE(parse_motor_record(json("", "mx64"), "a.json", {}).has_duty) << "its load is no duty";
}

std::string complaint(const std::string& text, const RecordDefaults& defaults = {}) {
  try {
    parse_motor_record(text, "a.txt", defaults);
  } catch (const SetupError& e) {
    return e.what();
  }
  return "";
}

TEST(MotorRecordFile, MistakesAreNamedWithTheirPlace) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "a.txt is empty"},
      {csv("# mass: 0.5\n# length: 0.1\n# supply_voltage: 7\n"),
       "the P gain is 0, which is not above 0; the record says it, or --p-gain"},
      {csv("# p_gain: 5\n# supply_voltage: 7\n"), "a.txt: there is no load"},
      {csv("# p_gain: 5\n# mass: 1\n# length: 1\n"), "a.txt:5:1: the supply voltage is 0 V"},
      {csv("# p_gain: x\n"), "a.txt:1:10: `p_gain` is `x`, which is no number"},
      {csv("# p_gain: 5\n", "time,goal\n"), "a.txt:2:1: the header has no column `position`"},
      {csv("# p_gain: 5\n", "time,position,goal,time\n"), "a.txt:2:20: there is a second column for `time`"},
      {csv("# a\n", "time,position,goal\n", "0.1,0.2\n"), "a.txt:13:8: there are 2 cells for 3 columns"},
      {csv("# a\n", "time,position,goal\n", "0.1,0,2,2\n"), "a.txt:13:9: there are more cells than the 3 columns"},
      {csv("# a\n", "time,position,goal\n", "0.1,0x2,1\n"), "a.txt:13:5: `0x2` is no number"},
      {csv("# a\n", "time,position,goal\n", "0.1,nan,1\n"), "a.txt:13:5: `nan` is no number"},
      {json().substr(0, 300), "a.txt:4:"},
      {json("3"), "a.txt:13:1: this entry is no object"},
      {json("{\"timestamp\": 0.05}"), "a.txt:13:1: this entry has no `position`"},
      {json("{\"timestamp\": 0.05, \"position\": \"a\"}"), "a.txt:13:1: `position` of this entry is \"a\""},
      {json("{\"timestamp\": 0.01, \"position\": 1, \"goal_position\": 0}"),
       "a.txt:13:1: time goes back from 0.045 s to 0.01 s"},
      {"{\"entries\": 3}", "has an array `entries`"},
      {"{\"entries\": [], \"kp\": 1, \"mass\": 1, \"length\": 1}", "it has 0 samples; 20 are the fewest"},
      {"{\"entries\": [], \"kp\": \"1\"}", "`kp` is \"1\", which is no number"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_NE(complaint(text).find(message), std::string::npos) << message << "\n" << complaint(text);
}

TEST(MotorRecordFile, ChangedBytesAreReadOrRefusedInOneLine) {
  std::uint64_t state = 7;
  const auto next = [&] { return state = state * 6364136223846793005ull + 1442695040888963407ull, state >> 33; };
  for (int round = 0; round < 2000; ++round) {
    std::string text = round % 2 == 0 ? csv() : json();
    for (std::uint64_t k = 0; k <= next() % 4; ++k) {
      const std::size_t at = next() % text.size();
      const char* const bytes = "0,-.e\"{}[]:\n;# \xff\x01";
      if (next() % 3 == 0)
        text.erase(at, 1 + next() % 20);
      else
        text[at] = bytes[next() % 17];
      if (text.empty()) text = " ";
    }
    const std::string message = complaint(text);
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    EXPECT_LT(message.size(), 600u) << message;
  }
}

TEST(MotorRecordFile, SamplesAtTheSameTimeAreLeftOut) {
  const MotorRecord r = parse_motor_record(
      csv("# p_gain: 5\n# mass: 1\n# length: 1\n# supply_voltage: 7\n", "time,position,goal\n", "0.09,5,5\n"), "a.csv",
      {});
  EXPECT_EQ(r.samples.size(), 29u);
  ASSERT_EQ(r.notes.size(), 1u);
}

TEST(MotorRecordFile, PlacesAreRightBehindSamplesAtTheSameTime) {
  std::string text = "# p_gain: 5\n# mass: 1\n# length: 1\ntime,position,goal,supply_voltage\n";
  for (int i = 0; i < 40; ++i) {
    text += std::to_string(0.01 * i) + ",0,0," + (i == 25 ? "-7" : "7") + "\n";
    if (i < 5) text += std::to_string(0.01 * i) + ",0,0,7\n";
  }
  EXPECT_EQ(complaint(text).substr(0, 46), "a.txt:35:1: the supply voltage is -7 V; it is ") << complaint(text);
}

TEST(MotorRecordFile, SaysWhatItsFirmwareDoes) {
  const MotorRecord r = parse_motor_record(
      csv("# p_gain: 5\n# duty_gain: 0.01\n# duty_limit: 0.8\n# mass: 1\n# length: 1\n# supply_voltage: 7\n"), "a.csv",
      {});
  EXPECT_EQ(r.duty_gain, 0.01);
  EXPECT_EQ(r.duty_limit, 0.8);
  EXPECT_NE(complaint(csv("# p_gain: 5\n# duty_limit: 1.5\n")).find("`duty_limit` is 1.5, and 1 is full duty"),
            std::string::npos);
}

}  // namespace
}  // namespace muro::host
