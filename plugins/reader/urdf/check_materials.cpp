// SPDX-License-Identifier: MIT
#include <algorithm>

#include "model.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::urdf {

namespace {

/// Changes the colour of a material to four numbers between 0 and 1. Returns false if there is no colour to show.
bool check_color(Element& material, const std::string& owner, Problems& problems) {
  Element* color = only_child(material, "color", owner, problems);
  if (!color) return false;
  const char* rgba = color->Attribute("rgba");
  if (!rgba) {
    problems.warning(location_of(*color),
                     concat(owner, ": <color> has no rgba=\"red green blue alpha\" and is ignored"));
    return false;
  }
  std::string error;
  const auto values = model_file::parse_numbers(rgba, 4, error);
  if (!values) {
    problems.warning(location_of(*color),
                     concat(owner, ", <color rgba>: ", quote(rgba), " ", error, "; it is ignored"));
    return false;
  }
  std::string bounded;
  bool outside = false;
  for (const double v : *values) {
    outside = outside || v < 0 || v > 1;
    bounded += (bounded.empty() ? "" : " ") + shortest(std::clamp(v, 0.0, 1.0));
  }
  if (outside)
    problems.warning(location_of(*color), concat(owner, ": colour ", quote(rgba), " is read as ", quote(bounded),
                                                 "; red, green, blue and alpha are between 0 and 1"));
  color->SetAttribute("rgba", bounded.c_str());
  return true;
}

/// Returns the name of the picture of a material; empty if there is none.
std::string texture_of(Element& material, const std::string& owner, Problems& problems) {
  Element* texture = only_child(material, "texture", owner, problems);
  if (!texture) return {};
  const char* file = texture->Attribute("filename");
  if (file && *file) return file;
  problems.warning(location_of(*texture), concat(owner, ": <texture> has no filename=\"...\" and is ignored"));
  return {};
}

/// Appearance of a material: rgba and the name of a picture. Either may be empty.
struct Looks {
  std::string color, texture;

  bool empty() const { return color.empty() && texture.empty(); }
  /// Writes the only children of a material and removes its name, so that no other definition replaces them.
  void write(Element& material) const {
    material.DeleteChildren();
    // urdfdom reads a material without a colour as black
    material.InsertNewChildElement("color")->SetAttribute("rgba", color.empty() ? "1 1 1 1" : color.c_str());
    if (!texture.empty()) material.InsertNewChildElement("texture")->SetAttribute("filename", texture.c_str());
    material.SetAttribute("name", "");
  }
};

Looks looks_of(Element& material, const std::string& owner, Problems& problems) {
  Looks looks;
  if (check_color(material, owner, problems)) looks.color = material.FirstChildElement("color")->Attribute("rgba");
  looks.texture = texture_of(material, owner, problems);
  return looks;
}

using Materials = std::map<std::string, Looks>;  ///< materials by name

Materials check_global_materials(Element& robot, std::vector<std::string>& plain, Problems& problems) {
  Materials materials;
  for (Element* material : children(robot, "material")) {
    const char* name = material->Attribute("name");
    const std::string owner = concat("material ", quote(name ? name : ""));
    if (!name) {
      problems.warning(location_of(*material), "a material of the robot has no name, so that no link can use it");
    } else if (materials.count(name)) {
      problems.warning(location_of(*material), concat(owner, " is defined twice; the first definition is used"));
    } else if (const Looks looks = looks_of(*material, owner, problems); !looks.empty()) {
      materials[name] = looks;
      looks.write(*material);
      material->SetAttribute("name", name);
      continue;
    } else {
      plain.emplace_back(name);
    }
    remove(*material);
  }
  return materials;
}

}  // namespace

void check_materials(Element& robot, Problems& problems) {
  std::vector<std::string> plain;
  Materials materials = check_global_materials(robot, plain, problems);
  struct Reference {
    Element* material;
    std::string owner;
  };
  std::vector<Reference> by_name;
  for (Element* link : children(robot, "link")) {
    const char* link_name = link->Attribute("name");
    const std::string owner = "link " + quote(link_name ? link_name : "");
    for (Element* visual : children(*link, "visual")) {
      Element* material = only_child(*visual, "material", owner, problems);
      visual->DeleteAttribute("material");
      if (!material) continue;
      const char* name = material->Attribute("name");
      if (name) visual->SetAttribute("material", name);  // for check_links, as the material loses its name
      if (const Looks looks = looks_of(*material, owner, problems); !looks.empty()) {
        if (name && *name) materials.try_emplace(name, looks);
        looks.write(*material);
      } else if (name && *name) {
        by_name.push_back({material, owner});
      } else {
        remove(*material);
      }
    }
  }
  for (const auto& [material, owner] : by_name) {
    const std::string name = material->Attribute("name");
    if (const auto known = materials.find(name); known != materials.end()) {
      known->second.write(*material);
      continue;
    }
    if (std::find(plain.begin(), plain.end(), name) == plain.end())
      problems.warning(location_of(*material),
                       concat(owner, ": material ", quote(name), " is not defined; it is grey. Give it ",
                              "a <color rgba=\"...\"/>"));
    remove(*material);
  }
}

}  // namespace muro::urdf
