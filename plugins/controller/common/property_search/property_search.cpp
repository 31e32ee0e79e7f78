// SPDX-License-Identifier: MIT
#include "plugins/controller/common/property_search/property_search.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

/// Returns the end of a message about a wrong name: "; there are ...".
std::string known_properties(std::string_view wrong, std::vector<std::string> names, std::string_view verb) {
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return quote(wrong) + did_you_mean(wrong, names) + "; " + std::string(verb) + " " + quoted_list(names) +
         "; `muro describe` lists all";
}

}  // namespace

PropertyReference read_reference(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  if (colon == text.npos) return {"", std::string(text)};
  return {std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
}

RobotObjects::RobotObjects(const Connector& connector) : begins_(connector.robots().size() + 1) {
  const std::uint32_t count = connector.object_count();
  std::vector<RobotId> robots(count);
  for (std::uint32_t o = 0; o < count; ++o)
    if ((robots[o] = connector.robot_of(ObjectId{o})) != no_robot) ++begins_[index_of(robots[o]) + 1];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  objects_.resize(begins_.back());
  std::vector<std::size_t> next = begins_;
  for (std::uint32_t o = 0; o < count; ++o)
    if (robots[o] != no_robot) objects_[next[index_of(robots[o])]++] = ObjectId{o};
}

PropertySearch::PropertySearch(const Connector& connector, const Item& item, const RobotObjects& of_robots)
    : connector_(connector), item_(item) {
  objects_.push_back(item.object);
  const auto add = [&](ObjectId o) {
    if (std::find(objects_.begin(), objects_.end(), o) == objects_.end()) objects_.push_back(o);
  };
  if (item.robot) add(item.robot->base());
  preferred_ = objects_.size();
  if (item.robot)
    for (const ObjectId o : of_robots.of(index_of(item.robot->id))) add(o);
}

std::vector<FoundProperty> PropertySearch::candidates(std::string_view property) const {
  std::vector<FoundProperty> found;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    if (const auto p = property_of(objects_[i], property)) found.push_back(*p);
    if (i < preferred_ && !found.empty()) return found;
  }
  if (found.empty())
    if (const auto p = property_of(world_object, property)) found.push_back(*p);
  return found;
}

std::optional<FoundProperty> PropertySearch::property_of(ObjectId object, std::string_view property) const {
  for (const FoundProperty& p : connector_.properties(object))
    if (p.key->name == property && !p.is_sum) return p;
  return std::nullopt;
}

std::optional<FoundProperty> PropertySearch::measured(const FoundProperty& p) const {
  return property_of(p.object, std::string(p.key->name) + ".measured");
}

std::optional<FoundProperty> PropertySearch::only(std::string_view property, std::string_view parameter,
                                                  std::string_view port) const {
  const std::vector<FoundProperty> found = candidates(property);
  if (found.empty()) return std::nullopt;
  if (found.size() == 1) return found.front();
  std::vector<std::string> names;
  for (const FoundProperty& p : found) names.push_back(local_name(p.object));
  throw Error("several objects of " + owner() + " have a property " + quote(property) + ": " + quoted_list(names) +
              "; choose in " + quote(parameter) + ", e.g. \"" + std::string(port) + "=" + names[0] + ":" +
              std::string(property) + "\" (several, separated by commas, stand side by side)");
}

FoundProperty PropertySearch::find(const PropertyReference& reference, std::string_view parameter,
                                   std::string_view port) const {
  std::vector<std::string> names;
  if (reference.object.empty()) {
    if (const auto p = only(reference.property, parameter, port)) return *p;
    for (const ObjectId o : objects_)
      for (const FoundProperty& p : connector_.properties(o)) names.emplace_back(p.key->name);
    throw Error("no object of " + owner() + " has a property " +
                known_properties(reference.property, names, "its objects have"));
  }
  const ObjectId o = object(reference.object);
  if (o == no_object) {
    for (const ObjectId known : objects_) names.push_back(local_name(known));
    throw Error(owner() + " has no object " + quote(reference.object) + did_you_mean(reference.object, names) +
                "; it has " + quoted_list(names));
  }
  if (const auto p = property_of(o, reference.property)) return *p;
  for (const FoundProperty& p : connector_.properties(o)) names.emplace_back(p.key->name);
  throw Error("object " + quote(connector_.object_name(o)) + " has no property " +
              known_properties(reference.property, names, "it has"));
}

FoundProperty PropertySearch::find_output(const PropertyReference& reference, std::string_view parameter,
                                          std::string_view port) const {
  const ObjectId o = reference.object.empty() ? no_object : object(reference.object);
  if (o != no_object && !property_of(o, reference.property))
    if (const auto velocity = target_velocity(o, reference.property)) return *velocity;
  return find(reference, parameter, port);
}

std::optional<FoundProperty> PropertySearch::target_velocity(ObjectId object, std::string_view property) const {
  if (property != keys::joint_velocity_target.name) return std::nullopt;
  std::optional<FoundProperty> found = property_of(object, keys::joint_position_target.name);
  if (found) found->key = &keys::joint_velocity_target;
  return found;
}

ObjectId PropertySearch::object(std::string_view name) const {
  ObjectId found = no_object;
  if (item_.robot) found = connector_.find_object(std::string(item_.robot->name) + "/" + std::string(name));
  return found != no_object ? found : connector_.find_object(name);
}

std::vector<ObjectId> PropertySearch::own_objects() const {
  std::vector<ObjectId> own;
  std::copy_if(objects_.begin(), objects_.end(), std::back_inserter(own), [this](ObjectId o) { return is_own(o); });
  std::sort(own.begin(), own.end());
  return own;
}

bool PropertySearch::is_own(ObjectId object) const {
  return item_.robot && connector_.robot_of(object) == item_.robot->id;
}

bool PropertySearch::is_shadow(ObjectId object) const {
  const RobotId robot = connector_.robot_of(object);
  return robot != no_robot && connector_.constant(connector_.robots()[index_of(robot)]->base(), keys::shadow_of);
}

JointKind PropertySearch::joint_of(ObjectId object) const {
  object = connector_.constant(object, keys::encoder_joint).value_or(object);
  const RobotId robot = connector_.robot_of(object);
  if (robot == no_robot) return JointKind::fixed;
  for (const Link& link : connector_.robots()[index_of(robot)]->links)
    if (link.joint_object == object) return link.joint;
  return JointKind::fixed;
}

std::string PropertySearch::owner() const { return item_.robot ? "robot " + quote(item_.robot->name) : "the world"; }

std::string PropertySearch::local_name(ObjectId object) const {
  std::string name(connector_.object_name(object));
  if (item_.robot && name.starts_with(std::string(item_.robot->name) + "/"))
    name.erase(0, item_.robot->name.size() + 1);
  return name;
}

std::string PropertySearch::name_of(const FoundProperty& p) const {
  return quote(std::string(connector_.object_name(p.object)) + ":" + std::string(p.key->name));
}

}  // namespace muro
