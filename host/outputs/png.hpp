// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace muro::host {

/// Returns the bytes of a PNG file. `rgb`: sRGB, rows from the top.
std::string png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb);

}  // namespace muro::host
