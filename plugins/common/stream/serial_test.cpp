// SPDX-License-Identifier: MIT
// The bit rate of serial devices. A terminal stands for the device: its master tells how it is set.
#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>

#include "plugins/common/stream/echo_testing.hpp"

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
  echo.stream.set_baud(123);  // there is no such rate: it stays
  echo.stream.set_baud(0);
  EXPECT_TRUE(echo.run_until([&] { return speed() == B57600; }));
}

}  // namespace
}  // namespace muro::stream
