// SPDX-License-Identifier: MIT
// For programs that are started as a ChildProcess.
#pragma once

#include <signal.h>

#include <cstddef>
#include <initializer_list>

#include "child_process.hpp"

namespace muro::as_child {

/// The exit code where the socket is no longer that of the start: somebody has closed it.
inline constexpr int exit_without_socket = 173;

/// First of all. From then on the process leaves no core files. False where it was not started as a child. [main]
bool begin();

/// From then on a thread ends the process, and those that it has started, when its parent has ended, whatever it does
/// meanwhile, and whatever descriptors it closes. False when there can be no thread. [main]
bool end_with_parent();

/// Whether the socket is still that of the start. May be called in signal handlers.
bool has_socket();

/// Whole buffers on the socket. They do not return when the parent has ended, and the process goes on no more.
void send(const void* data, std::size_t size);
void receive(void* data, std::size_t size);

/// What happens in a signal handler, on a stack of its own, before the process dies by the signal.
using CrashHandler = void (*)(int number, const siginfo_t& info);
/// From now on `handler` is called when the process dies by an error of its own, and by each of `more`. [main]
void catch_crashes(CrashHandler handler, std::initializer_list<int> more = {});

}  // namespace muro::as_child
