// SPDX-License-Identifier: MIT
#include "connections.hpp"

#include <algorithm>
#include <utility>

#include "control_table.hpp"
#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/quote.hpp"
#include "port.hpp"

namespace muro::control {

namespace {

/// Returns a unit for each property. A port has one unit for all properties, or one for each: "rad, rad, m".
std::vector<std::string_view> units_of(const muro_port& port, const std::vector<PortProperty>& properties) {
  const std::string_view unit = port.unit ? port.unit : "";
  std::vector<std::string_view> each;
  for (std::size_t from = 0; from <= unit.size();) {
    const std::size_t end = std::min(unit.find(", ", from), unit.size());
    each.push_back(unit.substr(from, end - from));
    from = end + 2;
  }
  const auto has_it = [&](const PortProperty& p) { return p.found.key->unit == unit; };
  if (each.size() == 1 || properties.size() == 1 || std::any_of(properties.begin(), properties.end(), has_it))
    return std::vector(properties.size(), unit);
  if (each.size() == properties.size()) return each;
  throw Error("its unit in the library is \"" + std::string(unit) + "\", which is one for each of " +
              std::to_string(each.size()) + " properties, but " + std::to_string(properties.size()) + " are connected");
}

std::string comma_separated(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& n : names) all += (all.empty() ? "" : ", ") + n;
  return all;
}

}  // namespace

Connections read_connections(std::string_view parameter, std::span<const std::string_view> texts,
                             std::span<const muro_port> ports, std::string_view library) {
  std::vector<std::string> known;
  for (const muro_port& p : ports) known.emplace_back(p.name);
  Connections result;
  for (const std::string_view text : texts) {
    const std::string context = quote(parameter) + ": " + quote(text);
    const std::size_t equals = text.find('=');
    if (equals == std::string_view::npos || equals == 0)
      throw Error(context + " must be \"port=object:property\" or \"port=property\"");
    const std::string port(text.substr(0, equals));
    if (std::find(known.begin(), known.end(), port) == known.end())
      throw Error(context + ": library " + quote(library) + " has no such " +
                  (parameter == "inputs" ? "input" : "output") + did_you_mean(port, known) +
                  "; it has: " + (known.empty() ? "none" : comma_separated(known)));
    if (result.contains(port)) throw Error(context + " connects port " + quote(port) + " a second time");
    std::vector<PropertyReference>& references = result[port];
    for (std::string_view rest = text.substr(equals + 1);;) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      references.push_back(read_reference(rest.substr(0, comma)));
      if (references.back().property.empty()) throw Error(context + " names no property");
      if (comma == rest.size()) break;
      rest.remove_prefix(comma + 1);
    }
  }
  return result;
}

bool matches(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = pattern.npos, from = 0;  // `from`: end of the text that the last star matches
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++, from = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p, ++n;
    } else if (star != pattern.npos && name[from] != '/') {
      p = star + 1, n = ++from;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

/// Returns matching properties in the order of the scenario: of the item's robot if there are any, else of all objects.
/// Leaves out shadows. Outputs prefer properties that exist already.
std::vector<FoundProperty> PropertyFinder::find_matching(const PropertyReference& reference, bool input) const {
  std::vector<FoundProperty> found, targets;
  bool any_object = false;
  const auto add = [&](ObjectId o, std::string_view name) {
    if (!matches(reference.object, name) || search_.is_shadow(o)) return;
    any_object = true;
    if (const auto p = search_.property_of(o, reference.property))
      found.push_back(*p);
    else if (const auto target = search_.target_velocity(o, reference.property); target && !input)
      targets.push_back(*target);
  };
  for (const ObjectId o : search_.own_objects()) add(o, search_.local_name(o));
  if (found.empty()) found = std::exchange(targets, {});
  if (!found.empty()) return found;
  targets.clear();
  for (std::uint32_t o = 0; o < connector_.object_count(); ++o) add(ObjectId{o}, connector_.object_name(ObjectId{o}));
  if (found.empty()) found = std::move(targets);
  if (!found.empty()) return found;
  if (any_object)
    throw Error("no object with a name like " + quote(reference.object) + " has a property " +
                quote(reference.property));
  std::vector<std::string> names;
  for (const ObjectId o : search_.objects()) names.push_back(search_.local_name(o));
  for (const RobotView* r : connector_.robots()) names.emplace_back(connector_.object_name(r->base()));
  throw Error("no object has a name like " + quote(reference.object) + " (a `*` stands for any characters but `/`)" +
              did_you_mean(reference.object, names) + "; there are: " + quoted_list(names));
}

std::optional<PropertyFinder::Following> PropertyFinder::following(ObjectId joint) const {
  const RobotId id = joint == no_object ? no_robot : connector_.robot_of(joint);
  if (id == no_robot) return std::nullopt;
  const RobotView& robot = *connector_.robots()[index_of(id)];
  for (const Link& link : robot.links)
    if (link.joint_object == joint && link.mimic >= 0)
      return Following{&robot, &link, &robot.links[std::size_t(link.mimic)]};
  return std::nullopt;
}

std::string PropertyFinder::leader_of(const PortProperty& follower) const {
  return quote(search_.local_name(following(follower.found.object)->leader->joint_object));
}

/// Returns the target of a joint that follows another one. Nothing commands such a joint itself.
std::optional<PortProperty> PropertyFinder::find_follower(const PropertyReference& reference) const {
  if (!reference.property.ends_with(".target")) return std::nullopt;
  ObjectId joint = no_object;
  if (item_.robot) joint = connector_.find_object(std::string(item_.robot->name) + "/" + reference.object);
  if (joint == no_object) joint = connector_.find_object(reference.object);
  const auto mimic = following(joint);
  if (!mimic || search_.property_of(joint, reference.property)) return std::nullopt;
  auto of_leader = search_.property_of(mimic->leader->joint_object, reference.property);
  if (!of_leader) of_leader = search_.target_velocity(mimic->leader->joint_object, reference.property);
  if (!of_leader) return std::nullopt;
  PortProperty follower{*of_leader, -1, mimic->link->mimic_multiplier, mimic->link->mimic_offset};
  if (of_leader->key->name != keys::joint_position_target.name) follower.offset = 0;
  follower.found.object = joint;
  return follower;
}

/// Finds the leader of each follower in `all`. Throws Error when it is missing.
void PropertyFinder::find_leaders(std::vector<PortProperty>& all) const {
  for (PortProperty& p : all) {
    const auto mimic = following(p.found.object);
    if (!mimic || search_.property_of(p.found.object, p.found.key->name)) continue;
    const ObjectId leader = mimic->leader->joint_object;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].found.object == leader && all[i].found.key->name == p.found.key->name) p.leader = std::int32_t(i);
    if (p.leader < 0)
      throw Error(search_.name_of(p.found) + " cannot be written: the joint follows " + leader_of(p) +
                  " (a mimic joint), which takes the target of both; write \"" + search_.local_name(leader) + ":" +
                  std::string(p.found.key->name) + "\" in its place, or beside it in the same port");
  }
}

/// Checks the unit. Properties of joints are in "rad or m": the first for revolute joints, the second for prismatic
/// ones. `wanted`: unit of the port at this place.
void PropertyFinder::check_unit(const FoundProperty& p, const muro_port& port, std::string_view wanted) const {
  if (p.key->unit == wanted) return;
  std::string_view unit = p.key->unit;
  std::string why;
  const std::size_t alternative = unit.find(" or ");
  const JointKind joint = alternative == unit.npos ? JointKind::fixed : search_.joint_of(p.object);
  if (joint == JointKind::revolute) unit = unit.substr(0, alternative), why = ", for the joint turns,";
  if (joint == JointKind::prismatic) unit = unit.substr(alternative + 4), why = ", for the joint shifts,";
  if (unit == wanted) return;
  throw Error(search_.name_of(p) + " is in \"" + std::string(unit) + "\"" + (why.empty() ? "," : why) +
              " but the library works in \"" + std::string(wanted) + "\"" +
              (wanted == port.unit ? "" : " there (\"" + std::string(port.unit) + "\")"));
}

void PropertyFinder::check_type(const FoundProperty& p, const muro_port& port, bool input) const {
  const std::string is_of_type = search_.name_of(p) + " is of type " + std::string(p.key->type->name);
  const Scalar scalar = p.key->type->scalar;
  if (type_of(port) == PortType::text) {
    const bool is_bytes = scalar == Scalar::u8;
    const bool is_object = input && *p.key->type == value_type<ObjectId>;
    const bool is_text = input && *p.key->type == value_type<TextId> && p.is_constant;
    if (!is_bytes && !is_object && !is_text)
      throw Error(is_of_type + (input ? "; a port of texts reads texts that are constants, names of objects, and bytes"
                                      : "; a port of texts writes bytes, an array of u8"));
    return;
  }
  const bool is_list_of_contacts = has_flag(port, MURO_PORT_LIST) && is_contact(*p.key);
  if (size_of(scalar) == 0 && !is_list_of_contacts) throw Error(is_of_type + ", which is not made of numbers");
  if (type_of(port) == PortType::integer && (scalar == Scalar::f64 || scalar == Scalar::f32))
    throw Error(is_of_type + ", but the port is of integers; a port of numbers takes it");
}

void PropertyFinder::check(const FoundProperty& p, const muro_port& port, bool input, std::string_view unit) const {
  check_type(p, port, input);
  const bool is_list = p.multiplicity == Multiplicity::list;
  if (is_list && !has_flag(port, MURO_PORT_LIST))
    throw Error(search_.name_of(p) +
                " is a list, whose length changes from step to step; a port without MURO_PORT_LIST has a fixed size");
  if (!is_list && has_flag(port, MURO_PORT_LIST))
    throw Error(search_.name_of(p) + " has a fixed length, but the port is a list (MURO_PORT_LIST)");
  if (port.unit) check_unit(p, port, unit);
}

std::vector<PortProperty> PropertyFinder::find(const muro_port& port, bool input,
                                               const Connections& connections) const {
  const std::string_view parameter = input ? "inputs" : "outputs";
  std::vector<PortProperty> found;
  if (const auto connected = connections.find(port.name); connected != connections.end()) {
    for (const PropertyReference& r : connected->second) {
      if (r.object.find('*') != std::string::npos) {
        for (const FoundProperty& p : find_matching(r, input)) found.push_back({p});
      } else if (const auto follower = input ? std::nullopt : find_follower(r)) {
        found.push_back(*follower);
      } else {
        found.push_back({input ? search_.find(r, parameter, port.name) : search_.find_output(r, parameter, port.name)});
      }
    }
    if (!input) find_leaders(found);
  } else {
    const FoundProperty p = search_.find({"", port.name}, parameter, port.name);
    found.push_back({input ? search_.measured(p).value_or(p) : p});
  }
  const std::vector<std::string_view> units = units_of(port, found);
  for (std::size_t i = 0; i < found.size(); ++i) check(found[i].found, port, input, units[i]);
  const bool is_one = has_flag(port, MURO_PORT_LIST) || (!input && type_of(port) == PortType::text);
  if (is_one && found.size() > 1)
    throw Error("it is " + std::string(input ? "a list" : "a text") + ", which stands for one property, but " +
                std::to_string(found.size()) + " are connected");
  return found;
}

}  // namespace muro::control
