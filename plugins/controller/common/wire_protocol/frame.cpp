// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/frame.hpp"

#include <cstring>

#include "plugins/controller/common/wire_protocol/crc32.hpp"

namespace muro::wire {

namespace {

constexpr char first_sync = char(0xa5), second_sync = 0x5a;

std::size_t payload_size(std::string_view header) {
  return std::size_t(std::uint8_t(header[4])) | std::size_t(std::uint8_t(header[5])) << 8;
}

std::uint8_t sum_of(std::string_view bytes) {
  std::uint8_t sum = 0;
  for (const char c : bytes) sum = std::uint8_t(sum + std::uint8_t(c));
  return sum;
}

bool is_header(std::string_view bytes) {
  return bytes[0] == first_sync && bytes[1] == second_sync && sum_of(bytes.substr(2, 6)) == 255;
}

bool has_right_crc(std::string_view frame) {
  const std::size_t end = frame.size() - 4;
  std::uint32_t crc = 0;
  std::memcpy(&crc, frame.data() + end, sizeof crc);
  return crc == crc32(frame.substr(0, end));
}

/// Returns the number of bytes before the next possible begin of a frame, from the second byte on.
std::size_t garbage_size(std::string_view bytes) { return std::min(bytes.find(first_sync, 1), bytes.size()); }

}  // namespace

std::optional<Frame> read_frame(std::string_view bytes) {
  if (bytes.size() < frame_overhead || !is_header(bytes)) return std::nullopt;
  if (bytes.size() != frame_overhead + payload_size(bytes) || !has_right_crc(bytes)) return std::nullopt;
  return Frame{std::uint8_t(bytes[2]), std::uint8_t(bytes[3]), std::uint8_t(bytes[6]),
               bytes.substr(frame_header, payload_size(bytes))};
}

std::size_t frame_size(std::string_view bytes, bool) {
  if (bytes[0] != first_sync) return garbage_size(bytes);
  if (bytes.size() > 1 && bytes[1] != second_sync) return garbage_size(bytes);
  if (bytes.size() < frame_header) return 0;
  if (!is_header(bytes) || payload_size(bytes) > longest_request) return garbage_size(bytes);
  const std::size_t size = frame_overhead + payload_size(bytes);
  if (bytes.size() < size) return 0;
  return has_right_crc(bytes.substr(0, size)) ? size : garbage_size(bytes);
}

void add_frame(std::string& out, const Frame& frame) {
  const std::string_view payload = frame.payload.substr(0, longest_payload);
  const std::size_t begin = out.size();
  out += first_sync;
  out += second_sync;
  add_bytes(out, frame.type);
  add_bytes(out, frame.sequence);
  add_bytes(out, std::uint16_t(payload.size()));
  add_bytes(out, frame.format);
  add_bytes(out, std::uint8_t(255 - sum_of(std::string_view(out).substr(begin + 2))));
  out += payload;
  add_bytes(out, crc32(std::string_view(out).substr(begin)));
}

}  // namespace muro::wire
