// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::stream {

/// Keeps a path for one stream of one process: another one of this machine cannot claim it until this one is gone,
/// however it ends. So what is found at a path that is claimed now was left behind.
class Claim {
 public:
  Claim() = default;
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;
  ~Claim();
  /// False: another has it. Throws muro::Error where the system fails.
  bool take(const std::string& path);

 private:
  int socket_ = -1;
};

}  // namespace muro::stream
