// SPDX-License-Identifier: MIT
#pragma once

#include "plugins/controller/common/stream/stream.hpp"

namespace muro::jsonrpc {

/// One message a line. A client whose first line begins with anything but an object or a batch speaks another protocol,
/// as a browser does that was talked into a POST: it is disconnected before its second line is looked at.
inline std::size_t size_of_first(std::string_view bytes, bool is_first_of_client) {
  if (is_first_of_client && bytes.front() != '{' && bytes.front() != '[') return stream::Framing::invalid;
  return stream::line_size(bytes, is_first_of_client);
}

inline constexpr stream::Framing request_framing{.size_of_first = size_of_first, .longest = 1 << 20};

}  // namespace muro::jsonrpc
