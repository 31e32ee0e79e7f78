// SPDX-License-Identifier: MIT
// Its compiler laid out the SDK's types in another way.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.probe_size += 8)
