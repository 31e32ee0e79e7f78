// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include "checks.hpp"
#include "muro/base/elementary.hpp"
#include "plugins/common/model_file/mesh_path.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::sdf {

namespace {

constexpr std::array<std::string_view, 9> joint_types = {"revolute",  "continuous", "prismatic", "fixed",  "universal",
                                                         "revolute2", "ball",       "screw",     "gearbox"};

/// Friction that replaces friction without limit. Nothing slides on it.
constexpr double most_friction = 1e6;

/// Limit of <drake:rotor_inertia> and <drake:gear_ratio>; it keeps the reflected inertia within the range of inertias.
constexpr double max_rotor_value = 1e7;

std::vector<double> values_of(const Element* e) {
  std::string error;
  return e ? model_file::parse_numbers(text_of(*e), error) : std::vector<double>{};
}

}  // namespace

void Check::prepare(Element& e, std::string_view section) {
  // up to SDFormat 1.5 <gravity> is in <physics>, which is not read
  if (section != "world" || source_.version_number() >= 106 || e.FirstChildElement("gravity")) return;
  Element* physics = e.FirstChildElement("physics");
  Element* gravity = physics ? physics->FirstChildElement("gravity") : nullptr;
  if (gravity) e.InsertEndChild(gravity);
}

/// Completes an element. Returns false if it has to be removed.
bool Check::complete(Element& e, std::string_view section) {
  if (section == "world" || section == "model") {
    // the name of a world is not used, and some names are not allowed
    if (section == "world") e.SetAttribute("name", "default");
    if (attribute(e, "name").empty()) {
      if (section == "model") problems_.warning(location_of(e), "a model has no name; write <model name=\"...\">");
      e.SetAttribute("name", std::string(section).c_str());
    }
    Scope scope;
    scope.is_world = section == "world";
    names(e, scope);
    references(e, scope);
    const bool still = child_text(e, "static") == "true" || child_text(e, "static") == "1";
    const bool empty = !e.FirstChildElement("link") && !e.FirstChildElement("model") && !e.FirstChildElement("include");
    if (section == "model" && empty && !still)
      error(location_of(e),
            concat("model ", quote(attribute(e, "name")), " has no link; it needs at least one <link name=\"...\"/>"));
  } else if (section == "link") {
    for (const char* kind : {"collision", "visual"}) {
      std::set<std::string> used;
      for (Element* part : model_file::children(e, kind)) {
        // these names are not used
        std::string name = attribute(*part, "name");
        if (name.empty()) name = kind;
        std::replace(name.begin(), name.end(), ':', '_');
        while (!used.insert(name).second) name += "_";
        part->SetAttribute("name", name.c_str());
      }
    }
  } else if (section == "inertial") {
    Element* pose = e.FirstChildElement("pose");
    if (pose && !attribute(*pose, "relative_to").empty()) {
      problems_.warning(location_of(*pose),
                        "the <pose> of an <inertial> is always relative to its link; `relative_to` is ignored");
      pose->DeleteAttribute("relative_to");
    }
  } else if (section == "joint") {
    return complete_joint(e);
  } else if (section == "collision" || section == "visual") {
    return complete_shape(e);
  } else if (section == "metal" || section == "specular") {
    find_picture(e, "albedo_map");
  } else if (section == "ode friction") {
    for (const char* name : {"mu", "mu2"})
      if (Element* friction = e.FirstChildElement(name)) take_endless(*friction);
  } else if (section == "include") {
    return complete_include(e);
  }
  return true;
}

/// Replaces a negative coefficient of friction, which means friction without limit. libsdformat does not read it.
void Check::take_endless(Element& friction) {
  const std::vector<double> value = values_of(&friction);
  if (value.size() != 1 || !(value[0] < 0)) return;
  problems_.note(location_of(friction),
                 concat("a friction of ", value[0], " has no limit, as in Gazebo: it is taken as ", most_friction));
  friction.DeleteChildren();
  friction.SetText(model_file::text_of({most_friction}).c_str());
}

/// Replaces the name of a picture in a child of `owner` by the path of its file. Returns false if there is none.
bool Check::find_picture(Element& owner, const char* name) {
  Element* map = owner.FirstChildElement(name);
  if (!map) return false;
  const model_file::MeshPath found = model_file::find_file(text_of(*map), source_.folder, sources_.packages());
  if (found.path.empty()) {
    problems_.warning(location_of(*map),
                      concat("picture ", quote(text_of(*map)), " is not found; what it covers is plain"));
    owner.DeleteChild(map);
    return false;
  }
  map->DeleteChildren();
  map->SetText(found.path.c_str());
  return true;
}

bool Check::complete_joint(Element& joint) {
  const std::string owner = "joint " + quote(attribute(joint, "name")), type = attribute(joint, "type");
  const auto fix = [&](const FileLocation& at, const std::string& why) {
    problems_.warning(at, concat(owner, why, "; it is taken as fixed"));
    joint.SetAttribute("type", "fixed");
    for (const char* axis : {"axis", "axis2"})
      if (Element* e = joint.FirstChildElement(axis)) joint.DeleteChild(e);
  };
  for (const char* end : {"parent", "child"})
    if (child_text(joint, end).empty()) {
      problems_.warning(location_of(joint),
                        concat(owner, " is left out: it has no ", end, "; write <", end, ">LINK</", end, ">"));
      return false;
    }
  if (child_text(joint, "parent") == child_text(joint, "child")) {
    problems_.warning(location_of(joint), concat(owner, " is left out: it joins link ",
                                                 quote(child_text(joint, "parent")), " with itself"));
    return false;
  }
  if (std::find(joint_types.begin(), joint_types.end(), type) == joint_types.end()) {
    std::vector<std::string> known(joint_types.begin(), joint_types.end());
    fix(location_of(joint), concat(type.empty() ? " has no type" : " is of the unknown type " + quote(type),
                                   ", and types are ", quoted_list(known)));
    return true;
  }
  const int axes = type == "fixed" || type == "ball"                                 ? 0
                   : type == "universal" || type == "revolute2" || type == "gearbox" ? 2
                                                                                     : 1;
  take_rotor(joint, owner, axes == 1);
  for (int i = 0; i < 2; ++i) {
    const char* name = i == 0 ? "axis" : "axis2";
    Element* axis = joint.FirstChildElement(name);
    if (i >= axes) {
      // libsdformat would report it or misread it
      if (axis) joint.DeleteChild(axis);
      continue;
    }
    if (!axis) {
      problems_.warning(location_of(joint), concat(owner, " has no <", name, ">; the axis is z, SDFormat's default"));
      axis = joint.InsertNewChildElement(name);
      axis->SetUserData(joint.GetUserData());
      Element* xyz = axis->InsertNewChildElement("xyz");
      xyz->SetUserData(joint.GetUserData());
      xyz->SetText("0 0 1");
    }
    const std::vector<double> xyz = values_of(axis->FirstChildElement("xyz"));
    if (xyz.size() == 3 && !(elementary::hypot(elementary::hypot(xyz[0], xyz[1]), xyz[2]) > 1e-9)) {
      fix(location_of(*axis),
          concat(": its <", name, "> has no direction, and <xyz> is a vector of length 1, such as 0 0 1"));
      return true;
    }
    take_mimic(joint, *axis, i);
  }
  if (Element* pitch = joint.FirstChildElement("screw_thread_pitch")) {
    // SDFormat 1.10: metres a turn, right-handed; before: turns of -1 rad a metre
    const std::vector<double> metres = values_of(pitch);
    Element* old = joint.FirstChildElement("thread_pitch");
    if (!old) old = joint.InsertNewChildElement("thread_pitch");
    if (metres.size() == 1 && metres[0] != 0)
      old->SetText(model_file::shortest(-2 * std::numbers::pi / metres[0]).c_str());
    joint.DeleteChild(pitch);
  }
  const std::vector<double> pitch = values_of(joint.FirstChildElement("thread_pitch"));
  if (type == "screw" && !pitch.empty() && pitch[0] == 0)
    fix(location_of(joint), ": its thread_pitch is 0, and it is the angle in rad a metre");
  if (type == "gearbox" && child_text(joint, "gearbox_reference_body").empty()) {
    problems_.warning(location_of(joint),
                      concat(owner, " is left out: it has no <gearbox_reference_body>, which names ",
                             "the link that carries both wheels"));
    return false;
  }
  return true;
}

/// Reads <drake:rotor_inertia> and <drake:gear_ratio> as Drake does. libsdformat does not read them.
void Check::take_rotor(Element& joint, const std::string& owner, bool has_one_axis) {
  Element *inertia = joint.FirstChildElement("drake:rotor_inertia"),
          *ratio = joint.FirstChildElement("drake:gear_ratio");
  const std::vector<double> i = values_of(inertia), r = values_of(ratio);
  const auto is_fine = [](const std::vector<double>& v) { return v.empty() || (v[0] >= 0 && v[0] <= max_rotor_value); };
  if (!is_fine(i) || !is_fine(r))
    problems_.warning(location_of(is_fine(i) ? *ratio : *inertia),
                      concat(owner,
                             ": the inertia of its rotor is left out; <drake:rotor_inertia> and "
                             "<drake:gear_ratio> are from 0 to 1e7"));
  else if (!i.empty() && !has_one_axis)
    problems_.warning(location_of(*inertia), concat(owner,
                                                    ": the inertia of its rotor is left out; only joints with "
                                                    "one axis have one"));
  else if (!i.empty())
    sources_.armatures[location_of(joint)] = i[0] * (r.empty() ? 1 : r[0] * r[0]);
  for (Element* e : {inertia, ratio})
    if (e) joint.DeleteChild(e);
}

void Check::take_mimic(Element& joint, Element& axis, int number) {
  Element* mimic = axis.FirstChildElement("mimic");
  if (!mimic) return;
  Mimic taken{attribute(*mimic, "joint"), attribute(*mimic, "axis"), 1, 0, 0, location_of(*mimic)};
  const auto value = [&](const char* name, double& out) {
    if (const auto v = values_of(mimic->FirstChildElement(name)); v.size() == 1) out = v[0];
  };
  value("multiplier", taken.multiplier);
  value("offset", taken.offset);
  value("reference", taken.reference);
  if (taken.joint.empty())
    problems_.warning(location_of(*mimic), "a <mimic> that names no joint is left out; write <mimic joint=\"...\">");
  else
    sources_.mimics[{location_of(joint), number}] = taken;
  axis.DeleteChild(mimic);
}

bool Check::complete_shape(Element& e) {
  Element* geometry = e.FirstChildElement("geometry");
  Element* shape = geometry ? geometry->FirstChildElement() : nullptr;
  const Severity lost = std::string_view(e.Name()) == "collision" ? Severity::lost_collision : Severity::warning;
  // an unsupported kind of shape was reported already
  if (!shape) {
    problems_.report(
        lost, location_of(e),
        concat("<", e.Name(), " name=", quote(attribute(e, "name")), "> is left out, as it has no shape that is read"));
    return false;
  }
  while (Element* second = shape->NextSiblingElement()) {
    problems_.warning(location_of(*second),
                      concat("a second shape in one <geometry> is left out; give each a <", e.Name(), "> of its own"));
    geometry->DeleteChild(second);
  }
  const std::string error = error_of_shape(*shape);
  if (!error.empty())
    problems_.report(lost, location_of(*shape),
                     concat("<", e.Name(), " name=", quote(attribute(e, "name")), "> is left out, as ", error));
  else if (std::string_view(shape->Name()) == "mesh")
    return find_mesh(e, *shape->FirstChildElement("uri"));
  else if (std::string_view(shape->Name()) == "heightmap")
    return complete_heightmap(e, *shape);
  return error.empty();
}

/// Replaces the name of a mesh by the path of its file. Returns false if the mesh is not found: its shape is left out.
bool Check::find_mesh(const Element& body, Element& uri) {
  const std::string name = text_of(uri);
  const model_file::MeshPath found = model_file::find_mesh(name, source_.folder, sources_.packages());
  if (found.path.empty()) {
    missing_meshes_.add(name, location_of(uri), found, std::string_view(body.Name()) == "collision");
    return false;
  }
  if (const std::string note = model_file::note_on(name, found); !note.empty()) problems_.note(location_of(uri), note);
  uri.DeleteChildren();
  uri.SetText(found.path.c_str());
  return true;
}

std::string Check::error_of_shape(Element& shape) {
  const std::string_view kind = shape.Name();
  const auto needs = [&](const char* name) -> std::string {
    const Element* size = shape.FirstChildElement(name);
    if (!size) return concat("its <", kind, "> has no <", name, ">");
    const auto values = values_of(size);
    const bool fine = std::all_of(values.begin(), values.end(), [](double v) { return v > 0; });
    return fine ? std::string() : concat("its <", kind, "> has a <", name, "> that is not above 0");
  };
  if (kind == "box") return needs("size");
  if (kind == "sphere") return needs("radius");
  if (kind == "cylinder" || kind == "capsule") {
    const std::string radius = needs("radius");
    return radius.empty() ? needs("length") : radius;
  }
  if (kind == "plane") {
    const auto normal = values_of(shape.FirstChildElement("normal"));
    if (normal.size() == 3 && !(elementary::hypot(elementary::hypot(normal[0], normal[1]), normal[2]) > 1e-9))
      return "its <plane> has a <normal> without direction";
    return {};
  }
  if (kind == "heightmap" && shape.FirstChildElement("size"))
    if (const std::string error = needs("size"); !error.empty()) return error;
  const auto scale = values_of(shape.FirstChildElement("scale"));
  if (std::any_of(scale.begin(), scale.end(), [](double s) { return s == 0; })) return "its <mesh> has a <scale> of 0";
  const Element* uri = shape.FirstChildElement("uri");
  return uri && !text_of(*uri).empty() ? "" : concat("its <", kind, "> has no <uri>");
}

}  // namespace muro::sdf
