// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/controller/common/stream/stream.hpp"

namespace muro::jsonrpc {

/// Takes one line as a message. A client whose first line does not begin with an object or a batch speaks another
/// protocol, such as a browser that was tricked into a POST. It is disconnected before its second line is read.
inline std::size_t size_of_first(std::string_view bytes, bool is_first_of_client) {
  if (is_first_of_client && bytes.front() != '{' && bytes.front() != '[') return stream::Framing::invalid;
  return stream::line_size(bytes, is_first_of_client);
}

inline constexpr stream::Framing request_framing{.size_of_first = size_of_first, .longest = 1 << 20};

}  // namespace muro::jsonrpc
