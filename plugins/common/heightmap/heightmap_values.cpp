// SPDX-License-Identifier: MIT
#include "heightmap_values.hpp"

#include <stb/stb_image.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>

#include "muro/algorithm.hpp"
#include "plugins/common/parser_process/limits.hpp"
#include "plugins/common/text/lfs_pointer.hpp"

namespace muro::heightmap {
namespace {

constexpr std::uint32_t max_nodes = 16'384;  ///< in each direction
constexpr std::uintmax_t max_size = std::uintmax_t(max_nodes) * max_nodes * sizeof(float) + 8;

struct Nodes {
  std::uint32_t columns = 0, rows = 0;
};

class HeightmapReader {
 public:
  explicit HeightmapReader(const std::string& path) : path_(path) {}

  HeightmapFile read() const {
    const std::vector<std::uint8_t> bytes = content();
    Nodes nodes;
    if (is_lfs_pointer({reinterpret_cast<const char*>(bytes.data()), bytes.size()}))
      throw error(std::string(is_lfs_pointer_text));
    if (is_tiff(bytes))
      throw error(
          "is a TIFF file, which muro does not read; make a grey PNG file of 16 bits of it, by `gdal_translate -of PNG "
          "-ot UInt16 -scale FILE.tif FILE.png` or `convert FILE.tif -depth 16 FILE.png`, and name that");
    std::vector<float> values = is_picture(bytes) ? values_of_picture(bytes, nodes) : values_of_floats(bytes, nodes);
    return HeightmapFile::of(std::move(values), nodes.columns, nodes.rows);
  }

 private:
  Error error(const std::string& what) const { return Error("heightmap " + path_ + " " + what); }

  std::vector<std::uint8_t> content() const {
    std::error_code code;
    if (!std::filesystem::is_regular_file(path_, code))
      throw error("is not there, or no file; give the path of a grey PNG file or of a file of floats");
    const std::uintmax_t size = std::filesystem::file_size(path_, code);
    if (code) throw error("cannot be read: " + code.message());
    if (size > max_size) throw error("has more than 1 GiB; use fewer nodes");
    parser_process::allow(parser_process::allowance_for(size, 4, 1));
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path_, std::ios::binary);
    if (!file || !file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(size)))
      throw error("cannot be read; check its permissions");
    return bytes;
  }

  /// Whether the bytes are TIFF, GeoTIFF or BigTIFF, by their byte order and number.
  static bool is_tiff(const std::vector<std::uint8_t>& bytes) {
    const auto begins = [&](std::uint8_t order, std::initializer_list<std::uint8_t> number) {
      return bytes.size() >= 4 && bytes[0] == order && bytes[1] == order &&
             std::equal(number.begin(), number.end(), bytes.begin() + 2);
    };
    return begins('I', {42, 0}) || begins('I', {43, 0}) || begins('M', {0, 42}) || begins('M', {0, 43});
  }

  static bool is_picture(const std::vector<std::uint8_t>& bytes) {
    int width = 0, height = 0, channels = 0;
    return stbi_info_from_memory(bytes.data(), int(std::min<std::size_t>(bytes.size(), 1 << 30)), &width, &height,
                                 &channels) != 0;
  }

  void check(std::uint64_t columns, std::uint64_t rows) const {
    const std::string size = std::to_string(columns) + " x " + std::to_string(rows);
    if (columns < 2 || rows < 2) throw error("has " + size + " values, and must have 2 or more in each direction");
    if (columns > max_nodes || rows > max_nodes)
      throw error("has " + size + " values, and may have " + std::to_string(max_nodes) +
                  " in each direction; make it smaller");
  }

  /// Returns the values: black is 0 and white is 1. The upper rows are at +y.
  std::vector<float> values_of_picture(const std::vector<std::uint8_t>& bytes, Nodes& nodes) const {
    int width = 0, height = 0, channels = 0;
    const int size = int(bytes.size());
    stbi_info_from_memory(bytes.data(), size, &width, &height, &channels);
    check(std::uint64_t(width), std::uint64_t(height));
    parser_process::allow(parser_process::allowance_for(std::uint64_t(width) * std::uint64_t(height), 32, 0.2));
    const std::unique_ptr<stbi_us, void (*)(void*)> pixels(
        stbi_load_16_from_memory(bytes.data(), size, &width, &height, &channels, 1), stbi_image_free);
    if (!pixels) throw error(std::string("cannot be read: ") + stbi_failure_reason() + "; use a grey PNG file");
    nodes = {std::uint32_t(width), std::uint32_t(height)};
    std::vector<float> values;
    values.reserve(std::size_t(width) * std::size_t(height));
    for (std::size_t row = nodes.rows; row-- > 0;)
      for (std::size_t column = 0; column < nodes.columns; ++column)
        values.push_back(float(pixels.get()[row * nodes.columns + column]) / 65535.0f);
    return values;
  }

  /// Returns the header of MuJoCo's files of height fields, which begin with the numbers of rows and columns.
  static std::optional<Nodes> header_of(const std::vector<std::uint8_t>& bytes) {
    std::int32_t counts[2] = {};
    if (bytes.size() < sizeof counts) return std::nullopt;
    std::memcpy(counts, bytes.data(), sizeof counts);
    if (counts[0] < 1 || counts[1] < 1) return std::nullopt;
    if (bytes.size() != sizeof counts + sizeof(float) * std::uint64_t(counts[0]) * std::uint64_t(counts[1]))
      return std::nullopt;
    return Nodes{std::uint32_t(counts[1]), std::uint32_t(counts[0])};
  }

  std::vector<float> values_of_floats(const std::vector<std::uint8_t>& bytes, Nodes& nodes) const {
    const std::optional<Nodes> header = header_of(bytes);
    const std::size_t count = bytes.size() / sizeof(float) - (header ? 2 : 0);
    const auto side = std::uint32_t(std::lround(std::sqrt(double(count))));
    if (!header && (bytes.size() % sizeof(float) != 0 || std::uint64_t(side) * side != count || count == 0))
      throw error("has " + std::to_string(bytes.size()) +
                  " bytes and is neither a picture (PNG of 8 or 16 bits) nor the floats of a square grid, nor does it "
                  "begin with the numbers of rows and columns of its floats (int32), as MuJoCo's height fields do");
    nodes = header.value_or(Nodes{side, side});
    check(nodes.columns, nodes.rows);
    std::vector<float> values(count);
    std::memcpy(values.data(), bytes.data() + (header ? 8 : 0), count * sizeof(float));
    for (std::size_t i = 0; i < count; ++i)
      if (!(std::abs(values[i]) <= 1e6f))
        throw error("has a value that is not finite or beyond 1e6: number " + std::to_string(i % nodes.columns) +
                    " of row " + std::to_string(i / nodes.columns));
    return values;
  }

  const std::string& path_;
};

}  // namespace

HeightmapFile read_values(const std::string& path) { return HeightmapReader(path).read(); }

}  // namespace muro::heightmap
