// SPDX-License-Identifier: MIT
// All status codes of all commands.
#include "command.hpp"

#include "scip2_testing.hpp"

namespace muro::scip2 {
namespace {

using Statuses = std::vector<std::pair<std::string, std::string>>;

/// Sends the lines to one device, one after the other.
void expect(Bench& d, const Statuses& dialogue) {
  for (const auto& [line, status] : dialogue) EXPECT_EQ(d.status_of(line), status) << line;
}

Model new_firmware() {
  Model m = urg_04lx();
  m.firmware = "3.3.00(01/Jan./2008)";
  apply_firmware(m);
  return m;
}

TEST(Scip2Command, AdjustModeRefusesAllElse) {
  Awake d;
  expect(d, {{"TM1", "04"},
             {"TM2", "03"},
             {"TM3", "01"},
             {"TMx", "01"},
             {"TM", "0C"},
             {"BM", "00"},
             {"TM0", "00"},
             {"TM0", "02"},
             {"BM", "0E"},
             {"QT", "0E"},
             {"GD0044072501", "0E"},
             {"VV", "0E"},
             {"TM1", "00"},
             {"TM2", "00"},
             {"GD0044072501", "10"}});
}

TEST(Scip2Command, AdjustModeTellsTheTimeAtOnce) {
  Awake d;
  d.ask("TM0\n", 150);
  const std::string reply = d.ask("TM1\n", 1);
  ASSERT_EQ(reply.size(), 15u);
  EXPECT_EQ(decoded(reply.substr(8, 4)), d.milliseconds - 1) << "the device was switched on at 1 ms";
}

TEST(Scip2Command, BitRatesAreThoseOfTheTable) {
  Awake d;
  expect(d, {{"SS019200", "03"},
             {"SS11520x", "01"},
             {"SS012345", "02"},
             {"SS115200", "00"},
             {"SS115200", "03"},
             {"SS038400", "00"},
             {"SS057600", "00"},
             {"SS250000", "00"},
             {"SS500000", "00"},
             {"SS750000", "00"},
             {"SS1152", "0F"},
             {"SS", "0C"},
             {"SS1152000", "0D"}});
  EXPECT_EQ(d.bit_rate, 750000u);
  EXPECT_NE(d.ask("II\n").find("SBPS:750000[bps];"), std::string::npos);
  expect(d, {{"RS", "00"}, {"SS019200", "03"}});
  EXPECT_EQ(d.bit_rate, 0u) << "as at the start";
  Bench ethernet(ust_10lx());
  EXPECT_EQ(ethernet.status_of("SS115200"), "04");
}

TEST(Scip2Command, TheFirstBitRateIsThatOfTheLine) {
  Awake d;
  d.device = Device(urg_04lx(), false, 115200);
  EXPECT_NE(d.ask("II\n").find("SBPS:115200[bps]<-Default setting by user;"), std::string::npos);
  expect(d, {{"SS115200", "03"}, {"SS019200", "00"}, {"SS019200", "03"}});
  EXPECT_EQ(d.bit_rate, 19200u);
  EXPECT_NE(d.ask("II\n").find("SBPS:19200[bps];"), std::string::npos);
  expect(d, {{"RS", "00"}});
  EXPECT_EQ(d.bit_rate, 0u);
  expect(d, {{"SS115200", "03"}, {"SS038400", "00"}, {"SS115200", "00"}});
  EXPECT_EQ(d.bit_rate, 115200u);
}

TEST(Scip2Command, MotorSpeedSlowsScansDown) {
  Awake d;
  expect(d, {{"CR00", "03"}, {"CR99", "03"}, {"CRx1", "01"}, {"CR11", "02"}, {"CR10", "00"}, {"CR10", "03"}});
  EXPECT_NE(d.ask("II\n", 200).find("SCSP:10%Down(540[rpm]);"), std::string::npos);
  d.ask("MD0044004401000\n", 500);
  d.times.clear();
  d.run(1200);
  EXPECT_EQ(d.times.size(), 10u + (d.times.size() > 10)) << "scans in 1.2 s at 540 rpm: 10.8";
  d.ask("QT\n", 300);
  expect(d, {{"CR99", "00"}, {"CR05", "00"}, {"RS", "00"}, {"CR00", "03"}});
}

TEST(Scip2Command, HighSensitivityNeedsNewerFirmware) {
  Awake d(new_firmware());
  expect(d, {{"HS0", "02"}, {"HS1", "00"}, {"HS1", "02"}, {"HS2", "01"}, {"HSx", "01"}, {"HS", "0C"}});
  d.ask("BM\n");
  EXPECT_NE(d.ask("II\n").find("MESM:Measuring by Sensitive Mode;A"), std::string::npos);
  Awake old;
  expect(old, {{"HS1", "0C"}, {"DB02", "0E"}});
}

TEST(Scip2Command, WindowsAreCheckedFieldByField) {
  Awake d;
  for (const std::string c : {"GD", "GS", "GE"})
    expect(d, {{c + "x044072501", "01"},
               {c + "0044x72501", "02"},
               {c + "00440725x1", "03"},
               {c + "0044076901", "04"},
               {c + "0044999901", "04"},
               {c + "0100009901", "05"},
               {c + "0044072501", "10"},
               {c + "00440725", "0F"},
               {c, "0C"},
               {c + "00440725011", "0D"}});
  for (const std::string c : {"MD", "MS", "ME"})
    expect(d, {{c + "x044072501000", "01"},
               {c + "0044x72501000", "02"},
               {c + "00440725x1000", "03"},
               {c + "0044076901000", "04"},
               {c + "0100009901000", "05"},
               {c + "0044072501x00", "06"},
               {c + "00440725010x0", "07"},
               {c + "0044072501", "0F"},
               {c, "0C"}});
}

TEST(Scip2Command, UndefinedAndIncompleteLinesAreRefused) {
  Awake d;
  expect(d, {{"X", "0D"},
             {"XX", "0E"},
             {"vv", "0E"},
             {"VVx", "0D"},
             {"SCIP2.0", "0E"},
             {"VV;12345678901234567", "0G"},
             {"VV;a-b", "0H"},
             {"VV;1234567890123456", "00"},
             {"ND0044072501000", "0E"},
             {"HD0044072501", "0E"},
             {"RT", "0E"},
             {"RB", "0E"}});
}

TEST(Scip2Command, ResetIsAsAtTheStart) {
  Awake d;
  d.run(5000);
  expect(d, {{"BM", "00"}, {"RS", "00"}, {"GD0044072501", "10"}});
  const auto replies = replies_in(d.ask("BM\nGD0044072501\n", 300));
  ASSERT_TRUE(replies && replies->size() == 2);
  EXPECT_LT((*replies)[1].timestamp(), 1000) << "the timer began anew";
}

TEST(Scip2Command, NewerModelsRestart) {
  Bench d(utm_30lx());
  expect(d, {{"BM", "00"},
             {"RT", "00"},
             {"GD0000108001", "10"},
             {"BM", "00"},
             {"RB", "01"},
             {"RB", "00"},
             {"GD0000108001", "10"}});
}

TEST(Scip2Command, AUst10LxTellsItsState) {
  Bench d(ust_10lx());
  const auto state = [&] {
    const std::string reply = d.ask("%ST\n", 5);
    EXPECT_EQ(reply.substr(0, 8), "%ST\n00P\n");
    EXPECT_EQ(reply.substr(11), std::string(1, expected_sum(reply.substr(8, 3))) + "\n\n");
    return reply.substr(8, 3);
  };
  EXPECT_EQ(state(), "000");
  for (const auto& [command, expected] :
       Statuses{{"TM0", "002"}, {"TM2", "000"}, {"BM", "003"}, {"%SL", "005"}, {"BM", "003"}, {"QT", "000"}}) {
    EXPECT_EQ(d.status_of(command), "00");
    EXPECT_EQ(state(), expected) << command;
  }
  d.ask("MD0000108001000\n", 5);
  EXPECT_EQ(state(), "004");
  EXPECT_EQ(Awake().status_of("%ST"), "0E");
}

TEST(Scip2Command, MultipleEchoesAreWrittenAsOneByDevicesThatSeeOne) {
  Model m = utm_30lx();
  m.has_multiecho = true;
  Bench d(m);
  d.ask("BM\n", 60);
  const auto replies = replies_in(d.ask("HD0000108001\nGD0000108001\nHE0000000901\n", 60));
  ASSERT_TRUE(replies && replies->size() == 3);
  EXPECT_EQ((*replies)[0].values(3), (*replies)[1].values(3));
  EXPECT_EQ((*replies)[2].values(3).size(), 20u);
}

TEST(Scip2Command, MalfunctionsAreSimulatedInStages) {
  const auto statuses = [](const std::string& code) {
    Awake d(new_firmware());
    d.ask("DB" + code + "\n");
    std::string text;
    const auto replies = replies_in(d.ask("MD0044004401000\n", 3500));
    for (const Reply& r : replies.value()) text += r.status + (r.lines.empty() ? " " : "+");
    return text + (d.status_of("BM"));
  };
  std::string good, bad;
  for (int i = 0; i < 9; ++i) good += "99+";
  for (int i = 0; i < 10; ++i) bad += "21 ";
  EXPECT_EQ(statuses("03").find("00 " + good + bad + "98 99+"), 0u) << statuses("03");
  EXPECT_EQ(statuses("04"), "00 " + good + bad + "50 01");
  EXPECT_EQ(statuses("05"), "00 " + good + "50 01");
  EXPECT_EQ(statuses("02"), "50 01");
  Awake d(new_firmware());
  expect(d, {{"DB06", "01"},
             {"DBxx", "01"},
             {"DB10", "03"},
             {"DB02", "00"},
             {"DB02", "02"},
             {"GD0044072501", "50"},
             {"DB10", "00"},
             {"DB10", "03"},
             {"BM", "00"},
             {"DB01", "00"}});
  d.ask("QT\nBM\n", 2500);
  expect(d, {{"DB10", "03"}, {"DB01", "00"}});
}

}  // namespace
}  // namespace muro::scip2
