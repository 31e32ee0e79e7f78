// SPDX-License-Identifier: MIT
// Its SDK has another layout of a struct that crosses the boundary; the stamp does not show the difference.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.layout ^= 1)
