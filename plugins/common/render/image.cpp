// SPDX-License-Identifier: MIT
#include "image.hpp"

#include "plugins/common/parser_process/ask.hpp"

namespace muro::render {

namespace process = parser_process;

Image Image::from_file(const std::string& path) { return from_bytes({}, path); }

Image Image::from_bytes(std::span<const std::uint8_t> bytes, const std::string& name) {
  process::Writer request;
  request.text(name);
  request.list(bytes);
  const process::Answer answer = process::ask({.service = "picture",
                                               .subject = "picture " + name,
                                               .needs = "libstb-dev",
                                               .advice = "the file is probably damaged: save it anew as PNG or JPEG"},
                                              request.bytes());
  process::Reader reader = answer.reader();
  Image image;
  image.width = reader.value<std::uint32_t>();
  image.height = reader.value<std::uint32_t>();
  image.rgba = reader.list<std::uint8_t>();
  if (image.rgba.size() != std::size_t(4) * image.width * image.height)
    throw Error("picture " + name + " has come from the parser process with a wrong size");
  return image;
}

}  // namespace muro::render
