// SPDX-License-Identifier: MIT
// A device for tests, and a reader of its replies that shares no code with the device.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device.hpp"

namespace muro::scip2 {

/// Returns the check character as the text of the protocol defines it.
inline char expected_sum(const std::string& line) {
  int sum = 0;
  for (const unsigned char c : line) sum = (sum + c) % 64;
  return char('0' + sum);
}

inline long decoded(const std::string& characters) {
  long value = 0;
  for (const char c : characters) value = value * 64 + (c - '0');
  return value;
}

/// One reply: lines until an empty one.
struct Reply {
  std::string echo, status;
  std::vector<std::string> lines;  ///< lines after the status, with their sums
  bool sums_are_right = true;

  long timestamp() const { return lines.empty() ? -1 : decoded(lines[0].substr(0, 4)); }
  /// Returns values of `characters` characters from the data lines after the time stamp; values may cross line ends.
  std::vector<long> values(std::size_t characters) const {
    std::string data;
    for (std::size_t i = 1; i < lines.size(); ++i) data += lines[i].substr(0, lines[i].size() - 1);
    std::vector<long> result;
    for (std::size_t at = 0; at + characters <= data.size(); at += characters)
      result.push_back(decoded(data.substr(at, characters)));
    EXPECT_EQ(data.size() % characters, 0u);
    return result;
  }
};

/// Returns the replies of SCIP 2.0 in `bytes`; nothing when the last one is not complete.
inline std::optional<std::vector<Reply>> replies_in(const std::string& bytes) {
  std::vector<Reply> replies;
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = bytes.find('\n', begin);
    if (end == std::string::npos) return std::nullopt;
    lines.push_back(bytes.substr(begin, end - begin));
    begin = end + 1;
    if (!lines.back().empty() || lines.size() < 2) continue;
    Reply r{lines[0], lines[1], {lines.begin() + 2, lines.end() - 1}, true};
    for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
      const std::string text = lines[i].substr(0, lines[i].size() - 1);
      const bool is_entry = !text.empty() && text.back() == ';' && text.find(':') != text.npos;
      if (lines[i].back() != expected_sum(is_entry ? text.substr(0, text.size() - 1) : text)) r.sums_are_right = false;
    }
    if (r.status.size() == 3) r.status.pop_back();
    replies.push_back(r);
    lines.clear();
  }
  if (!lines.empty()) return std::nullopt;
  return replies;
}

/// A device with the scan of a test, in steps of a millisecond, switched on at 1 ms.
struct Bench : DeviceHost {
  explicit Bench(Model m = urg_04lx(), bool is_swept = false) : device(std::move(m), is_swept) {
    memory.resize(device.state_size() / 8 + 1);
    scan.assign(device.model().step_count(), 1000);
    intensity.assign(scan.size(), 300);
    run(1);
  }
  virtual ~Bench() = default;
  State& state() { return *reinterpret_cast<State*>(memory.data()); }

  void send(std::uint32_t to, std::string_view bytes) override {
    (to == 1 ? output : other_output) += bytes;
    times.push_back(milliseconds);
  }
  void read_scan(std::span<std::uint32_t> d, std::span<std::uint32_t> i) override {
    ++scans_read;
    std::copy(scan.begin(), scan.end(), d.begin());
    std::copy(intensity.begin(), intensity.end(), i.begin());
  }
  void answered() override { ++answers; }
  void set_bit_rate(std::uint32_t rate) override { bit_rate = rate; }

  /// Sends lines, each with its LF, as client 1.
  void type(const std::string& lines, std::uint32_t client = 1) {
    for (std::size_t begin = 0; begin < lines.size();) {
      const std::size_t end = lines.find('\n', begin);
      device.receive(state(), client, lines.substr(begin, end - begin), *this);
      begin = end + 1;
    }
  }
  void run(std::int64_t ms) {
    for (const std::int64_t end = milliseconds + ms; milliseconds < end;) {
      ++milliseconds;
      device.advance(state(), milliseconds * 1'000'000, *this);
    }
  }
  /// Returns all bytes that the device sends within `ms`.
  std::string ask(const std::string& lines, std::int64_t ms = 100) {
    output.clear();
    type(lines);
    run(ms);
    return std::exchange(output, "");
  }
  std::string status_of(const std::string& line) {
    const auto replies = replies_in(ask(line + "\n", 200));
    if (!replies || replies->size() != 1) return "no single reply";
    EXPECT_EQ((*replies)[0].echo, line);
    EXPECT_TRUE((*replies)[0].sums_are_right);
    return (*replies)[0].status;
  }

  Device device;
  std::vector<std::uint64_t> memory;
  std::vector<std::uint32_t> scan, intensity;
  std::int64_t milliseconds = 0;
  std::string output, other_output;
  std::vector<std::int64_t> times;  ///< times of all replies, ms
  int scans_read = 0, answers = 0;
  std::uint32_t bit_rate = 0;  ///< last rate that was set; 0: the rate at the start
};

/// A device after the command SCIP2.0.
struct Awake : Bench {
  explicit Awake(Model m = urg_04lx(), bool is_swept = false) : Bench(std::move(m), is_swept) { ask("SCIP2.0\n"); }
};

}  // namespace muro::scip2
