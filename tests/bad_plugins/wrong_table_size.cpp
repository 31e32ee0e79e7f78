// SPDX-License-Identifier: MIT
// Its table has more members.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.table_size += 16)
