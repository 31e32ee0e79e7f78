// SPDX-License-Identifier: MIT
// Its stamp has another number of fields.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.stamp_size += 4)
