// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "muro/toolkit/link_pose.hpp"

namespace muro::articulated {

namespace {

struct SignedAxis {
  int axis = 2;
  double sign = 1;
};

/// Returns the axis of the frame that is equal to a unit vector, to rounding.
std::optional<SignedAxis> frame_axis(const Vec3& v) {
  constexpr double rounding = 1e-12;
  for (int k = 0; k < 3; ++k)
    if (std::abs(std::abs(v[k]) - 1) < rounding &&
        std::sqrt(v[(k + 1) % 3] * v[(k + 1) % 3] + v[(k + 2) % 3] * v[(k + 2) % 3]) < rounding)
      return SignedAxis{k, v[k] < 0 ? -1.0 : 1.0};
  return std::nullopt;
}

void set_turn(Body& body, const Mat3& turn) {
  body.turned = !turn.isIdentity(0);
  for (int k = 0; k < 9; ++k) body.turn[k] = turn(k % 3, k / 3);
}

/// Rotations of the kernel's frames in those of bodies: each turns a vector of the kernel's frame into the body's
/// frame.
using Frames = std::vector<Quat>;

/// Sets the axis of a body. `in_parent`: the body's frame in the kernel's frame of its parent. Returns the rotation of
/// the kernel's frame in the body's frame.
Quat set_axis(Body& body, const multibody::RigidBody& rigid, const Pose& in_parent) {
  for (int k = 0; k < 3; ++k) body.offset[k] = in_parent.position[k];
  body.shifted = !in_parent.position.isZero(0);
  body.slides = rigid.joint == JointKind::prismatic;
  SignedAxis axis;
  Quat to_body = Quat::Identity();
  if (const auto of_parent = frame_axis(in_parent.orientation * rigid.axis)) {
    axis = *of_parent;
    to_body = in_parent.orientation.conjugate();
  } else if (const auto own = frame_axis(rigid.axis)) {
    axis = *own;
    set_turn(body, in_parent.orientation.toRotationMatrix());
  } else {
    to_body = Quat::FromTwoVectors(Vec3::UnitZ(), rigid.axis);
    set_turn(body, (in_parent.orientation * to_body).toRotationMatrix());
  }
  body.axis = axis.axis;
  body.sign = axis.sign;
  return to_body;
}

/// Finds the kernel's frames, and sets `bodies` if it is not null.
Frames find_frames(const multibody::RobotModel& robot, std::vector<Body>* bodies) {
  Frames frames(robot.bodies.size(), Quat::Identity());
  for (std::size_t i = 1; i < robot.bodies.size(); ++i) {
    const multibody::RigidBody& rigid = robot.bodies[i];
    Body body;
    body.parent = rigid.parent;
    const Pose from_parent{Vec3::Zero(), frames[std::size_t(rigid.parent)].conjugate()};
    frames[i] = set_axis(body, rigid, from_parent * rigid.origin);
    if (bodies) (*bodies)[i] = body;
  }
  return frames;
}

/// Assigns slots to bodies: few slots, which are used again.
int assign_slots(std::vector<Body>& bodies) {
  std::vector<int> unused;
  std::vector<bool> has_child(bodies.size());
  int slots = 0;
  for (std::size_t i = bodies.size(); i-- > 0;) {
    Body& b = bodies[i];
    if (b.slot >= 0) unused.push_back(b.slot);  // its inertia has been read
    if (b.parent < 0) continue;
    const auto p = std::size_t(b.parent);
    b.first = !has_child[p];
    has_child[p] = true;
    if (b.first) {
      if (unused.empty()) unused.push_back(slots++);
      bodies[p].slot = unused.back();
      unused.pop_back();
    }
    b.parent_slot = bodies[p].slot;
  }
  std::vector<int> children(bodies.size());
  for (std::size_t i = 1; i < bodies.size(); ++i) ++children[std::size_t(bodies[i].parent)];
  for (std::size_t i = 1; i < bodies.size(); ++i)
    bodies[i].kept = children[i] > 0 && children[std::size_t(bodies[i].parent)] > 1;
  return slots;
}

Joint joint_of(const multibody::RigidBody& body) {
  const JointLimits& limits = body.limits;
  Joint j;
  j.lower = limits.lower, j.upper = limits.upper, j.speed = limits.velocity, j.effort = limits.effort;
  j.damping = limits.damping, j.friction = limits.friction, j.armature = limits.armature;
  j.leader = body.leader, j.multiplier = body.multiplier, j.offset = body.offset;
  return j;
}

/// Hands the friction of mimic joints on to their leaders. The mimic joint itself has no friction and no stops.
void hand_on_friction(std::vector<Joint>& joints) {
  for (Joint& j : joints) {
    if (j.leader < 0) continue;
    joints[std::size_t(j.leader)].friction += std::abs(j.multiplier) * j.friction;
    j.friction = 0;
    j.lower = -Joint::infinite, j.upper = Joint::infinite;
  }
}

}  // namespace

Structure Model::structure() const {
  const auto any = [this](auto test) { return std::any_of(joints.begin() + 1, joints.end(), test); };
  return {.bodies = bodies.data(),
          .joints = joints.data(),
          .count = int(bodies.size()),
          .slots = slots,
          .fixed = fixed,
          .has_mimics = !mimics.groups.empty(),
          .needs_inertia = any([](const Joint& j) { return j.needs_inertia(); }),
          .mimic_groups = mimics.groups.data(),
          .mimic_group_count = int(mimics.groups.size()),
          .mimic_ways = mimics.ways.data(),
          .mimic_bodies = mimics.bodies.data(),
          .mimic_places = mimics.places.data(),
          .mimic_numbers = mimics.numbers,
          .lie_side_by_side = !any([this](const Joint& j) {
            const std::ptrdiff_t place = &j - joints.data() - 1;
            return j.position != place || j.velocity != place || j.out_effort != place;
          })};
}

Model model_of_bodies(const multibody::RobotModel& robot) {
  Model model;
  model.bodies.resize(robot.bodies.size());
  find_frames(robot, &model.bodies);
  model.slots = assign_slots(model.bodies);
  model.fixed = robot.fixed_base;
  for (const multibody::RigidBody& body : robot.bodies) model.joints.push_back(joint_of(body));
  hand_on_friction(model.joints);
  model.mimics = mimic_groups_of(model.bodies, model.joints);
  return model;
}

std::vector<Mass> masses_of_bodies(const multibody::RobotModel& robot) {
  const Frames frames = find_frames(robot, nullptr);
  std::vector<Mass> masses;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Inertia inertia = robot.bodies[i].inertia.in({Vec3::Zero(), frames[i].conjugate()});
    const Vec3 moment = inertia.mass * inertia.com;
    const Mat3 tensor = inertia.tensor() + inertia.mass * (inertia.com.squaredNorm() * Mat3::Identity() -
                                                           inertia.com * inertia.com.transpose());
    Mass& mass = masses.emplace_back();
    mass.mass = inertia.mass;
    for (int k = 0; k < 3; ++k) mass.moment[k] = moment[k], mass.inertia[k] = tensor(k, k);
    mass.inertia[3] = tensor(1, 2), mass.inertia[4] = tensor(0, 2), mass.inertia[5] = tensor(0, 1);
  }
  return masses;
}

double radius_of_gyration(const multibody::RobotModel& robot) {
  std::vector<Pose> poses(robot.bodies.size());
  Inertia all;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const multibody::RigidBody& body = robot.bodies[i];
    if (i > 0) poses[i] = poses[std::size_t(body.parent)] * multibody::pose_in_parent(body, robot.initial_positions[i]);
    all = all + body.inertia.in(poses[i]);
  }
  return std::sqrt(all.tensor().trace() / (3 * all.mass));
}

}  // namespace muro::articulated
