// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/stream.hpp"

namespace muro::stream {

std::size_t line_size(std::string_view bytes, bool) {
  const std::size_t end = bytes.find_first_of("\r\n");
  if (end == bytes.npos) return 0;
  const bool is_pair = end + 1 < bytes.size() && bytes[end] == '\r' && bytes[end + 1] == '\n';
  return end + (is_pair ? 2 : 1);
}

}  // namespace muro::stream
