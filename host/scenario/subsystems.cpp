// SPDX-License-Identifier: MIT
#include "host/scenario/subsystems.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/names.hpp"
#include "host/scenario/initial_state.hpp"
#include "muro/base/did_you_mean.hpp"

namespace muro::host {

namespace {

bool serves_scene(Kind kind) {
  return kind == Kind::scene || kind == Kind::collision || kind == Kind::contact || kind == Kind::recorder ||
         kind == Kind::view;
}

}  // namespace

bool Subsystems::add(const RobotTemplate& t, const RobotView& robot, const std::vector<Subsystem>& subsystems) {
  bool moved = false;
  const Subsystem* motion = nullptr;
  for (const bool sensors : {true, false})
    for (const Subsystem& s : subsystems) {
      const Description* d = algorithms_.describe(s);
      if (!d) {
        moved = true;
      } else if ((d->kind == Kind::sensor) == sensors) {
        if (d->kind == Kind::motion && !is_only_motion(t, s, motion)) continue;
        moved = add_one(t, robot, s, *d, subsystems) || moved;
      }
    }
  return moved;
}

/// Whether a robot has only one motion, or levels of one. Another one is often a misspelt name. `first`: the first.
bool Subsystems::is_only_motion(const RobotTemplate& t, const Subsystem& s, const Subsystem*& first) {
  if (!first || (first->level && s.level)) {
    first = &s;
    return true;
  }
  problems_.add(
      s.location,
      fmt::format("robot `{}` has a second motion, `{}`{}; `{}` ({}) moves it already: remove one of them, or "
                  "write them as `levels` of one motion",
                  t.name, s.name, did_you_mean(s.name, std::vector{first->name}), first->name, first->location.text()));
  return false;
}

bool Subsystems::add_one(const RobotTemplate& t, const RobotView& robot, const Subsystem& given, const Description& d,
                         const std::vector<Subsystem>& all) {
  Subsystem s = given;
  Item item{&robot, robot.base()};
  if (serves_scene(d.kind)) {
    problems_.add(s.location, fmt::format("`{}` serves the whole scene; name it under `algorithms`, not in robot `{}`",
                                          s.use, t.name));
    return false;
  }
  if (d.kind == Kind::sensor)
    item.object = add_sensor(t, robot, s);
  else if (d.kind == Kind::sensor_error)
    item.object = sensor_of_error(t, robot, s, all);
  else if (!s.on.empty())
    item.object = mounting_object(robot, s);
  if (item.object == no_object) return false;
  if (s.level) {
    if (d.kind != Kind::motion) {
      problems_.add(s.location, fmt::format("`{}` is no motion; only motions have levels", s.use));
      return false;
    }
    item.level = s.level->index;
    if (s.level->index == 0) simulation_.set_levels(robot, s.level->names, s.level->start);
  }
  const bool batched = (d.capabilities & Capability::batched) != 0;
  const std::string owner = batched ? t.name : std::string(robot.name);
  algorithms_.add(s, owner + "." + s.name, {item}, t.name + "." + s.name);
  return d.kind == Kind::motion;
}

/// Returns the object "robot/NAME" for `on: NAME`. When there is none, returns the base and adds a problem.
ObjectId Subsystems::mounting_object(const RobotView& robot, const Subsystem& s) {
  const ObjectId object = world_.find_object(fmt::format("{}/{}", robot.name, s.on));
  if (object != no_object) return object;
  std::vector<std::string> names;
  for (const ObjectId part : world_.objects_of(robot)) names.push_back(name_within(world_, robot, part));
  problems_.add(s.on_location, fmt::format("`on: {}` of `{}`: the robot has no part of this name{}", s.on, s.name,
                                           suggestion(s.on, names, "it has")));
  return robot.base();
}

ObjectId Subsystems::add_sensor(const RobotTemplate& t, const RobotView& robot, const Subsystem& s) {
  const ObjectId link = s.on.empty() ? robot.base() : mounting_object(robot, s);
  if (world_.find_object(fmt::format("{}/{}", robot.name, s.name)) == no_object)
    return simulation_.add_sensor_object(robot, s.name, link);
  problems_.add(s.location,
                fmt::format("sensor `{}` has the name of a part of robot `{}`; give it another", s.name, t.name));
  return no_object;
}

/// Returns the object of the sensor with this error. An error without rate and phase gets those of the sensor.
ObjectId Subsystems::sensor_of_error(const RobotTemplate& t, const RobotView& robot, Subsystem& s,
                                     const std::vector<Subsystem>& all) {
  const auto sensor = std::find_if(all.begin(), all.end(), [&](const Subsystem& o) { return o.name == s.on; });
  if (sensor == all.end() || !algorithms_.is_kind(*sensor, Kind::sensor)) {
    std::vector<std::string> sensors;
    for (const Subsystem& o : all)
      if (algorithms_.is_kind(o, Kind::sensor)) sensors.push_back(o.name);
    problems_.add(
        s.on.empty() ? s.location : s.on_location,
        fmt::format("`{}` needs `on:` with the name of the sensor whose readings it changes{}", s.name,
                    sensors.empty() ? fmt::format("; robot `{}` has no sensor", t.name) : suggestion(s.on, sensors)));
    return no_object;
  }
  if (!s.rate && !s.on_demand) s.rate = sensor->rate, s.on_demand = sensor->on_demand;
  if (!s.phase) s.phase = sensor->phase;
  return mounting_object(robot, s);
}

}  // namespace muro::host
