// SPDX-License-Identifier: MIT
// Records of scans in SCIP 2.0 and CSV, correct and wrong ones.
#include "host/tools/compare/scan_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "tests/compare/scip_text.hpp"

namespace muro::host {
namespace {

using test::scip_scan;
using test::with_sum;

/// Answer of a URG-04LX with firmware 3.1.04 to PP, byte by byte.
const std::string parameters =
    "PP\n00P\nMODL:URG-04LX(Hokuyo Automatic Co.,Ltd.);N\nDMIN:20;4\nDMAX:5600;_\nARES:1024;\\\nAMIN:44;7\nAMAX:725;o\n"
    "AFRT:384;6\nSCAN:600;e\n\n";

TEST(ScipRecord, TheDialogueOfTheManualIsRead) {
  const ScanRecord r = parse_scan_record("GD0300030901\n00P\n00DDX\n0d50ci0c^0cS0cH0c>0c30bi0b_0bUQ\n\n", "a.scip");
  ASSERT_EQ(r.ranges.size(), 1u);
  ASSERT_EQ(r.beam_count(), 10u);
  EXPECT_NEAR(r.ranges[0][0], 3.333, 1e-12);
  EXPECT_NEAR(r.ranges[0][1], 3.321, 1e-12);
  EXPECT_NEAR(r.angles[0], (300 - 384) * 2 * M_PI / 1024, 1e-12);
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("it has no reply to PP"), std::string::npos);
}

TEST(ScipRecord, HasWhatTheDeviceSaysOfItself) {
  const ScanRecord r = parse_scan_record(
      parameters + scip_scan("MD0380038800001", {0, 7, 19, 20, 1234, 5432, 5600, 5601, 18}) + "QT\n00P\n\n", "a.scip");
  EXPECT_EQ(r.scanner, "URG-04LX(Hokuyo Automatic Co.,Ltd.)");
  EXPECT_EQ(r.range_min, 0.02);
  EXPECT_EQ(r.range_max, 5.6);
  EXPECT_TRUE(r.notes.empty());
  EXPECT_EQ(r.angles[4], 0);
  EXPECT_TRUE(std::isnan(r.ranges[0][2]));
  EXPECT_NEAR(r.ranges[0][3], 0.020, 1e-12);
  EXPECT_NEAR(r.ranges[0][5], 5.432, 1e-12);
  EXPECT_NEAR(r.ranges[0][6], 5.6, 1e-12);
  EXPECT_TRUE(std::isnan(r.ranges[0][7]));
  EXPECT_EQ(r.codes, (std::map<std::uint32_t, std::size_t>{{0, 1}, {7, 1}, {18, 1}, {19, 1}, {5601, 1}}));
}

TEST(ScipRecord, ScansAreToldFromOtherReplies) {
  const std::string acknowledged = "MD0000000202002\n00P\n\n";
  const std::string text = "SCIP2.0\n0\n\n" + parameters + "BM\n00P\n\n" + acknowledged +
                           scip_scan("MD0000000202001", {1000, 1001}) + scip_scan("MD0000000202000", {1002, 1003}) +
                           "GS0000000202\n10Q\n\n";
  const ScanRecord r = parse_scan_record(text, "a.scip");
  ASSERT_EQ(r.ranges.size(), 2u);
  EXPECT_NEAR(r.ranges[1][1], 1.003, 1e-12);
  EXPECT_NEAR(r.angles[0], (0.5 - 384) * 2 * M_PI / 1024, 1e-12) << "a cluster of two steps";
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("refused 1 command"), std::string::npos);
}

TEST(ScipRecord, IntensitiesArePassedOver) {
  const ScanRecord r =
      parse_scan_record(parameters + scip_scan("ME0000000200000", {1000, 77, 1001, 4000, 1002, 9}), "a.scip");
  ASSERT_EQ(r.beam_count(), 3u);
  EXPECT_NEAR(r.ranges[0][2], 1.002, 1e-12);
}

TEST(ScipRecord, RequestsMayStandBeforeTheirEchoes) {
  std::string requests;
  for (int i = 0; i < 100000; ++i) requests += "MD0000000200000\n";
  EXPECT_EQ(parse_scan_record(requests + scip_scan("MD0000000200000", {1000, 1001, 1002}), "a.scip").ranges.size(), 1u);
}

TEST(ScipRecord, ACutOffScanIsLeftOut) {
  const std::string scan = scip_scan("MD0000000200000", {1000, 1001, 1002});
  const ScanRecord r = parse_scan_record(parameters + scan + scan.substr(0, scan.size() - 4), "a.scip");
  EXPECT_EQ(r.ranges.size(), 1u);
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("its last scan is cut off"), std::string::npos);
}

TEST(ScipRecord, MayBeginInTheMiddleOfAReply) {
  const std::string scan = scip_scan("MD0000000200000", {1000, 1001, 1002});
  const ScanRecord r = parse_scan_record("0Ud0Ue\n0UfP\n\n" + scan + scan, "a.scip");
  EXPECT_EQ(r.ranges.size(), 2u);
  EXPECT_NE(r.notes.at(1).find("it begins in the middle of a reply; 2 lines are left out"), std::string::npos)
      << r.notes.at(1);
}

TEST(CsvScans, HasConstantsAndColumns) {
  const ScanRecord r = parse_scan_record(
      "# scanner: URG-04LX\n# angle_min: -0.1\n# angle_increment: 0.05\n# range_min: 0.02\n# range_max: 5.6\n# unit: "
      "mm\n"
      "time,ranges[0],ranges[1],ranges[2],ranges[3]\n0.0,1000,0,nan,5600\n0.1,1001,inf,,2000\n",
      "a.csv");
  ASSERT_EQ(r.ranges.size(), 2u);
  EXPECT_EQ(r.angles, (std::vector<double>{-0.1, -0.05, 0, -0.1 + 3 * 0.05}));
  EXPECT_EQ(r.ranges[0][0], 1);
  EXPECT_TRUE(std::isnan(r.ranges[0][1]) && std::isnan(r.ranges[0][2]) && std::isnan(r.ranges[1][1]));
  EXPECT_TRUE(std::isnan(r.ranges[0][3])) << "the largest range is what nothing seen reads";
  EXPECT_EQ(r.ranges[1][3], 2);
}

TEST(CsvScans, TakesWhatARecorderHasWritten) {
  const ScanRecord r = parse_scan_record(
      "time,rover/base:pose.x,rover/laser:ranges.measured[0],rover/laser:ranges.measured[1],"
      "rover/laser:ranges.measured[2]\n0,7,1,2,3\n",
      "a.csv");
  EXPECT_EQ(r.ranges, (std::vector<std::vector<double>>{{1, 2, 3}}));
  EXPECT_TRUE(r.angles.empty());
}

TEST(ScanRecordFile, IsToldFromRecordsOfAJoint) {
  EXPECT_TRUE(is_scan_record(parameters));
  EXPECT_TRUE(is_scan_record("# unit: m\n\ntime,ranges[0]\n"));
  EXPECT_FALSE(is_scan_record("# p_gain: 2\ntime,position,goal\n"));
  EXPECT_FALSE(is_scan_record("{\"entries\": []}"));
  EXPECT_FALSE(is_scan_record(""));
}

std::string complaint(const std::string& text) {
  try {
    parse_scan_record(text, "a.txt");
  } catch (const SetupError& e) {
    return e.what();
  }
  return "";
}

TEST(ScanRecordFile, MistakesAreNamedWithTheirPlace) {
  const std::string scan = scip_scan("MD0000000200000", {1000, 1001, 1002});
  std::string changed = scan;
  ++changed[changed.size() - 5];
  const std::string head = "time,ranges[0],ranges[1],ranges[2]\n";
  const auto entry = [](const std::string& text) { return text + ";" + with_sum(text).back() + "\n"; };
  const std::pair<std::string, std::string> cases[] = {
      {changed, "a.txt:4:10: the sum of this line does not fit"},
      {"MD0000000200000\n99b\n00000\n" + with_sum("0Ud0Ue") + "\n\n",
       "a.txt:1:1: this scan has 6 characters of data; its steps need 9"},
      {scan + scip_scan("MD0000000100000", {1000, 1001}),
       "a.txt:6:1: this scan has the steps 0 to 1 by 1, and those before have 0 to 2 by 1"},
      {scan + "hello there\n", "a.txt:6:1: this is no line of SCIP 2.0"},
      {parameters, "a.txt: there is no whole scan in it"},
      {"PP\n00P\nDMAX:5600;x\n", "a.txt:3:10: the sum of this line does not fit"},
      {scip_scan("MD1000100200000", {1000, 1001, 1002}), "steps up to 1002 are none of a URG-04LX"},
      {head, "a.txt: there is no scan in it"},
      {head + "0,1,2\n", "a.txt:2:6: there are 3 cells for 4 columns"},
      {head + "0,1,2,3,4\n", "a.txt:2:9: there are more cells than the 4 columns"},
      {head + "0,1,two,3\n", "a.txt:2:5: `two` is no range"},
      {"time,ranges[0],ranges[2],ranges[1]\n", "a.txt:1:16: `ranges[2]` is expected as [1]"},
      {"ranges[0],ranges[1]\n", "a.txt:1:1: the header has no columns `ranges[0]`, `ranges[1]`, ... for three beams"},
      {"a/l:ranges[0],b/l:ranges[1]\n", "a.txt:1:15: there are ranges of `a/l:ranges` and of `b/l:ranges`"},
      {"# unit: cm\n" + head, "a.txt:1:8: `unit` is `cm`; ranges are in `m` or `mm`"},
      {"# angle_min: x\n" + head, "a.txt:1:13: `angle_min` is `x`, which is no number"},
      {"# angle_min: 1\n" + head + "0,1,2,3\n", "`# angle_increment: ...` (rad) belong together"},
      {"# range_min: 2\n# range_max: 1\n" + head + "0,1,2,3\n", "`range_max` is 1 m, and is above `range_min`, 2 m"},
      {head + "0,1,2,3\n# unit: mm\n", "a.txt:3:1: `unit` stands behind the first scan"},
      {"PP\n00P\n" + entry("DMIN:9000") + entry("DMAX:10") + "\n" + scan, "from 9000 mm to 10 mm"},
      {"MD0000000200000\n99b\n00000\n" + with_sum("0Ud0Ue0U ") + "\n\n", "a.txt:4:9: a character of data is between"},
  };
  for (const auto& [text, message] : cases)
    EXPECT_NE(complaint(text).find(message), std::string::npos) << message << "\n" << complaint(text);
}

TEST(ScanRecordFile, EveryChangedByteOfAScanIsNoticed) {
  // the sums of SCIP have six bits: a change of a data byte by one is always noticed
  const std::string scan = scip_scan("MD0000002900000", std::vector<std::uint32_t>(30, 2345));
  for (std::size_t at = scan.find("\n00000\n") + 7; at + 2 < scan.size(); ++at) {
    std::string changed = scan;
    ++changed[at];
    EXPECT_NE(complaint(changed), "") << at;
  }
}

TEST(ScanRecordFile, ChangedBytesAreReadOrRefusedInOneLine) {
  const std::string texts[] = {
      parameters + scip_scan("MD0000000200001", {1000, 1001, 1002}) + scip_scan("MD0000000200000", {1000, 1001, 1002}),
      "# angle_min: -1\n# angle_increment: 0.1\ntime,ranges[0],ranges[1],ranges[2]\n0,1,2,3\n1,1,2,3\n"};
  std::uint64_t state = 11;
  const auto next = [&] { return state = state * 6364136223846793005ull + 1442695040888963407ull, state >> 33; };
  for (int round = 0; round < 3000; ++round) {
    std::string text = texts[round % 2];
    for (std::uint64_t k = 0; k <= next() % 4; ++k) {
      const std::size_t at = next() % text.size();
      const char* const bytes = "0,-.e\"[]:;\n# MG\xff\x01";
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

}  // namespace
}  // namespace muro::host
