// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "plugins/controller/common/stream/address.hpp"
#include "plugins/controller/common/stream/claim.hpp"

namespace muro::stream {

/// Stands in for a LiveStream where a scenario is only looked at: opens nothing, and tells what in the scenario and in
/// the folders of this machine would keep the stream from being opened. Ports that other programs have and devices that
/// are not plugged in are matters of the run.
class LookedAtStream {
 public:
  /// Throws muro::Error as LiveStream does.
  LookedAtStream(const std::string& name, const Address& address);

 private:
  Claim claim_;  ///< of this process: keeps two streams of a scenario apart
};

}  // namespace muro::stream
