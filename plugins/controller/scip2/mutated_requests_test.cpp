// SPDX-License-Identifier: MIT
// Random requests, and requests with random changes.
#include <random>

#include "scip2_testing.hpp"
#include "tests/support/allocation_counter.hpp"

namespace muro::scip2 {
namespace {

const std::string seeds[] = {"VV",
                             "PP",
                             "II",
                             "BM",
                             "QT",
                             "RS",
                             "TM0",
                             "TM1",
                             "TM2",
                             "SS115200",
                             "CR05",
                             "HS1",
                             "DB03",
                             "GD0044072501",
                             "GS0044072503",
                             "GE0100020002",
                             "MD0044072501000",
                             "MS0044072510203",
                             "ME0044010001102",
                             "SCIP2.0",
                             "V",
                             "L1",
                             "G00076801",
                             "S0192000000000",
                             "QT;some text",
                             "RB",
                             "RT",
                             "HD0044072501",
                             "NE0044072501000"};

class Mutator {
 public:
  std::string next() {
    std::string line = seeds[random_() % std::size(seeds)];
    for (std::uint32_t changes = random_() % 4; changes > 0; --changes) change(line);
    return line;
  }
  std::uint32_t below(std::uint32_t n) { return std::uint32_t(random_() % n); }

 private:
  void change(std::string& line) {
    const std::size_t at = line.empty() ? 0 : random_() % line.size();
    char any = char(random_() % 256);
    if (any == '\n' || any == '\r') any = ';';
    switch (random_() % 5) {
      case 0:
        line.insert(at, 1, any);
        break;
      case 1:
        if (!line.empty()) line[at] = any;
        break;
      case 2:
        line.erase(at, 1);
        break;
      case 3:
        line += line;
        break;
      default:
        line += std::string(random_() % 300, any);
        break;
    }
  }
  std::mt19937 random_{20260101};
};

/// Expects complete replies only: an echo, a status, lines with their sums, an empty line.
void expect_whole_replies(const std::string& bytes, bool may_be_scip1) {
  const auto replies = replies_in(bytes);
  ASSERT_TRUE(replies.has_value());
  for (const Reply& r : *replies) {
    ASSERT_LE(r.echo.size(), longest_line);
    if (may_be_scip1 && r.status.size() == 1) continue;
    ASSERT_EQ(r.status.size(), 2u) << r.echo;
    ASSERT_TRUE(r.sums_are_right) << r.echo;
  }
}

TEST(Scip2Requests, AHundredThousandMutatedOnesGetWholeReplies) {
  for (Model m : {urg_04lx(), utm_30lx()}) {
    m.has_multiecho = m.has_malfunctions = m.has_high_sensitivity = m.has_restarts = true;
    Bench d(m);
    Mutator mutator;
    d.run(1);
    std::size_t lines = 0;
    const std::uint32_t size = d.device.state_size();
    for (int i = 0; i < 50000; ++i) {
      const std::string line = mutator.next();
      d.device.receive(d.state(), 1, line, d);
      ++lines;
      ASSERT_LE(d.state().pending_count, State::queue_size);
      // time passes only after one line in three, so that sometimes many lines wait
      if (mutator.below(3) == 0) d.run(mutator.below(20));
      if (i % 100 == 99) {
        expect_whole_replies(d.output, true);
        d.output.clear();
        if (HasFatalFailure()) return;
      }
    }
    EXPECT_EQ(d.device.state_size(), size);
    d.run(500);
    EXPECT_EQ(d.answers, int(lines)) << "each line got its answer";
    d.output.clear();
    d.type("TM2\n");
    d.run(300);
    d.type("QT\n");
    d.run(300);
    d.output.clear();
    d.type("PP\n");
    d.run(300);
    EXPECT_EQ(replies_in(d.output).value().back().lines.size(), 8u) << "it is not stuck";
  }
}

TEST(Scip2Requests, LinesWithoutEndAreCutAndRefused) {
  Awake d;
  for (const std::size_t length : {65u, 66u, 1000u, 100000u}) {
    d.device.receive(d.state(), 1, "VV;" + std::string(length, 'a'), d);
    d.run(200);
    const auto replies = replies_in(std::exchange(d.output, ""));
    ASSERT_TRUE(replies && replies->size() == 1);
    EXPECT_EQ((*replies)[0].status, "0G");
    EXPECT_EQ((*replies)[0].echo.size(), longest_line);
  }
}

TEST(Scip2Requests, AFloodIsRefusedAtOnceAndTheFirstLinesAreAnswered) {
  Awake d;
  for (int i = 0; i < 1000; ++i) d.device.receive(d.state(), 1, "VV;" + std::to_string(i), d);
  const auto refused = replies_in(std::exchange(d.output, ""));
  ASSERT_EQ(refused.value().size(), 1000 - State::queue_size);
  for (const Reply& r : *refused) EXPECT_EQ(r.status, "0B");
  d.run(200);
  const auto replies = replies_in(d.output).value();
  ASSERT_EQ(replies.size(), State::queue_size);
  EXPECT_EQ(replies[0].status, "00");
  EXPECT_EQ(replies[1].status, "0B");
}

/// A host that keeps nothing, so that only allocations of the device are counted.
struct Silent final : DeviceHost {
  void send(std::uint32_t, std::string_view bytes) override { sent += bytes.size(); }
  void read_scan(std::span<std::uint32_t> d, std::span<std::uint32_t> i) override {
    std::fill(d.begin(), d.end(), 5000u);
    std::fill(i.begin(), i.end(), 500u);
  }
  std::size_t sent = 0;
};

TEST(Scip2Requests, NothingIsAllocatedFromTheFirstReplyOn) {
  Device device(utm_30lx());
  std::vector<std::uint64_t> memory(device.state_size() / 8 + 1);
  State& s = *reinterpret_cast<State*>(memory.data());
  Silent host;
  const std::string_view lines[] = {"VV", "PP", "II", "ME0000108001000", "GE0000108001", "XX", "TM1"};
  const std::uint64_t before = test::allocations();
  for (int i = 0; i < 2000; ++i) {
    device.receive(s, 1, lines[i % 7], host);
    device.advance(s, std::int64_t(i) * 5'000'000, host);
  }
  EXPECT_EQ(test::allocations() - before, 0u);
  EXPECT_GT(host.sent, 1'000'000u);
}

}  // namespace
}  // namespace muro::scip2
