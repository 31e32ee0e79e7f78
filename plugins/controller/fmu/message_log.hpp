// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::fmu {

/// Status codes with the numbers of both versions of the standard; only FMI 2 has `pending`.
enum class Status { ok, warning, discard, error, fatal, pending };

/// Messages of an instance of an FMU, from any thread. Warnings go to the host. Messages about an error are kept for
/// the error that is thrown.
class MessageLog {
 public:
  /// `name`: name of the robot. `all`: whether to log other messages than warnings, too.
  MessageLog(Host& host, std::string name, bool all) : host_(&host), name_(std::move(name)), all_(all) {}
  MessageLog(const MessageLog&) = delete;
  MessageLog& operator=(const MessageLog&) = delete;

  bool logs_all() const { return all_; }
  /// Logs a line that already names its source.
  void pass_on(LogLevel level, std::string_view line);
  void say(Status status, std::string_view text);
  /// Returns the last message about an error or a discarded step, and forgets it.
  std::string take_reason();
  /// Stops all messages to the host, which may be gone.
  void close();

 private:
  static constexpr int most_messages = 100;

  std::mutex mutex_;
  Host* host_;
  std::string name_, reason_;
  bool all_;
  int said_ = 0;
};

}  // namespace muro::fmu
