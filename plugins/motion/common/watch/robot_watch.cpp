// SPDX-License-Identifier: MIT
#include "robot_watch.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "muro/base/number_text.hpp"
#include "parameters.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::watch {
namespace {

/// m: deeper overlaps are named as a likely cause.
constexpr double told_depth = 0.01;
/// m/s^2: larger external forces per mass are named as a likely cause.
constexpr double told_push = 1e4;

constexpr const char* growing_forces =
    "forces that grow from step to step; try a higher rate, or a lower `frequency` of what finds the forces of its "
    "contacts";

std::string newtons(double force) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g N", force);
  return text;
}

std::string millimetres(double depth) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g mm", 1e3 * depth);
  return text;
}

/// Returns the base and the links that are fixed to it.
std::vector<ObjectId> bodies_of_base(const RobotView& robot) {
  std::vector<ObjectId> bodies;
  std::vector<bool> is_fixed;
  for (const Link& link : robot.links) {
    is_fixed.push_back(link.parent < 0 || (link.joint == JointKind::fixed && is_fixed[std::size_t(link.parent)]));
    if (is_fixed.back()) bodies.push_back(link.object);
  }
  return bodies;
}

}  // namespace

void Surroundings::connect(const Connector& c) {
  host = &c.host();
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    if (const ObjectId id{i}; !c.constant_array(id, keys::collision_shapes).empty())
      obstacles.emplace(i, Obstacle{std::string(c.object_name(id)), c.robot_of(id) == no_robot});
}

std::string failure_of_numbers(std::string_view robot, const Pose& pose, const Twist& twist, const Wrench& external,
                               double mass) {
  const double force = external.force.stableNorm();
  const std::string problem = is_somewhere(pose, twist) ? "its joints are" : "the motion of its base is";
  std::string cause = growing_forces;
  if (!std::isfinite(external.force.sum() + external.torque.sum()))
    cause = "the sum of its external wrenches is not; look at what adds to `wrench.external`";
  else if (force > told_push * mass)
    cause = "an external force of " + newtons(force) +
            " acts on it; look at what adds to `wrench.external`: something that pushes, or contacts "
            "that are too stiff for the rate";
  return quote(robot) + ": " + problem + " no longer finite. Likely cause: " + cause;
}

RobotWatch::RobotWatch(Connector& c, const RobotView& robot, std::span<const double* const> velocities)
    : base_(robot.base()), name_(robot.name) {
  const Reach reach = reach_of(c, robot);
  watch_ = Watch(c, c.parameters(), reach);
  if (c.parameters().text(watch.name) != "off") resting_depth_ = RestingDepth(reach.of_link[0]);
  if (c.parameters().text("base") == "fixed") fixed_ = bodies_of_base(robot);
  for (std::size_t i = 1; i < velocities.size(); ++i) {
    if (!velocities[i]) continue;
    const Link& link = robot.links[i];
    const double arm = link.joint == JointKind::prismatic ? 1 : reach.of_link[i];
    joints_.push_back({velocities[i], arm * arm, std::string(c.object_name(link.joint_object))});
  }
}

void RobotWatch::connect_contacts(Connector& c) {
  has_contact_law_ = c.is_used(base_, keys::contact_wrenches_of_law, usage::derived);
  if (c.is_used(base_, keys::contacts, usage::read)) contacts_ = c.read_list(base_, keys::contacts);
}

void RobotWatch::begin(const SumIn<Wrench>* external) {
  begins_ = true;
  resting_depth_.begin();
  if (external && external->size() > (has_contact_law_ ? 1 : 0)) watch_.allow_pushes();
}

RobotWatch::Overlap RobotWatch::deepest_overlap(const Surroundings& surroundings) const {
  Overlap deepest;
  if (!contacts_) return deepest;
  for (const Contact& c : *contacts_) {
    // an overlap that is neither too deep nor named as a cause needs no name
    if (!(c.depth > deepest.depth) || (!begins_ && c.depth <= told_depth && watch_.allows_depth(c.depth))) continue;
    const auto obstacle = surroundings.obstacles.find(index_of(c.other));
    if (obstacle != surroundings.obstacles.end() && obstacle->second.is_scenery)
      deepest = {c.depth, &obstacle->second.name};
  }
  return deepest;
}

bool RobotWatch::is_fixed(ObjectId body) const { return std::find(fixed_.begin(), fixed_.end(), body) != fixed_.end(); }

void RobotWatch::look(const Step& step, const Pose& pose, const Twist& twist, Surroundings& surroundings) {
  const std::string failure = problem(pose, twist, surroundings);
  if (!failure.empty()) throw Error(failure);
  tell_depth(step.seconds(), surroundings);
}

void RobotWatch::tell_depth(double time, Surroundings& surroundings) {
  std::atomic<bool>& is_told = surroundings.depth_is_told;
  if (!contacts_ || is_told.load(std::memory_order_relaxed)) return;
  const Contact* deepest = nullptr;
  for (const Contact& c : *contacts_)
    if ((!deepest || c.depth > deepest->depth) && !is_fixed(c.self)) deepest = &c;
  if (!resting_depth_.sees(time, deepest ? deepest->depth : 0) || is_told.exchange(true)) return;
  const auto name_of = [&](ObjectId id) {
    const auto found = surroundings.obstacles.find(index_of(id));
    return found == surroundings.obstacles.end() ? quote(name_) : quote(found->second.name);
  };
  const auto touched = surroundings.obstacles.find(index_of(deepest->other));
  const bool is_scenery = touched == surroundings.obstacles.end() || touched->second.is_scenery;
  surroundings.host->log(
      LogLevel::warning,
      name_of(deepest->self) + " stands " + millimetres(deepest->depth) + " deep in " + name_of(deepest->other) +
          ": contacts are too soft for what they bear at this rate; try a higher rate or a "
          "higher `frequency` of contacts, or another motion" +
          (is_scenery ? "" : "; what no force moves squeezes whatever its commands say") + " (told once)");
}

std::string RobotWatch::problem(const Pose& pose, const Twist& twist, const Surroundings& surroundings) {
  const Overlap overlap = deepest_overlap(surroundings);
  if (begins_) {
    watch_.begin(pose.position, twist);
    watch_.begin_overlap(overlap.depth);
    begins_ = false;
  }
  std::string problem, parameter = "watch_speed";
  if (!watch_.allows_depth(overlap.depth)) {
    problem = watch_.depth_text("it", quote(*overlap.obstacle), overlap.depth);
    parameter = "watch_depth";
  } else if (!watch_.allows(pose.position, twist)) {
    problem = watch_.speed_text(pose.position, twist);
  }
  const double square = watch_.allowed_square(pose.position);
  for (const Joint& j : joints_) {
    if (!problem.empty() || *j.velocity * *j.velocity * j.reach_square < square) continue;
    problem = watch_.speed_text(pose.position, "what " + quote(j.name) + " carries moves",
                                std::sqrt(*j.velocity * *j.velocity * j.reach_square));
  }
  if (problem.empty()) return problem;
  std::string cause;
  if (!watch_.allows_depth(overlap.depth)) {
    cause = cause_of_depth;
    cause += "; try a higher rate, or an engine";
  } else if (overlap.obstacle && overlap.depth > told_depth) {
    cause = "it is " + number_text(overlap.depth) + " m deep in " + quote(*overlap.obstacle);
    cause += ": start it clear of that, or move it less in a step";
  } else {
    cause = growing_forces;
  }
  return quote(name_) + ": " + problem + ". Likely cause: " + cause + how_to_go_on(parameter);
}

}  // namespace muro::watch
