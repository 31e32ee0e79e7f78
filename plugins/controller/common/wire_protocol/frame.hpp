// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace muro::wire {

/// A message of the binary protocol:
///
///     0      a5 5a           where a frame may begin
///     2      u8              type
///     3      u8              sequence number
///     4      u16             N, length of the payload
///     6      u8              format of numbers: 0 f32, 1 f64
///     7      u8              check of the header: the sum of bytes 2 to 7 is 255, modulo 256
///     8      N bytes         payload
///     8 + N  u32             CRC-32 of all bytes before
///
/// Numbers are little-endian.
struct Frame {
  std::uint8_t type = 0;
  std::uint8_t sequence = 0;
  std::uint8_t format = 0;
  std::string_view payload;
};

inline constexpr std::size_t frame_header = 8, frame_overhead = 12;
/// Longest payload of a received frame. A longer one counts as garbage, so that a wrong length causes little delay.
inline constexpr std::size_t longest_request = 2048;
inline constexpr std::size_t longest_payload = 65535;

/// Returns the frame that `bytes` form; nothing when they are not exactly one intact frame.
std::optional<Frame> read_frame(std::string_view bytes);

/// Returns the size of a frame, or of garbage up to the next possible frame; for stream::Framing.
std::size_t frame_size(std::string_view bytes, bool is_first_of_client);

/// Adds a frame. Cuts a payload that is too long.
void add_frame(std::string& out, const Frame& frame);

/// Adds the bytes of a number of any type, little-endian.
template <class T>
void add_bytes(std::string& out, T number) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

}  // namespace muro::wire
