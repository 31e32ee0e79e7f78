// SPDX-License-Identifier: MIT
#include "host/scenario/subsystem_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/scenario/levels.hpp"
#include "host/scenario/map_reader.hpp"

namespace muro::host {

namespace {

void read_rate(MapReader& map, Subsystem& out) {
  const Node* rate = map.find("rate");
  if (!rate) return;
  out.on_demand = rate->kind == Node::Kind::scalar && rate->scalar == "on_demand";
  const auto hertz = as_number(*rate);
  if (hertz && *hertz >= 1e-6 && *hertz <= 1e9)
    out.rate = *hertz;
  else if (!out.on_demand)
    map.problem("rate",
                fmt::format("is {} but must be a number from 1e-06 to 1e+09 in Hz, or on_demand", quoted(*rate)));
}

/// Whether an inner value is empty, which another message reports already.
bool has_empty_value(const Node& value) {
  const auto is_null = [](const auto& entry) { return entry.second.kind == Node::Kind::null; };
  return std::any_of(value.map.begin(), value.map.end(), is_null);
}

/// Returns why a list or a map is no parameter: the first inner value that is not a single value.
std::string what_nests(const Node& value) {
  for (const auto& [key, inner] : value.map)
    if (inner.kind != Node::Kind::scalar) return fmt::format("; its `{}` is {}", key, quoted(inner));
  for (const Node& inner : value.list)
    if (inner.kind != Node::Kind::scalar) return fmt::format("; it contains {}", quoted(inner));
  return fmt::format(", not {}", quoted(value));
}

/// Reads all remaining keys as parameters. Those under the name of an algorithm hold only for that algorithm.
void read_parameters(MapReader& map, Subsystem& out, Problems& problems) {
  const auto add = [&](const std::string& key, const Node& value) {
    if (value.location.file != out.location.file) out.parameter_places[key] = value.location.text();
    if (const auto parameter = as_parameter(value))
      out.parameters[key] = *parameter;
    else if (!has_empty_value(value))
      problems.add(value.location,
                   fmt::format("parameter `{}` of {} must be a single value, a flat list or a flat map{}", key,
                               map.what(), what_nests(value)));
  };
  for (const auto& [key, value] : map.unread()) {
    if (key.find('.') == std::string::npos) {
      add(key, *value);
      continue;
    }
    const Node& parameters = map.map(key);
    out.alternatives.push_back({key, map.key_location(key)});
    if (key == out.use)
      for (const auto& [name, parameter] : parameters.map) add(name, parameter);
  }
}

}  // namespace

bool is_subsystem(const Node& node) {
  return node.kind == Node::Kind::map && (node.find("use") != nullptr || node.find("levels") != nullptr);
}

Subsystem read_subsystem(const std::string& name, const Node& node, const std::string& owner, Problems& problems) {
  MapReader map(node, fmt::format("`{}` of {}", name, owner), problems);
  Subsystem out;
  out.name = name;
  out.location = node.location;
  out.use = map.text("use", "");
  read_rate(map, out);
  if (const Node* shadow = map.find("shadow")) {
    if (is_subsystem(*shadow) && !has_levels(*shadow))
      out.shadow = std::make_shared<Subsystem>(read_subsystem(name, *shadow, "the shadow of " + owner, problems));
    else
      map.problem("shadow", "must be a map {use: NAME, ...} of the motion that moves the shadow");
  }
  if (map.has("phase")) out.phase = map.number("phase", 0, 0, 1e9);
  out.on = map.text("on", "");
  if (const Node* on = node.find("on")) out.on_location = on->location;
  read_parameters(map, out, problems);
  return out;
}

}  // namespace muro::host
