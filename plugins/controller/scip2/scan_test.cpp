// SPDX-License-Identifier: MIT
// Scans: their times and their content.
#include "scip2_testing.hpp"

namespace muro::scip2 {
namespace {

std::vector<Reply> complete(const std::string& bytes) {
  const auto replies = replies_in(bytes);
  EXPECT_TRUE(replies.has_value()) << bytes;
  return replies.value_or(std::vector<Reply>());
}

TEST(Scip2Scan, ThreeScansAreCountedDownAndThenTheLaserIsOff) {
  Awake d;
  const auto replies = complete(d.ask("MD0044072501003;abc\n", 1000));
  ASSERT_EQ(replies.size(), 4u);
  EXPECT_EQ(replies[0].echo + " " + replies[0].status, "MD0044072501003;abc 00");
  EXPECT_TRUE(replies[0].lines.empty());
  const char* echoes[] = {"MD0044072501002;abc", "MD0044072501001;abc", "MD0044072501000;abc"};
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(replies[i].echo, echoes[i - 1]);
    EXPECT_EQ(replies[i].status, "99");
    EXPECT_TRUE(replies[i].sums_are_right);
    EXPECT_EQ(replies[i].values(3), std::vector<long>(682, 1000));
  }
  EXPECT_EQ(d.status_of("GD0044072501"), "10");
}

/// Step D of table 2 in the protocol, "last measurement point". Some drivers (Player, gearbox) always request all 769.
TEST(Scip2Scan, StepsGoToTheLastMeasurementPoint) {
  Awake d;
  d.ask("BM\n", 250);
  const auto replies = complete(d.ask("GD0000076801\nGS0720076801\n", 250));
  ASSERT_EQ(replies.size(), 2u);
  std::vector<long> wanted(769, 0);
  std::fill(wanted.begin() + 44, wanted.begin() + 726, 1000);
  EXPECT_EQ(replies[0].values(3), wanted);
  EXPECT_EQ(replies[1].values(2), std::vector<long>(wanted.begin() + 720, wanted.end()));
  EXPECT_EQ(d.status_of("GD0000076901"), "04");
  Bench utm(utm_30lx());
  utm.ask("BM\n", 60);
  EXPECT_EQ(utm.status_of("GD0000108101"), "04");
}

/// A scan has 2134 bytes of ten bits each: 185 ms at 115200 bit/s, 1.11 s at 19200 bit/s.
TEST(Scip2Scan, ScansThatALineIsTooSlowForAreLeftOut) {
  Awake d;
  d.device = Device(urg_04lx(), false, 115200);
  auto replies = complete(d.ask("MD0044072501004\n", 1050));
  ASSERT_EQ(replies.size(), 5u) << "all that were asked for";
  for (std::size_t i = 2; i < replies.size(); ++i) EXPECT_EQ(replies[i].timestamp() - replies[i - 1].timestamp(), 200);
  EXPECT_EQ(replies[4].echo, "MD0044072501000");
  d.ask("SS019200\n");
  d.ask("MD0044072501000\n", 3000);
  replies = complete(d.ask("QT\n", 100));
  EXPECT_EQ(replies.back().echo, "QT");
  EXPECT_LE(replies.size(), 2u) << "no scans wait before it";
  replies = complete(d.ask("SS115200\nMS0384038501000\n", 1150));
  ASSERT_GE(replies.size(), 3u);
  EXPECT_EQ(replies[3].timestamp() - replies[2].timestamp(), 100) << "short ones are all sent";
}

TEST(Scip2Scan, OneScanThatWasAskedForSays00) {
  const auto replies = complete(Awake().ask("MD0044072501101\n", 1000));
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[1].echo, "MD0044072501100");
}

TEST(Scip2Scan, EndlessScansSay00AndStopAfterWholeBlocks) {
  Awake d;
  auto replies = complete(d.ask("MD0044072501000\n", 1050));
  ASSERT_EQ(replies.size(), 10u);
  for (std::size_t i = 1; i < replies.size(); ++i) EXPECT_EQ(replies[i].echo, "MD0044072501000");
  replies = complete(d.ask("VV\nQT\n", 1000));
  ASSERT_EQ(replies.size(), 3u);
  EXPECT_EQ(replies[0].status, "99");
  EXPECT_EQ(replies[0].values(3).size(), 682u);
  EXPECT_EQ(replies[2].echo + replies[2].status, "QT00");
}

TEST(Scip2Scan, ScansComeTenTimesASecondWithTheTimeOfStepZero) {
  Awake d;
  const auto replies = complete(d.ask("MD0044072501000\n", 2050));
  ASSERT_EQ(replies.size(), 20u);
  for (std::size_t i = 1; i < replies.size(); ++i)
    EXPECT_EQ(replies[i].timestamp(), long(100 * (i + 1))) << "one turn before it is sent";
}

TEST(Scip2Scan, AnIntervalLeavesScansOut) {
  Awake d;
  const auto replies = complete(d.ask("MD0044072501200\n", 1950));
  ASSERT_GE(replies.size(), 6u);
  for (std::size_t i = 2; i < replies.size(); ++i) EXPECT_EQ(replies[i].timestamp() - replies[i - 1].timestamp(), 300);
}

TEST(Scip2Scan, RepliesComeEveryHundredMilliseconds) {
  Awake d;
  d.times.clear();
  for (int i = 0; i < 20; ++i) {
    d.type(i % 2 ? "PP\n" : "II\n");
    d.run(37);
  }
  for (const std::int64_t t : d.times) EXPECT_EQ((t - 1) % 100, 0) << "the device was switched on at 1 ms";
}

TEST(Scip2Scan, AnIntervalOfRepliesMayBeChosen) {
  Model m = urg_04lx();
  m.reply_time = ReplyTime::at_interval;
  m.reply_interval = 20'000'000;
  Bench d(m);
  d.run(1);
  d.times.clear();
  for (int i = 0; i < 10; ++i) d.ask("PP\n", 20);
  ASSERT_EQ(d.times.size(), 10u);
  for (const std::int64_t t : d.times) EXPECT_EQ((t - 1) % 20, 0);
  m.reply_time = ReplyTime::at_once;
  Bench fast(m);
  EXPECT_NE(fast.ask("PP\n", 1), "");
}

TEST(Scip2Scan, TheFirstScanIsOneThatBeganWithTheLaserOn) {
  for (const bool is_swept : {false, true}) {
    Awake d(urg_04lx(), is_swept);
    d.run(40);
    const auto replies = complete(d.ask("BM\nGD0044072501\n", 400));
    ASSERT_EQ(replies.size(), 2u);
    EXPECT_EQ(replies[1].status, "00");
    EXPECT_EQ(replies[1].timestamp(), 200) << "BM was answered then";
    EXPECT_EQ(d.times.back(), 301);
  }
}

TEST(Scip2Scan, ASweptScanIsReadAtItsEndAndOneOfAnInstantAtItsBegin) {
  for (const bool is_swept : {false, true}) {
    Awake d(urg_04lx(), is_swept);
    d.ask("MD0044072501000\n", 50);
    d.output.clear();
    for (int i = 0; i < 1000; ++i) {
      d.scan.assign(d.scan.size(), std::uint32_t(1000 + d.milliseconds));  // to be read in the next millisecond
      d.run(1);
    }
    for (const Reply& r : complete(d.output))
      if (r.status == "99") {
        EXPECT_EQ(r.values(3)[0] - 1000, r.timestamp() + (is_swept ? 100 : 0));
      }
  }
}

TEST(Scip2Scan, TimestampsWrapAfterTwentyFourBits) {
  Awake d;
  d.device.shift(d.state(), -std::int64_t(0xffffff - 250) * 1'000'000);
  d.state().scan_begin = (d.milliseconds + 1) * 1'000'000;
  const auto replies = complete(d.ask("MD0044004401005\n", 900));
  ASSERT_EQ(replies.size(), 6u);
  EXPECT_GT(replies[1].timestamp(), 0xffff00);
  EXPECT_LT(replies[5].timestamp(), 1000);
  EXPECT_EQ((replies[5].timestamp() - replies[1].timestamp()) & 0xffffff, 400);
}

TEST(Scip2Scan, AClusterReadsItsLeastDistanceWithoutErrors) {
  Awake d;
  d.scan = std::vector<std::uint32_t>(682, 0);
  const std::vector<std::uint32_t> begin{500, 400, 7, 0, 19, 0, 0, 700, 20, 900};
  std::copy(begin.begin(), begin.end(), d.scan.begin());
  d.ask("BM\n");
  const auto clusters = [&](const std::string& window) {
    return complete(d.ask("GD" + window + "\n", 300)).at(0).values(3);
  };
  EXPECT_EQ(clusters("0044005303"), (std::vector<long>{400, 0, 20, 900})) << "the last one is of a single step";
  EXPECT_EQ(clusters("0044005310"), (std::vector<long>{20}));
  EXPECT_EQ(clusters("0044005300"), clusters("0044005301"));
  EXPECT_EQ(clusters("0044072503").size(), 228u);
  EXPECT_EQ(clusters("0044072599").size(), 7u);
  EXPECT_EQ(clusters("0040004401"), (std::vector<long>{0, 0, 0, 0, 500})) << "steps that see nothing";
}

TEST(Scip2Scan, TwoCharactersEndAt4095) {
  Awake d;
  d.scan[0] = 4094, d.scan[1] = 5000, d.scan[2] = 19;
  d.ask("BM\n");
  EXPECT_EQ(complete(d.ask("GS0044004601\n", 300)).at(0).values(2), (std::vector<long>{4094, 4095, 19}));
  const auto replies = complete(d.ask("MS0044004601001\n", 300));
  ASSERT_EQ(replies.size(), 2u);
  EXPECT_EQ(replies[1].values(2), (std::vector<long>{4094, 4095, 19}));
}

TEST(Scip2Scan, IntensitiesStandBehindTheirDistances) {
  Awake d;
  for (std::size_t i = 0; i < d.scan.size(); ++i) {
    d.scan[i] = std::uint32_t(100 + i);
    d.intensity[i] = std::uint32_t(9000 - i);
  }
  const auto replies = complete(d.ask("ME0044072501001\n", 400));
  ASSERT_EQ(replies.size(), 2u);
  const std::vector<long> values = replies[1].values(3);
  ASSERT_EQ(values.size(), 2 * 682u);
  for (std::size_t i = 0; i < 682; ++i) EXPECT_EQ(values[2 * i] + values[2 * i + 1], 9100);
  d.ask("BM\n");
  EXPECT_EQ(complete(d.ask("GE0044072501\n", 300)).at(0).values(3), values);
}

TEST(Scip2Scan, AUtm30LxSends1081StepsEvery25Milliseconds) {
  Bench d(utm_30lx());
  const auto replies = complete(d.ask("MD0000108001000\n", 1060));
  EXPECT_EQ(replies.size(), 42u);
  EXPECT_EQ(replies.back().values(3).size(), 1081u);
  EXPECT_EQ(replies[2].timestamp() - replies[1].timestamp(), 25);
}

TEST(Scip2Scan, WhoAsksForTheLatestScanAgainGetsANewOne) {
  Bench d(utm_30lx());
  d.ask("BM\n", 60);
  std::vector<long> timestamps;
  for (int i = 0; i < 5; ++i) {
    d.output.clear();
    d.type("GD0000108001\n");
    for (int k = 0; k < 100 && d.output.empty(); ++k) d.run(1);
    timestamps.push_back(complete(d.output).at(0).timestamp());
  }
  for (std::size_t i = 1; i < timestamps.size(); ++i) EXPECT_EQ(timestamps[i] - timestamps[i - 1], 25);
  const auto both = complete(d.ask("GS0000108001\nGE0000108001\n", 1));
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].timestamp(), both[1].timestamp());
}

TEST(Scip2Scan, RepliesGoToWhoAskedAndScansEndWithTheirClient) {
  Awake d;
  d.type("MD0044004401000\n", 2);
  d.type("MD;\nVV\n", 1);
  d.run(450);
  EXPECT_EQ(complete(d.output).size(), 2u);
  EXPECT_EQ(complete(d.other_output).size(), 4u) << "each client its own, also commands of one kind at once";
  d.device.forget(d.state(), 2, d);
  d.other_output.clear();
  d.run(500);
  EXPECT_EQ(d.other_output, "");
  EXPECT_EQ(d.status_of("GD0044072501"), "10");
}

TEST(Scip2Scan, WhoSaysNoMoreStillGetsReplies) {
  Awake d;
  d.type("MD0044004401000\nVV\n", 2);
  EXPECT_TRUE(Device::owes(d.state(), 2));
  d.device.forget(d.state(), 2, d);
  EXPECT_TRUE(Device::owes(d.state(), 2)) << "VV";
  d.run(450);
  EXPECT_FALSE(Device::owes(d.state(), 2));
  EXPECT_EQ(complete(d.other_output).size(), 1u) << "no scans, which nobody would get";
}

TEST(Scip2Scan, AStateMovedInTimeGoesOn) {
  Awake a, b;
  a.ask("MD0044072501000\n", 350);
  b.ask("MD0044072501000\n", 350);
  b.device.shift(b.state(), -b.milliseconds * 1'000'000);
  b.milliseconds = 0;
  a.run(1000);
  b.run(1000);
  EXPECT_EQ(a.output, b.output);
  EXPECT_FALSE(a.output.empty());
}

}  // namespace
}  // namespace muro::scip2
