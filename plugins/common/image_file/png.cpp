// SPDX-License-Identifier: MIT
#include "png.hpp"

#include <png.h>

#include "muro/toolkit/whole_file.hpp"

namespace muro::image_file {

void write_png(const std::string& path, Format format, std::uint32_t width, std::uint32_t height, const void* pixels) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = width;
  image.height = height;
  image.format = format == Format::rgb8 ? PNG_FORMAT_RGB : PNG_FORMAT_LINEAR_Y;
  WholeFile file(path);
  if (!png_image_write_to_file(&image, file.location().c_str(), 0, pixels, 0, nullptr))
    throw Error("the picture `" + path + "` cannot be written: " + image.message);
  file.publish();
}

}  // namespace muro::image_file
