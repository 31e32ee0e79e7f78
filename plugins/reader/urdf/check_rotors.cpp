// SPDX-License-Identifier: MIT
#include "model.hpp"

namespace muro::urdf {

namespace {

/// Returns the attribute `value` of a child of `actuator`, 0 or more; nothing if it is missing or invalid.
std::optional<double> rotor_value(Element& actuator, const char* name, const std::string& owner, Problems& problems) {
  Element* e = only_child(actuator, name, owner, problems);
  if (!e) return std::nullopt;
  Problems softer = softened(problems, "the inertia of its rotor is left out");
  const auto value = number(*e, "value", owner + ", <" + name + ">", softer);
  if (value && *value >= 0 && *value <= max_rotor_value) return value;
  if (!softer.found_error())
    problems.warning(location_of(*e), concat(owner, ", <", name, ">: write value=\"...\" with a number from 0 to 1e7; ",
                                             "the inertia of its rotor is left out"));
  return std::nullopt;
}

/// Returns the reflected inertia of an actuator's rotor at its joint, kg m^2 or kg.
std::optional<double> reflected_inertia(Element& actuator, const std::string& owner, Problems& problems) {
  const auto inertia = rotor_value(actuator, "drake:rotor_inertia", owner, problems);
  if (!inertia) return std::nullopt;
  if (!actuator.FirstChildElement("drake:gear_ratio")) return inertia;
  const auto ratio = rotor_value(actuator, "drake:gear_ratio", owner, problems);
  if (!ratio) return std::nullopt;
  return *ratio * *ratio * *inertia;
}

/// Returns the joint that a transmission moves; null, with a warning, if there is none that can have a rotor.
JointInfo* moved_joint(Element& transmission, const std::string& owner, ModelInfo& model, Problems& problems) {
  const std::vector<Element*> joints = children(transmission, "joint");
  const char* name = joints.size() == 1 ? joints.front()->Attribute("name") : nullptr;
  const auto found = name ? model.joints.find(name) : model.joints.end();
  if (found != model.joints.end() && found->second.moves) return &found->second;
  problems.warning(location_of(transmission),
                   concat(owner, " moves no single joint of the robot; the inertia of its rotor is left out"));
  return nullptr;
}

}  // namespace

void take_rotors(Element& robot, ModelInfo& model, Problems& problems) {
  for (Element* transmission : children(robot, "transmission"))
    for (Element* actuator : children(*transmission, "actuator")) {
      if (!actuator->FirstChildElement("drake:rotor_inertia")) continue;
      const char* name = actuator->Attribute("name");
      const std::string owner = "actuator " + quote(name ? name : "");
      JointInfo* joint = moved_joint(*transmission, owner, model, problems);
      const auto inertia = joint ? reflected_inertia(*actuator, owner, problems) : std::nullopt;
      if (!inertia) continue;
      if (joint->armature && *joint->armature != *inertia)
        problems.warning(location_of(*actuator),
                         concat(owner, ": its rotor is ", *inertia, " at the joint, whose <dynamics> has the armature ",
                                *joint->armature, "; that of <dynamics> counts"));
      else
        joint->armature = inertia;
    }
}

}  // namespace muro::urdf
