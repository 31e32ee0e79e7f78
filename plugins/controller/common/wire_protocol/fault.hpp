// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace muro::wire {

/// Reasons to refuse a request. The numbers are part of the protocols.
enum class FaultCode : std::uint8_t {
  unknown_request = 1,
  wrong_fields = 2,  ///< too few, too many, or cut short
  unknown_group = 3,
  unknown_quantity = 4,
  not_a_number = 5,  ///< or not a finite one
  out_of_range = 6,
  not_available = 7,  ///< the group cannot be read, or set, in this way
};

/// A request that cannot be carried out. No part of it has taken effect. It is thrown, and sent to the client.
struct Fault {
  FaultCode code;
  std::string text;  ///< one line
};

}  // namespace muro::wire
