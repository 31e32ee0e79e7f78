// SPDX-License-Identifier: MIT
#include "host/scenario/shadows.hpp"

#include <algorithm>

#include "core/instance.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Returns a property by its name only: it belongs to the plugin level.shadow.
double value(const Simulation& s, const RobotView& robot, std::string_view key) {
  return s.world().value(robot.base(), Key<double>{key, "", ""}, 0.0);
}

}  // namespace

bool is_shadow(const Simulation& s, const RobotView& robot) {
  return s.world().has(robot.base(), keys::shadow_of.name);
}

std::vector<ShadowResult> shadow_results(const Simulation& s) {
  std::vector<ShadowResult> all;
  for (const RobotView* robot : s.world().robots()) {
    if (!is_shadow(s, *robot)) continue;
    ShadowResult r;
    r.robot = robot->name.substr(0, robot->name.rfind(".shadow"));
    for (const auto& instance : s.instances()) {
      const auto& items = instance->setup().items;
      if (instance->description().kind == Kind::motion &&
          std::any_of(items.begin(), items.end(), [&](const Item& i) { return i.robot == robot; }))
        r.motion = instance->setup().use;
    }
    r.distance = value(s, *robot, "shadow.distance");
    r.angle = value(s, *robot, "shadow.angle");
    r.max_distance = value(s, *robot, "shadow.distance.max");
    r.max_angle = value(s, *robot, "shadow.angle.max");
    all.push_back(std::move(r));
  }
  return all;
}

}  // namespace muro::host
