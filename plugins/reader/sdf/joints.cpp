// SPDX-License-Identifier: MIT
#include "joints.hpp"

#include <sdf/Collision.hh>
#include <sdf/Geometry.hh>
#include <sdf/Sphere.hh>

#include "muro/base/limits.hpp"
#include "plugins/common/model_file/joint_spring.hpp"

#include <cmath>
#include <sdf/JointAxis.hh>
#include <utility>

namespace muro::sdf {

namespace {

using Type = ::sdf::JointType;

constexpr double no_length = 1e-12;  // m

/// Returns infinity for limits from 1e16 on, and for negative limits that have no meaning.
double or_infinite(double limit) {
  return std::abs(limit) >= 1e16 ? std::copysign(std::numeric_limits<double>::infinity(), limit) : limit;
}
double positive_or_infinite(double limit) {
  return limit < 0 ? std::numeric_limits<double>::infinity() : or_infinite(limit);
}

/// Whether a body carries nothing and all its collision shapes are spheres about a point of it (m, in its frame).
bool is_sphere_about(const Body& body, const Vec3& centre) {
  if (!body.link || body.link->CollisionCount() == 0 || !body.child_joints.empty() || !body.attached.empty())
    return false;
  for (std::uint64_t i = 0; i < body.link->CollisionCount(); ++i) {
    const ::sdf::Collision& collision = *body.link->CollisionByIndex(i);
    const ::sdf::Sphere* sphere = collision.Geom() ? collision.Geom()->SphereShape() : nullptr;
    ignition::math::Pose3d pose;
    if (!sphere || !collision.SemanticPose().Resolve(pose).empty()) return false;
    constexpr double tolerance = 0.01;  // share of the radius
    if ((pose_of(pose).position - centre).norm() > tolerance * sphere->Radius()) return false;
  }
  return true;
}

}  // namespace

Joints::Joints(Assembly& assembly, const SourceFiles& sources, RobotBuilder& builder, Problems& problems)
    : a_(assembly), sources_(sources), builder_(builder), problems_(problems) {
  for (const Joint& joint : a_.joints) {
    if (joint.left_out)
      dofs_.emplace_back();
    else
      dofs_.push_back(dofs_of(joint));
  }
  find_mimics();
  for (const Joint& joint : a_.joints)
    if (joint.definition->Type() == Type::GEARBOX) add_gearbox(joint);
  resolve_followers();
}

std::vector<Joints::SingleDofJoint> Joints::dofs_of(const Joint& joint) {
  const auto name = [&](const char* suffix) { return a_.unique(joint.name + suffix, "_joint"); };
  switch (joint.definition->Type()) {
    case Type::REVOLUTE:
    case Type::CONTINUOUS:
      return {{joint.name, 0, false, axis_of(joint, 0)}};
    case Type::PRISMATIC:
      return {{joint.name, 0, true, axis_of(joint, 0)}};
    case Type::UNIVERSAL:
    case Type::REVOLUTE2:
      return {{name("_axis"), 0, false, axis_of(joint, 0)}, {name("_axis2"), 1, false, axis_of(joint, 1)}};
    case Type::SCREW: {
      const Vec3 axis = axis_of(joint, 0);
      std::vector<SingleDofJoint> dofs = {{joint.name, 0, false, axis}, {name("_slide"), 0, true, axis}};
      followers_[dofs[1].name] = {joint.name, -1 / joint.definition->ThreadPitch(), 0};
      return dofs;
    }
    case Type::BALL:
      return dofs_of_ball(joint);
    default:
      return {};
  }
}

/// Three revolute joints lock if the second is at 90 degrees. The ball of a caster reaches that angle as it rolls.
std::vector<Joints::SingleDofJoint> Joints::dofs_of_ball(const Joint& joint) {
  Body& child = a_.bodies[std::size_t(joint.child)];
  if (is_sphere_about(child, child.pose.inverse() * joint.pose.position)) {
    child.is_caster_ball = true;
    problems_.warning(joint.location,
                      concat("joint ", quote(joint.name), " is the ball joint of a caster; its sphere, ",
                             quote(child.name), ", is fixed and slides without friction instead"));
    return {};
  }
  const auto name = [&](const char* suffix) { return a_.unique(joint.name + suffix, "_joint"); };
  std::vector<SingleDofJoint> dofs = {{name("_x"), 0, false, Vec3::UnitX()},
                                      {name("_y"), 0, false, Vec3::UnitY()},
                                      {name("_z"), 0, false, Vec3::UnitZ()}};
  problems_.warning(joint.location,
                    concat("joint ", quote(joint.name), " is a ball; it is made of the revolute joints ",
                           quote(dofs[0].name), ", ", quote(dofs[1].name), " and ", quote(dofs[2].name),
                           ", which cannot turn freely where the second is at 90 degrees"));
  return dofs;
}

Vec3 Joints::axis_of(const Joint& joint, unsigned number) {
  const ::sdf::JointAxis* axis = joint.definition->Axis(number);
  if (!axis) return Vec3::UnitZ();
  ignition::math::Vector3d v = axis->Xyz();
  const ::sdf::Errors errors = axis->ResolveXyz(v);
  if (!errors.empty()) problems_.error(joint.location, "libsdformat: " + errors.front().Message());
  const Vec3 direction(v.X(), v.Y(), v.Z());
  return direction.norm() > no_length ? Vec3(direction.normalized()) : Vec3::UnitZ();
}

JointLimits Joints::limits_of(const Joint& joint, const SingleDofJoint& dof) {
  JointLimits limits;
  const ::sdf::JointAxis* axis = joint.definition->Axis(dof.number);
  // the prismatic joint of a screw follows the revolute one
  if (!axis || (joint.definition->Type() == Type::SCREW && dof.is_prismatic)) return limits;
  const std::string owner = "joint " + quote(dof.name);
  if (joint.definition->Type() != Type::CONTINUOUS) {
    limits.lower = or_infinite(axis->Lower());
    limits.upper = or_infinite(axis->Upper());
    if (limits.lower > limits.upper) {
      problems_.warning(joint.location, concat(owner, ": its lower limit ", limits.lower, " is above the upper one ",
                                               limits.upper, "; they are exchanged"));
      std::swap(limits.lower, limits.upper);
    }
  }
  limits.velocity = positive_or_infinite(axis->MaxVelocity());
  limits.effort = positive_or_infinite(axis->Effort());
  const auto not_negative = [&](const char* what, double value) {
    if (value >= 0) return value;
    problems_.warning(joint.location, concat(owner, ": its ", what, " ", value, " is negative and taken as 0"));
    return 0.0;
  };
  limits.damping = not_negative("damping", axis->Damping());
  limits.friction = not_negative("friction", axis->Friction());
  if (const auto rotor = sources_.armatures.find(joint.location); rotor != sources_.armatures.end())
    limits.armature = rotor->second;
  return limits;
}

void Joints::add_transform(const Pose& pose) {
  if (pose.position.norm() > no_length) builder_.translation(pose.position);
  if (pose.orientation.vec().norm() > 1e-15) builder_.rotation(pose.orientation);
}

void Joints::add_spring(const Joint& joint, const SingleDofJoint& dof) {
  const ::sdf::JointAxis* axis = joint.definition->Axis(dof.number);
  const double stiffness = axis ? axis->SpringStiffness() : 0;
  if (stiffness == 0) return;
  const model_file::JointSpring spring{stiffness, axis->SpringReference()};
  const std::string owner = concat("joint ", quote(dof.name));
  if (followers_.count(dof.name) != 0)
    return problems_.warning(joint.location, owner + ": its spring is left out, as it follows a joint");
  if (stiffness < 0 || stiffness > limits::joint_resistance || std::abs(spring.reference) > limits::joint_position)
    return problems_.warning(joint.location,
                             concat(owner, " has a spring of stiffness ", stiffness,
                                    ", which is left out; it is from 0 to 1e12, its reference from -1e6 to 1e6"));
  problems_.note(joint.location, owner + spring.note());
  spring.add_to(builder_);
}

/// `rotation`: orientation of the present frame in the frame of the joint.
void Joints::add_dof(const Joint& joint, const SingleDofJoint& dof, const Quat& rotation) {
  const Vec3 axis = rotation.conjugate() * dof.axis;
  const JointLimits limits = limits_of(joint, dof);
  dof.is_prismatic ? builder_.prismatic(dof.name, axis, limits) : builder_.revolute(dof.name, axis, limits);
  add_spring(joint, dof);
  ranges_[dof.name] = {{limits.lower, limits.upper}, &joint};
  const auto follower = followers_.find(dof.name);
  if (follower == followers_.end()) return;
  builder_.mimic(follower->second.leader, follower->second.multiplier, follower->second.offset);
}

void Joints::check_mimic_limits() const {
  for (const auto& [name, follower] : followers_) {
    const auto own = ranges_.find(name), leader = ranges_.find(follower.leader);
    if (own == ranges_.end() || leader == ranges_.end()) continue;
    const model_file::JointRange reached = leader->second.range.followed(follower.multiplier, follower.offset);
    if (const auto text = model_file::passed_mimic_limits(name, follower.leader, reached, own->second.range))
      problems_.warning(own->second.joint->location, *text);
  }
}

void Joints::add(int number) {
  const Joint& joint = a_.joints[std::size_t(number)];
  const Pose& child = a_.bodies[std::size_t(joint.child)].pose;
  Pose to_joint = a_.bodies[std::size_t(joint.parent)].pose.inverse() * joint.pose;
  const Pose from_joint = joint.pose.inverse() * child;
  const std::vector<SingleDofJoint>& dofs = dofs_[std::size_t(number)];
  if (dofs.empty()) return add_transform(to_joint * from_joint);  // a fixed joint
  for (std::size_t i = 0; i + 1 < dofs.size(); ++i) {
    add_transform(std::exchange(to_joint, Pose{}));
    add_dof(joint, dofs[i], Quat::Identity());
    builder_.body(a_.unique(dofs[i].name + "_body", "_body"));
  }
  // If the child's origin lies on the axis, its frame can be the frame of the joint as well.
  const SingleDofJoint& last = dofs.back();
  if (last.is_prismatic || from_joint.position.cross(last.axis).norm() <= no_length) {
    add_transform(to_joint * from_joint);
    return add_dof(joint, last, from_joint.orientation);
  }
  add_transform(to_joint);
  add_dof(joint, last, Quat::Identity());
  builder_.body(a_.unique(last.name + "_frame", "_body"));
  add_transform(from_joint);
}

void Joints::find_mimics() {
  for (std::size_t i = 0; i < a_.joints.size(); ++i) {
    const Joint& joint = a_.joints[i];
    for (const SingleDofJoint& dof : dofs_[i]) {
      const auto mimic = sources_.mimics.find({joint.location, int(dof.number)});
      if (mimic == sources_.mimics.end() || followers_.count(dof.name) != 0) continue;
      const Mimic& m = mimic->second;
      const auto leader = a_.joints_by_name.find(joint.scope + m.joint);
      const unsigned number = m.axis == "axis2" ? 1 : 0;
      const SingleDofJoint* found = nullptr;
      if (leader != a_.joints_by_name.end())
        for (const SingleDofJoint& d : dofs_[std::size_t(leader->second)])
          if (d.number == number && !found) found = &d;
      if (!found) {
        problems_.warning(m.location, concat("joint ", quote(joint.name), " mimics ", quote(m.joint),
                                             ", which is no joint that moves; it moves on its own"));
        continue;
      }
      followers_[dof.name] = {found->name, m.multiplier, m.offset - m.multiplier * m.reference};
    }
  }
}

/// Returns the revolute joint between the carrier of a gear and one of its wheels, and the direction in which its
/// position turns the wheel about `axis` (in the frame of the model): 1 or -1, or 0 if there is no such joint.
std::pair<int, double> Joints::wheel(int carrier, int link, const Vec3& axis) const {
  for (std::size_t i = 0; i < a_.joints.size(); ++i) {
    const Joint& joint = a_.joints[i];
    const bool forward = joint.parent == carrier && joint.child == link,
               back = joint.parent == link && joint.child == carrier;
    if ((!forward && !back) || dofs_[i].size() != 1 || dofs_[i][0].is_prismatic) continue;
    const double along = (joint.pose.orientation * dofs_[i][0].axis).dot(axis);
    if (std::abs(along) < 1 - 1e-6) continue;
    return {int(i), (along > 0) == forward ? 1.0 : -1.0};
  }
  return {-1, 0};
}

/// theta_1: angle of the parent, theta_2: angle of the child, both relative to the body that carries them.
/// theta_2 = -ratio theta_1 (SDFormat, <gearbox_ratio>).
void Joints::add_gearbox(const Joint& joint) {
  const ::sdf::ElementPtr element = joint.definition->Element();
  const auto carrier = a_.bodies_by_name.find(joint.scope + element->Get<std::string>("gearbox_reference_body"));
  const Vec3 first = joint.pose.orientation * axis_of(joint, 0), second = joint.pose.orientation * axis_of(joint, 1);
  const double ratio = element->Get<double>("gearbox_ratio", 1.0).first;
  std::pair<int, double> leader{-1, 0}, follower{-1, 0};
  if (carrier != a_.bodies_by_name.end()) {
    leader = wheel(carrier->second, joint.parent, first);
    follower = wheel(carrier->second, joint.child, second);
  }
  if (leader.first < 0 || follower.first < 0 || leader.first == follower.first)
    return problems_.warning(
        joint.location, concat("gearbox ", quote(joint.name), " is left out: its parent and its child each need a ",
                               "revolute joint with the <gearbox_reference_body>, about the gearbox's axis and axis2"));
  const std::string& name = dofs_[std::size_t(follower.first)][0].name;
  if (followers_.count(name) != 0)
    return problems_.warning(joint.location, concat("gearbox ", quote(joint.name), " is left out: joint ", quote(name),
                                                    " follows another one already"));
  followers_[name] = {dofs_[std::size_t(leader.first)][0].name, -follower.second * ratio * leader.second, 0};
}

/// Robots have one level of mimic joints: a follower of a follower gets the first leader.
void Joints::resolve_followers() {
  std::vector<std::string> circles;
  for (auto& [name, follower] : followers_) {
    for (std::size_t steps = 0; followers_.count(follower.leader) != 0; ++steps) {
      if (follower.leader == name || steps > followers_.size()) {
        problems_.warning({},
                          concat("joint ", quote(name), " mimics itself through other joints; it moves on its own"));
        circles.push_back(name);
        break;
      }
      const Follower& next = followers_.at(follower.leader);
      follower.offset += follower.multiplier * next.offset;
      follower.multiplier *= next.multiplier;
      follower.leader = next.leader;
    }
  }
  for (const std::string& name : circles) followers_.erase(name);
}

}  // namespace muro::sdf
