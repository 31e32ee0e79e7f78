// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace muro {

/// Whether a sanitizer is active. Sanitizers have more address space than any bound.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif
#else
inline constexpr bool is_sanitized = false;
#endif

/// Returns the bytes of address space that this process has now. May be called in signal handlers.
std::uint64_t own_address_space();

/// Limits the address space of this process from now on, in bytes; the system may allow less. No effect with a
/// sanitizer.
void bound_address_space(std::uint64_t bytes);

}  // namespace muro
