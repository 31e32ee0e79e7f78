// SPDX-License-Identifier: MIT
#include "host/shadows.hpp"

#include <algorithm>

#include "core/instance.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// A property by its name alone: it belongs to the plugin level.shadow.
double value(const Simulation& s, const RobotView& robot, std::string_view key) {
  const Slot* slot = s.world().store().find(robot.base(), key);
  return slot && slot->place ? *static_cast<const double*>(slot->place) : 0;
}

}  // namespace

bool is_shadow(const Simulation& s, const RobotView& robot) {
  return s.world().store().find(robot.base(), keys::shadow_of.name) != nullptr;
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
