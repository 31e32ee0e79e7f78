// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace muro::render {

/// A texture image.
struct Image {
  std::uint32_t width = 0, height = 0;  ///< pixels
  std::vector<std::uint8_t> rgba;       ///< sRGB, rows from the top

  static Image white() { return {1, 1, {255, 255, 255, 255}}; }
  /// Reads PNG, JPEG, TGA, BMP or GIF. Throws muro::Error with the path.
  static Image from_file(const std::string& path);
  /// Reads the bytes of such a file; `name` is for messages.
  static Image from_bytes(std::span<const std::uint8_t> bytes, const std::string& name);
};

}  // namespace muro::render
