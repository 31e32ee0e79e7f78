// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/frame.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "plugins/controller/common/wire_protocol/crc32.hpp"
#include "plugins/controller/common/wire_protocol/service_testing.hpp"
#include "tests/support/files.hpp"

namespace muro::wire {
namespace {

std::string frame(Verb verb, std::uint8_t sequence, const std::string& payload, std::uint8_t format = 0) {
  std::string bytes;
  add_frame(bytes, {std::uint8_t(verb), sequence, format, payload});
  return bytes;
}

template <class... T>
std::string bytes_of(T... numbers) {
  std::string bytes;
  (add_bytes(bytes, numbers), ...);
  return bytes;
}

using Byte = std::uint8_t;

/// Returns the frames that a stream finds in the bytes, and the number of bytes of garbage.
std::vector<std::string> frames_in(std::string_view bytes, std::size_t* garbage = nullptr) {
  std::vector<std::string> frames;
  while (!bytes.empty()) {
    const std::size_t size = frame_size(bytes, false);
    if (size == 0) break;
    const auto frame = read_frame(bytes.substr(0, size));
    if (frame && frame->payload.size() <= longest_request)
      frames.emplace_back(bytes.substr(0, size));
    else if (garbage)
      *garbage += size;
    bytes.remove_prefix(size);
  }
  return frames;
}

TEST(Crc32, HasTheCheckValueOfItsCatalogue) {
  static_assert(crc32("123456789") == 0xcbf43926);
  EXPECT_EQ(crc32("123456789"), 0xcbf43926u) << "CRC-32/ISO-HDLC";
  EXPECT_EQ(crc32(""), 0u);
}

TEST(BinaryFrame, IsReadBackAsItWasWritten) {
  for (const std::size_t size : {0u, 1u, 8u, 2048u}) {
    const std::string payload(size, char(0xa5)), bytes = frame(Verb::set, 7, payload, 1);
    EXPECT_EQ(bytes.size(), frame_overhead + size);
    EXPECT_EQ(frame_size(bytes, true), bytes.size());
    for (std::size_t cut = 1; cut < bytes.size(); cut += 1 + cut / 16)
      EXPECT_EQ(frame_size(bytes.substr(0, cut), false), 0u);
    const auto read = read_frame(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->type, 3);
    EXPECT_EQ(read->sequence, 7);
    EXPECT_EQ(read->format, 1);
    EXPECT_EQ(read->payload, payload);
  }
}

TEST(BinaryFrame, WithAnyByteChangedIsNone) {
  const std::string good = frame(Verb::set, 1, bytes_of(Byte(0), Byte(0), 0.5f, -0.5f));
  for (std::size_t i = 0; i < good.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[i] = char(bad[i] ^ (1 << bit));
      EXPECT_FALSE(read_frame(bad)) << "byte " << i << ", bit " << bit;
    }
}

TEST(BinaryFrame, IsFoundAfterGarbage) {
  const std::string good = frame(Verb::get, 9, ""), broken = frame(Verb::get, 1, "\xa5\x5a").substr(0, 10);
  for (const std::string& before :
       {std::string("hello"), std::string("\xa5"), std::string("\xa5\xa5\x5a"), broken, std::string(3000, '\xa5'),
        frame(Verb::get, 1, std::string(3000, 'x')), std::string("\xa5\x5a\x02\x00", 4)}) {
    std::size_t garbage = 0;
    const auto frames = frames_in(before + good + good, &garbage);
    ASSERT_EQ(frames.size(), 2u) << before.size();
    EXPECT_EQ(frames[0], good);
    EXPECT_EQ(garbage, before.size());
  }
}

TEST(BinaryDialogue, SetsAndGetsInBothFormats) {
  Bench b(binary_protocol());
  const std::int64_t now = 0;
  EXPECT_EQ(b.ask(frame(Verb::set, 1, bytes_of(Byte(0), Byte(0), 0.5f, -0.25f))), frame(Verb(0x80), 1, bytes_of(now)));
  EXPECT_EQ(b.ask(frame(Verb::get, 2, "")),
            frame(Verb(0x82), 2, bytes_of(now, Byte(0), Byte(0), std::uint16_t(2), 0.5f, -0.25f)));
  EXPECT_EQ(b.ask(frame(Verb::set, 3, bytes_of(Byte(1), Byte(1), 0.1), 1)), frame(Verb(0x80), 3, bytes_of(now), 1));
  EXPECT_EQ(b.ask(frame(Verb::get, 255, bytes_of(Byte(1), Byte(1)), 1)),
            frame(Verb(0x82), 255, bytes_of(now, Byte(1), Byte(1), std::uint16_t(1), 0.1), 1));
  EXPECT_EQ(b.ask(frame(Verb::info, 4, "")), frame(Verb(0x81), 4, "bench 1 100 arm gripper"));
  EXPECT_EQ(b.ask(frame(Verb::time, 5, "")), frame(Verb(0x87), 5, bytes_of(now)));
  EXPECT_EQ(b.ask(frame(Verb::wait, 6, bytes_of(std::int64_t(15'000'000), Byte(1)))), "");
  EXPECT_EQ(b.run(), "");
  EXPECT_EQ(b.run(),
            frame(Verb(0x82), 6, bytes_of(std::int64_t(20'000'000), Byte(1), Byte(0), std::uint16_t(1), 0.1f)));
  EXPECT_EQ(b.ask(frame(Verb::stop, 7, "")), frame(Verb(0x80), 7, bytes_of(std::int64_t(20'000'000))));
}

TEST(BinaryDialogue, NumbersReportsOneByOne) {
  Bench b(binary_protocol());
  b.ask(frame(Verb::report, 50, bytes_of(std::int64_t(20'000'000), Byte(1))));
  const auto reports = frames_in(b.run(520));
  ASSERT_EQ(reports.size(), 260u);
  EXPECT_EQ(reports[0],
            frame(Verb(0x83), 0, bytes_of(std::int64_t(20'000'000), Byte(1), Byte(0), std::uint16_t(1), 0.f)));
  EXPECT_EQ(read_frame(reports[257])->sequence, 1);
  b.ask(frame(Verb::report, 51, bytes_of(std::int64_t(0))));
  EXPECT_EQ(b.run(10), "");
}

TEST(BinaryDialogue, RefusesWhatItDoesNotUnderstandAndLeavesOutWhatIsBroken) {
  Bench b(binary_protocol());
  const auto fault = [&](const std::string& request) {
    const std::string reply = b.ask(request);
    const auto read = read_frame(reply);
    if (!read || read->type != 0x84 || read->payload.size() < 10) return -1;
    EXPECT_EQ(read->sequence, std::uint8_t(request[3]));
    return int(read->payload[8]);
  };
  EXPECT_EQ(fault(frame(Verb(0), 1, "")), 1);
  EXPECT_EQ(fault(frame(Verb(8), 2, "")), 1);
  EXPECT_EQ(fault(frame(Verb::time, 3, "x")), 2);
  EXPECT_EQ(fault(frame(Verb::set, 4, "")), 2);
  EXPECT_EQ(fault(frame(Verb::set, 5, bytes_of(Byte(0), Byte(0), 1.f, Byte(0)))), 2);
  EXPECT_EQ(fault(frame(Verb::set, 6, bytes_of(Byte(0), Byte(0), 1.f))), 2);
  EXPECT_EQ(fault(frame(Verb::get, 7, "", 2)), 2);
  EXPECT_EQ(fault(frame(Verb::get, 8, bytes_of(Byte(2)))), 3);
  EXPECT_EQ(fault(frame(Verb::get, 9, bytes_of(Byte(0), Byte(6)))), 4);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    EXPECT_EQ(fault(frame(Verb::set, 10, bytes_of(Byte(1), Byte(0), bad))), 5);
  EXPECT_EQ(fault(frame(Verb::set, 11, bytes_of(Byte(1), Byte(0), 11.f))), 6);
  EXPECT_EQ(fault(frame(Verb::wait, 12, bytes_of(std::int64_t(-1)))), 6);
  EXPECT_EQ(fault(frame(Verb::report, 13, bytes_of(std::int64_t(9'999'999)))), 6);
  EXPECT_EQ(fault(frame(Verb::get, 14, bytes_of(Byte(0), Byte(4)))), 7);
  const std::uint64_t replies = b.replies;
  EXPECT_EQ(b.ask("rubbish"), "");
  EXPECT_EQ(b.ask(frame(Verb::time, 15, "").substr(1)), "");
  EXPECT_EQ(b.replies, replies);
  EXPECT_EQ(b.answers, b.messages);
}

/// Returns the bytes of the code block after `label`: two hexadecimal digits each; text after two blanks is an
/// explanation.
std::string bytes_in_readme(const std::string& label) {
  const std::string text = test::text_of(README);
  const std::size_t at = text.find(label + "\n\n");
  if (at == text.npos) return "there is no " + label;
  const std::size_t begin = at + label.size() + 2;
  std::istringstream block(text.substr(begin, text.find("\n\n", begin) - begin));
  std::string bytes;
  for (std::string line; std::getline(block, line);) {
    line.erase(0, line.find_first_not_of(' '));
    std::istringstream digits(line.substr(0, line.find("  ")));
    for (std::string byte; digits >> byte;) bytes += char(std::stoi(byte, nullptr, 16));
  }
  return bytes;
}

TEST(BinaryDialogue, OfTheReadmeIsAnsweredAsItSays) {
  Bench b(binary_protocol());
  b.run(125);
  const std::string set = bytes_in_readme("`set` of group 0 to 0.5 and -0.25:");
  EXPECT_EQ(set, frame(Verb::set, 1, bytes_of(Byte(0), Byte(0), 0.5f, -0.25f)));
  EXPECT_EQ(b.ask(set), bytes_in_readme("the reply, `ok` at 1.25 s:"));
  EXPECT_EQ(b.ask(bytes_in_readme("`get` of group 0:")), bytes_in_readme("the reply, its `state`:"));
}

}  // namespace
}  // namespace muro::wire
