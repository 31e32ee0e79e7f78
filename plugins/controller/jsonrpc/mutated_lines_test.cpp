// SPDX-License-Identifier: MIT
// Lines that no client would send: each gets one line of JSON or no answer, and no memory grows.
#include <gtest/gtest.h>
#include <malloc.h>

#include <random>

#include "service_testing.hpp"

namespace muro::jsonrpc {
namespace {

using testing::Dialogue;

/// Returns requests of all methods.
std::vector<std::string> seeds() {
  std::vector<std::string> all = {
      R"([{"jsonrpc":"2.0","id":1,"method":"get","params":["rover:pose"]},{"jsonrpc":"2.0","method":"pause"},3])",
      R"({"jsonrpc":"2.0","id":"a","method":"set","params":{"property":"rover:command.twist","value":{"vx":1},"unit":"m/s, rad/s"}})",
      R"({"jsonrpc":"2.0","id":2,"method":"set","params":{"values":{"rover:ranges":[1,2,3],"rover:flag":7}}})",
      R"({"jsonrpc":"2.0","id":2.5,"method":"get","params":{"properties":["*:*"],"element":0}})",
      R"({"jsonrpc":"2.0","id":3,"method":"subscribe","params":{"properties":["rover:*"],"rate":10}})",
      R"({"jsonrpc":"2.0","id":3,"method":"subscribe","params":{"properties":["rover:pose"],"on_change":true,"least_period":1e-3}})",
      R"({"jsonrpc":"2.0","id":4,"method":"place","params":{"object":"rover","position":[1,2,3],"orientation_wxyz":[1,0,0,0],"linear":[0,0,0],"force":false}})",
      R"({"jsonrpc":"2.0","id":4,"method":"place","params":{"object":"rover","x":1,"y":2,"yaw":3}})",
      R"({"jsonrpc":"2.0","id":5,"method":"step","params":{"seconds":0.1}})",
      R"({"jsonrpc":"2.0","id":6,"method":"snapshot","params":["\u0061\ud83d\ude00"]})",
      R"({"jsonrpc":"2.0","id":6,"method":"restore","params":["a"]})"};
  for (const Method& m : methods())
    all.push_back(R"({"jsonrpc":"2.0","id":7,"method":")" + std::string(m.name) + R"("})");
  return all;
}

TEST(MutatedLines, AreAnsweredOrIgnored) {
  Dialogue d;
  std::mt19937 engine(20);
  const std::vector<std::string> all = seeds();
  constexpr std::string_view pieces[] = {"{",    "}",  "[",     "]",       "\"", ",",   ":",
                                         "null", "-1", "1e999", "\\u0000", "*",  "true"};
  const auto below = [&](std::size_t n) { return std::size_t(engine() % n); };
  std::size_t replies = 0, errors = 0, memory = 0;
  for (int i = 0; i < 100'000; ++i) {
    std::string line = all[below(all.size())];
    for (std::size_t k = below(4); k > 0; --k) {
      const std::size_t at = below(line.size() + 1);
      switch (below(5)) {
        case 0:
          line.insert(at, pieces[below(std::size(pieces))]);
          break;
        case 1:
          line.erase(at, below(10));
          break;
        case 2:
          if (at < line.size()) line[at] = char(engine());
          break;
        case 3: {
          const std::string& other = all[below(all.size())];
          line = line.substr(0, at) + other.substr(below(other.size()));
          break;
        }
        default:
          line.insert(at, line.substr(below(line.size() + 1), below(30)));
      }
    }
    std::erase(line, '\n');
    std::istringstream said(d.say(line + "\n"));
    for (std::string reply; std::getline(said, reply);) {
      const Json parsed = Json::parse(reply, nullptr, false);
      ASSERT_FALSE(parsed.is_discarded()) << line << "\n" << reply;
      errors += parsed.is_object() && parsed.contains("error") ? 1 : 0;
      ++replies;
    }
    if (i % 2 == 0) d.next_step();
    if (i % 5 == 0) d.attend();
    if (i % 50 == 0) {
      d.run.now = 0;
      d.service.time_was_set(0);
    }
    if (i % 500 == 0) {
      d.run.pause_at = -1;
      d.service.disconnected(0);
      d.attend();
      d.service.connected(0);
      d.run.carried_out = {};
      if (i == 20'000) memory = mallinfo2().uordblks;
    }
  }
  EXPECT_LE(mallinfo2().uordblks, memory + (1 << 20)) << "what is kept does not grow";
  EXPECT_GT(replies, 10'000u);
  EXPECT_GT(errors, 5'000u);
  EXPECT_LE(d.service.clients(), 2u);
  // the service still works
  d.service.connected(5);
  EXPECT_NE(d.say(R"({"jsonrpc":"2.0","id":1,"method":"time"})", 5).find("result"), std::string::npos);
}

TEST(MutatedLines, OfRandomBytesAreParseErrors) {
  Dialogue d;
  std::mt19937 engine(21);
  for (int i = 0; i < 100'000; ++i) {
    std::string line(1 + engine() % 60, ' ');
    for (char& c : line) c = char(1 + engine() % 255);
    std::replace(line.begin(), line.end(), '\n', ' ');
    const std::string reply = d.say(line + "\n");
    if (!reply.empty()) {
      ASSERT_FALSE(Json::parse(reply, nullptr, false).is_discarded()) << reply;
    }
  }
}

}  // namespace
}  // namespace muro::jsonrpc
