// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/complaint.hpp"

namespace muro::stream {

namespace {

Address read(const std::vector<std::string_view>& texts, const std::string& robot = "rover_3") {
  return read_address(FakeConnector({"other", robot}), 1, texts);
}
std::string complaint(const std::vector<std::string_view>& texts, const std::string& robot = "rover_3") {
  return test::complaint_of<Error>([&] { read(texts, robot); });
}

TEST(Address, OfTcp) {
  const Address plain = read({"tcp=4001"});
  EXPECT_EQ(plain.kind, Address::Kind::tcp_server);
  EXPECT_EQ(plain.text(), "tcp 127.0.0.1:4001");
  EXPECT_TRUE(plain.is_loopback());
  EXPECT_EQ(plain.clients, 8);
  EXPECT_EQ(read({"tcp=0.0.0.0:4001"}).text(), "tcp 0.0.0.0:4001");
  EXPECT_FALSE(read({"tcp=0.0.0.0:4001"}).is_loopback());
  EXPECT_EQ(read({"tcp=[::1]:4001"}).host, "::1");
  EXPECT_TRUE(read({"tcp=[::1]:4001"}).is_loopback());
  EXPECT_EQ(read({"tcp=[::]:4001"}).text(), "tcp [::]:4001");
  EXPECT_TRUE(read({"tcp=localhost:4001"}).is_loopback());
  const Address client = read({"connect=robot.local:10940", "lockstep=team", "timeout=2.5", "on_timeout=go_on"});
  EXPECT_EQ(client.kind, Address::Kind::tcp_client);
  EXPECT_EQ(client.text(), "connect robot.local:10940");
  EXPECT_EQ(client.lockstep, "team");
  EXPECT_EQ(client.timeout, 2.5);
  EXPECT_FALSE(client.ends_on_timeout);
  EXPECT_EQ(client.clients, 1);
}

TEST(Address, OfTeams) {
  EXPECT_EQ(read({"tcp=4001+{index}"}, "bots_7").port, 4008);
  EXPECT_EQ(read({"tcp=4001+{index}+100"}, "bots_12").port, 4113);
  EXPECT_EQ(read({"tcp=40{index}"}, "bots_007").port, 407);
  EXPECT_EQ(read({"tcp=4001+{index}"}, "explorer").port, 4001);
  EXPECT_EQ(read({"pty=/tmp/{robot}.laser"}).path, "/tmp/rover_3.laser");
  EXPECT_EQ(read({"unix=/tmp/muro-{index}.sock", "lockstep={robot}"}).lockstep, "rover_3");
  EXPECT_SAYS(complaint({"tcp=65530+{index}"}, "bots_7"), "port 65537 is above 65535");
  EXPECT_SAYS(complaint({"pty=/tmp/{robt}"}), "`{robt}` stands for nothing; allowed are {robot} and {index}");
}

TEST(Address, OfFiles) {
  const Address unix_server = read({"unix=folder/../x.sock", "clients=3"});
  EXPECT_EQ(unix_server.kind, Address::Kind::unix_server);
  EXPECT_TRUE(unix_server.path.starts_with("/") && unix_server.path.ends_with("/x.sock"));
  EXPECT_EQ(unix_server.clients, 3);
  EXPECT_EQ(read({"pty=laser"}).kind, Address::Kind::pty);
  EXPECT_EQ(read({"pty=laser", "timed=true", "baud=19200"}).baud, 19200);
  EXPECT_EQ(read({"pty=laser", "timed=true", "baud=750000"}).baud, 750000);
  EXPECT_EQ(read({"serial=/dev/ttyS0", "baud=115200"}).text(), "serial /dev/ttyS0");
  EXPECT_EQ(read({"serial=/dev/ttyS0"}).baud, 0);
  EXPECT_SAYS(complaint({"unix=/" + std::string(107, 'x')}),
              "it has 108 bytes, but that of a Unix socket has at most 107");
  EXPECT_EQ(read({"unix=/" + std::string(106, 'x')}).path.size(), 107);
  EXPECT_SAYS(complaint({"pty=/tmp/"}), "must be the path of a file");
}

TEST(Address, ThatIsWrong) {
  EXPECT_SAYS(complaint({}), "does not say where clients are served: {tcp: PORT}");
  EXPECT_SAYS(complaint({"4001"}), "it is a map, such as {tcp: 4001}");
  EXPECT_SAYS(complaint({"tpc=4001"}), "unknown key `tpc` (did you mean `tcp`?)");
  EXPECT_SAYS(complaint({"tcp=4001", "unix=x"}), "has both `tcp` and `unix`");
  EXPECT_SAYS(complaint({"tcp=1", "tcp=2"}), "has `tcp` twice");
  EXPECT_SAYS(complaint({"tcp=70000"}), "port 70000 is above 65535");
  EXPECT_SAYS(complaint({"tcp=-1"}), "`-1` is no port");
  EXPECT_SAYS(complaint({"tcp="}), "is no port");
  EXPECT_SAYS(complaint({"tcp=::1:4001"}), "\"[::1]:4001\"");
  EXPECT_SAYS(complaint({"tcp=:4001"}), "it begins with a host");
  EXPECT_SAYS(complaint({"connect=4001"}), "needs a host and a port");
  EXPECT_SAYS(complaint({"connect=localhost:0"}), "cannot connect to port 0");
  EXPECT_SAYS(complaint({"serial=/dev/ttyS0", "baud=12345"}), "no rate of serial devices; allowed are 1200, 2400");
  EXPECT_SAYS(complaint({"pty=x", "baud=19200"}), "add timed: true");
  EXPECT_SAYS(complaint({"pty=x", "timed=true"}), "needs `baud`");
  EXPECT_SAYS(complaint({"pty=x", "timed=yes"}), "true or false");
  EXPECT_SAYS(complaint({"pty=x", "clients=2"}), "has one client");
  EXPECT_SAYS(complaint({"tcp=1", "timed=true", "baud=9600", "clients=2"}), "is a line to one client");
  EXPECT_SAYS(complaint({"tcp=1", "clients=0"}), "from 1 to 1000");
  EXPECT_SAYS(complaint({"tcp=1", "timeout=5"}), "needs `lockstep`");
  EXPECT_SAYS(complaint({"tcp=1", "lockstep=a", "timeout=nan"}), "from 0.001 to 86400 s");
  EXPECT_SAYS(complaint({"tcp=1", "lockstep=a", "on_timeout=stop"}), "it must be end");
}

TEST(Address, OfAnythingIsAnAddressOrAnError) {
  const std::string_view parts[] = {"tcp",     "connect",    "unix",
                                    "pty",     "serial",     "baud",
                                    "timed",   "clients",    "lockstep",
                                    "timeout", "on_timeout", "=",
                                    "=",       "=",          "true",
                                    "4001",    "+",          ":",
                                    "[",       "]",          "::1",
                                    "{index}", "{robot}",    "{",
                                    "}",       "/",          "x",
                                    "-1",      "1e9",        "99999999999999999999",
                                    "go_on",   "\n",         std::string_view("\0", 1),
                                    "\xff"};
  std::uint32_t random = 1;
  const auto next = [&](std::size_t below) {
    return std::size_t((random = random * 1664525 + 1013904223) >> 16) % below;
  };
  int fine = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<std::string> texts(next(4));
    for (std::string& text : texts)
      for (std::size_t k = next(7); k > 0; --k) text += parts[next(std::size(parts))];
    try {
      const Address address = read({texts.begin(), texts.end()});
      EXPECT_FALSE(address.text().empty());
      ++fine;
    } catch (const Error& e) {
      EXPECT_LT(std::string_view(e.what()).size(), 1500);
    }
  }
  EXPECT_GT(fine, 10);
}

}  // namespace

}  // namespace muro::stream
