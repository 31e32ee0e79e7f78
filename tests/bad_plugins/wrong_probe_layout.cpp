// SPDX-License-Identifier: MIT
// Its SDK has the members of a shape in another order, in a struct of the same size.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.probe_layout ^= 1)
