// SPDX-License-Identifier: MIT
#include <algorithm>

#include "model.hpp"
#include "muro/base/elementary.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/model_file/numbers.hpp"

namespace muro::urdf {

namespace {

void check_origin(Element& parent, const std::string& owner, Problems& problems) {
  Element* origin = only_child(parent, "origin", owner, problems);
  if (!origin) return;
  numbers(*origin, "xyz", 3, owner, problems);
  numbers(*origin, "rpy", 3, owner, problems);
  numbers(*origin, "quat_xyzw", 4, owner, problems);
}

/// Removes an <inertial> that is empty or invalid, completes one that is incomplete.
void check_inertial(Element& link, const std::string& owner, Problems& all_problems) {
  Problems problems = softened(all_problems, "the link has no mass");
  Element* inertial = only_child(link, "inertial", owner, problems);
  if (!inertial) return;
  check_origin(*inertial, owner, problems);
  Element* mass = only_child(*inertial, "mass", owner, problems);
  if (!mass || !mass->Attribute("value")) {
    problems.warning(location_of(*inertial),
                     owner + ": <inertial> without <mass value=\"...\"/>; the link has no mass");
    return remove(*inertial);
  }
  const double kg = number(*mass, "value", owner, problems).value_or(1);
  if (kg < 0) {
    problems.warning(location_of(*mass), concat(owner, ": the mass is ", kg,
                                                " kg and taken as 0, a frame without a body; it is 0 or more"));
    return remove(*inertial);
  }
  Element* inertia = only_child(*inertial, "inertia", owner, problems);
  if (!inertia) inertia = inertial->InsertNewChildElement("inertia");
  bool any = false;
  std::string missing;
  for (const char* element : {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"}) {
    if (inertia->Attribute(element)) {
      any = number(*inertia, element, owner, problems).value_or(1) != 0 || any;
    } else {
      inertia->SetAttribute(element, "0");
      missing += (missing.empty() ? "" : ", ") + std::string(element);
    }
  }
  if (!missing.empty() && any)
    problems.warning(location_of(*inertia), concat(owner, ": <inertia> lacks ", missing, ", which count as 0"));
  if (problems.found_error()) return remove(*inertial);
  if (kg != 0) return;
  if (any) problems.warning(location_of(*inertial), owner + " has an inertia but no mass; the inertia is ignored");
  remove(*inertial);
}

/// Writes three numbers, as Bullet reads them: one number is repeated, numbers after the third are dropped.
void make_three(Element& element, const char* attribute, const std::string& owner, Problems& problems) {
  std::string error;
  const char* text = element.Attribute(attribute);
  const auto given = model_file::parse_numbers(text ? text : "", error);
  if (!text || !error.empty() || given.size() == 3 || given.empty() || given.size() == 2) return;
  const double y = given.size() == 1 ? given[0] : given[1], z = given.size() == 1 ? given[0] : given[2];
  const std::string three = model_file::text_of({given[0], y, z});
  problems.warning(location_of(element),
                   concat(owner, ", <", element.Name(), " ", attribute, ">: ", quote(text), " has ", given.size(),
                          given.size() == 1 ? " number" : " numbers", " and is read as ", quote(three)));
  element.SetAttribute(attribute, three.c_str());
}

/// Returns the severity of a message that a collision or visual is left out.
Severity severity_of_lost(std::string_view kind) {
  return kind == "collision" ? Severity::lost_collision : Severity::warning;
}

/// Returns false if no shape can be made of the element; the reason is reported.
bool check_shape(Element& element, const std::string& owner, Problems& problems) {
  check_origin(element, owner, problems);
  Element* geometry = only_child(element, "geometry", owner, problems);
  Element* shape = geometry ? geometry->FirstChildElement() : nullptr;
  const std::string left_out = concat(owner, ": a <", element.Name(), "> is left out, ");
  const Severity lost = severity_of_lost(element.Name());
  if (!shape) {
    problems.report(lost, location_of(element), left_out + "as it has no shape in <geometry>");
    return false;
  }
  if (shape->NextSiblingElement())
    problems.warning(location_of(*geometry),
                     concat(owner, ": <geometry> holds several shapes; only the first one counts. Give ", "each a <",
                            element.Name(), "> of its own"));
  const std::string kind = shape->Name();
  const auto lacks = [&](const char* attribute) {
    if (shape->Attribute(attribute)) return false;
    problems.report(lost, location_of(*shape), concat(left_out, "as its <", kind, "> has no ", attribute));
    return true;
  };
  const auto sized = [&](std::initializer_list<double> sizes) {
    if (std::all_of(sizes.begin(), sizes.end(), [](double s) { return s > 0; })) return true;
    problems.report(lost, location_of(*shape), concat(left_out, "as its <", kind, "> has a size that is not above 0"));
    return false;
  };
  // invalid numbers were reported as errors; the values used instead have no effect
  if (kind == "box") {
    if (lacks("size")) return false;
    const auto size = numbers(*shape, "size", 3, owner, problems).value_or(std::vector<double>{1, 1, 1});
    return sized({size[0], size[1], size[2]});
  }
  if (kind == "sphere") {
    if (lacks("radius")) return false;
    return sized({number(*shape, "radius", owner, problems).value_or(1)});
  }
  if (kind == "cylinder" || kind == "capsule") {
    if (lacks("radius") || lacks("length")) return false;
    const double radius = number(*shape, "radius", owner, problems).value_or(1);
    return sized({radius, number(*shape, "length", owner, problems).value_or(1)});
  }
  if (kind == "mesh") {
    if (lacks("filename")) return false;
    make_three(*shape, "scale", owner, problems);
    const auto scale = numbers(*shape, "scale", 3, owner, problems).value_or(std::vector<double>{1, 1, 1});
    return sized({std::abs(scale[0]), std::abs(scale[1]), std::abs(scale[2])});
  }
  problems.report(lost, location_of(*shape),
                  concat(left_out, "as ", quote(kind), " is no shape of URDF: box, capsule, cylinder, sphere, mesh"));
  return false;
}

void take_shapes(Element& link, LinkInfo& info) {
  if (const Element* inertial = link.FirstChildElement("inertial")) info.inertial_rotation = origin_rotation(*inertial);
  const auto take = [&](const char* kind, std::vector<LinkInfo::ShapeInfo>& shapes) {
    for (Element* e = link.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      Element& shape = *e->FirstChildElement("geometry")->FirstChildElement();
      const bool is_capsule = std::string_view(shape.Name()) == "capsule";
      if (is_capsule) shape.SetName("cylinder");  // urdfdom 3 reads no capsule
      const char* material = e->Attribute("material");
      shapes.push_back({origin_rotation(*e), location_of(shape), is_capsule, material ? material : ""});
    }
  };
  take("collision", info.collisions);
  take("visual", info.visuals);
}

}  // namespace

Quat origin_rotation(const Element& owner) {
  const Element* origin = owner.FirstChildElement("origin");
  std::string error;
  // quat_xyzw of URDF 1.1 has priority over rpy
  if (const char* xyzw = origin ? origin->Attribute("quat_xyzw") : nullptr)
    if (const auto q = model_file::parse_numbers(xyzw, 4, error)) {
      const double length = elementary::hypot(elementary::hypot((*q)[0], (*q)[1]), elementary::hypot((*q)[2], (*q)[3]));
      if (length > 1e-9 && std::isfinite(length))
        return Quat((*q)[3] / length, (*q)[0] / length, (*q)[1] / length, (*q)[2] / length);
    }
  const char* rpy = origin ? origin->Attribute("rpy") : nullptr;
  const auto angles = rpy ? model_file::parse_numbers(rpy, 3, error) : std::nullopt;
  if (!angles) return Quat::Identity();
  return from_rpy((*angles)[0], (*angles)[1], (*angles)[2]);
}

void check_links(Element& robot, ModelInfo& model, Problems& problems) {
  for (Element* link : children(robot, "link")) {
    const Location location = location_of(*link);
    const char* name = link->Attribute("name");
    if (!name || !*name) {
      problems.warning(location, "a link without a name is left out; write <link name=\"...\">");
      remove(*link);
      continue;
    }
    const std::string owner = "link " + quote(name);
    const auto [entry, fresh] = model.links.try_emplace(name);
    if (!fresh) {
      problems.warning(location, concat("a second link named ", quote(name), " is left out; the first one is in line ",
                                        entry->second.location.line, ", and names are unique"));
      remove(*link);
      continue;
    }
    check_inertial(*link, owner, problems);
    for (const char* kind : {"collision", "visual"})
      for (Element* element : children(*link, kind)) {
        Problems of_shape = softened(problems, concat("the <", kind, "> is left out"), severity_of_lost(kind));
        if (!check_shape(*element, owner, of_shape) || of_shape.found_error()) remove(*element);
      }
    take_shapes(*link, entry->second);
    entry->second.location = location;
    entry->second.bare = !link->FirstChildElement("inertial") && !link->FirstChildElement("collision") &&
                         !link->FirstChildElement("visual");
  }
  if (model.links.empty() && !problems.found_error())
    problems.error(location_of(robot), "the robot has no link; it needs at least one <link name=\"...\"/>");
}

}  // namespace muro::urdf
