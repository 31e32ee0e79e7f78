// SPDX-License-Identifier: MIT
// Random requests, and requests with random changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "plugins/controller/common/wire_protocol/frame.hpp"
#include "plugins/controller/common/wire_protocol/service_testing.hpp"

namespace muro::wire {
namespace {

constexpr int message_count = 100'000;

/// Random bytes, or a request with up to four bytes changed, removed or added.
class Messages {
 public:
  Messages(std::vector<std::string> requests, std::string_view letters)
      : requests_(std::move(requests)), letters_(letters) {}

  std::string next() {
    if (random_() % 4 == 0) {
      std::string text;
      for (std::uint32_t n = random_() % 40; n > 0; --n) text += letter();
      return text;
    }
    std::string text = requests_[random_() % requests_.size()];
    for (std::uint32_t n = random_() % 5; n > 0 && !text.empty(); --n) {
      const std::size_t at = random_() % text.size();
      if (random_() % 3 == 0)
        text.erase(at, 1);
      else if (random_() % 2 == 0)
        text.insert(at, 1, letter());
      else
        text[at] = letter();
    }
    return text;
  }
  std::uint32_t random() { return std::uint32_t(random_()); }

 private:
  char letter() { return random_() % 4 == 0 ? char(random_()) : letters_[random_() % letters_.size()]; }

  std::mt19937 random_{42};
  std::vector<std::string> requests_;
  std::string letters_;
};

/// Sends all messages as one stream of bytes, cut anywhere, with steps in between. The service must still answer.
void expect_dialogue_goes_on(const Protocol& protocol, Messages messages, const std::string& question,
                             const std::string& answer_begin) {
  Bench b(protocol);
  const stream::Framing framing = protocol.framing();
  std::string bytes;
  std::size_t longest = 0;
  for (int i = 0; i < message_count; ++i) {
    bytes += messages.next();
    while (!bytes.empty()) {
      const std::size_t size = framing.size_of_first(bytes, false);
      if (size == 0) break;
      ASSERT_LE(size, bytes.size());
      ++b.messages;
      b.service.received(1, std::string_view(bytes).substr(0, size));
      bytes.erase(0, size);
    }
    ASSERT_LT(bytes.size(), framing.longest);
    longest = std::max(longest, bytes.size());
    if (messages.random() % 16 == 0) b.run(int(messages.random() % 8));
    b.sent.clear();
    if (!b.disconnected.empty()) {  // too many messages after a long wait
      b.service.disconnected(1);
      b.service.connected(1);
      b.disconnected.clear();
    }
  }
  EXPECT_LE(longest, framing.longest);
  b.service.disconnected(1);
  EXPECT_EQ(b.answers, b.messages) << "each message is through once";
  EXPECT_LE(b.replies, b.messages);
  EXPECT_GT(b.replies, 1000u);
  b.service.connected(1);
  EXPECT_EQ(b.ask(question).substr(0, answer_begin.size()), answer_begin);
}

TEST(MutatedLines, LeaveTheDialogueGoing) {
  expect_dialogue_goes_on(text_protocol(),
                          {{"info\n", "info arm\n", "get\n", "get gripper position\n", "set arm 0.5 -0.25\n",
                            "velocity arm 1 2\n", "stop\n", "wait\n", "wait 0.01 gripper\n", "report 50 arm\n",
                            "report 0\n", "time\n", "set gripper 1e300\n", "set gripper nan\n"},
                           "abcdefghijklmnopqrstuvwxyz0123456789.-+ \t\r\n"},
                          "info\n", "info bench 1 100 arm gripper\n");
}

TEST(MutatedFrames, LeaveTheDialogueGoing) {
  std::vector<std::string> requests;
  for (std::uint8_t type = 0; type <= 8; ++type)
    for (const std::string& payload :
         {std::string(), std::string(1, '\1'), std::string(8, '\0'), std::string("\0\0\0\0\0\x3f\0\0\x80\xbe", 10)})
      for (const std::uint8_t format : {0, 1}) add_frame(requests.emplace_back(), {type, type, format, payload});
  std::string question, answer;
  add_frame(question, {1, 9, 0, ""});
  add_frame(answer, {0x81, 9, 0, "bench 1 100 arm gripper"});
  expect_dialogue_goes_on(binary_protocol(), {requests, std::string("\xa5\x5a\0\1\2", 5)}, question, answer);
}

}  // namespace
}  // namespace muro::wire
