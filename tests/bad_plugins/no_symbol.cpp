// SPDX-License-Identifier: MIT
// Has an algorithm, but no MURO_PLUGIN.
#include "broken_table.hpp"

extern "C" __attribute__((visibility("default"))) const char* const some_other_name = broken::description.id.data();
