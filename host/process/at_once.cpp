// SPDX-License-Identifier: MIT
// _exit() and _Exit() of the program: loaded libraries find these before those of the C library.
#include <unistd.h>

#include <cstdlib>

#include "host/process/exit_guard.hpp"

extern "C" {
[[gnu::visibility("default")]] void _exit(int code) { muro::host::ExitGuard::leave_for_others(code); }
[[gnu::visibility("default")]] void _Exit(int code) noexcept { muro::host::ExitGuard::leave_for_others(code); }
}
