// SPDX-License-Identifier: MIT
#include <algorithm>

#include "model.hpp"

namespace muro::urdf {

namespace {

/// Makes the colour of a material four numbers between 0 and 1. False when there is no colour to show.
bool check_color(Element& material, const std::string& owner, Problems& problems) {
  Element* color = only_child(material, "color", owner, problems);
  if (!color) return false;
  const char* rgba = color->Attribute("rgba");
  if (!rgba) {
    problems.warning(place_of(*color), say(owner, ": <color> has no rgba=\"red green blue alpha\" and is ignored"));
    return false;
  }
  const auto values = numbers(*color, "rgba", 4, owner, problems);
  if (!values) return false;
  std::string bounded;
  bool outside = false;
  for (const double v : *values) {
    outside = outside || v < 0 || v > 1;
    bounded += (bounded.empty() ? "" : " ") + shortest(std::clamp(v, 0.0, 1.0));
  }
  if (!outside) return true;
  problems.warning(place_of(*color), say(owner, ": colour ", cited(color->Attribute("rgba")), " is read as ",
                                         cited(bounded), "; red, green, blue and alpha are between 0 and 1"));
  color->SetAttribute("rgba", bounded.c_str());
  return true;
}

using Colors = std::map<std::string, std::string>;  ///< name of a material: rgba

Colors check_global_materials(Element& robot, std::vector<std::string>& colorless, Problems& problems) {
  Colors colors;
  for (Element* material : children(robot, "material")) {
    const char* name = material->Attribute("name");
    const std::string owner = say("material ", cited(name ? name : ""));
    if (!name) {
      problems.warning(place_of(*material), "a material of the robot has no name, so that no link can use it");
    } else if (colors.count(name)) {
      problems.warning(place_of(*material), say(owner, " is defined twice; the first definition is used"));
    } else if (check_color(*material, owner, problems)) {
      colors[name] = material->FirstChildElement("color")->Attribute("rgba");
      continue;
    } else {
      if (material->FirstChildElement("texture"))
        problems.note(place_of(*material), say(owner, " has a texture only; textures are not shown, and it is grey"));
      colorless.emplace_back(name);
    }
    remove(*material);
  }
  return colors;
}

}  // namespace

void check_materials(Element& robot, Problems& problems) {
  std::vector<std::string> colorless;
  Colors colors = check_global_materials(robot, colorless, problems);
  struct Reference {
    Element* material;
    std::string owner;
  };
  std::vector<Reference> by_name;
  for (Element* link : children(robot, "link")) {
    const char* link_name = link->Attribute("name");
    const std::string owner = "link " + cited(link_name ? link_name : "");
    for (Element* visual : children(*link, "visual")) {
      Element* material = only_child(*visual, "material", owner, problems);
      if (!material) continue;
      const char* name = material->Attribute("name");
      if (check_color(*material, owner, problems)) {
        if (name && *name) colors.try_emplace(name, material->FirstChildElement("color")->Attribute("rgba"));
        // a colour of its own goes before one that another place gives the name
        material->SetAttribute("name", "");
      } else if (name && *name) {
        by_name.push_back({material, owner});
      } else {
        remove(*material);
      }
    }
  }
  for (const auto& [material, owner] : by_name) {
    const std::string name = material->Attribute("name");
    if (const auto color = colors.find(name); color != colors.end()) {
      material->DeleteChildren();
      material->InsertNewChildElement("color")->SetAttribute("rgba", color->second.c_str());
      material->SetAttribute("name", "");
      continue;
    }
    if (std::find(colorless.begin(), colorless.end(), name) == colorless.end() &&
        !material->FirstChildElement("texture"))
      problems.warning(place_of(*material), say(owner, ": material ", cited(name),
                                                " is not defined; it is grey. Give it ", "a <color rgba=\"...\"/>"));
    remove(*material);
  }
}

}  // namespace muro::urdf
