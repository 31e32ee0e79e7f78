// SPDX-License-Identifier: MIT
// Completes a heightmap: finds the file of its heights, and a picture.
#include <algorithm>

#include "checks.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/heightmap/heightmap_values.hpp"
#include "plugins/common/model_file/mesh_path.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::sdf {

namespace {

Vec3 size_of(const Element* size) {
  std::string error;
  const auto values = size ? model_file::parse_numbers(text_of(*size), 3, error) : std::nullopt;
  return values ? Vec3((*values)[0], (*values)[1], (*values)[2]) : Vec3(Vec3::Ones());
}

/// Returns the height of a value of 1. <size> is the height of the brightest pixel of the picture, as in Gazebo.
double height_of_white(const heightmap::HeightmapFile& file, double height) {
  const double brightest = *std::max_element(file.values.begin(), file.values.end());
  return brightest > 0 ? height / brightest : height;
}

}  // namespace

/// Replaces the name of the picture by the path of its file, and the height of its brightest pixel by that of white.
bool Check::complete_heightmap(const Element& body, Element& heightmap) {
  Element& uri = *heightmap.FirstChildElement("uri");
  const std::string name = text_of(uri);
  const bool to_touch = std::string_view(body.Name()) == "collision";
  const Severity severity = to_touch ? Severity::lost_collision : Severity::warning;
  const char* const lost = to_touch ? " and left out, so that nothing touches it" : " and left out";
  const model_file::MeshPath found = model_file::find_file(name, source_.folder, sources_.packages());
  if (found.path.empty()) {
    problems_.report(severity, location_of(uri),
                     concat("heightmap ", quote(name), " is not found", lost, "; looked for ",
                            model_file::searched_places(found), "; ", model_file::advice_for_missing(name, found)));
    return false;
  }
  Element* size = heightmap.FirstChildElement("size");
  Vec3 lengths = size_of(size);
  try {
    lengths.z() = height_of_white(heightmap::read_values(found.path), lengths.z());
  } catch (const Error& error) {
    problems_.report(severity, location_of(uri), concat(error.what(), "; it is not read", lost));
    return false;
  }
  if (!size) size = heightmap.InsertNewChildElement("size");
  size->SetUserData(heightmap.GetUserData());
  size->DeleteChildren();
  size->SetText(model_file::text_of({lengths.x(), lengths.y(), lengths.z()}).c_str());
  uri.DeleteChildren();
  uri.SetText(found.path.c_str());
  return complete_textures(heightmap);
}

/// Keeps only the first texture, and adds the elements that libsdformat requires in it.
bool Check::complete_textures(Element& heightmap) {
  const std::vector<Element*> textures = model_file::children(heightmap, "texture");
  if (textures.size() > 1)
    problems_.note(location_of(*textures[1]),
                   concat("a heightmap has one texture, and ", textures.size() - 1,
                          textures.size() == 2 ? " other is left out" : " others are left out"));
  for (std::size_t i = 0; i < textures.size(); ++i) {
    Element& texture = *textures[i];
    if (i > 0 || !find_picture(texture, "diffuse")) {
      heightmap.DeleteChild(&texture);
      continue;
    }
    for (const auto& [name, value] : {std::pair("size", "10"), std::pair("normal", "none")})
      if (!texture.FirstChildElement(name)) {
        Element* const child = texture.InsertNewChildElement(name);
        child->SetUserData(texture.GetUserData());
        child->SetText(value);
      }
  }
  return true;
}

}  // namespace muro::sdf
