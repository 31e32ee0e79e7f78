// SPDX-License-Identifier: MIT
#include "host/outputs/png.hpp"

#include <png.h>

#include "core/error.hpp"

namespace muro::host {

std::string png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::string bytes;
  if (png_image_write_get_memory_size(image, size, 0, rgb.data(), 0, nullptr)) {
    bytes.resize(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr)) {
      bytes.resize(size);
      return bytes;
    }
  }
  throw SetupError(std::string("the picture cannot be written as PNG: ") + image.message);
}

}  // namespace muro::host
