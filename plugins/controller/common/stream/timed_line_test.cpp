// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/timed_line.hpp"

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

constexpr std::int64_t ms = 1'000'000;

TEST(TimedLine, TakesTenBitTimesAByte) {
  TimedLine line(9600);
  EXPECT_EQ(line.put(5 * ms, 96), 105 * ms);
  EXPECT_EQ(line.put(50 * ms, 96), 205 * ms);  // after the bytes that are on the line
  EXPECT_EQ(line.advance(5 * ms), 0);
  EXPECT_EQ(line.advance(6 * ms), 0);  // 0.96 bytes
  EXPECT_EQ(line.advance(7 * ms), 1);
  EXPECT_EQ(line.advance(105 * ms), 95);
  EXPECT_EQ(line.advance(1000 * ms), 96);
  EXPECT_EQ(line.put(1000 * ms, 1), 1000 * ms + 1'041'667);  // rounded up
}

TEST(TimedLine, KeepsTimeForEver) {
  TimedLine line(115200);
  std::uint64_t passed = 0;
  std::int64_t now = 0;
  std::int64_t end = 0;
  for (int i = 0; i < 10'000; ++i) {
    now = std::int64_t(i) * 10 * ms;
    passed += line.advance(now);
    end = line.put(now, 120);  // 115.2 are enough: the line is never idle
  }
  EXPECT_EQ(passed, std::uint64_t(std::int64_t(11520) * now / 1'000'000'000));
  EXPECT_NEAR(double(end), 1.2e6 / 11520 * 1e9, 2);
}

TEST(TimedLine, ChangesItsRate) {
  TimedLine line(9600);
  line.put(0, 20);
  EXPECT_EQ(line.advance(10 * ms), 9);  // 9.6
  line.set_baud(10 * ms, 96000);
  EXPECT_EQ(line.end(), 10 * ms + 1'145'834);
  EXPECT_EQ(line.advance(12 * ms), 11);
}

struct TimedStream : testing::Test {
  test::ScratchFolder folder;
  const std::string text = "unix=" + folder.path("timed.sock");
};

TEST_F(TimedStream, DelaysWhatComesAndWhatGoes) {
  Echo echo({text, "timed=true", "baud=10000"});  // a byte each millisecond
  Peer peer = Peer::unix_socket(folder.path("timed.sock"));
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  EXPECT_TRUE(peer.say("123456789\nabc\n"));
  while (echo.stream.statistics().messages < 2) usleep(100);
  const std::int64_t begin = echo.time;
  std::vector<std::int64_t> heard_at;  // arrival of the bytes of the answer
  for (int i = 0; i < 40; ++i) {
    echo.step();
    usleep(1000);
    for (peer.hear(); heard_at.size() < peer.heard.size();) heard_at.push_back((echo.time - ms - begin) / ms);
  }
  ASSERT_EQ(echo.heard.size(), 3);
  EXPECT_EQ(echo.heard[1].bytes, "123456789\n");
  EXPECT_EQ(echo.heard[1].time - begin, 10 * ms);
  EXPECT_EQ(echo.heard[2].bytes, "abc\n");
  EXPECT_EQ(echo.heard[2].time - begin, 14 * ms);
  EXPECT_EQ(peer.heard, "123456789\nabc\n");
  for (std::size_t i = 0; i < heard_at.size(); ++i) EXPECT_GE(heard_at[i], std::int64_t(11 + i));
  EXPECT_LE(heard_at.back(), 24 + 3);  // the exact time also depends on when the wall clock lets it be read
}

TEST_F(TimedStream, ChangesItsRate) {
  Echo echo({text, "timed=true", "baud=10000"});
  Peer peer = Peer::unix_socket(folder.path("timed.sock"));
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  echo.stream.send(0, std::string(1000, 'x'));
  for (int i = 0; i < 10; ++i) echo.step();
  EXPECT_TRUE((usleep(5000), peer.hear().size() == 10)) << peer.heard.size();
  echo.stream.set_baud(1000000);
  for (int i = 0; i < 5; ++i) echo.step();
  EXPECT_TRUE((usleep(5000), peer.hear().size() == 510)) << peer.heard.size();
  echo.stream.set_baud(0);  // 0: the rate at the start
  for (int i = 0; i < 10; ++i) echo.step();
  EXPECT_TRUE((usleep(5000), peer.hear().size() == 520)) << peer.heard.size();
  echo.stream.set_baud(1000000);
  echo.stream.disconnect(0);  // takes effect when all bytes have passed
  for (int i = 0; i < 4; ++i) echo.step();
  EXPECT_TRUE((usleep(5000), peer.hear().size() == 920 && !peer.is_closed)) << peer.heard.size();
  EXPECT_TRUE(echo.run_until([&] { return peer.hear().size() == 1000 && peer.is_closed; }));
}

TEST_F(TimedStream, GoesOnAfterAReset) {
  Echo echo({text, "timed=true", "baud=10000"});
  Peer peer = Peer::unix_socket(folder.path("timed.sock"));
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  echo.time = 1000 * ms;
  echo.step();
  echo.stream.send(0, "0123456789");
  echo.time = 0;
  echo.step();
  for (int i = 0; i < 5; ++i) echo.step();
  EXPECT_TRUE((usleep(5000), peer.hear() == "01234")) << peer.heard;
}

}  // namespace

}  // namespace muro::stream
