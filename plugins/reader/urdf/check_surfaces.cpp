// SPDX-License-Identifier: MIT
#include <array>

#include "model.hpp"
#include "muro/base/limits.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::urdf {

namespace {

struct Range {
  double most;
  const char* text;
};

constexpr Range friction_range = {limits::friction, "from 0 to 1e20"};
constexpr Range restitution_range = {1, "between 0 and 1"};
constexpr Range resistance_range = {limits::max_size, "from 0 to 1e6 m"};

/// Returns the value of <name>0.8</name> or <name value="0.8"/>, anywhere below `parent`.
std::optional<double> value_below(Element& parent, const char* name, const std::string& owner, Problems& problems) {
  for (Element* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (std::string_view(e->Name()) != name) {
      if (const auto deeper = value_below(*e, name, owner, problems)) return deeper;
      continue;
    }
    const char* text = e->Attribute("value") ? e->Attribute("value") : e->GetText();
    std::string error;
    const auto values = model_file::parse_numbers(text ? text : "", error);
    if (error.empty() && values.size() == 1) return values.front();
    problems.warning(location_of(*e),
                     concat(owner, ", <", name, ">: ", quote(text ? text : ""), " is no single number and is ignored"));
  }
  return std::nullopt;
}

/// Takes the value of <name> below `parent` if it exists and is in its range.
void take(Element& parent, const char* name, const Range& range, const std::string& owner, std::optional<double>& taken,
          Problems& problems) {
  const auto value = value_below(parent, name, owner, problems);
  if (!value) return;
  if (*value >= 0 && *value <= range.most)
    taken = value;
  else
    problems.warning(location_of(parent), concat(owner, ": ", name, " ", *value, " is ignored; it is ", range.text));
}

/// Reads <contact> of a link as Bullet and PyBullet do.
void take_contact(Element& contact, const std::string& owner, Surface& surface, Problems& problems) {
  take(contact, "lateral_friction", friction_range, owner, surface.friction, problems);
  take(contact, "restitution", restitution_range, owner, surface.restitution, problems);
  take(contact, "rolling_friction", resistance_range, owner, surface.rolling_resistance, problems);
  take(contact, "spinning_friction", resistance_range, owner, surface.spinning_resistance, problems);
}

}  // namespace

void take_surface(Element& gazebo, const std::string& owner, Surface& surface, Problems& problems) {
  std::optional<double> mu1, mu2;
  take(gazebo, "mu1", friction_range, owner, mu1, problems);
  take(gazebo, "mu2", friction_range, owner, mu2, problems);
  if (mu1 && mu2 && *mu1 != *mu2)
    problems.note(location_of(gazebo), concat(owner, ": mu1 is ", *mu1, " and mu2 is ", *mu2,
                                              "; friction is the same in all directions, ", "and mu1 is used"));
  if (mu1 || mu2) surface.friction = mu1 ? mu1 : mu2;
  take(gazebo, "restitution_coefficient", restitution_range, owner, surface.restitution, problems);
}

void take_surfaces(Element& robot, ModelInfo& model, Problems& problems) {
  for (Element* xml : children(robot, "link"))
    if (const auto link = model.links.find(xml->Attribute("name") ? xml->Attribute("name") : "");
        link != model.links.end())
      if (Element* contact = xml->FirstChildElement("contact"))
        take_contact(*contact, "link " + quote(link->first), link->second.surface, problems);
}

void remove_others(Element& robot) {
  constexpr std::array<std::string_view, 3> kept = {"link", "joint", "material"};
  for (tinyxml2::XMLNode* node = robot.FirstChild(); node;) {
    tinyxml2::XMLNode* next = node->NextSibling();
    const Element* element = node->ToElement();
    if (!element || std::find(kept.begin(), kept.end(), element->Name()) == kept.end()) robot.DeleteChild(node);
    node = next;
  }
}

}  // namespace muro::urdf
