// SPDX-License-Identifier: MIT
#include <array>

#include "model.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::urdf {

namespace {

/// The value of <name>0.8</name> or <name value="0.8"/>, anywhere below `parent`.
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

void take_surface(Element& gazebo, const std::string& link, Surface& surface, Problems& problems) {
  const std::string owner = "link " + quote(link);
  const Location location = location_of(gazebo);
  const auto mu1 = value_below(gazebo, "mu1", owner, problems), mu2 = value_below(gazebo, "mu2", owner, problems);
  if (mu1 && mu2 && *mu1 != *mu2)
    problems.note(location, concat(owner, ": mu1 is ", *mu1, " and mu2 is ", *mu2,
                                   "; friction is the same in all directions, ", "and mu1 is used"));
  if (const auto mu = mu1 ? mu1 : mu2) {
    if (*mu >= 0)
      surface.friction = *mu;
    else
      problems.warning(location, concat(owner, ": friction ", *mu, " is negative and ignored; it is 0 or more"));
  }
  if (const auto restitution = value_below(gazebo, "restitution_coefficient", owner, problems)) {
    if (*restitution >= 0 && *restitution <= 1)
      surface.restitution = *restitution;
    else
      problems.warning(location,
                       concat(owner, ": restitution_coefficient ", *restitution, " is ignored; it is between 0 and 1"));
  }
}

}  // namespace

void take_surfaces(Element& robot, ModelInfo& model, Problems& problems) {
  for (Element* gazebo : children(robot, "gazebo")) {
    const char* reference = gazebo->Attribute("reference");
    if (!reference) continue;
    if (const auto link = model.links.find(reference); link != model.links.end())
      take_surface(*gazebo, reference, link->second.surface, problems);
    else if (model.joints.find(reference) == model.joints.end())
      problems.warning(location_of(*gazebo),
                       concat("<gazebo reference=", quote(reference), "> names no link or joint and is ignored"));
  }
  constexpr std::array<std::string_view, 3> kept = {"link", "joint", "material"};
  for (tinyxml2::XMLNode* node = robot.FirstChild(); node;) {
    tinyxml2::XMLNode* next = node->NextSibling();
    const Element* element = node->ToElement();
    if (!element || std::find(kept.begin(), kept.end(), element->Name()) == kept.end()) robot.DeleteChild(node);
    node = next;
  }
}

}  // namespace muro::urdf
