// SPDX-License-Identifier: MIT
// Calls a function that no library has.
#include "broken_table.hpp"

extern "C" int function_that_nobody_wrote();
extern "C" __attribute__((visibility("default"))) int calls_it() { return function_that_nobody_wrote(); }

BROKEN_PLUGIN(static_cast<void>(table))
