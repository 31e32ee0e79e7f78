// SPDX-License-Identifier: MIT
#include "host/scenario/placement_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "muro/base/limits.hpp"

namespace muro::host {

namespace {

constexpr int max_side = 10'000, max_cells = 1'000'000;  // of a grid

PoseInput read_pose(const Node& node, const std::string& what, Problems& problems) {
  MapReader map(node, what, problems);
  PoseInput pose;
  const auto metres = [&](const char* key) { return map.number(key, 0, -limits::position, limits::position); };
  const auto radians = [&](const char* key) { return map.number(key, 0, -limits::angle, limits::angle); };
  pose.x = metres("x");
  pose.y = metres("y");
  if (map.has("z")) pose.z = metres("z");
  pose.roll = radians("roll");
  pose.pitch = radians("pitch");
  pose.yaw = radians("yaw");
  map.reject_unknown_keys();
  return pose;
}

/// Reads the value of `place:`.
Placement read_place(const Node& node, const std::string& what, Problems& problems) {
  Placement p;
  MapReader map(node, "`place` of " + what, problems);
  const std::optional<std::string> kind = map.one_of({"list", "grid", "random"});
  if (kind == "list") {
    const Node& list = map.list("list");
    if (list.list.empty()) map.problem("list", "is empty but must be a list of {x, y, yaw, ...}, one a copy");
    for (const Node& e : list.list) p.poses.push_back(read_pose(e, "an entry of `list` of " + what, problems));
  } else if (kind == "grid") {
    p = read_grid(*map.find("grid"), "`grid` of " + what, problems);
  } else if (kind == "random") {
    p.kind = Placement::Kind::random;
    p.area = map.text("random", "");
    if (map.has("seed")) p.seed = std::uint64_t(map.integer("seed", 1, 0, std::int64_t(1) << 53));
    p.clearance = map.number("clearance", 0.1, 0, 1e6);
  }
  if (p.poses.empty()) p.poses.emplace_back();
  if (kind) map.reject_unknown_keys();
  return p;
}

}  // namespace

Placement read_grid(const Node& node, const std::string& what, Problems& problems) {
  MapReader map(node, what, problems);
  Placement p;
  p.kind = Placement::Kind::grid;
  if (!map.has("count")) problems.add(node.location, what + " needs `count: [along x, along y]`");
  if (const auto counts = map.numbers("count", {2})) {
    const bool valid = std::all_of(counts->begin(), counts->end(),
                                   [](double c) { return c == std::floor(c) && c >= 1 && c <= max_side; });
    if (!valid || (*counts)[0] * (*counts)[1] > max_cells) {
      map.problem("count",
                  fmt::format("must be two whole numbers, along x and along y, from 1 to {} each and of at most "
                              "{} places in all",
                              max_side, max_cells));
    } else {
      p.columns = int((*counts)[0]);
      p.rows = int((*counts)[1]);
    }
  }
  if (const auto spacing = map.numbers("spacing", {2}, -limits::position, limits::position)) {
    p.spacing_x = (*spacing)[0];
    p.spacing_y = (*spacing)[1];
  }
  const Node* centre = map.find("center");
  p.poses.push_back(centre ? read_pose(*centre, "`center` of " + what, problems) : PoseInput{});
  map.reject_unknown_keys();
  return p;
}

Placement read_placement(MapReader& map, Problems& problems) {
  const Node* at = map.find("at");
  const Node* place = map.find("place");
  if (at && place) map.problem("place", "and `at` exclude each other: one says where, so drop the other");
  Placement p;
  if (place && !at) {
    p = read_place(*place, map.what(), problems);
    p.location = place->location;
    return p;
  }
  p.poses.push_back(at ? read_pose(*at, "`at` of " + map.what(), problems) : PoseInput{});
  p.location = at ? at->location : map.location();
  return p;
}

}  // namespace muro::host
