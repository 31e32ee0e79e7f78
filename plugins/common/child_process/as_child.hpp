// SPDX-License-Identifier: MIT
// Functions for programs that are started as a ChildProcess.
#pragma once

#include <signal.h>

#include <cstddef>
#include <initializer_list>

#include "child_process.hpp"

namespace muro::as_child {

/// Exit code of a process whose socket is no longer that of the start, because somebody has closed it.
inline constexpr int exit_without_socket = 173;

/// Must be called first. From then on the process leaves no core files. Returns false if it is not a child. [main]
bool begin();

/// Starts a thread that ends the process, and those that it has started, when its parent has ended. It works whatever
/// the process does meanwhile, and whatever descriptors it closes. Returns false if there can be no thread. [main]
bool end_with_parent();

/// Whether the socket is still that of the start. May be called in signal handlers.
bool has_socket();

/// Transfers a whole buffer on the socket. When the parent has ended, the call does not return and the process ends.
void send(const void* data, std::size_t size);
void receive(void* data, std::size_t size);

/// A function that is called in a signal handler, on its own stack, before the process dies by the signal.
using CrashHandler = void (*)(int number, const siginfo_t& info);
/// Calls `handler` from now on when the process dies by an error of its own, and by each of `more`. [main]
void catch_crashes(CrashHandler handler, std::initializer_list<int> more = {});

}  // namespace muro::as_child
