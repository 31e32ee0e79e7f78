// SPDX-License-Identifier: MIT
#include "host/scenario/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "host/names.hpp"
#include "host/scenario/subsystem_reader.hpp"

namespace muro::host {

const std::vector<std::string> template_keys = {
    "model", "shape", "mass",     "friction",         "restitution", "color",    "texture",   "count",
    "place", "at",    "velocity", "angular_velocity", "joints",      "dynamics", "materials", "variants"};

namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Reads "3" or "0-4".
std::optional<std::pair<int, int>> parse_range(const std::string& text) {
  const char* end = text.data() + text.size();
  int first = 0;
  auto r = std::from_chars(text.data(), end, first);
  int last = first;
  if (r.ec == std::errc{} && r.ptr != end && *r.ptr == '-') r = std::from_chars(r.ptr + 1, end, last);
  if (r.ec != std::errc{} || r.ptr != end || first < 0 || last < first) return std::nullopt;
  return std::pair(first, last);
}

/// Checks the changes of a variant. `own`: the subsystems of the template.
void check_changes(const Node& changes, const std::string& what, const std::vector<std::string>& own,
                   const TakeUnknown& unknown, Problems& problems) {
  for (std::size_t i = 0; i < changes.map.size(); ++i) {
    const auto& [key, change] = changes.map[i];
    const Location& at = changes.key_locations[i];
    if (key == "materials") continue;
    if (is_among(template_keys, key))
      problems.add(at, fmt::format("{} changes `{}`, which belongs to all robots of the template; variants change "
                                   "subsystems and `materials`",
                                   what, key));
    else if (change.kind == Node::Kind::map && !is_subsystem(change) && !is_among(own, key))
      unknown({key, at,
               fmt::format("{} changes `{}`, but the template has no subsystem of this name{}", what, key,
                           suggestion(key, own, "it has"))});
    else if (change.kind != Node::Kind::map && !change.is_off())
      problems.add(change.location,
                   fmt::format("`{}` of {} is {} but must be a map or `off`", key, what, quoted(change)));
  }
}

}  // namespace

std::vector<Variant> read_variants(const Node& variants, const MapReader& robot, int count,
                                   const std::vector<std::string>& subsystem_names, const TakeUnknown& unknown,
                                   Problems& problems) {
  std::vector<std::string> own;
  for (const auto& [key, value] : robot.unread())
    if (is_subsystem(*value) || value->is_off()) own.push_back(key);
  std::vector<Variant> all;
  for (std::size_t v = 0; v < variants.map.size(); ++v) {
    const auto& [range, changes] = variants.map[v];
    const std::string what = fmt::format("variant `{}` of {}", range, robot.what());
    if (const auto r = parse_range(range); r && r->second < count)
      all.push_back({r->first, r->second, &changes});
    else
      problems.add(variants.key_locations[v],
                   fmt::format("{} must be a number or a range such as 0-4, {}", what,
                               count > 0 ? fmt::format("within 0-{}", count - 1) : "and there is no such robot"));
    if (changes.kind != Node::Kind::map) {
      problems.add(changes.location,
                   fmt::format("{} is {} but must be a map of the subsystems that differ", what, quoted(changes)));
      continue;
    }
    for (UnknownSubsystem& u : unknown_switched_off(changes, subsystem_names, what)) unknown(std::move(u));
    check_changes(changes, what, own, unknown, problems);
  }
  return all;
}

Node merged(const Node& subsystems, const std::vector<Variant>& variants, const std::vector<std::size_t>& indices) {
  Node out = subsystems;
  for (const std::size_t v : indices)
    for (const auto& [key, change] : variants[v].changes->map) {
      if (key == "materials") continue;
      Node& subsystem = out.child(key, change.location);
      merge(subsystem, change);
      subsystem.location = change.location;
    }
  return out;
}

}  // namespace muro::host
