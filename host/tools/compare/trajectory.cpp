// SPDX-License-Identifier: MIT
#include "host/tools/compare/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "muro/toolkit/link_pose.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Position of the joint of a link (rad or m); its start position when the motion of the robot does not move joints.
double position_of_joint(const World& world, const RobotView& robot, const Link& link) {
  if (const double* const position = world.find_value(link.joint_object, keys::joint_position)) return *position;
  if (link.mimic >= 0)
    return link.mimic_offset +
           link.mimic_multiplier * position_of_joint(world, robot, robot.links[std::size_t(link.mimic)]);
  return world.constant(link.joint_object, keys::initial_joint_position, 0.0);
}

/// `difference`: returns the difference of two values, 0 or more.
template <class T, class Difference>
std::optional<Differences> differences_of(const std::vector<T>& values, const std::vector<T>& reference,
                                          Difference difference) {
  const std::size_t n = std::min(values.size(), reference.size());
  if (n == 0) return std::nullopt;
  Differences d;
  double squares = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double between = difference(values[i], reference[i]);
    squares += between * between;
    d.largest = std::max(d.largest, between);
  }
  d.rms = std::sqrt(squares / double(n));
  return d;
}

}  // namespace

/// Computes link poses from the base and the joints only, which every motion has; no algorithm has to write link poses.
void Trajectory::sample_links(const World& world, const RobotView& robot) {
  std::vector<Pose> poses{world.value(robot.base(), keys::pose)};
  for (const Link& link : robot.links) {
    if (link.parent < 0) continue;
    double position = 0;
    if (link.joint != JointKind::fixed) {
      position = position_of_joint(world, robot, link);
      (link.joint == JointKind::revolute ? revolute_joints_ : prismatic_joints_).push_back(position);
    }
    poses.push_back(poses[std::size_t(link.parent)] * pose_in_parent(link, position));
    links_.push_back(poses.back().position);
  }
}

void Trajectory::sample(const Simulation& simulation) {
  const World& world = simulation.world();
  for (const std::uint32_t r : robots_) {
    const Pose& pose = world.value(world.robots()[r]->base(), keys::pose);
    samples_.push_back({pose.position, yaw_of(pose.orientation)});
    sample_links(world, *world.robots()[r]);
  }
}

double Trajectory::distance() const {
  const std::size_t n = robots_.size();
  double sum = 0;
  for (std::size_t i = n; i < samples_.size(); ++i) sum += (samples_[i].position - samples_[i - n].position).norm();
  return n > 0 ? sum / double(n) : 0;
}

Deviation deviation_of(const Trajectory& trajectory, const Trajectory& reference) {
  using Sample = Trajectory::Sample;
  const auto distance = [](const Vec3& a, const Vec3& b) { return (a - b).norm(); };
  const auto difference = [](double a, double b) { return std::abs(a - b); };
  const auto of_positions =
      differences_of(trajectory.samples_, reference.samples_,
                     [&](const Sample& a, const Sample& b) { return distance(a.position, b.position); });
  const auto of_headings = differences_of(
      trajectory.samples_, reference.samples_,
      [](const Sample& a, const Sample& b) { return std::abs(std::remainder(a.heading - b.heading, 2 * M_PI)); });
  Deviation d;
  if (of_positions) d = {of_positions->rms, of_positions->largest, of_headings->largest, {}, {}, {}};
  d.links = differences_of(trajectory.links_, reference.links_, distance);
  d.revolute_joints = differences_of(trajectory.revolute_joints_, reference.revolute_joints_, difference);
  d.prismatic_joints = differences_of(trajectory.prismatic_joints_, reference.prismatic_joints_, difference);
  return d;
}

}  // namespace muro::host
