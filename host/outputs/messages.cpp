// SPDX-License-Identifier: MIT
#include "host/outputs/messages.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace muro::host {

void Messages::say(const std::string& line) {
  if (said_.insert(line).second) fmt::print(stderr, "{}\n", message_text(line));
}

void Messages::log(LogLevel level, std::string_view text) {
  if (level == LogLevel::debug) return;
  const char* const severity = level == LogLevel::error ? "error" : level == LogLevel::warning ? "warning" : "note";
  say(fmt::format("{}: {}", severity, text));
}

}  // namespace muro::host
