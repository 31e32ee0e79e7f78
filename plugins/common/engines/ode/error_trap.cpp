// SPDX-License-Identifier: MIT
#include "error_trap.hpp"

#include <ode/ode.h>

#include <cstdio>

#include "muro/algorithm.hpp"

namespace muro::ode {

namespace {

thread_local MessageLog* trap = nullptr;

/// Handlers before. Each plugin that uses ODE has its own handlers and a copy of this file: they form a chain.
dMessageFunction *next_error = nullptr, *next_debug = nullptr, *next_message = nullptr;

std::string text_of(const char* format, va_list arguments) {
  char text[500];
  std::vsnprintf(text, sizeof text, format, arguments);
  return text;
}

/// Throws or prints an error. ODE ends the process when its handlers for errors return.
void handle(dMessageFunction* next, const char* title, int number, const char* format, va_list arguments) {
  if (trap) throw Error("ODE: " + text_of(format, arguments));
  if (next) return next(number, format, arguments);
  std::fprintf(stderr, "%s %d: %s\n", title, number, text_of(format, arguments).c_str());
}

void on_error(int number, const char* format, va_list arguments) {
  handle(next_error, "ODE Error", number, format, arguments);
}

void on_debug(int number, const char* format, va_list arguments) {
  handle(next_debug, "ODE INTERNAL ERROR", number, format, arguments);
}

void on_message(int number, const char* format, va_list arguments) {
  if (!trap && next_message) return next_message(number, format, arguments);
  if (!trap)
    std::fprintf(stderr, "ODE Message %d: %s\n", number, text_of(format, arguments).c_str());
  else if (trap->is_new(format))
    trap->tell(text_of(format, arguments));
}

}  // namespace

bool MessageLog::is_new(const char* kind) {
  for (std::atomic<const char*>& known : kinds_) {
    const char* expected = nullptr;
    if (known.compare_exchange_strong(expected, kind)) return true;
    if (expected == kind) return false;
  }
  return false;
}

void MessageLog::tell(const std::string& message) {
  if (host_) host_->log(LogLevel::warning, std::string(teller_) + ": ODE says once or more often: " + message);
}

ErrorTrap::ErrorTrap(MessageLog& messages) : outer_(trap) { trap = &messages; }
ErrorTrap::~ErrorTrap() { trap = outer_; }

void set_error_handlers() {
  static const bool done = [] {
    next_error = dGetErrorHandler();
    next_debug = dGetDebugHandler();
    next_message = dGetMessageHandler();
    dSetErrorHandler(&on_error);
    dSetDebugHandler(&on_debug);
    dSetMessageHandler(&on_message);
    return true;
  }();
  static_cast<void>(done);
}

}  // namespace muro::ode
