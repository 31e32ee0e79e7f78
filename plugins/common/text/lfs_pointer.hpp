// SPDX-License-Identifier: MIT
// Pointers of Git LFS: a clone without it has a few lines of text in place of a large file.
#pragma once

#include <string_view>

namespace muro {

/// Whether the content of a file begins like a pointer of Git LFS (its specification, version 1).
inline bool is_lfs_pointer(std::string_view content) { return content.starts_with("version https://git-lfs"); }

/// End of the message on such a file, after "FILE ".
inline constexpr std::string_view is_lfs_pointer_text =
    "is only a pointer to the file, left there by Git LFS; run `git lfs pull`";

}  // namespace muro
