// SPDX-License-Identifier: MIT
// Exact bytes that real devices have sent.
#include "scip2_testing.hpp"

namespace muro::scip2 {
namespace {

TEST(Scip2Dialogue, VersionIsThatOfFirmware3_1_04) {
  EXPECT_EQ(Awake().ask("VV\n"),
            "VV\n00P\nVEND:Hokuyo Automatic Co.,Ltd.;[\nPROD:SOKUIKI Sensor URG-04LX;[\nFIRM:3.1.04(02/Aug./2007);a\n"
            "PROT:SCIP 2.0;N\nSERI:H0706400;F\n\n");
}

TEST(Scip2Dialogue, ParametersAreThoseOfFirmware3_1_04) {
  EXPECT_EQ(Awake().ask("PP\n"),
            "PP\n00P\nMODL:URG-04LX(Hokuyo Automatic Co.,Ltd.);N\nDMIN:20;4\nDMAX:5600;_\nARES:1024;\\\nAMIN:44;7\n"
            "AMAX:725;o\nAFRT:384;6\nSCAN:600;e\n\n");
}

TEST(Scip2Dialogue, StatusTellsLaserSpeedBitRateAndTime) {
  Awake d;
  d.run(6401 - d.milliseconds);
  EXPECT_EQ(d.ask("II\n"),
            "II\n00P\nMODL:URG-04LX(Hokuyo Automatic Co.,Ltd.);N\nLASR:OFF;7\n"
            "SCSP:Initial(600[rpm])<-Default setting by user;A\nMESM:IDLE;:\n"
            "SBPS:19200[bps]<-Default setting by user;A\nTIME:001964;M\nSTAT:Sensor works well.;8\n\n");
  d.ask("BM\n");
  const std::string measuring = d.ask("II\n");
  EXPECT_NE(measuring.find("\nLASR:ON;9\n"), std::string::npos) << measuring;
  EXPECT_NE(measuring.find("\nMESM:CLASSIC;^\n"), std::string::npos) << measuring;
}

TEST(Scip2Dialogue, TheLineOfTheTimeIsAsARealDeviceSummedIt) {
  std::string text;
  ReplyWriter(text).keyed("TIME", "001957");
  EXPECT_EQ(text, "TIME:001957;O\n");
}

TEST(Scip2Dialogue, SwitchesFromScip1ToScip2) {
  Bench d;
  EXPECT_EQ(d.ask("SCIP2.0\n"), "SCIP2.0\n0\n\n");
  EXPECT_EQ(d.ask("BM\n"), "BM\n00P\n\n");
  EXPECT_EQ(d.ask("BM\n"), "BM\n02R\n\n");
  EXPECT_EQ(d.ask("QT\n"), "QT\n00P\n\n");
}

TEST(Scip2Dialogue, Scip1TellsItsVersion) {
  EXPECT_EQ(Bench().ask("V\n"),
            "V\n0\nVEND:Hokuyo Automatic Co.,Ltd.\nPROD:SOKUIKI Sensor URG-04LX\n"
            "FIRM:3.1.04,07/08/02(20-4095[mm],240[deg],44-725[step],600[rpm])\nPROT:00003,(SCIP 1.0)\n"
            "SERI:H0706400\nSTAT:Sensor works well.\n\n");
}

TEST(Scip2Dialogue, Scip1MeasuresWithTwoCharactersAndNoSums) {
  Bench d;
  EXPECT_EQ(d.ask("L1\n"), "L1\n0\n\n");
  const std::string reply = d.ask("G04407501\n", 200);
  std::string wanted = "G04407501\n0\n";
  for (int i = 0; i < 32; ++i) wanted += "?X";
  EXPECT_EQ(reply, wanted + "\n\n");
  const std::string full = d.ask("G00076801\n", 200);
  EXPECT_EQ(full.size(), 12 + 769 * 2 + 25 + 1u);
  EXPECT_EQ(d.ask("S1152000000000\n"), "S1152000000000\n0\n\n");
}

TEST(Scip2Dialogue, AStrictScip1StartKnowsNothingElse) {
  Model strict = urg_04lx();
  strict.start = Start::scip1;
  Bench d(strict);
  EXPECT_EQ(d.ask("QT\n"), "QT\nE\n\n");
  EXPECT_EQ(d.ask("VV\n"), "VV\nE\n\n");
  EXPECT_EQ(d.ask("SCIP2.0\n"), "SCIP2.0\n0\n\n");
  EXPECT_EQ(d.ask("QT\n"), "QT\n00P\n\n");
  EXPECT_EQ(d.ask("V\n"), "V\n0Dd\n\n");
}

TEST(Scip2Dialogue, EchoesStringsToo) { EXPECT_EQ(Awake().ask("QT;a.b_c+d@e 9\n"), "QT;a.b_c+d@e 9\n00P\n\n"); }

TEST(Scip2Dialogue, RealFirmwareAnswersCr00AndHsSo) {
  Awake d;
  EXPECT_EQ(d.ask("CR00\n"), "CR00\n03S\n\n");
  EXPECT_EQ(d.ask("HS0\n"), "HS0\n0Cc\n\n");
  EXPECT_EQ(d.ask("GD0044072501\n"), "GD0044072501\n10Q\n\n");
}

TEST(Scip2Dialogue, AFullScanOfThreeCharactersHas2134Bytes) {
  Awake d;
  for (std::size_t i = 0; i < d.scan.size(); ++i) d.scan[i] = std::uint32_t(5432);
  d.ask("BM\n");
  const std::string reply = d.ask("GD0044072501\n", 200);
  EXPECT_EQ(reply.size(), 2134u);
  EXPECT_EQ(reply.substr(0, 17), "GD0044072501\n00P\n");
  EXPECT_EQ(reply.substr(23, 64), "1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1Dh1");
}

TEST(Scip2Dialogue, AnEmptyLineGetsNoReply) {
  Awake d;
  EXPECT_EQ(d.ask("\n\n\nBM\n\n"), "BM\n00P\n\n");
}

TEST(Scip2Dialogue, SeveralCommandsAreAnsweredInTurnAndRepeatedOnesOnce) {
  Awake d;
  EXPECT_EQ(d.ask("BM\nTM9\nBM\nQT\nQT\n"), "BM\n00P\n\nTM9\n01Q\n\nBM\n0Bb\n\nQT\n00P\n\nQT\n0Bb\n\n");
  EXPECT_EQ(d.ask("QT\n"), "QT\n00P\n\n");
}

}  // namespace
}  // namespace muro::scip2
