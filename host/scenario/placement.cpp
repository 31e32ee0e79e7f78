// SPDX-License-Identifier: MIT
#include "host/scenario/placement.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/toolkit/random.hpp"

namespace muro::host {

namespace {

constexpr int most_tries = 10'000;  // for one copy, before the area counts as full

Pose pose_of(const Placement::At& at, double standing) {
  return {{at.x, at.y, at.z.value_or(standing)}, from_rpy(at.roll, at.pitch, at.yaw)};
}

bool touches(const Footprint& f, const Obstacle& o, double clearance) {
  const Vec3 p = o.pose.inverse() * Vec3(f.x, f.y, o.pose.position.z());
  const double dx = std::max(0.0, std::abs(p.x()) - o.half_x), dy = std::max(0.0, std::abs(p.y()) - o.half_y);
  return std::hypot(dx, dy) < f.radius + clearance;
}

bool touches(const Footprint& a, const Footprint& b, double clearance) {
  return std::hypot(a.x - b.x, a.y - b.y) < a.radius + b.radius + clearance;
}

const std::vector<Rectangle>& area_of(const Placement& p, const std::map<std::string, std::vector<Rectangle>>& places) {
  const auto area = places.find(p.area);
  if (area != places.end()) return area->second;
  std::vector<std::string> names;
  std::string all;
  for (const auto& [name, unused] : places) {
    names.push_back(name);
    all += (all.empty() ? "" : ", ") + name;
  }
  throw SetupError(p.location.text() + ": no place is named `" + p.area + "`" + did_you_mean(p.area, names) +
                   (all.empty() ? "; the world has no `places`" : "; there are: " + all));
}

std::vector<Pose> place_random(const Placement& p, int count, double standing, double radius,
                               const std::vector<Rectangle>& area, const std::vector<Obstacle>& obstacles,
                               std::vector<Footprint>& taken, const std::string& what) {
  double total = 0;
  for (const Rectangle& r : area) total += r.width * r.depth;
  const double z = p.list.front().z.value_or(standing);
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    bool found = false;
    for (int attempt = 0; attempt < most_tries && !found; ++attempt) {
      const Random random(p.seed.value_or(1), std::uint64_t(i), std::uint64_t(attempt));
      double at = random.uniform(0) * total;
      std::size_t k = 0;
      while (k + 1 < area.size() && at > area[k].width * area[k].depth) at -= area[k].width * area[k].depth, ++k;
      const Rectangle& r = area[k];
      const Footprint f{r.x + (random.uniform(1) - 0.5) * r.width, r.y + (random.uniform(2) - 0.5) * r.depth, radius};
      found =
          std::none_of(taken.begin(), taken.end(), [&](const Footprint& t) { return touches(f, t, p.clearance); }) &&
          std::none_of(obstacles.begin(), obstacles.end(),
                       [&](const Obstacle& o) { return touches(f, o, p.clearance); });
      if (!found) continue;
      const std::size_t choice =
          std::min(std::size_t(random.uniform(3) * double(r.headings.size())), r.headings.size() - 1);
      const double yaw = r.headings.empty() ? 2 * M_PI * random.uniform(3) : r.headings[choice];
      poses.push_back({{f.x, f.y, z}, from_rpy(0, 0, yaw)});
      taken.push_back(f);
    }
    if (!found)
      throw SetupError(p.location.text() + ": only " + std::to_string(i) + " of " + std::to_string(count) +
                       " copies of `" + what + "` fit into `" + p.area +
                       "` without overlap; ask for fewer, a larger place or less `clearance`");
  }
  return poses;
}

}  // namespace

std::vector<Pose> place(const Placement& p, int count, double standing, double radius,
                        const std::map<std::string, std::vector<Rectangle>>& places,
                        const std::vector<Obstacle>& obstacles, std::vector<Footprint>& taken,
                        const std::string& what) {
  if (p.form == Placement::Form::random)
    return place_random(p, count, standing, radius, area_of(p, places), obstacles, taken, what);
  std::vector<Pose> poses;
  if (p.form == Placement::Form::list) {
    for (const Placement::At& at : p.list) poses.push_back(pose_of(at, standing));
  } else {
    const Pose centre = pose_of(p.list.front(), standing);
    for (int row = 0; row < p.rows; ++row)
      for (int column = 0; column < p.columns; ++column)
        poses.push_back(
            centre * Pose{{(column - 0.5 * (p.columns - 1)) * p.spacing_x, (row - 0.5 * (p.rows - 1)) * p.spacing_y, 0},
                          Quat::Identity()});
  }
  if (int(poses.size()) < count)
    throw SetupError(p.location.text() + ": " + std::to_string(count) + " copies of `" + what + "` but only " +
                     std::to_string(poses.size()) + " places for them; lower `count`, or give more places");
  poses.resize(std::size_t(count));
  for (const Pose& pose : poses) taken.push_back({pose.position.x(), pose.position.y(), radius});
  return poses;
}

}  // namespace muro::host
