// SPDX-License-Identifier: MIT
// Many streams, and their cost for a step.
#include <sys/resource.h>

#include <csignal>
#include <deque>
#include <filesystem>
#include <optional>

#include "plugins/controller/common/stream/echo_testing.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::stream {

namespace {

TEST(Load, ThreeHundredStreams) {
  const std::size_t before = open_descriptors();
  {
    test::ScratchFolder folder;
    std::deque<Echo> echoes;
    for (int i = 0; i < 100; ++i) {
      echoes.emplace_back(std::vector<std::string_view>{"tcp=0"});
      echoes.emplace_back(std::vector<std::string_view>{"unix=" + folder.path(std::to_string(i))});
      echoes.emplace_back(std::vector<std::string_view>{"pty=" + folder.path("pty" + std::to_string(i))});
    }
    std::deque<Peer> peers;
    for (Echo& echo : echoes) {
      const Address& a = echo.stream.address();
      peers.push_back(a.kind == Address::Kind::tcp_server    ? Peer::tcp(a.port)
                      : a.kind == Address::Kind::unix_server ? Peer::unix_socket(a.path)
                                                             : Peer::file(a.path));
    }
    for (int round = 0; round < 3; ++round) {
      for (std::size_t i = 0; i < peers.size(); ++i) EXPECT_TRUE(peers[i].say("I am " + std::to_string(i) + "\n"));
      for (std::size_t i = 0; i < peers.size(); ++i) {
        const std::string line = "I am " + std::to_string(i) + "\n";
        EXPECT_TRUE(echoes[i].run_until([&] { return peers[i].hear() == line; })) << i << ": " << peers[i].heard;
        peers[i].heard.clear();
      }
    }
  }
  EXPECT_EQ(open_descriptors(), before);
}

TEST(Load, NeedsNoMemoryInAStepOnceWarm) {
  Echo echo({"tcp=0"});
  Peer peer = Peer::tcp(echo.port());
  const std::string line = "a command of some length\n";
  std::string lines;
  for (int i = 0; i < 200; ++i) lines += line;
  std::uint64_t allocations = 0;
  for (int round = 0; round < 20; ++round) {
    EXPECT_TRUE(peer.say(lines));
    const std::uint64_t wanted = 200 * std::uint64_t(round + 1);
    for (int i = 0; i < 50000 && echo.stream.statistics().messages < wanted; ++i) usleep(100);
    const std::uint64_t before = test::allocations_of_this_thread();
    echo.stream.begin(round);
    while (const Event* const event = echo.stream.next())
      if (event->kind == Event::Kind::message) echo.stream.send(event->client, event->bytes);
    if (round >= 10) allocations += test::allocations_of_this_thread() - before;
    for (peer.heard.clear(); peer.hear().size() < lines.size();) usleep(100);
  }
  EXPECT_EQ(allocations, 0u);
}

/// Returns the blocked signals of the I/O thread, from /proc/self/task/*/status; nothing when there is no such thread.
std::optional<std::uint64_t> blocked_in_io_thread() {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    if (test::text_of(task.path() / "comm") != "muro streams\n") continue;
    const std::string status = test::text_of(task.path() / "status");
    return std::stoull(status.substr(status.find("SigBlk:") + 7), nullptr, 16);
  }
  return std::nullopt;
}

TEST(Load, HasOneThreadThatLeavesSignalsToOthers) {
  const auto has = [](std::uint64_t set, int signal) { return (set >> (signal - 1) & 1) != 0; };
  {
    Echo one({"tcp=0"});
    Echo two({"tcp=0"});
    const auto blocked = blocked_in_io_thread();
    ASSERT_TRUE(blocked);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGALRM}) EXPECT_TRUE(has(*blocked, signal));
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) EXPECT_FALSE(has(*blocked, signal));
  }
  EXPECT_FALSE(blocked_in_io_thread());
}

TEST(Load, TellsThatThereAreTooManyFiles) {
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  Echo first({"tcp=0"});
  std::size_t most = 0;
  for (std::size_t fd = 0; fd < 4096; ++fd)
    if (::fcntl(int(fd), F_GETFD) >= 0) most = fd + 1;
  const rlimit tight{most, before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &tight);
  std::vector<int> holes;
  for (int fd = ::dup(0); fd >= 0; fd = ::dup(0)) holes.push_back(fd);
  const std::string complaint = test::complaint_of<Error>([] { Echo({"tcp=127.0.0.1:0"}); });
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_SAYS(complaint, "this process may have " + std::to_string(most) + " files open");
  EXPECT_SAYS(complaint, "ulimit -n");
  // a client that connects now waits until there is room
  ::setrlimit(RLIMIT_NOFILE, &before);
  Peer peer = Peer::tcp(first.port());
  for (const int fd : holes) ::close(fd);
  EXPECT_TRUE(peer.say("late\n"));
  EXPECT_TRUE(first.run_until([&] { return peer.hear() == "late\n"; }));
}

TEST(Load, IsInTheReport) {
  FakeReport report;
  FakeConnector connector;
  connector.fake_host.report = &report;
  Stream stream(connector, "rover_3/laser", address_of(connector, {"tcp=0"}), {line_size});
  stream.open();
  Peer peer = Peer::tcp(stream.address().port);
  EXPECT_TRUE(peer.say("a\nb\n"));
  while (stream.statistics().messages < 2) usleep(100);
  stream.finish();
  const std::vector<std::pair<std::string, std::uint64_t>> wanted = {
      {"streams/rover_3/laser/clients", 1},      {"streams/rover_3/laser/refused", 0},
      {"streams/rover_3/laser/messages", 2},     {"streams/rover_3/laser/bytes_in", 4},
      {"streams/rover_3/laser/bytes_out", 0},    {"streams/rover_3/laser/dropped", 0},
      {"streams/rover_3/laser/disconnected", 0}, {"streams/rover_3/laser/lost", 0},
      {"streams/rover_3/laser/held_back", 0}};
  EXPECT_EQ(report.numbers, wanted);
  EXPECT_TRUE(connector.fake_host.warnings().empty());
}

}  // namespace

}  // namespace muro::stream
