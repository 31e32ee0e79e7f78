// SPDX-License-Identifier: MIT
// Messages that drivers send and expect, in their order: urg_library (also used by urg_node and urg_node2), hokuyoaist,
// hokuyolx, MRPT, hokuyo_node. Each waits for a line at most as long as in its own code.
#include <algorithm>

#include "scip2_testing.hpp"

namespace muro::scip2 {
namespace {

/// A client that reads lines, each within a time.
struct Client : Bench {
  explicit Client(Model m = urg_04lx()) : Bench(std::move(m)) { run(6); }

  void write(const std::string& lines) { type(lines); }
  /// Returns the next line; nothing when none comes within `timeout` ms.
  std::optional<std::string> line(std::int64_t timeout) {
    for (std::int64_t waited = 0; output.find('\n') == std::string::npos; ++waited) {
      if (waited == timeout) return std::nullopt;
      run(1);
    }
    const std::size_t end = output.find('\n');
    const std::string first = output.substr(0, end);
    output.erase(0, end + 1);
    return first;
  }
  /// Returns a complete reply without the echo, which must equal the command.
  std::vector<std::string> reply_to(const std::string& command, std::int64_t timeout) {
    write(command + "\n");
    EXPECT_EQ(line(timeout).value_or("nothing"), command);
    return rest(timeout);
  }
  std::vector<std::string> rest(std::int64_t timeout) {
    std::vector<std::string> lines;
    do {
      lines.push_back(line(timeout).value_or("nothing"));
    } while (!lines.back().empty() && lines.back() != "nothing");
    EXPECT_EQ(lines.back(), "") << "no end within " << timeout << " ms";
    return lines;
  }
};

std::size_t data_of(const std::vector<std::string>& lines) {
  std::size_t characters = 0;
  for (std::size_t i = 2; i + 1 < lines.size(); ++i) {
    EXPECT_EQ(lines[i].back(), expected_sum(lines[i].substr(0, lines[i].size() - 1)));
    characters += lines[i].size() - 1;
  }
  return characters;
}

/// Connects as urg_library. A line end alone clears the line without an answer; QT finds the bit rate. Without the
/// echo, PP must have ten lines, VV seven, II nine. It waits 140 ms for a line until PP has returned the scan period.
void connect_as_urg_library(Client& c, const std::string& window) {
  c.write("\n");
  EXPECT_EQ(c.line(140), std::nullopt);
  const std::vector<std::string> stop = c.reply_to("QT", 140);
  ASSERT_EQ(stop.size(), 2u);
  if (stop[0] == "E") {
    EXPECT_EQ(c.reply_to("SCIP2.0", 140)[0], "0");
  } else {
    EXPECT_EQ(stop[0], "00P");
  }
  EXPECT_EQ(c.reply_to("PP", 140).size(), 10u);
  EXPECT_EQ(c.reply_to("VV", 1600).size(), 7u);
  const std::vector<std::string> status = c.reply_to("II", 1600);
  EXPECT_EQ(status.size(), 9u);
  const std::string& diagnosis = status[7];
  EXPECT_TRUE(diagnosis.rfind("STAT:Sensor works well", 0) == 0 ||
              diagnosis.rfind("STAT:sensor is working normally", 0) == 0)
      << diagnosis;

  EXPECT_EQ(c.reply_to("BM", 1600)[0], "00P");
  const std::vector<std::string> one = c.reply_to("GD" + window + "01", 1600);
  EXPECT_EQ(one[0], "00P");
  EXPECT_EQ(data_of(one), 3 * c.device.model().step_count());

  EXPECT_EQ(c.reply_to("ME" + window + "01000", 1600)[0], "00P");
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(c.line(1600), "ME" + window + "01000");
    const std::vector<std::string> scan = c.rest(1600);
    EXPECT_EQ(scan[0], "99b");
    EXPECT_EQ(data_of(scan), 6 * c.device.model().step_count());
  }
  c.write("QT\n");
  int scans = 0;
  while (c.line(1600) != "QT") {
    ASSERT_LT(++scans, 3) << "the driver gives up after three replies";
    c.rest(1600);
  }
  EXPECT_EQ(c.rest(1600)[0], "00P");
}

TEST(Scip2Handshake, UrgLibraryConnectsMeasuresAndStops) {
  Client c;
  connect_as_urg_library(c, "00440725");
  EXPECT_EQ(c.reply_to("TM0", 1600)[0], "00P");
  EXPECT_EQ(c.reply_to("TM1", 1600)[1].size(), 5u);
  EXPECT_EQ(c.reply_to("TM2", 1600)[0], "00P");
}

TEST(Scip2Handshake, UrgLibraryConnectsToAStrictScip1Start) {
  Model m = urg_04lx();
  m.start = Start::scip1;
  Client c(m);
  connect_as_urg_library(c, "00440725");
}

TEST(Scip2Handshake, UrgLibraryConnectsToOtherModels) {
  for (const Model& m : {utm_30lx(), ust_10lx()}) {
    Client c(m);
    connect_as_urg_library(c, "00001080");
  }
}

TEST(Scip2Handshake, UrgLibraryFindsADeviceThatIsMeasuringOrAdjusting) {
  Client measuring;
  measuring.ask("SCIP2.0\n");
  measuring.ask("MD0044072501000\n", 730);
  measuring.write("QT\n");
  std::optional<std::string> line;
  for (int i = 0; i < 100 && line != "QT"; ++i) line = measuring.line(140);
  EXPECT_EQ(line, "QT");
  EXPECT_EQ(measuring.rest(140)[0], "00P");
  Client adjusting;
  adjusting.ask("SCIP2.0\nTM0\n");
  EXPECT_EQ(adjusting.reply_to("QT", 140)[0], "0Ee");
  EXPECT_EQ(adjusting.reply_to("TM2", 140)[0], "00P");
}

/// Connects as hokuyoaist. It asks for the version in SCIP 2.0 and, if that fails, in 1.1. Then it reads VV, PP, II
/// line by line. It refuses unknown keys, and a speed or bit rate that it cannot read.
void connect_as_hokuyoaist(Client& c) {
  c.write("VV\n");
  EXPECT_EQ(c.line(1000), "VV");
  const std::string status = c.line(1000).value_or("");
  if (status != "00P") {
    c.output.clear();
    c.write("V\n");
    EXPECT_EQ(c.line(1000), "V");
    EXPECT_EQ(c.line(1000), "0");
    c.line(1000), c.line(1000);
    EXPECT_EQ(c.line(1000).value_or("").rfind("FIRM:3", 0), 0u);
    c.run(10);
    c.output.clear();
    EXPECT_EQ(c.reply_to("SCIP2.0", 1000)[0], "0");
  } else {
    EXPECT_EQ(c.rest(1000).size(), 6u);
  }
  const std::pair<const char*, std::vector<std::string>> known[] = {
      {"VV", {"VEND", "PROD", "FIRM", "PROT", "SERI"}},
      {"PP", {"MODL", "DMIN", "DMAX", "ARES", "AMIN", "AMAX", "AFRT", "SCAN"}},
      {"II", {"MODL", "LASR", "SCSP", "MESM", "SBPS", "TIME", "STAT"}}};
  for (const auto& [command, keys] : known) {
    const std::vector<std::string> lines = c.reply_to(command, 1000);
    ASSERT_EQ(lines.size(), keys.size() + 2);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::string& text = lines[i + 1];
      EXPECT_EQ(text.substr(0, 5), keys[i] + ":");
      EXPECT_EQ(text.substr(text.size() - 2), std::string(";") + expected_sum(text.substr(0, text.size() - 2)));
      int rpm = 0, rate = 0;
      if (keys[i] == "SCSP") {
        EXPECT_EQ(std::sscanf(text.c_str(), "SCSP:%*7s(%d[rpm]", &rpm), 1) << text;
      }
      if (keys[i] == "SBPS" && text.find("USB Full Speed") == text.npos) {
        EXPECT_EQ(std::sscanf(text.c_str(), "SBPS:%d[bps]", &rate), 1) << text;
      }
    }
  }
}

TEST(Scip2Handshake, HokuyoaistConnectsInEveryStart) {
  for (const Start start : {Start::scip1, Start::scip2, Start::either}) {
    Model m = urg_04lx();
    m.start = start;
    Client c(m);
    connect_as_hokuyoaist(c);
  }
  Client usb(utm_30lx());
  connect_as_hokuyoaist(usb);
}

TEST(Scip2Handshake, HokuyoaistTakesNewScansAndTheTime) {
  Client c;
  connect_as_hokuyoaist(c);
  EXPECT_EQ(c.reply_to("BM", 1000)[0], "00P");
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(c.reply_to("MD0044072501101", 1000)[0], "00P");
    EXPECT_EQ(c.line(1000), "MD0044072501100") << "it compares the parameters with 00 scans to come";
    const std::vector<std::string> scan = c.rest(1000);
    EXPECT_EQ(scan[0], "99b");
    EXPECT_EQ(data_of(scan), 3 * 682u);
  }
  EXPECT_EQ(c.reply_to("TM0", 1000)[0], "00P");
  c.write("TM1\n");
  c.run(100);
  EXPECT_EQ(c.output.size(), 15u) << "it reads fifteen bytes at once";
  c.output.clear();
  EXPECT_EQ(c.reply_to("TM2", 1000)[0], "00P");
}

/// Connects as hokuyolx, for the UST series. It reads the state by %ST and the time ten times, and PP as "key:value"
/// with one colon. For it a reply ends when the received bytes end with two line ends.
TEST(Scip2Handshake, HokuyolxSynchronisesActivatesAndIterates) {
  Client c(ust_10lx());
  EXPECT_EQ(c.reply_to("%ST", 5000)[1].substr(0, 3), "000");
  EXPECT_EQ(c.reply_to("TM0", 5000)[0], "00P");
  for (int i = 0; i < 10; ++i) EXPECT_EQ(c.reply_to("TM1", 5000)[1].size(), 5u);
  EXPECT_EQ(c.reply_to("TM2", 5000)[0], "00P");
  for (const std::string command : {"PP", "II", "VV"}) {
    const std::vector<std::string> lines = c.reply_to(command, 5000);
    for (std::size_t i = 1; i + 1 < lines.size(); ++i)
      EXPECT_EQ(std::count(lines[i].begin(), lines[i].end() - 2, ':'), 1);
  }
  EXPECT_EQ(c.reply_to("BM", 5000)[0], "00P");
  EXPECT_EQ(data_of(c.reply_to("GE0000108000", 5000)), 6 * 1081u);
  EXPECT_EQ(c.reply_to("MD0000108000005", 5000)[0], "00P");
  for (int left = 4; left >= 0; --left) {
    EXPECT_EQ(c.line(5000), "MD000010800000" + std::to_string(left));
    EXPECT_EQ(data_of(c.rest(5000)), 3 * 1081u);
  }
}

/// MRPT: searches the echo of its command, then the status, then two line ends. Waits 200 ms on a serial line.
struct MrptClient : Client {
  explicit MrptClient(Model m) : Client(std::move(m)) {}
  bool response() {
    while (true) {
      const std::optional<std::string> text = line(200);
      if (!text) return false;
      if (*text == command) break;
    }
    lines = rest(200);
    return lines[0].size() == 1 || lines[0][0] == '0' || lines[0][0] == '9';
  }
  bool say(const std::string& text) {
    command = text;
    write(text + "\n");
    return response();
  }
  std::string command;
  std::vector<std::string> lines;
};

TEST(Scip2Handshake, MrptTurnsOnAndReceivesScans) {
  for (const Start start : {Start::either, Start::scip2}) {
    Model m = urg_04lx();
    m.start = start;
    MrptClient c(m);
    for (const char* text : {"QT", "QT", "SS115200", "SCIP2.0", "SCIP2.0", "BM", "CR05", "HS0", "PP", "VV"})
      EXPECT_TRUE(c.say(text)) << text;
    ASSERT_TRUE(c.say("MD0044072501000"));
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(c.response());
      EXPECT_EQ(c.lines[0], "99b");
      EXPECT_EQ(data_of(c.lines), 682 * 3u);
    }
    EXPECT_TRUE(c.say("QT"));
  }
}

/// Connects as hokuyo_node. TM2 and RS must return a number as status; then it sends RS again and asks for the
/// parameters. Three scans in a row must not have the same time.
TEST(Scip2Handshake, HokuyoNodeResetsConfiguresAndScans) {
  Client c;
  EXPECT_EQ(c.reply_to("TM2", 1000)[0], "03S");
  EXPECT_EQ(c.reply_to("RS", 1000)[0], "00P");
  EXPECT_EQ(c.reply_to("RS", 1000)[0], "00P");
  const std::vector<std::string> parameters = c.reply_to("PP", 1000);
  const char* order[] = {"DMIN:20", "DMAX:5600", "ARES:1024", "AMIN:44", "AMAX:725", "AFRT:384", "SCAN:600"};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(parameters[i + 2].rfind(order[i], 0), 0u);
  EXPECT_EQ(c.reply_to("VV", 1000)[0], "00P");
  EXPECT_EQ(c.reply_to("II", 1000)[0], "00P");
  EXPECT_EQ(c.reply_to("BM", 1000)[0], "00P");
  std::string last;
  for (int i = 0; i < 4; ++i) {
    const std::vector<std::string> scan = c.reply_to("GD0044072501", 1000);
    EXPECT_EQ(data_of(scan), 682 * 3u);
    EXPECT_NE(scan[1], last);
    last = scan[1];
  }
  EXPECT_EQ(c.reply_to("MD0044072501099", 1000)[0], "00P");
  for (int left = 98; left >= 90; --left) {
    EXPECT_EQ(c.line(1000), "MD00440725010" + std::to_string(left));
    EXPECT_EQ(data_of(c.rest(1000)), 682 * 3u);
  }
  c.write("RS\n");
  while (c.line(1000).value_or("RS") != "RS") continue;
  EXPECT_EQ(c.rest(1000)[0], "00P") << "it skips lines up to the echo";
}

}  // namespace
}  // namespace muro::scip2
