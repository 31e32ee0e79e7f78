// SPDX-License-Identifier: MIT
#include "core/external/placing.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/world.hpp"
#include "muro/base/limits.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

namespace {

/// Returns the place of a property that changes, or null.
template <class T>
T* variable(const World& world, ObjectId object, const Key<T>& key) {
  const Slot* slot = world.store().find(object, key.name);
  const bool changes = slot && slot->kind == Slot::Class::variable && slot->multiplicity == Multiplicity::single;
  return changes ? static_cast<T*>(slot->place) : nullptr;
}

}  // namespace

std::string problem_of(const World& world, const Placement& p) {
  if (index_of(p.object) >= world.object_count()) return fmt::format("there is no object {}", index_of(p.object));
  const std::string name = in_backquotes(world.object_name(p.object));
  if (const RobotId robot = world.robot_of(p.object); robot != no_robot) {
    const RobotView& view = *world.robots()[index_of(robot)];
    if (view.base() != p.object)
      return fmt::format("{} is a part of robot {}; a robot is put by its base, {}", name, in_backquotes(view.name),
                         in_backquotes(world.object_name(view.base())));
  }
  if (!variable(world, p.object, keys::pose))
    return fmt::format("{} does not move: only robots with a motion, and objects that move, can be put somewhere",
                       name);
  if (const std::string problem = limits::problem_of(p.pose); !problem.empty())
    return fmt::format("the pose for {} {}", name, problem);
  if (const std::string problem = limits::problem_of(p.twist); !problem.empty())
    return fmt::format("the velocity for {} {}", name, problem);
  const bool stands = p.twist.linear.isZero(0) && p.twist.angular.isZero(0);
  if (!stands && !variable(world, p.object, keys::twist))
    return fmt::format("{} has no velocity of its own, so it can only be put at rest", name);
  return "";
}

void write_placement(World& world, const Placement& p) {
  Pose& pose = *variable(world, p.object, keys::pose);
  pose = p.pose;
  pose.orientation.normalize();
  if (Twist* twist = variable(world, p.object, keys::twist)) *twist = p.twist;
}

}  // namespace muro
