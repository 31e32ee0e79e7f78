// SPDX-License-Identifier: MIT
#include "meshes.hpp"

#include <algorithm>

#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

namespace fs = std::filesystem;

/// Returns the numbers of an attribute; `fallback` if there is no such attribute.
template <std::size_t n>
std::array<double, n> numbers(const Element& e, const char* name, std::array<double, n> fallback) {
  const char* const text = e.Attribute(name);
  std::string error;
  const auto found = text ? model_file::parse_numbers(text, n, error) : std::nullopt;
  if (found) std::copy_n(found->begin(), n, fallback.begin());
  return fallback;
}

Vec3 vector_in(const Element& e, const char* name, double fallback) {
  const auto v = numbers<3>(e, name, {fallback, fallback, fallback});
  return {v[0], v[1], v[2]};
}

Quat quaternion_in(const Element& e, const char* name) {
  return quaternion_of(numbers<4>(e, name, {1, 0, 0, 0}).data());
}

std::string lower_extension(const std::string& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

}  // namespace

Meshes::Meshes(const Compiled& compiled, const Source& source) : model_(compiled.model.get()) {
  if (compiled.canonical.empty()) return;
  model_file::Document document;
  Location location;
  std::string error;
  if (!document.parse(compiled.canonical, location, error) || !document.root()) return;
  read_assets(*document.root(), source);
  for (Element* world : model_file::children(*document.root(), "worldbody")) read_body(*world);
  complete_ = geoms_.size() == std::size_t(model_->ngeom) && assets_.size() == std::size_t(model_->nmesh);
}

void Meshes::read_assets(const Element& root, const Source& source) {
  const Element* const compiler = root.FirstChildElement("compiler");
  const char* const folder = compiler ? compiler->Attribute("meshdir") : nullptr;
  const fs::path meshes = source.folder() / (folder ? folder : "");
  for (const Element* all = root.FirstChildElement("asset"); all; all = all->NextSiblingElement("asset"))
    for (const Element* e = all->FirstChildElement("mesh"); e; e = e->NextSiblingElement("mesh")) {
      Asset& asset = assets_.emplace_back();
      if (const char* const file = e->Attribute("file")) asset.path = (meshes / file).lexically_normal().string();
      asset.scale = vector_in(*e, "scale", 1);
      asset.reference = vector_in(*e, "refpos", 0);
      asset.turn = quaternion_in(*e, "refquat");
    }
}

/// Visits bodies and geoms in the order of their numbers.
void Meshes::read_body(const Element& body) {
  for (const Element* e = body.FirstChildElement("geom"); e; e = e->NextSiblingElement("geom")) {
    const Vec3 position = vector_in(*e, "pos", 0);
    geoms_.push_back({position, quaternion_in(*e, "quat")});
  }
  for (const Element* e = body.FirstChildElement("body"); e; e = e->NextSiblingElement("body")) read_body(*e);
}

std::optional<PlacedMesh> Meshes::of(int geom, std::string& problem) const {
  const int number = model_->geom_dataid[geom];
  if (!complete_ || number < 0 || number >= model_->nmesh) {
    problem = "MuJoCo does not say where its mesh comes from";
    return std::nullopt;
  }
  const Asset& asset = assets_[std::size_t(number)];
  const std::string name = quote(name_of(*model_, model_->name_meshadr, number));
  const std::string extension = lower_extension(asset.path);
  if (asset.path.empty() || extension == ".msh") {
    problem = concat("mesh ", name, asset.path.empty() ? " is written in the MJCF itself" : " is MuJoCo's own .msh",
                     "; save it as .obj or .stl");
    return std::nullopt;
  }
  std::error_code none;
  if (!fs::is_regular_file(asset.path, none)) {
    problem = concat("mesh ", name, " is not found at ", quote(asset.path));
    return std::nullopt;
  }
  const bool turned = asset.turn.vec().norm() > 1e-9;
  if (turned && (asset.scale - Vec3::Constant(asset.scale.x())).norm() > 1e-9 * asset.scale.norm()) {
    problem = concat("mesh ", name, " has a refquat and another scale along each axis; apply one of them to the file");
    return std::nullopt;
  }
  // MuJoCo subtracts refpos, applies the inverse of refquat, then scales
  const Quat back = asset.turn.conjugate();
  const Pose reference{-asset.scale.cwiseProduct(Vec3(back * asset.reference)), back};
  return PlacedMesh{asset.path, asset.scale, geoms_[std::size_t(geom)] * reference};
}

}  // namespace muro::mjcf
