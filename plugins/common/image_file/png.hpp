// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace muro::picture_file {

enum class Format {
  rgb8,    ///< three bytes a pixel, sRGB
  grey16,  ///< a std::uint16_t a pixel, linear
};

/// Writes rows of pixels, the upper first, as PNG: under another name first, so that no file is ever half written.
/// Throws muro::Error with the path.
void write_png(const std::string& path, Format format, std::uint32_t width, std::uint32_t height, const void* pixels);

}  // namespace muro::picture_file
