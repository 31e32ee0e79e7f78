// SPDX-License-Identifier: MIT
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <termios.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

std::string all_bytes() {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += char(i);
  return "\r\n\x03\x04" + bytes + "\n\r";
}

struct PseudoTerminal : testing::Test {
  test::ScratchFolder folder;
  const std::string path = folder.path("rover_3.laser");
  const std::string text = "pty=" + folder.path("{robot}.laser");
  std::string target() const {
    char name[256];
    const ssize_t size = ::readlink(path.c_str(), name, sizeof name);
    return std::string(name, size < 0 ? 0 : std::size_t(size));
  }
  bool is_there() const { return !target().empty(); }
};

TEST_F(PseudoTerminal, HandsOnEveryByteAsItIs) {
  std::optional<Echo> echo(std::in_place, std::vector<std::string_view>{text}, Framing{});
  Peer peer = Peer::file(path);
  EXPECT_TRUE(peer.say(all_bytes()));  // also when nothing has noticed the client yet
  EXPECT_TRUE(echo->run_until([&] { return peer.hear() == all_bytes(); })) << peer.heard.size();
  std::string said;
  for (const Heard& h : echo->heard) said += h.bytes;
  EXPECT_EQ(said, all_bytes());
  echo.reset();
  EXPECT_FALSE(is_there());
}

TEST_F(PseudoTerminal, TellsWhenClientsComeAndGo) {
  Echo echo({text});
  const std::size_t before = open_descriptors();
  for (int i = 0; i < 30; ++i) EXPECT_TRUE((usleep(100), echo.step(), echo.heard.empty()));  // no client has opened it
  for (std::uint32_t i = 0; i < 5; ++i) {
    Peer peer = Peer::file(path);
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == i + 1; }));
    EXPECT_EQ(echo.heard.back().client, i);
    echo.stream.send_to_all("measurement\n");
    EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "measurement\n"; }));
    EXPECT_TRUE(peer.say("thanks\n"));
    peer.close();
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == i + 1; }));
    EXPECT_EQ(echo.count(Event::Kind::message), i + 1);
    const std::size_t events = echo.heard.size();
    echo.stream.send_to_all("to nobody\n");
    for (int k = 0; k < 10; ++k) echo.step();
    EXPECT_EQ(echo.heard.size(), events);
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST_F(PseudoTerminal, HearsWhoIsGoneAtOnce) {
  Echo echo({text});
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_TRUE(Peer::file(path).say("short " + std::to_string(i) + "\n"));
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::message) == i + 1; }));
  }
  EXPECT_TRUE(
      echo.run_until([&] { return echo.count(Event::Kind::disconnected) == echo.count(Event::Kind::connected); }));
}

TEST_F(PseudoTerminal, KeepsWhatAClientSetsAndStaysRaw) {
  Echo echo({text});
  for (const speed_t speed : {B19200, B115200}) {
    Peer peer = Peer::file(path);
    termios settings{};
    EXPECT_EQ(::tcgetattr(peer.fd, &settings), 0);
    EXPECT_EQ(settings.c_lflag & tcflag_t(ECHO | ICANON | ISIG | IEXTEN), 0u);
    EXPECT_EQ(settings.c_iflag & tcflag_t(ICRNL | INLCR | IGNCR | IXON | ISTRIP), 0u);
    EXPECT_EQ(settings.c_oflag & tcflag_t(OPOST), 0u);
    if (speed == B115200) {
      EXPECT_EQ(::cfgetospeed(&settings), B19200);
    }
    ::cfsetspeed(&settings, speed);
    EXPECT_EQ(::tcsetattr(peer.fd, TCSAFLUSH, &settings), 0);
    EXPECT_TRUE(peer.say("a\r"));
    EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "a\r"; }));
    peer.close();
    EXPECT_TRUE(
        echo.run_until([&] { return echo.count(Event::Kind::disconnected) == echo.count(Event::Kind::connected); }));
  }
}

TEST_F(PseudoTerminal, IsFreeAgainAfterAClientThatHadItToItself) {
  Echo echo({text});
  for (std::size_t i = 1; i < 4; ++i) {
    Peer peer = Peer::file(path);
    EXPECT_EQ(::ioctl(peer.fd, TIOCEXCL), 0);
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == i; }));
    peer.close();
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == i; }));
    usleep(5000);
    const pid_t child = ::fork();
    if (child == 0) {  // root could open the terminal in any case
      static_cast<void>(!::seteuid(65534));
      ::_exit(::open(path.c_str(), O_RDONLY | O_NOCTTY | O_NONBLOCK) < 0 && errno == EBUSY ? 1 : 0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
}

TEST_F(PseudoTerminal, DoesNotHandOnWhatTheLastClientHasNotRead) {
  Echo echo({text});
  Peer first = Peer::file(path);
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  echo.stream.send_to_all("for the first\n");
  usleep(20000);
  first.close();
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == 1; }));
  usleep(5000);
  Peer second = Peer::file(path);
  EXPECT_TRUE(second.say("second\n"));
  EXPECT_TRUE(echo.run_until([&] { return second.hear().ends_with("second\n"); }));
  EXPECT_EQ(second.heard, "second\n");
}

TEST_F(PseudoTerminal, IsNotDisturbedByAClientThatReadsNothing) {
  Echo echo({text}, {line_size}, {.output_bytes = 100000});
  Peer peer = Peer::file(path);
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  const std::string line = std::string(999, 'x') + "\n";
  std::size_t taken = 0;
  for (int i = 0; i < 1000; ++i) {
    taken += echo.stream.send(0, line) ? 1 : 0;
    if (i % 50 == 0) usleep(1000);
    echo.step();
  }
  EXPECT_LT(taken, 500);
  EXPECT_EQ(echo.stream.statistics().dropped, 1000 - taken);
  EXPECT_TRUE(echo.run_until([&] { return peer.hear().size() == taken * 1000; })) << peer.heard.size();
  EXPECT_TRUE(peer.say("and on\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear().ends_with("xxx\nand on\n"); }));
}

TEST_F(PseudoTerminal, HangsUpOnGarbage) {
  Echo echo({text}, {[](std::string_view bytes, bool) { return bytes[0] == '!' ? Framing::invalid : bytes.size(); }});
  const std::string before = target();
  Peer bad = Peer::file(path);
  EXPECT_TRUE(bad.say("!"));
  EXPECT_TRUE(echo.run_until([&] { return bad.hear().empty() && bad.is_closed; }));
  EXPECT_TRUE(echo.run_until([&] { return is_there() && target() != before; }));
  EXPECT_EQ(echo.stream.statistics().disconnected, 1);
  Peer good = Peer::file(path);
  EXPECT_TRUE(good.say("fine"));
  EXPECT_TRUE(echo.run_until([&] { return good.hear() == "fine"; }));
}

TEST_F(PseudoTerminal, ReplacesLinksThatWereLeftBehind) {
  ASSERT_EQ(::symlink("/dev/pts/99999", path.c_str()), 0);  // link to a terminal that is gone
  { Echo echo({text}); }
  const pid_t child = ::fork();
  if (child == 0) {
    Echo echo({text});
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status) && is_there());
  const int other = ::posix_openpt(O_RDWR | O_NOCTTY);  // gets the number of the terminal that is gone
  Echo echo({text});
  Peer peer = Peer::file(path);
  EXPECT_TRUE(peer.say("a\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "a\n"; }));
  ::close(other);
}

TEST_F(PseudoTerminal, LeavesFilesAndLinksOfOthers) {
  {
    Echo echo({text});
    EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({text}); }), "another stream has this name");
    Peer peer = Peer::file(path);
    EXPECT_TRUE(peer.say("a\n"));
    EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "a\n"; }));
    ::unlink(path.c_str());
    std::ofstream(path) << "precious";
  }
  EXPECT_EQ(test::text_of(path), "precious");
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({text}); }), "is no link to a terminal");
  EXPECT_EQ(test::text_of(path), "precious");
  ::unlink(path.c_str());
  for (const std::string& where : {folder.path("precious"), std::string("/dev/null"), std::string("/dev/pts/ptmx")}) {
    ASSERT_EQ(::symlink(where.c_str(), path.c_str()), 0);
    EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({text}); }), "`" + where + "`, which muro has not made");
    EXPECT_EQ(target(), where);
    ::unlink(path.c_str());
  }
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({"pty=/no/such/folder/laser"}); }),
              "the link to it cannot be made: there is no folder `/no/such/folder`; create it, or choose another path");
}

/// A serial device; the test's own terminal replaces the hardware.
struct SerialDevice : testing::Test {
  Peer line{::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)};
  std::string device;
  void SetUp() override {
    ::grantpt(line.fd);
    ::unlockpt(line.fd);
    device = ::ptsname(line.fd);
  }
};

TEST_F(SerialDevice, HandsOnEveryByteAsItIs) {
  const std::string serial = "serial=" + device;
  Echo echo({serial, "baud=115200"}, {});
  termios settings{};
  ASSERT_EQ(::tcgetattr(line.fd, &settings), 0);  // a master reports the settings of its terminal
  EXPECT_EQ(::cfgetospeed(&settings), B115200);
  EXPECT_TRUE(line.say(all_bytes()));
  EXPECT_TRUE(echo.run_until([&] { return line.hear() == all_bytes(); }));
  EXPECT_EQ(echo.heard[0].kind, Event::Kind::connected);
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({serial}); }), "another program has locked it");
}

TEST_F(SerialDevice, IsOpenedAgainWhenItComesBack) {
  test::ScratchFolder folder;
  const std::string name = folder.path("ttyUSB0");
  ASSERT_EQ(::symlink(device.c_str(), name.c_str()), 0);
  const std::string serial = "serial=" + name;
  Echo echo({serial});
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  line.close();
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == 1; }));
  ::unlink(name.c_str());
  usleep(300000);
  Peer back(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC));
  ::grantpt(back.fd);
  ::unlockpt(back.fd);
  ASSERT_EQ(::symlink(::ptsname(back.fd), name.c_str()), 0);
  EXPECT_TRUE(back.say("back\n"));
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 2; }));
  EXPECT_TRUE(back.say("back\n"));
  EXPECT_TRUE(echo.run_until([&] { return back.hear().ends_with("back\n"); }));
}

TEST_F(SerialDevice, MustBeOne) {
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({"serial=/dev/null"}); }), "`/dev/null`: it is no serial device");
  EXPECT_SAYS(test::complaint_of<Error>([&] { Echo({"serial=/dev/ttyNONE"}); }), "No such file or directory");
}

}  // namespace

}  // namespace muro::stream
