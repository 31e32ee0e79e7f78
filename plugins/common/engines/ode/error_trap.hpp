// SPDX-License-Identifier: MIT
// Errors and messages of the Open Dynamics Engine, which otherwise ends the process or writes to stderr.
#pragma once

#include <atomic>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::ode {

/// Writes ODE's messages to the log of a host, each kind of message once. [any thread]
class MessageLog {
 public:
  /// `teller`: the user of ODE, such as "motion.ode". Without a host no messages are shown.
  MessageLog() = default;
  MessageLog(Host& host, std::string_view teller) : host_(&host), teller_(teller) {}

  /// Whether a message is new: true the first time it comes. `kind`: the constant text of which ODE makes the message.
  bool is_new(const char* kind);
  void tell(const std::string& message);

 private:
  static constexpr std::size_t max_kinds = 16;

  Host* host_ = nullptr;
  std::string_view teller_;
  std::atomic<const char*> kinds_[max_kinds] = {};
};

/// While a trap lives, failed assertions and errors of ODE in its thread throw Error, and messages go to a MessageLog.
/// After a throw ODE's work is half done: neither the world nor the spaces that took part can be used or destroyed.
class ErrorTrap {
 public:
  explicit ErrorTrap(MessageLog& messages);
  ~ErrorTrap();
  ErrorTrap(const ErrorTrap&) = delete;
  ErrorTrap& operator=(const ErrorTrap&) = delete;

 private:
  MessageLog* outer_;
};

/// Makes ODE call the traps of this plugin first, then the handlers before. Once a process is enough. [any thread]
void set_error_handlers();

}  // namespace muro::ode
