// SPDX-License-Identifier: MIT
// Written for the next SDK.
#include "broken_table.hpp"

BROKEN_PLUGIN(table.stamp.sdk_major += 1)
