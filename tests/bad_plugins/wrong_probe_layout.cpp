// SPDX-License-Identifier: MIT
// Its SDK had a shape's parts in another order, in a struct of the same size.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.probe_layout ^= 1)
