// SPDX-License-Identifier: MIT
// PNG files, read by libpng, for checks of pictures. A target that includes this links PNG::PNG.
#pragma once

#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

namespace muro::test {

/// A picture of a file, rows from the top; empty if it cannot be read. T: std::uint8_t for three bytes a pixel (sRGB),
/// std::uint16_t for one grey value a pixel (linear).
template <class T = std::uint8_t>
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<T> values;

  explicit Picture(const std::string& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_file(&image, path.c_str())) return;
    image.format = sizeof(T) == 1 ? PNG_FORMAT_RGB : PNG_FORMAT_LINEAR_Y;
    width = image.width, height = image.height;
    values.resize(PNG_IMAGE_SIZE(image) / sizeof(T));
    png_image_finish_read(&image, nullptr, values.data(), 0, nullptr);
  }
};

}  // namespace muro::test
