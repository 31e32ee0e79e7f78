// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace muro::image_file {

enum class Format {
  rgb8,    ///< three bytes for each pixel, sRGB
  grey16,  ///< a std::uint16_t for each pixel, linear
};

/// Writes rows of pixels, the upper row first, as a PNG file. Writes the whole file or none. Throws muro::Error with
/// the path.
void write_png(const std::string& path, Format format, std::uint32_t width, std::uint32_t height, const void* pixels);

}  // namespace muro::image_file
