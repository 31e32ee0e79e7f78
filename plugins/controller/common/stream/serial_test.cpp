// SPDX-License-Identifier: MIT
// The bit rate of serial devices. A terminal represents the device; its master shows the settings.
#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>

#include <future>
#include <thread>

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "plugins/controller/common/stream/io_thread.hpp"

namespace muro::stream {
namespace {

struct SerialLine : ::testing::Test {
  Peer far_end{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
  std::string device;
  void SetUp() override {
    ::grantpt(far_end.fd);
    ::unlockpt(far_end.fd);
    device = "serial=" + std::string(::ptsname(far_end.fd));
  }
  speed_t speed() const {
    termios settings{};
    EXPECT_EQ(::tcgetattr(far_end.fd, &settings), 0);
    return ::cfgetospeed(&settings);
  }
};

/// Keeps the I/O thread busy from the end of the constructor until it is released.
struct BusyIo {
  BusyIo() {
    std::promise<void> begun;
    thread = std::thread([&] {
      io->call([&] {
        begun.set_value();
        released.get_future().wait();
      });
    });
    begun.get_future().wait();
  }
  ~BusyIo() { release(); }
  void release() {
    if (!thread.joinable()) return;
    released.set_value();
    thread.join();
  }
  const std::shared_ptr<IoThread> io = IoThread::shared();
  std::promise<void> released;
  std::thread thread;
};

TEST_F(SerialLine, ChangesItsRateAndGoesBackToItsFirst) {
  Echo echo({device, "baud=19200"});
  EXPECT_EQ(speed(), speed_t(B19200));
  EXPECT_TRUE(far_end.say("SS115200\n"));
  EXPECT_TRUE(echo.run_until([&] { return far_end.hear() == "SS115200\n"; }));
  echo.stream.set_baud(115200);
  EXPECT_TRUE(echo.run_until([&] { return speed() == B115200; }));
  EXPECT_TRUE(far_end.say("on\n"));
  EXPECT_TRUE(echo.run_until([&] { return far_end.hear() == "SS115200\non\n"; }));
  echo.stream.set_baud(0);
  EXPECT_TRUE(echo.run_until([&] { return speed() == B19200; }));
}

TEST_F(SerialLine, ReturnsToTheRateThatItWasFoundWith) {
  termios settings{};
  ::tcgetattr(far_end.fd, &settings);
  ::cfsetspeed(&settings, B57600);
  ::tcsetattr(far_end.fd, TCSANOW, &settings);
  Echo echo({device});
  EXPECT_EQ(speed(), speed_t(B57600));
  echo.stream.set_baud(38400);
  EXPECT_TRUE(echo.run_until([&] { return speed() == B38400; }));
  echo.stream.set_baud(123);  // there is no such rate: the old one stays
  echo.stream.set_baud(0);
  EXPECT_TRUE(echo.run_until([&] { return speed() == B57600; }));
}

TEST_F(SerialLine, GivesTheLastBytesTheirTimeToLeaveTheHardware) {
  Echo echo({device, "baud=1200"});
  const auto begin = std::chrono::steady_clock::now();
  echo.stream.set_baud(9600);
  EXPECT_TRUE(echo.run_until([&] { return speed() == B9600; }));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(133)) << "16 characters";
}

/// The stream has got a new rate before. The I/O thread handles it only after the reply was sent.
TEST_F(SerialLine, SendsAReplyAtTheRateBefore) {
  Echo echo({device, "baud=19200"});
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  const Peer same_device(::open(::ptsname(far_end.fd), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  std::size_t before = 0;
  for (int i = 0; i < 20; ++i) {  // until the line takes no more, also after the system has moved its buffers
    for (ssize_t size = 0; (size = ::write(same_device.fd, "x", 1)) > 0;) before += std::size_t(size);
    usleep(1000);
  }
  {
    const BusyIo busy;
    echo.stream.set_baud(57600);
    echo.stream.send(0, "reply\n");
    echo.stream.set_baud(115200);
  }
  for (int i = 0; i < 50; ++i) {
    usleep(1000);
    ASSERT_EQ(speed(), speed_t(B19200)) << "the reply has not left";
  }
  EXPECT_TRUE(echo.run_until([&] { return far_end.hear().size() == before + 6; })) << far_end.heard.size();
  EXPECT_TRUE(echo.run_until([&] { return speed() == B115200; }));
}

TEST_F(SerialLine, DoesNotChangeItsRateOnceItIsClosed) {
  std::optional<Echo> echo(std::in_place, std::vector<std::string_view>{device, "baud=1200"});
  EXPECT_TRUE(echo->run_until([&] { return echo->count(Event::Kind::connected) == 1; }));
  echo->stream.set_baud(115200);
  BusyIo busy;
  std::thread closing([&] { echo.reset(); });
  usleep(200000);  // the change is due now, but the close comes first
  busy.release();
  closing.join();
  EXPECT_EQ(speed(), speed_t(B1200));
}

}  // namespace
}  // namespace muro::stream
