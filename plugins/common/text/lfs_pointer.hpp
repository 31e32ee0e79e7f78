// SPDX-License-Identifier: MIT
// What a clone without Git LFS has in place of a large file: a few lines of text that name it.
#pragma once

#include <string_view>

namespace muro {

/// Whether the content of a file begins as a pointer of Git LFS does (its specification, version 1).
inline bool is_lfs_pointer(std::string_view content) { return content.starts_with("version https://git-lfs"); }

/// What to tell of such a file: "FILE " and this.
inline constexpr std::string_view is_lfs_pointer_text =
    "is only a pointer to the file, left there by Git LFS; run `git lfs pull`";

}  // namespace muro
