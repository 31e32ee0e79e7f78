// SPDX-License-Identifier: MIT
// The source is correct: CMake compiles it with flags that make it unusable, or damages its description.
#include "broken_table.hpp"

BROKEN_PLUGIN(static_cast<void>(table))
