// SPDX-License-Identifier: MIT
#include "message_log.hpp"

#include <utility>

#include "plugins/common/text/one_line.hpp"

namespace muro::fmu {

void MessageLog::say(Status status, std::string_view text) {
  const std::lock_guard lock(mutex_);
  const std::string line = one_line(text);
  if (status != Status::ok && status != Status::warning) {
    reason_ = line;
    return;
  }
  if (!host_ || (status == Status::ok && !all_)) return;
  if (++said_ > most_messages + 1) return;
  const std::string about = "robot `" + name_ + "`: ";
  if (said_ > most_messages)
    host_->log(LogLevel::warning, about + "further messages of its FMU are left out");
  else
    host_->log(status == Status::ok ? LogLevel::info : LogLevel::warning, about + "FMU: " + line);
}

void MessageLog::pass_on(LogLevel level, std::string_view line) {
  const std::lock_guard lock(mutex_);
  if (host_) host_->log(level, line);
}

std::string MessageLog::take_reason() {
  const std::lock_guard lock(mutex_);
  return std::exchange(reason_, {});
}

void MessageLog::close() {
  const std::lock_guard lock(mutex_);
  host_ = nullptr;
}

}  // namespace muro::fmu
