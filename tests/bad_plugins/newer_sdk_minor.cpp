// SPDX-License-Identifier: MIT
// Needs a feature that only a later SDK has.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.sdk_minor += 1)
