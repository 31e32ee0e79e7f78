// SPDX-License-Identifier: MIT
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <map>

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

Framing ends_with_semicolon(std::size_t longest = 65536, bool keeps_too_long = false) {
  return {[](std::string_view bytes, bool) {
            return bytes.front() == '!' ? Framing::invalid : bytes.find(';') + 1;  // npos + 1 is 0
          },
          longest, keeps_too_long};
}

TEST(TcpServer, AnswersEachOfItsClients) {
  Echo echo({"tcp=0"});
  ASSERT_NE(echo.stream.address().port, 0);
  std::vector<Peer> peers;
  for (int i = 0; i < 8; ++i) {
    peers.push_back(Peer::tcp(echo.port()));
    EXPECT_TRUE(peers.back().say("I am " + std::to_string(i) + "\n"));
  }
  for (int i = 0; i < 8; ++i) {
    const std::string text = "I am " + std::to_string(i) + "\n";
    EXPECT_TRUE(echo.run_until([&] { return peers[std::size_t(i)].hear() == text; })) << peers[std::size_t(i)].heard;
  }
  const Statistics s = echo.stream.statistics();
  EXPECT_EQ(s.clients, 8);
  EXPECT_EQ(s.messages, 8);
  EXPECT_EQ(s.bytes_in, 8 * 7);
  EXPECT_EQ(s.bytes_out, 8 * 7);
}

TEST(TcpServer, NumbersClientsInOrderAndTellsWhenTheyGo) {
  Echo echo({"tcp=0"});
  for (std::uint32_t i = 0; i < 3; ++i) {
    Peer peer = Peer::tcp(echo.port());
    EXPECT_TRUE(peer.say("a\n"));
    peer.close();
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == i + 1; }));
  }
  ASSERT_EQ(echo.heard.size(), 9);
  for (std::uint32_t i = 0; i < 9; ++i) {
    EXPECT_EQ(echo.heard[i].client, i / 3);
    EXPECT_EQ(std::uint32_t(echo.heard[i].kind), i % 3);
  }
}

TEST(TcpServer, AnswersAClientInPython) {
  if (std::system("command -v python3 >/dev/null") != 0) GTEST_SKIP() << "no python3";
  Echo echo({"tcp=0"});
  const std::string script = "import socket,sys; s = socket.create_connection(('127.0.0.1', " +
                             std::to_string(echo.port()) +
                             ")); s.sendall(b'from python\\n'); print(s.makefile('rb').readline())";
  std::FILE* const python = ::popen(("python3 -c \"" + script + "\"").c_str(), "r");
  ASSERT_NE(python, nullptr);
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == 1; }));
  char line[100] = {};
  EXPECT_NE(std::fgets(line, sizeof line, python), nullptr);
  EXPECT_EQ(std::string(line), "b'from python\\n'\n");
  EXPECT_EQ(::pclose(python), 0);
}

TEST(TcpServer, AnswersWhoHasFinishedSpeaking) {
  Echo echo({"tcp=0"});
  Peer peer = Peer::tcp(echo.port());
  const std::string text(100000, 'x');
  EXPECT_TRUE(peer.say("one\n" + text.substr(0, 60000) + "\n"));
  peer.end();
  EXPECT_TRUE(echo.run_until([&] { return peer.hear().size() == 60005 && peer.is_closed; })) << peer.heard.size();
}

TEST(TcpServer, ServesIpv4AndIpv6) {
  Echo echo({"tcp=localhost:0"});
  Peer peer = Peer::tcp(echo.port());
  EXPECT_TRUE(peer.say("4\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "4\n"; }));
  const int fd = ::socket(AF_INET6, SOCK_STREAM, 0);
  if (fd < 0) GTEST_SKIP() << "no IPv6";
  sockaddr_in6 to{};
  to.sin6_family = AF_INET6;
  to.sin6_port = htons(echo.port());
  to.sin6_addr = in6addr_loopback;
  Peer six(fd);
  Echo explicitly({"tcp=[::1]:0"});
  to.sin6_port = htons(explicitly.port());
  ASSERT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0) << std::strerror(errno);
  EXPECT_TRUE(six.say("6\n"));
  EXPECT_TRUE(explicitly.run_until([&] { return six.hear() == "6\n"; }));
  Echo everywhere({"tcp=[::]:0"});
  Peer four = Peer::tcp(everywhere.port());
  EXPECT_TRUE(four.say("4\n"));
  EXPECT_TRUE(everywhere.run_until([&] { return four.hear() == "4\n"; }));
}

TEST(TcpServer, RefusesClientsAboveItsBound) {
  Echo echo({"tcp=0", "clients=2"});
  Peer first = Peer::tcp(echo.port());
  Peer second = Peer::tcp(echo.port());
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 2; }));
  Peer third = Peer::tcp(echo.port());
  EXPECT_TRUE(echo.run_until([&] { return third.hear().empty() && third.is_closed; }));
  EXPECT_EQ(echo.stream.statistics().refused, 1);
  first.close();
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == 1; }));
  Peer fourth = Peer::tcp(echo.port());
  EXPECT_TRUE(fourth.say("in\n"));
  EXPECT_TRUE(echo.run_until([&] { return fourth.hear() == "in\n"; }));
  EXPECT_EQ(echo.heard.back().client, 2);
}

TEST(TcpServer, TellsOfAPortThatIsTaken) {
  Echo echo({"tcp=0"});
  const std::string port = std::to_string(echo.port());
  const std::string text = test::complaint_of<Error>([&] { Echo other({"tcp=" + port}); });
  EXPECT_SAYS(text, "cannot serve on tcp 127.0.0.1:" + port + ": port " + port + " is taken");
  EXPECT_SAYS(text, "\"" + port + "+{index}\"");
}

TEST(TcpServer, TellsOfAnAddressThatIsNotOurs) {
  EXPECT_SAYS(test::complaint_of<Error>([] { Echo({"tcp=192.0.2.1:4001"}); }), "is no address of this machine");
  EXPECT_SAYS(test::complaint_of<Error>([] { Echo({"tcp=no-such-host.invalid:4001"}); }),
              "no machine of the name `no-such-host.invalid` is known");
}

TEST(TcpServer, IsNotDisturbedByAClientThatReadsNothing) {
  Echo echo({"tcp=0"}, {line_size}, {.output_bytes = 200000});
  Peer deaf = Peer::tcp(echo.port());
  Peer good = Peer::tcp(echo.port());
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 2; }));
  const std::string kilobytes(100000, 'x');
  std::size_t taken = 0;
  for (int i = 0; i < 200; ++i) {
    taken += echo.stream.send(0, kilobytes) ? 1 : 0;
    echo.step();
    usleep(100);
  }
  EXPECT_LT(taken, 150);  // 20 MB: more than the buffers of the system and of the stream
  EXPECT_EQ(echo.stream.statistics().dropped, 200 - taken);
  EXPECT_TRUE(good.say("still there\n"));
  EXPECT_TRUE(echo.run_until([&] { return good.hear() == "still there\n"; }));
  // all that it does get is complete
  EXPECT_TRUE(echo.run_until([&] { return deaf.hear().size() == taken * kilobytes.size(); })) << deaf.heard.size();
  EXPECT_TRUE(echo.stream.send(0, "and on\n"));
  EXPECT_TRUE(echo.run_until([&] { return deaf.hear().ends_with("xand on\n"); }));
  echo.stream.finish();
  ASSERT_EQ(echo.connector.fake_host.warnings().size(), 1);
  EXPECT_SAYS(echo.connector.fake_host.warnings()[0], "dropped " + std::to_string(200 - taken) + " replies");
}

TEST(TcpServer, ReadsNoMoreOfAFloodThanItsBound) {
  Echo echo({"tcp=0"}, {line_size}, {.input_messages = 10});
  echo.answers = false;
  Peer flood = Peer::tcp(echo.port());
  ::fcntl(flood.fd, F_SETFL, O_NONBLOCK);
  std::string lines;
  for (int i = 0; i < 1000; ++i) lines += "flood " + std::to_string(i) + "\n";
  std::string said;
  for (int i = 0; i < 3000; ++i) {
    const ssize_t size = ::write(flood.fd, lines.data(), lines.size());
    if (size < 0) break;
    said += lines.substr(0, std::size_t(size));
    if (std::size_t(size) < lines.size()) break;
  }
  EXPECT_LT(said.size(), 3000 * lines.size());
  usleep(20000);
  const std::uint64_t bytes_read = echo.stream.statistics().bytes_in;
  EXPECT_LT(bytes_read, 300000);
  Peer good = Peer::tcp(echo.port());
  EXPECT_TRUE(good.say("hello\n"));
  EXPECT_TRUE(echo.run_until([&] {
    return std::any_of(echo.heard.begin(), echo.heard.end(), [](const Heard& h) { return h.bytes == "hello\n"; });
  }));
  // ten messages of the flood in each step, none lost
  const std::size_t before = echo.heard.size();
  EXPECT_TRUE(echo.run_until([&] { return echo.heard.size() > before + 100; }));
  std::string heard;
  for (const Heard& h : echo.heard)
    if (h.client == 0 && h.kind == Event::Kind::message) heard += h.bytes;
  EXPECT_EQ(heard, said.substr(0, heard.size()));
  std::map<std::int64_t, int> in_step;
  for (const Heard& h : echo.heard) in_step[h.time] += h.client == 0 ? 1 : 0;
  for (const auto& [time, count] : in_step) EXPECT_LE(count, 11);  // includes the event of its connection
  EXPECT_GT(echo.stream.statistics().held_back, 0);
}

TEST(TcpServer, DisconnectsWhoSendsGarbage) {
  Echo echo({"tcp=0"}, ends_with_semicolon());
  Peer bad = Peer::tcp(echo.port());
  Peer good = Peer::tcp(echo.port());
  EXPECT_TRUE(bad.say("fine;!!!!;more;"));
  EXPECT_TRUE(echo.run_until([&] { return bad.hear() == "fine;" && bad.is_closed; }));
  EXPECT_TRUE(good.say("fine too;"));
  EXPECT_TRUE(echo.run_until([&] { return good.hear() == "fine too;"; }));
  EXPECT_EQ(echo.stream.statistics().disconnected, 1);
  EXPECT_EQ(echo.stream.statistics().messages, 2);
}

TEST(TcpServer, BoundsTheLengthOfMessages) {
  Echo echo({"tcp=0"}, ends_with_semicolon(100));
  Peer endless = Peer::tcp(echo.port());
  EXPECT_TRUE(endless.say(std::string(99, 'x') + ";" + std::string(101, 'x')));
  EXPECT_TRUE(echo.run_until([&] { return endless.hear().size() == 100 && endless.is_closed; }));
  EXPECT_EQ(echo.stream.statistics().disconnected, 1);

  Echo keeping({"tcp=0"}, ends_with_semicolon(100, true));
  Peer long_one = Peer::tcp(keeping.port());
  EXPECT_TRUE(long_one.say(std::string(250, 'x') + ";"));
  EXPECT_TRUE(keeping.run_until([&] { return keeping.count(Event::Kind::message) == 3; }));
  EXPECT_EQ(keeping.heard[1].bytes.size(), 100);
  EXPECT_EQ(keeping.heard[2].bytes.size(), 100);
  EXPECT_EQ(keeping.heard[3].bytes, std::string(50, 'x') + ";");
}

TEST(TcpServer, PutsTogetherWhatComesInPieces) {
  const std::string text = "a\nbc\r\n\r\n\rdef\r\ng\n\rh\n";
  for (const std::size_t piece : {std::size_t(1), std::size_t(2), std::size_t(3), text.size()}) {
    Echo echo({"tcp=0"});
    Peer peer = Peer::tcp(echo.port());
    const int now = 1;
    ::setsockopt(peer.fd, IPPROTO_TCP, TCP_NODELAY, &now, sizeof now);
    for (std::size_t i = 0; i < text.size(); i += piece) {
      EXPECT_TRUE(peer.say(text.substr(i, piece)));
      usleep(1000);
      echo.step();
    }
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::message) == 7; }));
    std::string lines;
    for (const Heard& h : echo.heard) lines += h.bytes + "|";
    for (char& c : lines) c = c == '\r' ? 'R' : c == '\n' ? 'N' : c;
    EXPECT_EQ(lines, "|aN|bcR|R|R|defR|gN|hN|") << piece;
  }
}

TEST(TcpServer, SurvivesClientsThatVanish) {
  Echo echo({"tcp=0"});
  const std::size_t before = open_descriptors();
  for (int i = 0; i < 50; ++i) {
    Peer peer = Peer::tcp(echo.port());
    EXPECT_TRUE(peer.say("half a mess"));
    if (i % 2 == 0) echo.step();
    peer.reset();
    echo.stream.send_to_all(std::string(100000, 'x'));
  }
  EXPECT_TRUE(echo.run_until([&] {
    const Statistics s = echo.stream.statistics();
    return s.clients + s.refused == 50 && echo.count(Event::Kind::disconnected) == s.clients;
  }));
  EXPECT_EQ(echo.count(Event::Kind::message), 0);
  EXPECT_EQ(echo.stream.statistics().lost, echo.stream.statistics().clients);
  EXPECT_TRUE(echo.run_until([&] { return open_descriptors() == before; })) << before << " " << open_descriptors();
  Peer peer = Peer::tcp(echo.port());
  EXPECT_TRUE(peer.say("whole\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "whole\n"; }));
}

TEST(TcpServer, DisconnectsOnceAllIsSent) {
  Echo echo({"tcp=0"}, {line_size}, {.output_bytes = 1 << 24});
  Peer peer = Peer::tcp(echo.port());
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::connected) == 1; }));
  std::string large;
  large.resize(10'000'000, 'x');
  EXPECT_TRUE(echo.stream.send(0, large));
  echo.stream.disconnect(0);
  EXPECT_TRUE(echo.stream.send(0, "nobody gets this"));
  EXPECT_TRUE(peer.say("nobody hears this\n"));
  EXPECT_TRUE(echo.run_until([&] { return peer.hear().size() == 10'000'000 && peer.is_closed; }));
  EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == 1; }));
}

TEST(TcpServer, SendsTheLastWordsAtItsEnd) {
  std::optional<Echo> echo(std::in_place, std::vector<std::string_view>{"tcp=0"});
  Peer peer = Peer::tcp(echo->port());
  EXPECT_TRUE(peer.say("unread\n"));
  EXPECT_TRUE(echo->run_until([&] { return echo->count(Event::Kind::connected) == 1; }));
  echo->stream.send(0, "goodbye\n");
  echo.reset();
  for (int i = 0; i < 100 && !peer.is_closed; ++i) {
    peer.hear();
    usleep(1000);
  }
  EXPECT_TRUE(peer.heard.ends_with("goodbye\n"));
}

/// Returns a listening socket, made with plain POSIX calls.
Peer server_at(std::uint16_t port) {
  Peer server(test::bound_to_tcp(port));
  EXPECT_EQ(::listen(server.fd, 1), 0);
  return server;
}

TEST(TcpClient, ConnectsAgainAndAgain) {
  std::optional<Peer> server(server_at(0));
  const std::uint16_t port = test::port_of(server->fd);
  server.reset();
  const std::string connect = "connect=localhost:" + std::to_string(port);
  Echo echo({connect});
  for (int i = 0; i < 20; ++i) echo.step();
  EXPECT_TRUE(echo.heard.empty());  // nobody is there, and the stream waits for nobody
  for (std::uint32_t i = 0; i < 2; ++i) {
    server.emplace(server_at(port));
    Peer peer(::accept(server->fd, nullptr, nullptr));
    EXPECT_TRUE(peer.say("hello " + std::to_string(i) + "\n"));
    EXPECT_TRUE(echo.run_until([&] { return peer.hear() == "hello " + std::to_string(i) + "\n"; }));
    EXPECT_EQ(echo.heard.back().client, i);
    server.reset();
    peer.close();
    EXPECT_TRUE(echo.run_until([&] { return echo.count(Event::Kind::disconnected) == i + 1; }));
  }
}

}  // namespace

}  // namespace muro::stream
