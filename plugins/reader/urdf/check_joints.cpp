// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "model.hpp"
#include "muro/base/elementary.hpp"
#include "plugins/common/model_file/mimic_limits.hpp"

namespace muro::urdf {

namespace {

constexpr std::array<std::string_view, 6> types = {"fixed",     "revolute", "continuous",
                                                   "prismatic", "planar",   "floating"};

/// Checks of one joint.
class JointCheck {
 public:
  JointCheck(Element& xml, const std::string& name, Problems& problems)
      : xml_(xml), owner_("joint " + quote(name)), problems_(problems) {}

  /// Returns nothing if the joint cannot be used; the reason is reported.
  std::optional<JointInfo> run(const ModelInfo& model) {
    info_.location = location_of(xml_);
    info_.xml = &xml_;
    info_.parent = check_link("parent", model);
    info_.child = check_link("child", model);
    if (info_.parent.empty() || info_.child.empty()) return std::nullopt;
    if (info_.parent == info_.child) {
      problems_.warning(info_.location,
                        concat(owner_, " is left out: it joins link ", quote(info_.parent), " with itself"));
      return std::nullopt;
    }
    check_type();
    if (Element* origin = only_child(xml_, "origin", owner_, problems_)) {
      numbers(*origin, "xyz", 3, owner_, problems_);
      numbers(*origin, "rpy", 3, owner_, problems_);
      numbers(*origin, "quat_xyzw", 4, owner_, problems_);
    }
    info_.rotation = origin_rotation(xml_);
    check_axis();
    check_limit();
    check_dynamics();
    check_mimic();
    // these elements are not used, and urdfdom would stop at a mistake in them
    for (const char* other : {"safety_controller", "calibration"})
      for (Element* e : children(xml_, other)) remove(*e);
    return info_;
  }

 private:
  void check_type() {
    const char* type = xml_.Attribute("type");
    info_.type = type ? type : "";
    info_.moves = info_.type == "revolute" || info_.type == "continuous" || info_.type == "prismatic";
    if (std::find(types.begin(), types.end(), info_.type) != types.end()) return;
    problems_.warning(
        info_.location,
        concat(owner_, type ? concat(" is of the unknown type ", quote(type)) : " has no type",
               " and taken as fixed; types are fixed, revolute, continuous, prismatic, planar, floating"));
    make_fixed();
  }

  void make_fixed() {
    info_.type = "fixed";
    info_.moves = false;
    xml_.SetAttribute("type", "fixed");
  }

  std::string check_link(const char* end, const ModelInfo& model) {
    Element* element = only_child(xml_, end, owner_, problems_);
    const char* link = element ? element->Attribute("link") : nullptr;
    if (!link || !*link) {
      problems_.warning(info_.location,
                        concat(owner_, " is left out: it has no ", end, "; write <", end, " link=\"...\"/>"));
      return {};
    }
    if (model.links.count(link)) return link;
    std::vector<std::string> names;
    for (const auto& [name, unused] : model.links) names.push_back(name);
    problems_.warning(location_of(*element), concat(owner_, " is left out: its ", end, ", link ", quote(link),
                                                    ", does not exist; links are ", quoted_list(names)));
    return {};
  }

  void check_axis() {
    Element* axis = only_child(xml_, "axis", owner_, problems_);
    if (!axis) return;
    if (!info_.moves && info_.type != "planar") return remove(*axis);
    if (!axis->Attribute("xyz")) {
      problems_.warning(location_of(*axis), owner_ + ": <axis> has no xyz; the axis is x, URDF's default");
      return remove(*axis);
    }
    const auto xyz = numbers(*axis, "xyz", 3, owner_, problems_);
    if (!xyz) return;
    const double length = elementary::hypot(elementary::hypot((*xyz)[0], (*xyz)[1]), (*xyz)[2]);
    if (!(length > 1e-9) || !std::isfinite(length)) {
      problems_.warning(
          location_of(*axis),
          concat(owner_, ": axis ", quote(axis->Attribute("xyz")), " has no direction, so that the joint ",
                 "is taken as fixed; an axis is a vector of length 1, such as 0 0 1"));
      make_fixed();
      remove(*axis);
    } else if (std::abs(length - 1) > 1e-3)
      problems_.note(location_of(*axis), concat(owner_, ": axis ", quote(axis->Attribute("xyz")),
                                                " is not of length 1; only its direction is used"));
  }

  void check_limit() {
    Element* limit = only_child(xml_, "limit", owner_, problems_);
    if (!info_.moves) {
      if (limit) remove(*limit);
      return;
    }
    const bool bounded = info_.type != "continuous";
    if (!limit) {
      if (!bounded) return;
      problems_.warning(info_.location,
                        concat(owner_, " is ", info_.type, " but has no <limit>; it is unlimited. Write <limit ",
                               "lower=\"...\" upper=\"...\" velocity=\"...\" effort=\"...\"/>"));
      limit = xml_.InsertNewChildElement("limit");
      set(*limit, "lower", -no_limit);
      set(*limit, "upper", no_limit);
      set(*limit, "velocity", no_limit);
      set(*limit, "effort", no_limit);
      return;
    }
    for (const char* attribute : {"velocity", "effort"}) check_bound(*limit, attribute);
    if (!bounded) {
      const double lower = number(*limit, "lower", owner_, problems_).value_or(0);
      if (lower != 0 || number(*limit, "upper", owner_, problems_).value_or(0) != 0)
        problems_.note(location_of(*limit), owner_ + " is continuous: its lower and upper limits are ignored");
      limit->DeleteAttribute("lower");
      limit->DeleteAttribute("upper");
      return;
    }
    const double lower = number(*limit, "lower", owner_, problems_).value_or(0);
    const double upper = number(*limit, "upper", owner_, problems_).value_or(0);
    if (lower > upper) {
      problems_.warning(location_of(*limit), concat(owner_, ": lower limit ", lower, " is above upper limit ", upper,
                                                    "; the two are exchanged"));
      set(*limit, "lower", upper);
      set(*limit, "upper", lower);
    } else if (lower == upper) {
      problems_.warning(location_of(*limit), concat(owner_, ": lower and upper limits are both ", lower,
                                                    "; the joint cannot move. Give a range, or make it fixed"));
    }
  }

  void check_bound(Element& limit, const char* attribute) {
    const bool given = limit.Attribute(attribute) != nullptr;
    const auto value = number(limit, attribute, owner_, problems_);
    if (value && *value >= 0) {
      if (*value == 0)
        problems_.warning(location_of(limit),
                          concat(owner_, ": its ", attribute, " limit is 0, so that no drive can move it; leave ",
                                 attribute, " out when it is unknown"));
      return;
    }
    if (!given)
      problems_.warning(location_of(limit),
                        concat(owner_, ": <limit> has no ", attribute, ", which is taken as unlimited"));
    else if (value)
      problems_.warning(location_of(limit), concat(owner_, ": its ", attribute, " limit ", *value,
                                                   " is negative and taken as ", "unlimited; it is 0 or more"));
    set(limit, attribute, no_limit);
  }

  void check_dynamics() {
    Element* dynamics = only_child(xml_, "dynamics", owner_, problems_);
    if (!dynamics) return;
    Problems softer = softened(problems_, "it is taken as 0");
    for (const char* attribute : {"damping", "friction", "armature"}) {
      const auto value = number(*dynamics, attribute, owner_, softer);
      if (!value) dynamics->DeleteAttribute(attribute);
      if (value.value_or(0) >= 0) continue;
      problems_.warning(location_of(*dynamics), concat(owner_, ": ", attribute, " ", dynamics->Attribute(attribute),
                                                       " is negative and taken as 0"));
      dynamics->SetAttribute(attribute, "0");
    }
    // urdfdom does not read armature, and fails on <dynamics> with neither damping nor friction
    if (dynamics->Attribute("armature")) info_.armature = dynamics->DoubleAttribute("armature");
    if (!dynamics->Attribute("damping") && !dynamics->Attribute("friction")) remove(*dynamics);
  }

  void check_mimic() {
    Element* mimic = only_child(xml_, "mimic", owner_, problems_);
    if (!mimic) return;
    if (!info_.moves) {
      problems_.warning(location_of(*mimic),
                        concat(owner_, " is ", info_.type, " and cannot mimic; <mimic> is ignored"));
      return remove(*mimic);
    }
    Problems softer = softened(problems_, "the joint moves on its own");
    number(*mimic, "multiplier", owner_, softer);
    number(*mimic, "offset", owner_, softer);
    if (softer.found_error()) remove(*mimic);
  }

  Element& xml_;
  std::string owner_;
  Problems& problems_;
  JointInfo info_;
};

/// Returns the name of the joint that <mimic> of `xml` names, or an empty name.
std::string leader_of(Element& xml) {
  Element* mimic = xml.FirstChildElement("mimic");
  const char* leader = mimic ? mimic->Attribute("joint") : nullptr;
  return leader ? leader : "";
}

/// Returns the range between the limits of a joint.
model_file::JointRange own_range(const JointInfo& joint) {
  const Element* limit = joint.xml->FirstChildElement("limit");
  if (!limit || joint.type == "continuous") return {};
  const auto bound = [&](const char* attribute) {
    const double q = limit->DoubleAttribute(attribute, 0);
    return std::abs(q) < no_limit ? q : std::copysign(std::numeric_limits<double>::infinity(), q);
  };
  return {bound("lower"), bound("upper")};
}

/// Returns the range to which its leader moves a joint, or its own range if it has no leader.
model_file::JointRange range_of(const ModelInfo& model, const JointInfo& joint) {
  if (const std::string leader = leader_of(*joint.xml); !leader.empty()) {
    const Element& mimic = *joint.xml->FirstChildElement("mimic");
    return range_of(model, model.joints.at(leader))
        .followed(mimic.DoubleAttribute("multiplier", 1), mimic.DoubleAttribute("offset", 0));
  }
  return own_range(joint);
}

/// Reports mimic joints that their leaders move beyond their limits. All leaders must exist.
void check_mimic_limits(const ModelInfo& model, Problems& problems) {
  for (const auto& [name, joint] : model.joints) {
    const std::string leader = leader_of(*joint.xml);
    if (leader.empty()) continue;
    if (const auto text = model_file::passed_mimic_limits(name, leader, range_of(model, joint), own_range(joint)))
      problems.warning(location_of(*joint.xml->FirstChildElement("mimic")), *text);
  }
}

/// Returns a name that no joint has yet.
std::string new_joint_name(const ModelInfo& model, const std::string& wanted) {
  std::string name = wanted;
  for (int i = 2; model.joints.count(name) != 0; ++i) name = concat(wanted, "_", i);
  return name;
}

}  // namespace

void check_joints(Element& robot, ModelInfo& model, Problems& problems) {
  for (Element* joint : children(robot, "joint")) {
    const Location location = location_of(*joint);
    const char* given = joint->Attribute("name");
    std::string name = given ? given : "";
    if (name.empty()) {
      const Element* child = joint->FirstChildElement("child");
      const char* link = child ? child->Attribute("link") : nullptr;
      name = new_joint_name(model, concat(link && *link ? link : "unnamed", "_joint"));
      problems.warning(location, concat("a joint has no name and is called ", quote(name),
                                        "; write <joint name=\"...\" type=\"...\">"));
    } else if (const auto other = model.joints.find(name); other != model.joints.end()) {
      name = new_joint_name(model, name);
      problems.warning(location,
                       concat("a second joint is named ", quote(given), " and called ", quote(name),
                              "; the first one is in line ", other->second.location.line, ", and names are unique"));
    }
    joint->SetAttribute("name", name.c_str());
    std::optional<JointInfo> info = JointCheck(*joint, name, problems).run(model);
    if (!info) {
      remove(*joint);
      continue;
    }
    model.joints.emplace(name, std::move(*info));
    model.joint_order.push_back(name);
  }
}

void check_mimics(ModelInfo& model, Problems& problems) {
  for (const auto& [name, joint] : model.joints) {
    Element* mimic = joint.xml->FirstChildElement("mimic");
    if (!mimic) continue;
    const std::string leader = leader_of(*joint.xml);
    const auto found = model.joints.find(leader);
    if (found != model.joints.end() && found->second.moves) continue;
    problems.warning(location_of(*mimic), concat("joint ", quote(name), " mimics ", quote(leader), ", which is no ",
                                                 "revolute, continuous or prismatic joint; it moves on its own"));
    remove(*mimic);
  }
  for (const auto& [name, joint] : model.joints) {
    std::string leader = leader_of(*joint.xml);
    for (std::size_t steps = 0; !leader.empty() && steps <= model.joints.size(); ++steps) {
      if (leader == name) {
        Element* mimic = joint.xml->FirstChildElement("mimic");
        problems.warning(location_of(*mimic), concat("joint ", quote(name), " mimics itself, over ", steps,
                                                     " other joints; it moves on its own"));
        remove(*mimic);
        break;
      }
      leader = leader_of(*model.joints.at(leader).xml);
    }
  }
  check_mimic_limits(model, problems);
}

}  // namespace muro::urdf
