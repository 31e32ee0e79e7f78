// SPDX-License-Identifier: MIT
// Service of the parser process for pictures: pixels of PNG, JPEG, TGA, BMP and GIF files, by stb_image. A request is
// the name of the file, also for messages, and its bytes; without bytes they are read from the file.
#include <stb/stb_image.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "plugins/common/parser_process/limits.hpp"
#include "plugins/common/parser_process/service.hpp"
#include "plugins/common/text/lfs_pointer.hpp"

namespace muro::image_file {
namespace {

using parser_process::Reader;
using parser_process::Registration;
using parser_process::Writer;

/// Most pixels in each direction; GPUs take this size as a texture.
constexpr int max_pixels = 16'384;
/// Most bytes of a file; stb counts them with an int.
constexpr std::uintmax_t max_size = std::uintmax_t(1) << 30;

std::vector<std::uint8_t> bytes_of(const std::string& path) {
  const auto fail = [&](const std::string& what) { return Error("picture " + path + " " + what); };
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw fail("is not there, or no file; give the path of a PNG or JPEG file");
  const std::uintmax_t size = std::filesystem::file_size(path, code);
  if (code) throw fail("cannot be read: " + code.message());
  if (size > max_size) throw fail("has more than 1 GiB; use a smaller PNG or JPEG file");
  parser_process::allow(parser_process::allowance_for(size, 4, 1));
  std::vector<std::uint8_t> bytes(size);
  std::ifstream file(path, std::ios::binary);
  if (!file || !file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size)))
    throw fail("cannot be read; check its permissions");
  return bytes;
}

void serve(Reader& request, Writer& answer) {
  const std::string name = request.text();
  std::vector<std::uint8_t> bytes = request.list<std::uint8_t>();
  if (bytes.empty()) bytes = bytes_of(name);
  const auto fail = [&](const std::string& what) { return Error("picture " + name + " " + what); };
  if (is_lfs_pointer({reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
    throw fail(std::string(is_lfs_pointer_text));
  if (bytes.size() > max_size) throw fail("has more than 1 GiB; use a smaller PNG or JPEG file");
  int width = 0, height = 0, channels = 0;
  const auto size = int(bytes.size());
  const bool known = stbi_info_from_memory(bytes.data(), size, &width, &height, &channels) != 0;
  if (known && (width > max_pixels || height > max_pixels))
    throw fail("has " + std::to_string(width) + " x " + std::to_string(height) + " pixels, and may have " +
               std::to_string(max_pixels) + " in each direction; make it smaller");
  // decoders take up to four times the pixels for a while
  if (known)
    parser_process::allow(parser_process::allowance_for(std::uint64_t(width) * std::uint64_t(height), 24, 0.2));
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      known ? stbi_load_from_memory(bytes.data(), size, &width, &height, &channels, 4) : nullptr, stbi_image_free);
  if (!pixels) throw fail(std::string("cannot be read: ") + stbi_failure_reason() + "; use a PNG or JPEG file");
  answer.value(std::uint32_t(width));
  answer.value(std::uint32_t(height));
  answer.list(std::span<const std::uint8_t>(pixels.get(), std::size_t(4) * std::size_t(width) * std::size_t(height)));
}

const Registration pictures("picture", &serve);

}  // namespace
}  // namespace muro::image_file
