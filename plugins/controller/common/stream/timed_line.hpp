// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace muro::stream {

/// A serial line. Bytes pass one after the other, each in ten bit times.
class TimedLine {
 public:
  explicit TimedLine(std::uint32_t baud) : baud_(baud) {}

  /// Appends bytes at `now`. Returns the instant (ns) when the last of them has passed.
  std::int64_t put(std::int64_t now, std::size_t bytes) {
    if (now >= end()) restart(now, 0);
    on_line_ += bytes;
    return end();
  }
  /// Returns the number of further bytes that have passed by `now`.
  std::size_t advance(std::int64_t now) {
    // the end of the bytes on the line limits `now`, so that the product stays small
    const std::uint64_t elapsed = now <= origin_ ? 0 : std::uint64_t(std::min(now, end()) - origin_);
    const std::uint64_t passed = now >= end() ? on_line_ : std::min(on_line_, elapsed * baud_ / bits_ns);
    const std::uint64_t more = passed - std::min(passed, passed_);
    passed_ = std::max(passed, passed_);
    if (passed_ > rebase_after) restart(time_of(passed_), on_line_ - passed_);
    return std::size_t(more);
  }
  /// Sets the rate for the bytes that have not passed by `now`, the instant of the last advance().
  void set_baud(std::int64_t now, std::uint32_t baud) {
    restart(now);
    baud_ = baud;
  }
  /// Starts the bytes on the line again at `now`, which may be earlier than before.
  void restart(std::int64_t now) { restart(now, on_line_ - passed_); }
  /// Removes all bytes from the line.
  void clear() { restart(origin_, 0); }
  std::int64_t end() const { return time_of(on_line_); }

 private:
  static constexpr std::uint64_t bits_ns = 10'000'000'000;  ///< ten bits, at 1 bit/s
  static constexpr std::uint64_t rebase_after = 1 << 20;    ///< bytes: numbers stay small

  void restart(std::int64_t origin, std::uint64_t on_line) {
    origin_ = origin;
    on_line_ = on_line;
    passed_ = 0;
  }
  std::int64_t time_of(std::uint64_t byte) const {
    return origin_ + std::int64_t((byte * bits_ns + baud_ - 1) / baud_);
  }

  std::uint64_t baud_;
  std::int64_t origin_ = 0;    ///< ns
  std::uint64_t on_line_ = 0;  ///< bytes since `origin_`
  std::uint64_t passed_ = 0;   ///< number of these bytes that advance() has returned
};

/// Bytes on their way to a client, and answers that end when these bytes have passed.
class OutputLine {
 public:
  explicit OutputLine(std::uint32_t baud) : line_(baud) {}

  std::size_t waiting() const { return bytes_.size() - head_; }
  void put(std::int64_t now, std::string_view bytes) {
    line_.put(now, bytes.size());
    bytes_ += bytes;
    put_ += bytes.size();
  }
  /// Marks the end of an answer: it is complete when all bytes now on the line have passed.
  void put_answer() { answers_.push_back(put_); }

  /// Returns the bytes that have passed by `now`; valid until the next put.
  std::string_view advance(std::int64_t now) {
    if (head_ > bytes_.size() / 2) {
      bytes_.erase(0, head_);
      head_ = 0;
    }
    const std::size_t size = line_.advance(now);
    const std::string_view passed = std::string_view(bytes_).substr(head_, size);
    head_ += size;
    passed_ += size;
    return passed;
  }
  /// Returns the number of answers that have become complete.
  std::size_t take_answers() {
    const auto end = std::upper_bound(answers_.begin(), answers_.end(), passed_);
    const auto count = std::size_t(end - answers_.begin());
    answers_.erase(answers_.begin(), end);
    return count;
  }
  /// Prepares for another client: removes all bytes and answers.
  void clear() {
    line_.clear();
    answers_.clear();
    bytes_.clear();
    head_ = 0;
    passed_ = put_;
  }
  void set_baud(std::int64_t now, std::uint32_t baud) { line_.set_baud(now, baud); }
  void restart(std::int64_t now) { line_.restart(now); }

 private:
  TimedLine line_;
  std::string bytes_;
  std::size_t head_ = 0;                ///< number of `bytes_` that have passed
  std::uint64_t put_ = 0, passed_ = 0;  ///< total counts of bytes
  std::vector<std::uint64_t> answers_;  ///< counts of passed bytes at which the answers are complete
};

}  // namespace muro::stream
