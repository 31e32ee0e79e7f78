// SPDX-License-Identifier: MIT
// Errors and messages of the Open Dynamics Engine, which by itself ends the process or writes to stderr.
#pragma once

#include <atomic>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::ode {

/// What ODE tells, each kind of message once, through the log of a host. [any thread]
class MessageLog {
 public:
  /// `teller`: who uses ODE, such as "motion.ode". None of its messages are shown without a host.
  MessageLog() = default;
  MessageLog(Host& host, std::string_view teller) : host_(&host), teller_(teller) {}

  /// `kind`: the constant text of which ODE makes the message; true the first time that it comes.
  bool is_new(const char* kind);
  void tell(const std::string& message);

 private:
  static constexpr std::size_t max_kinds = 16;

  Host* host_ = nullptr;
  std::string_view teller_;
  std::atomic<const char*> kinds_[max_kinds] = {};
};

/// While one lives, failed assertions and errors of ODE in its thread throw Error, and messages go to a MessageLog.
/// What ODE was doing is half done then: neither the world nor the spaces that took part can be used or destroyed.
class ErrorTrap {
 public:
  explicit ErrorTrap(MessageLog& messages);
  ~ErrorTrap();
  ErrorTrap(const ErrorTrap&) = delete;
  ErrorTrap& operator=(const ErrorTrap&) = delete;

 private:
  MessageLog* outer_;
};

/// Makes ODE ask the traps of this plugin first, then who was asked before. Once a process is enough. [any thread]
void set_error_handlers();

}  // namespace muro::ode
