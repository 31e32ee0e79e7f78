// SPDX-License-Identifier: MIT
// The message of the team: the place of its sender, the target that it claims, and all targets that it knows. Each
// robot sends it again and again, so the next message replaces a lost one. It passes on what it has heard, so robots
// out of each other's range learn of it from others. At most 106 bytes: a frame of IEEE 802.15.4 has 127.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "targets.hpp"

namespace mixed_team {

struct Message {
  Point at;                           ///< place of the sender, m
  std::int64_t name = 0;              ///< 16 random bits that distinguish senders
  std::size_t claim = Targets::none;  ///< number of a target in the list
  double cost = 0;                    ///< s, time to get there
  Targets targets;                    ///< write() leaves out those with too few sightings
};

namespace detail {
constexpr std::uint8_t mark = 0x4d;     // first byte of the team's messages
constexpr std::uint8_t no_claim = 255;  // in place of a number
constexpr std::size_t head = 10, each = 6;

class Writer {
 public:
  explicit Writer(std::span<double> bytes) : bytes_(bytes) {}
  void byte(std::int64_t value) { bytes_[used_++] = double(value & 255); }
  void word(double value) {  // 16 bits, the lower byte first
    const auto v = std::int64_t(std::nearbyint(std::clamp(value, -32768.0, 65535.0)));
    byte(v), byte(v >> 8);
  }
  void centimetres(double m) { word(std::clamp(100 * m, -32768.0, 32767.0)); }  // with a sign
  std::size_t used() const { return used_; }

 private:
  std::span<double> bytes_;
  std::size_t used_ = 0;
};

class Reader {
 public:
  explicit Reader(std::span<const double> bytes) : bytes_(bytes) {}
  std::int64_t byte() { return std::int64_t(bytes_[used_++]); }
  std::int64_t word() {
    const std::int64_t low = byte();
    return low | byte() << 8;
  }
  double centimetres() {  // m, with a sign
    const std::int64_t w = word();
    return 0.01 * double(w < 32768 ? w : w - 65536);
  }
  std::size_t left() const { return bytes_.size() - used_; }

 private:
  std::span<const double> bytes_;
  std::size_t used_ = 0;
};
}  // namespace detail

/// Writes the bytes of a message; returns their number. `least`: targets with fewer sightings are left out.
inline std::size_t write(const Message& m, std::int64_t least, std::span<double> bytes) {
  std::array<std::size_t, Targets::most> sent{};
  std::size_t count = 0;
  std::int64_t claim = detail::no_claim;
  for (std::size_t i = 0; i < m.targets.size(); ++i) {
    if (m.targets[i].sightings < least) continue;
    if (i == m.claim) claim = std::int64_t(count);
    sent[count++] = i;
  }
  detail::Writer w(bytes);
  w.byte(detail::mark);
  w.word(double(m.name));
  w.centimetres(m.at.x), w.centimetres(m.at.y);
  w.byte(claim);
  w.byte(std::int64_t(std::clamp(m.cost, 0.0, 255.0)));
  w.byte(std::int64_t(count));
  for (std::size_t k = 0; k < count; ++k) {
    const Target& t = m.targets[sent[k]];
    w.centimetres(t.at.x), w.centimetres(t.at.y);
    w.byte(std::min<std::int64_t>(t.sightings, 255));
    w.byte(t.confirmed);
  }
  return w.used();
}

/// Returns the message; nothing when the bytes are no message of the team.
inline std::optional<Message> read(std::span<const double> bytes) {
  detail::Reader r(bytes);
  if (r.left() < detail::head || r.byte() != detail::mark) return std::nullopt;
  Message m;
  m.name = r.word();
  m.at.x = r.centimetres(), m.at.y = r.centimetres();
  const std::int64_t claim = r.byte();
  m.cost = double(r.byte());
  const auto count = std::size_t(r.byte());
  if (count > Targets::most || r.left() < count * detail::each) return std::nullopt;
  for (std::size_t k = 0; k < count; ++k) {
    Target t;
    t.at.x = r.centimetres(), t.at.y = r.centimetres();
    t.sightings = r.byte(), t.confirmed = r.byte();
    const std::size_t number = m.targets.learn(t);
    if (std::int64_t(k) == claim) m.claim = number;
  }
  return m;
}

}  // namespace mixed_team
