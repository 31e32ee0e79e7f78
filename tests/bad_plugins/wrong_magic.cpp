// SPDX-License-Identifier: MIT
// Its table does not begin with MUROPLUG.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.magic[0] = 'X')
