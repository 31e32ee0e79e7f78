// SPDX-License-Identifier: MIT
#include "image.hpp"

#include <stb/stb_image.h>

#include <fstream>
#include <iterator>

#include "muro/algorithm.hpp"

namespace muro::render {

Image Image::from_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error("picture " + path + " cannot be opened; give the path of a PNG or JPEG file");
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  return from_bytes({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, path);
}

Image Image::from_bytes(std::span<const std::uint8_t> bytes, const std::string& name) {
  int width = 0, height = 0, channels = 0;
  stbi_uc* pixels = stbi_load_from_memory(bytes.data(), int(bytes.size()), &width, &height, &channels, 4);
  if (!pixels)
    throw Error("picture " + name + " cannot be read: " + stbi_failure_reason() + "; use a PNG or JPEG file");
  Image image{std::uint32_t(width), std::uint32_t(height), {}};
  image.rgba.assign(pixels, pixels + std::size_t(4) * image.width * image.height);
  stbi_image_free(pixels);
  return image;
}

}  // namespace muro::render
