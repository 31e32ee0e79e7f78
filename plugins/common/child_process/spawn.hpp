// SPDX-License-Identifier: MIT
#pragma once

#include "child_process.hpp"

namespace muro {

/// Starts a program in a process group of its own, with this socket as child_socket. Nothing of ours runs between fork
/// and exec, so that other threads may do what they like. Returns 0, or an error number.
int spawn(const ChildProcess::Setup& setup, int socket, pid_t& pid);

}  // namespace muro
