// SPDX-License-Identifier: MIT
#include "core/algorithm_log.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "core/running_call.hpp"
#include "muro/base/printable.hpp"

namespace muro {
namespace {

/// Returns "urban.yaml:14:7: rovers.control (controller.library), robot `rover_3`, t = 0.500000 s: ", or "".
std::string by_whom(std::string_view text) {
  const RunningCall& call = running_call();
  if (!call.callee.load()) return "";
  std::string line = who(call, text);
  if (const std::int64_t time = call.time.load(); time != RunningCall::no_time)
    line += fmt::format("{} t = {:f} s", line.ends_with(',') ? "" : ",", 1e-9 * double(time));
  if (line.ends_with(',')) line.pop_back();
  return line + ": ";
}

void to_standard_error(LogLevel level, std::string_view text) {
  if (level >= LogLevel::warning)
    std::fprintf(stderr, "%s: %.*s\n", level == LogLevel::error ? "error" : "warning", int(text.size()), text.data());
}

}  // namespace

AlgorithmLog::AlgorithmLog(Extensions& extensions) : sink(to_standard_error), extensions_(extensions) {}

void AlgorithmLog::log(LogLevel level, std::string_view text) noexcept {
  const std::string line = printable(by_whom(text) + std::string(text), "\n\t");
  const std::lock_guard lock(mutex_);
  sink(level, line);
}

void* AlgorithmLog::find_extension(const ExtensionId& id) noexcept {
  std::string why_not;
  void* found = extensions_.find(id, why_not);
  if (!why_not.empty()) log(LogLevel::warning, why_not);
  return found;
}

}  // namespace muro
