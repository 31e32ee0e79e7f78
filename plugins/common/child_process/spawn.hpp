// SPDX-License-Identifier: MIT
#pragma once

#include "child_process.hpp"

namespace muro {

/// Starts a program in its own process group, with this socket as child_socket. None of our code runs between fork and
/// exec, so other threads may do what they like. Returns 0, or an error number.
int spawn(const ChildProcess::Setup& setup, int socket, pid_t& pid);

}  // namespace muro
