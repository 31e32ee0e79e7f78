// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::stream {

/// Keeps a path for one stream of one process. No other stream on this machine can claim it. The claim ends with its
/// process, also when that crashes. So a file found at a path that is claimed now is a remainder of an earlier process.
class Claim {
 public:
  Claim() = default;
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  ~Claim();
  /// Claims the path. Returns false when another stream has it. Throws muro::Error when the system fails.
  bool take(const std::string& path);

 private:
  int socket_ = -1;
};

}  // namespace muro::stream
