// SPDX-License-Identifier: MIT
#include "axes.hpp"

#include <algorithm>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/base/limits.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/glob.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::joints {

namespace {

constexpr double greatest_acceleration = 1e9, greatest_effort = 1e12;

/// Units of a joint: "rad", "rad/s", "rad/s^2", "N*m".
struct JointUnits {
  explicit JointUnits(JointKind kind) : turns(kind == JointKind::revolute) {}
  bool turns;
  std::string_view of(Quantity q) const {
    switch (q) {
      case Quantity::position:
        return turns ? "rad" : "m";
      case Quantity::velocity:
        return turns ? "rad/s" : "m/s";
      case Quantity::acceleration:
        return turns ? "rad/s^2" : "m/s^2";
      default:
        return turns ? "N*m" : "N";
    }
  }
};

}  // namespace

std::string Axes::local_name(const Link& link) const {
  return std::string(connector_.object_name(link.joint_object).substr(robot_.name.size() + 1));
}

bool Axes::has(ObjectId object, std::string_view property) const {
  const auto all = connector_.properties(object);
  return std::any_of(all.begin(), all.end(), [&](const FoundProperty& p) { return p.key->name == property; });
}

bool Axes::is_wanted(ObjectId object, const KeyInfo& key) const {
  return connector_.is_used(object, key, usage::input) || connector_.is_used(object, key, usage::read);
}

bool Axes::is_written(ObjectId object, const KeyInfo& key) const {
  constexpr Usage writing[] = {usage::write, usage::optional_output, usage::variable, usage::derived};
  return std::any_of(std::begin(writing), std::end(writing),
                     [&](Usage u) { return connector_.is_used(object, key, u); });
}

Axes::Axes(Connector& connector, const RobotView& robot, AxisState* states)
    : connector_(connector),
      robot_(robot),
      states_(states),
      commands_base_(is_wanted(robot.base(), keys::command_twist) && !is_written(robot.base(), keys::command_twist)),
      by_place_(count_states(robot)) {}

std::vector<Axis*> Axes::find(const std::string& member) {
  return member.starts_with(base_member) ? find_base(member) : find_joints(member);
}

std::vector<Axis*> Axes::find_base(const std::string& member) {
  const std::string robot = quote(robot_.name);
  if (!is_wanted(robot_.base(), keys::command_twist))
    throw Error(quote(member) + ": nothing of robot " + robot +
                " takes command.twist; use motion.point, or add a drive, such as drive.skid_steer");
  if (!commands_base_)
    throw Error(quote(member) + ": another algorithm writes command.twist of robot " + robot +
                " already; one of them can");
  if (member == base_member) return {base_component(0), base_component(1), base_component(5)};
  std::vector<std::string> known{std::string(base_member)};
  for (std::uint32_t i = 0; i < std::size(detail::twist_labels); ++i) {
    known.push_back(std::string(base_member) + "." + std::string(detail::twist_labels[i]));
    if (member == known.back()) return {base_component(i)};
  }
  throw Error(quote(member) + " is no command" + did_you_mean(member, known) + "; there are " + quoted_list(known));
}

std::vector<Axis*> Axes::find_joints(const std::string& member) {
  std::vector<Axis*> found;
  std::vector<std::string> known;
  for (std::uint32_t i = 0; i < robot_.links.size(); ++i) {
    const Link& link = robot_.links[i];
    if (link.joint == JointKind::fixed) continue;
    known.push_back(local_name(link));
    if (!matches(member, known.back())) continue;
    found.push_back(joint(i));
    if (found.back()->is_idle())
      throw Error("joint " + quote(known.back()) + " of robot " + quote(robot_.name) +
                  " is neither read nor set: its motion does not simulate joints; use another one, such as "
                  "motion.simplified");
  }
  if (!found.empty()) return found;
  known.emplace_back(base_member);
  throw Error("robot " + quote(robot_.name) + " has no joint " + quote(member) + did_you_mean(member, known) +
              "; a group may have " + quoted_list(known));
}

std::vector<Axis*> Axes::all_joints() {
  std::vector<Axis*> found;
  for (std::uint32_t i = 0; i < robot_.links.size(); ++i) {
    const Link& link = robot_.links[i];
    if (link.joint == JointKind::fixed || link.mimic >= 0) continue;
    if (Axis* const axis = joint(i); !axis->is_idle()) found.push_back(axis);
  }
  return found;
}

Axis* Axes::joint(std::uint32_t link) {
  if (by_place_[link]) return by_place_[link];
  all_.push_back(std::make_unique<Axis>(local_name(robot_.links[link]), states_[link]));
  connect_joint(*all_.back(), robot_.links[link]);
  return by_place_[link] = all_.back().get();
}

void Axes::connect_joint(Axis& axis, const Link& link) {
  const ObjectId object = link.joint_object;
  const JointUnits units(link.joint);
  const auto connect_reading = [&](Quantity q, const Key<double>& key) {
    if (has(object, key.name)) axis.set_reading(q, connector_.read(object, key).get(), units.of(q));
  };
  connect_reading(Quantity::position, keys::joint_position);
  connect_reading(Quantity::velocity, keys::joint_velocity);
  connect_reading(Quantity::effort, keys::joint_effort);
  const auto connect_target = [&](Quantity q, const Key<double>& key, double lower, double upper) {
    if (!is_wanted(object, key) || is_written(object, key)) return;
    axis.set_target(q, {connector_.write(object, key).get(), lower, upper, units.of(q)});
  };
  const JointLimits l = limits::effective(link.limits);
  const double speed = std::min(l.velocity, limits::speed), effort = std::min(l.effort, greatest_effort);
  connect_target(Quantity::position, keys::joint_position_target, std::max(l.lower, -limits::joint_position),
                 std::min(l.upper, limits::joint_position));
  // A motion that takes both targets follows the position, once it is written; motions of several levels may differ.
  const bool one_motion = connector_.constant_array(robot_.base(), keys::motion_level_names).empty();
  if (!one_motion || !is_wanted(object, keys::joint_position_target))
    connect_target(Quantity::velocity, keys::joint_velocity_target, -speed, speed);
  connect_target(Quantity::acceleration, keys::joint_acceleration_target, -greatest_acceleration,
                 greatest_acceleration);
  connect_target(Quantity::effort, keys::joint_effort_target, -effort, effort);
}

Axis* Axes::base_component(std::uint32_t component) {
  Axis*& axis = by_place_[robot_.links.size() + component];
  if (axis) return axis;
  all_.push_back(
      std::make_unique<Axis>(std::string(detail::twist_labels[component]), states_[robot_.links.size() + component]));
  axis = all_.back().get();
  const std::string_view unit = component < 3 ? "m/s" : "rad/s";
  const double limit = component < 3 ? limits::speed : limits::turn_rate;
  Twist* const command = connector_.write(robot_.base(), keys::command_twist).get();
  axis->set_target(Quantity::velocity, {reinterpret_cast<double*>(command) + component, -limit, limit, unit});
  axis->set_base_velocity(connector_.read(robot_.base(), keys::pose).get(),
                          connector_.read(robot_.base(), keys::twist).get(), component, unit);
  return axis;
}

}  // namespace muro::joints
