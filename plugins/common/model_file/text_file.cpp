// SPDX-License-Identifier: MIT
#include "text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "muro/algorithm.hpp"

namespace muro::model_file {

namespace {

constexpr std::uintmax_t largest_file = 64u << 20;

unsigned byte_at(std::string_view text, std::size_t i) { return static_cast<unsigned char>(text[i]); }

/// Returns the index of the first byte that is not well-formed UTF-8 (Unicode 15, table 3-7); the size if all are.
std::size_t first_bad_byte(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const unsigned lead = byte_at(text, i);
    if (lead < 0x80) {
      ++i;
      continue;
    }
    const std::size_t more = lead >= 0xc2 && lead <= 0xdf   ? 1
                             : lead >= 0xe0 && lead <= 0xef ? 2
                             : lead >= 0xf0 && lead <= 0xf4 ? 3
                                                            : 0;
    if (more == 0 || i + more >= text.size()) return i;
    const unsigned lowest = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
    const unsigned highest = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
    if (byte_at(text, i + 1) < lowest || byte_at(text, i + 1) > highest) return i;
    for (std::size_t k = 2; k <= more; ++k)
      if ((byte_at(text, i + k) & 0xc0) != 0x80) return i;
    i += more + 1;
  }
  return i;
}

Location location_of(std::string_view text, std::size_t index) {
  const std::string_view before = text.substr(0, index);
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return {int(std::count(before.begin(), before.end(), '\n')) + 1, int(index - line_start) + 1};
}

std::string from_latin1(std::string_view text) {
  std::string utf8;
  utf8.reserve(text.size() + text.size() / 8);
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += char(0xc0 | (byte >> 6));
      utf8 += char(0x80 | (byte & 0x3f));
    }
  }
  return utf8;
}

}  // namespace

std::string load_file(const std::string& path, const std::string& kind) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw Error("there is no file " + path);
  if (!std::filesystem::is_regular_file(status))
    throw Error(path + " is not a file; give the path of a " + kind + " file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw Error(path + " cannot be read: " + error.message());
  if (size > largest_file)
    throw Error(concat(path, " has ", size >> 20, " MiB, and a model may have ", largest_file >> 20,
                       "; keep meshes in files of their own"));
  std::ifstream file(path, std::ios::binary);
  std::string bytes(size, '\0');
  if (!file || !file.read(bytes.data(), std::streamsize(size)))
    throw Error(path + " cannot be read: " + std::strerror(errno));
  return bytes;
}

DecodingProblems decode(std::string& bytes, const std::string& kind, const std::string& root) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    return {.error = {{1, 1}, "the file is encoded as UTF-16; save it as UTF-8"}};
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.erase(0, 3);
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string::npos)
    return {.error = {{}, concat("the file is empty; a ", kind, " file holds a <", root, "> element")}};
  if (const std::size_t zero = bytes.find('\0'); zero != std::string::npos)
    return {
        .error = {location_of(bytes, zero), "the file holds a zero byte: it is no text file, or cut, or not UTF-8"}};
  DecodingProblems problems;
  if (const std::size_t bad = first_bad_byte(bytes); bad < bytes.size()) {
    problems.warning = {
        location_of(bytes, bad),
        concat("byte ", byte_at(bytes, bad), " is not UTF-8; the file is read as ISO-8859-1. Save it as UTF-8")};
    bytes = from_latin1(bytes);
  }
  if (bytes[start] != '<')
    problems.error = {location_of(bytes, start),
                      concat("the file is not XML; a ", kind, " file begins with <?xml or <", root)};
  return problems;
}

}  // namespace muro::model_file
