// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace muro::test {

/// Returns the number of calls of malloc, calloc and realloc of the whole process so far, plugins included. Stays 0 in
/// builds with sanitizers, which replace these functions.
std::uint64_t allocations();
/// Returns the number of calls of the calling thread alone.
std::uint64_t allocations_of_this_thread();

}  // namespace muro::test
