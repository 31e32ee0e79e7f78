// SPDX-License-Identifier: MIT
// Nothing wrong in the source: CMake compiles it with what makes it unusable, or spoils its description.
#include "broken_table.hpp"

BROKEN_PLUGIN(static_cast<void>(table))
