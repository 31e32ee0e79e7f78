// SPDX-License-Identifier: MIT
#include "host/scenario/placement.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "host/names.hpp"
#include "muro/base/random.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::host {

namespace {

constexpr int max_attempts = 10'000;  // for one copy, before the area counts as full

Pose pose_of(const PoseInput& given) {
  return {{given.x, given.y, given.z.value_or(0)}, from_rpy(given.roll, given.pitch, given.yaw)};
}

void stand(Pose& pose, const Body& body) {
  if (body.height_at) pose.position.z() = body.height_at(pose);
}

Pose pose_of(const PoseInput& given, const Body& body) {
  Pose pose = pose_of(given);
  if (!given.z) stand(pose, body);
  return pose;
}

const std::vector<Rectangle>& area_of(const Placement& p, const std::map<std::string, std::vector<Rectangle>>& places) {
  const auto area = places.find(p.area);
  if (area != places.end()) return area->second;
  std::vector<std::string> names;
  for (const auto& [name, unused] : places) names.push_back(name);
  throw SetupError(fmt::format("{}: no place is named `{}`{}", p.location.text(), p.area,
                               names.empty() ? "; the world has no `places`" : suggestion(p.area, names)));
}

/// Draws poses that are uniformly distributed over an area.
class PoseSampler {
 public:
  PoseSampler(const Placement& placement, const std::vector<Rectangle>& area, double radius)
      : placement_(placement), area_(area), radius_(radius) {
    for (const Rectangle& r : area) ends_.push_back((ends_.empty() ? 0 : ends_.back()) + r.width * r.depth);
  }
  struct Sample {
    Footprint footprint;
    double yaw;
  };
  Sample draw(int copy, int attempt) const {
    const std::uint64_t seed = placement_.seed.value_or(1);
    // Random uses the exclusive or of seed and key; with the bare number, small seeds would only exchange the copies
    const Random random(seed, hash_bytes(&copy, sizeof copy, seed), std::uint64_t(attempt));
    const auto end = std::lower_bound(ends_.begin(), std::prev(ends_.end()), random.uniform(0) * ends_.back());
    const Rectangle& r = area_[std::size_t(end - ends_.begin())];
    const Footprint f{r.x + (random.uniform(1) - 0.5) * r.width, r.y + (random.uniform(2) - 0.5) * r.depth, radius_};
    if (r.headings.empty()) return {f, 2 * M_PI * random.uniform(3)};
    const auto choice = std::size_t(random.uniform(3) * double(r.headings.size()));
    return {f, r.headings[std::min(choice, r.headings.size() - 1)]};
  }

 private:
  const Placement& placement_;
  const std::vector<Rectangle>& area_;
  double radius_;
  std::vector<double> ends_;  ///< m^2, sum of the areas of a rectangle and of those before it
};

std::vector<Pose> place_random(const Placement& p, int count, const Body& body, const std::vector<Rectangle>& area,
                               Occupancy& occupied) {
  const PoseSampler sampler(p, area, body.radius);
  const std::optional<double> z = p.poses.front().z;
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    int attempt = 0;
    const int copy = p.first_copy + i;
    PoseSampler::Sample sample = sampler.draw(copy, attempt);
    while (!occupied.is_free(sample.footprint, p.clearance)) {
      if (++attempt == max_attempts)
        throw SetupError(
            fmt::format("{}: only {} of {} copies of `{}` fit into `{}` without overlap; ask for fewer, a "
                        "larger place or less `clearance`",
                        p.location.text(), i, count, body.name, p.area));
      sample = sampler.draw(copy, attempt);
    }
    poses.push_back(pose_of({.x = sample.footprint.x, .y = sample.footprint.y, .z = z, .yaw = sample.yaw}, body));
    occupied.add(sample.footprint);
  }
  return poses;
}

std::vector<Pose> grid_poses(const Placement& p, const Body& body) {
  const Pose centre = pose_of(p.poses.front());
  std::vector<Pose> poses;
  for (int row = 0; row < p.rows; ++row)
    for (int column = 0; column < p.columns; ++column) {
      poses.push_back(
          centre * Pose{{(column - 0.5 * (p.columns - 1)) * p.spacing_x, (row - 0.5 * (p.rows - 1)) * p.spacing_y, 0},
                        Quat::Identity()});
      if (!p.poses.front().z) stand(poses.back(), body);
    }
  return poses;
}

}  // namespace

std::vector<Pose> place(const Placement& p, int count, const Body& body,
                        const std::map<std::string, std::vector<Rectangle>>& places, Occupancy& occupied) {
  if (p.kind == Placement::Kind::random) return place_random(p, count, body, area_of(p, places), occupied);
  std::vector<Pose> poses;
  if (p.kind == Placement::Kind::grid)
    poses = grid_poses(p, body);
  else
    for (const PoseInput& pose : p.poses) poses.push_back(pose_of(pose, body));
  if (int(poses.size()) < count)
    throw SetupError(
        fmt::format("{}: {} copies of `{}` but only {} place{} for them; lower `count`, or give more places",
                    p.location.text(), count, body.name, poses.size(), poses.size() == 1 ? "" : "s"));
  poses.resize(std::size_t(count));
  for (const Pose& pose : poses) occupied.add(Footprint{pose.position.x(), pose.position.y(), body.radius});
  return poses;
}

}  // namespace muro::host
