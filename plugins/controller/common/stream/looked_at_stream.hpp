// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "plugins/controller/common/stream/address.hpp"
#include "plugins/controller/common/stream/claim.hpp"

namespace muro::stream {

/// Replaces a LiveStream when a scenario is only checked. It opens nothing. It reports what in the scenario, or in the
/// folders of this machine, would prevent the stream from being opened. It does not report ports that other programs
/// use or devices that are not plugged in: these depend on the time of the run.
class LookedAtStream {
 public:
  /// Checks the address. Throws muro::Error as LiveStream does.
  LookedAtStream(const std::string& name, const Address& address);

 private:
  Claim claim_;  ///< claim of this process: two streams of a scenario cannot use one path
};

}  // namespace muro::stream
