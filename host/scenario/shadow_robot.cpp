// SPDX-License-Identifier: MIT
#include "host/scenario/shadow_robot.hpp"

#include <fmt/format.h>

#include "host/scenario/initial_state.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Makes the commands of the robot those of its shadow too.
void share_commands(World& world, const RobotView& shadow, const RobotView& robot) {
  world.share(shadow.base(), keys::command_twist, robot.base(), keys::command_twist);
  world.share(shadow.base(), keys::command_pose, robot.base(), keys::command_pose);
  for (std::size_t i = 0; i < robot.links.size(); ++i) {
    const ObjectId joint = shadow.links[i].joint_object;
    if (joint == no_object) continue;
    for (const Key<double>& key : {keys::joint_velocity_target, keys::joint_position_target,
                                   keys::joint_acceleration_target, keys::joint_effort_target})
      world.share(joint, key, robot.links[i].joint_object, key);
  }
}

}  // namespace

void add_shadow(Simulation& simulation, Algorithms& algorithms, const ShadowSetup& setup, Problems& problems) {
  World& world = simulation.world();
  const Subsystem& given = *setup.motion;
  const Description* d = algorithms.describe(given);
  if (!d) return;
  if (d->kind != Kind::motion)
    return problems.add(given.location, fmt::format("`{}` is no motion; a motion moves a shadow", given.use));
  const std::string name = std::string(setup.robot->name) + ".shadow";
  const RobotView* shadow = nullptr;
  if (!problems.collect(given.location.text() + ": ",
                        [&] { shadow = &world.add_robot(name, *setup.tree, setup.pose); }))
    return;
  world.set(shadow->base(), keys::shadow_of, setup.robot->base());
  set_initial_state(world, *setup.robot_template, *shadow, *setup.start);
  share_commands(world, *shadow, *setup.robot);
  Subsystem motion = given;
  if ((d->capabilities & Capability::world) != 0)
    motion.parameters["world"] = "the shadow of " + std::string(setup.robot->name);
  algorithms.add(motion, name + ".motion", {{shadow, shadow->base()}});
  Subsystem measure;
  measure.name = "shadow";
  measure.use = "level.shadow";
  measure.location = given.location;
  measure.rate = 100;
  algorithms.add(measure, "shadows", {{shadow, shadow->base()}});
}

}  // namespace muro::host
