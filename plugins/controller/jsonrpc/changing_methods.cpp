// SPDX-License-Identifier: MIT
// Methods that change the state of the simulation. They send requests to the host. The host carries out each request
// when the present instant is complete, and records it.
#include "method.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/text/quote.hpp"
#include "values.hpp"

namespace muro::jsonrpc {

namespace {

constexpr std::size_t most_elements = 10'000;  ///< most elements in one request
constexpr std::size_t most_snapshots = 16;
constexpr std::size_t longest_name = 64;  ///< bytes in the name of a snapshot

/// An element of a property and its new bytes.
struct Change {
  PropertyName property;
  std::uint32_t element = 0;
  std::string bytes;
};

void add_changes(const Call& c, const std::string& name, const Json& value, std::vector<Change>& changes) {
  const PropertyName property = c.served.scene.property(name);
  if (!c.served.grants.may_set(property.text))
    throw RpcError{Code::not_granted,
                   quote(property.text) + " may not be set: no pattern of the scenario's `write` grants it"};
  const LiveProperty p = c.served.scene.live(property);
  if (!p.is_variable || !has_values(p))
    throw RpcError{Code::refused, quote(property.text) + " is not part of the state, or not made of numbers"};
  if (c.params.has("unit") && c.params.text("unit") != p.key->unit)
    throw RpcError{Code::invalid_params,
                   quote(property.text) + " is in " + quote(p.key->unit) + ", not in " + quote(c.params.text("unit")),
                   {{"unit", std::string(p.key->unit)}}};
  const auto add = [&](std::uint32_t element, const Json& x) {
    if (changes.size() >= most_elements)
      throw RpcError{Code::too_many, "one request sets at most " + std::to_string(most_elements) + " elements"};
    changes.push_back({property, element, bytes_of_element(p, element, x, quote(property.text))});
  };
  if (c.params.has("element"))
    return add(std::uint32_t(c.params.integer("element", 0, std::int64_t(p.count) - 1)), value);
  if (p.multiplicity == Multiplicity::single) return add(0, value);
  if (!value.is_array() || value.size() != p.count)
    throw RpcError{Code::invalid_params, "a value for " + quote(property.text) + " must be an array of its " +
                                             std::to_string(p.count) + " elements; or give `element`"};
  for (std::uint32_t i = 0; i < p.count; ++i) add(i, value[i]);
}

Quat orientation_of(const Params& p, bool& is_given) {
  is_given = p.has("orientation_wxyz") || p.has("orientation_xyzw");
  if (!is_given) return Quat::Identity();
  const bool is_scalar_first = p.has("orientation_wxyz");
  const std::vector<double> q = p.reals(is_scalar_first ? "orientation_wxyz" : "orientation_xyzw", 4);
  const Quat turn = is_scalar_first ? Quat(q[0], q[1], q[2], q[3]) : Quat(q[3], q[0], q[1], q[2]);
  if (!(turn.norm() > 0.999 && turn.norm() < 1.001))
    throw RpcError{Code::invalid_params, "the orientation must be a quaternion of length 1"};
  return turn.normalized();
}

/// Returns the present pose of the object; the identity when it has no pose.
Pose pose_of(const Call& c, ObjectId object) {
  for (const LiveProperty& p : c.served.scene.inspection().properties(object))
    if (p.key->name == "pose" && p.key->type->name == ValueTraits<Pose>::name && p.data)
      return *static_cast<const Pose*>(p.data);
  return {};
}

/// Reads "position" and an orientation, or x, y, z and yaw. Defaults: the present z, and an upright orientation.
Pose wanted_pose(const Call& c, ObjectId object) {
  constexpr double most = 1e9;
  const Params& p = c.params;
  Pose pose = pose_of(c, object);
  bool has_orientation = false;
  pose.orientation = orientation_of(p, has_orientation);
  const bool has_coordinates = p.has("x") || p.has("y") || p.has("z");
  if (p.has("position") == has_coordinates || (p.has("orientation_wxyz") && p.has("orientation_xyzw")) ||
      (has_orientation && p.has("yaw")))
    throw RpcError{Code::invalid_params,
                   "give either `position` or `x` and `y`, and at most one of `orientation_wxyz`, `orientation_xyzw` "
                   "and `yaw`"};
  if (p.has("position")) {
    const std::vector<double> at = p.reals("position", 3);
    pose.position = {at[0], at[1], at[2]};
  } else {
    pose.position = {p.real("x", -most, most), p.real("y", -most, most),
                     p.has("z") ? p.real("z", -most, most) : pose.position.z()};
  }
  if (p.has("yaw")) pose.orientation = from_rpy(0, 0, p.real("yaw", -1e6, 1e6));
  return pose;
}

std::string name_of_snapshot(const Call& c) {
  std::string name = c.params.text("name");
  if (name.empty() || name.size() > longest_name)
    throw RpcError{Code::invalid_params, "`name` must be a text of 1 to " + std::to_string(longest_name) + " bytes"};
  return name;
}

}  // namespace

void set(Call& c) {
  std::vector<Change> changes;
  if (c.params.has("values")) {
    for (const char* other : {"property", "value", "element", "unit"})
      if (c.params.has(other))
        throw RpcError{Code::invalid_params, "`values` and " + quote(other) + " are both given; give one"};
    const Json& values = c.params.at("values");
    if (!values.is_object() || values.empty())
      throw RpcError{Code::invalid_params, "`values` must be an object {\"object:property\": value, ...}"};
    for (const auto& [name, value] : values.items()) add_changes(c, name, value, changes);
  } else {
    add_changes(c, c.params.text("property"), c.params.at("value"), changes);
  }
  for (const Change& change : changes) {  // reached only when all changes are possible
    const std::uint64_t ticket = c.effect();
    c.served.run.set(change.property.object, change.property.key, change.element, change.bytes, ticket, c.done());
  }
}

void place(Call& c) {
  Placement p;
  p.object = c.served.scene.object(c.params.text("object"));
  p.pose = wanted_pose(c, p.object);
  const auto vector = [&](std::string_view name) {
    const std::vector<double> v = c.params.has(name) ? c.params.reals(name, 3) : std::vector<double>(3);
    return Vec3(v[0], v[1], v[2]);
  };
  p.twist = {vector("linear"), vector("angular")};
  p.is_forced = c.params.flag("force", false);
  const std::uint64_t ticket = c.effect();
  c.served.run.place(p, ticket, c.done());
}

void reset(Call& c) {
  const std::uint64_t ticket = c.effect();
  c.served.run.reset(ticket, c.done());
}

void snapshot(Call& c) {
  const std::string name = name_of_snapshot(c);
  if (!c.served.snapshots.contains(name) && c.served.snapshots.size() >= most_snapshots)
    throw RpcError{Code::too_many, "there are at most " + std::to_string(most_snapshots) +
                                       " snapshots; one of a name that is there is replaced"};
  c.served.snapshots.insert(name);
  const std::uint64_t ticket = c.effect();
  c.served.run.snapshot(name, ticket, c.done());
}

void restore(Call& c) {
  const std::string name = name_of_snapshot(c);
  if (!c.served.snapshots.contains(name)) {
    const std::vector<std::string> known(c.served.snapshots.begin(), c.served.snapshots.end());
    throw RpcError{Code::not_there, "there is no snapshot " + quote(name) + "; there are " + quoted_list(known),
                   nearest_as_data(name, known)};
  }
  const std::uint64_t ticket = c.effect();
  c.served.run.restore(name, ticket, c.done());
}

}  // namespace muro::jsonrpc
