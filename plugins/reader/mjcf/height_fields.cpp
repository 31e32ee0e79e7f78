// SPDX-License-Identifier: MIT
#include "height_fields.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
#include "plugins/common/heightmap/heightmap_values.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

/// Returns the largest error of MuJoCo's heights by the range of heights in the file. `range`: that range by white.
/// MuJoCo rounds 16-bit values down to 8 bits, also the lowest and the highest.
double largest_rounding(double range) { return std::min(2.01 / 255 / range, 0.05); }

/// Returns the files of the height fields, in the order of their numbers.
std::vector<std::string> paths_in(const std::string& canonical, const Source& source) {
  std::vector<std::string> paths;
  model_file::Document document;
  Location location;
  std::string error;
  if (!document.parse(canonical, location, error) || !document.root()) return paths;
  const Element* const compiler = document.root()->FirstChildElement("compiler");
  const char* const folder = compiler ? compiler->Attribute("meshdir") : nullptr;
  for (Element* assets : model_file::children(*document.root(), "asset"))
    for (const Element* field : model_file::children(*assets, "hfield")) {
      const char* const file = field->Attribute("file");
      paths.push_back(file ? (source.folder() / (folder ? folder : "") / file).lexically_normal().string() : "");
    }
  return paths;
}

}  // namespace

HeightFields::HeightFields(const Compiled& compiled, const Source& source)
    : m_(*compiled.model), source_(source), paths_(paths_in(compiled.canonical, source)) {}

std::optional<PlacedHeights> HeightFields::of(int geom, std::string& problem) {
  const int number = m_.geom_dataid[geom];
  const auto [place, is_new] = known_.try_emplace(number);
  if (is_new) place->second.heights = read(number, place->second.problem);
  problem = place->second.problem;
  return place->second.heights;
}

std::optional<PlacedHeights> HeightFields::read(int number, std::string& problem) const {
  if (number < 0 || paths_.size() != std::size_t(m_.nhfield)) {
    problem = "MuJoCo does not say where its height field comes from";
    return std::nullopt;
  }
  const std::string& path = paths_[std::size_t(number)];
  const std::string name = name_of(m_, m_.name_hfieldadr, number);
  if (source_.has_elevation(name)) {
    problem = concat("height field ", quote(name),
                     " is written in the MJCF itself; save its values as a grey picture (PNG) and name it as `file`");
    return std::nullopt;
  }
  const mjtNum* const size = m_.hfield_size + 4 * number;  // half lengths, elevation, depth of the base
  const std::span<const float> compiled(m_.hfield_data + m_.hfield_adr[number],
                                        std::size_t(m_.hfield_nrow[number]) * std::size_t(m_.hfield_ncol[number]));
  const Vec3 lengths(2 * size[0], 2 * size[1], size[2]);
  if (std::all_of(compiled.begin(), compiled.end(), [](float v) { return v == 0; }))
    return PlacedHeights{"", {lengths.x(), lengths.y(), size[3]}, {{0, 0, -0.5 * size[3]}, Quat::Identity()}};
  heightmap::HeightmapFile file;
  try {
    file = heightmap::read_values(path);
  } catch (const Error& error) {
    problem = error.what();
    return std::nullopt;
  }
  const auto [low, high] = std::minmax_element(file.values.begin(), file.values.end());
  const double lowest = *low, range = double(*high) - lowest;
  double error = 0;
  for (std::size_t i = 0; i < std::min(compiled.size(), file.values.size()); ++i)
    error = std::max(error, std::abs((file.values[i] - lowest) / range - compiled[i]));
  if (file.values.size() != compiled.size() || file.columns != std::uint32_t(m_.hfield_ncol[number]) ||
      !(error <= largest_rounding(range))) {
    problem = concat("MuJoCo reads other heights from ", quote(path),
                     " than muro; save it as a grey picture (PNG) of 8 bits");
    return std::nullopt;
  }
  const double height = lengths.z() / range;
  return PlacedHeights{
      path, {lengths.x(), lengths.y(), height}, {{0, 0, -height * lowest}, Quat::Identity()}, error * lengths.z()};
}

}  // namespace muro::mjcf
