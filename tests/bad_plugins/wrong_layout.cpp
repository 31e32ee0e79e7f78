// SPDX-License-Identifier: MIT
// A struct of its SDK that crosses the boundary was changed, in a way that the stamp does not see.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.layout ^= 1)
