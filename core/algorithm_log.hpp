// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "core/extensions.hpp"
#include "muro/algorithm.hpp"

namespace muro {

/// The host of algorithms: passes on their log lines, with the name of the algorithm, and gives them extensions.
class AlgorithmLog final : public Host {
 public:
  explicit AlgorithmLog(Extensions& extensions);

  /// Receives the log lines; default: warnings and errors go to standard error.
  std::function<void(LogLevel, std::string_view)> sink;
  void log(LogLevel level, std::string_view text) noexcept override;
  void* find_extension(const ExtensionId& id) noexcept override;

 private:
  std::mutex mutex_;
  Extensions& extensions_;
};

}  // namespace muro
