// SPDX-License-Identifier: MIT
#include "png.hpp"

#include <png.h>

#include "muro/base/whole_file.hpp"

namespace muro::image_file {

void write_png(const std::string& path, Format format, std::uint32_t width, std::uint32_t height, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format == Format::rgb8 ? PNG_FORMAT_RGB : PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels, 0, nullptr))
    throw Error("the picture `" + path + "` cannot be written: " + image.message);
  WholeFile file(path);
  file.write(std::string_view(bytes).substr(0, size));
  file.publish();
}

}  // namespace muro::image_file
