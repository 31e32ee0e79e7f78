// SPDX-License-Identifier: MIT
// Sends and receives the messages of the team by the radio of the robot (docs/guide/radio.md).
#pragma once

#include <cstdint>
#include <span>

#include "message.hpp"
#include "muro_controller.hpp"

namespace mixed_team {

constexpr std::size_t most_messages = 32;  // limit within a period of the control code

/// Ports: inputs of lists, outputs of one message.
constexpr muro_port received_port = {"radio.received", "1, s, dBm", 7 * most_messages,
                                     MURO_PORT_LIST | MURO_PORT_OPTIONAL};
constexpr muro_port received_bytes_port = {"radio.received.bytes", "1", 256 * most_messages,
                                           MURO_PORT_LIST | MURO_PORT_OPTIONAL};
constexpr muro_port send_bytes_port = {"radio.send.bytes", "1", 256, 0};
constexpr muro_port send_size_port = {"radio.send.size", "1", 1, 0};
constexpr muro_port send_number_port = {"radio.send.number", "1", 1, MURO_PORT_INTEGER};

/// Calls `take` with each message of the team. `list`, `bytes`: values of `radio.received` and `radio.received.bytes`.
template <class Take>
void receive(std::span<const double> list, std::span<const double> bytes, Take take) {
  enum { from, number, sent, received, rssi, size, first, header };
  for (; list.size() >= header; list = list.subspan(header)) {
    const auto begin = std::size_t(list[first]), length = std::size_t(list[size]);
    if (begin + length > bytes.size()) return;  // the bytes of further messages did not fit
    if (const auto message = read(bytes.subspan(begin, length))) take(*message);
  }
}

/// Returns whether this robot sends now: every `period` s, at a phase by its name, so that senders rarely meet.
inline bool is_turn(const muro::controller::Step& now, std::int64_t name, double period) {
  const auto steps = std::uint64_t(std::nearbyint(std::max(1.0, period / now.period())));
  return (now.index() + std::uint64_t(name)) % steps == 0;
}

/// Returns 16 bits that two members of a team hardly ever have in common.
inline std::int64_t name_of(std::uint64_t seed) { return std::int64_t((seed ^ seed >> 16 ^ seed >> 32) & 0xffff); }

}  // namespace mixed_team
