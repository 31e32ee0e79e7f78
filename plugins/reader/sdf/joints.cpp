// SPDX-License-Identifier: MIT
#include "joints.hpp"

#include <cmath>
#include <sdf/JointAxis.hh>
#include <utility>

namespace muro::sdf {

namespace {

using Type = ::sdf::JointType;

constexpr double no_length = 1e-12;  // m

/// Limits from 1e16 on, and those that are negative where that has no meaning, stand for none.
double or_infinite(double limit) {
  return std::abs(limit) >= 1e16 ? std::copysign(std::numeric_limits<double>::infinity(), limit) : limit;
}
double positive_or_infinite(double limit) {
  return limit < 0 ? std::numeric_limits<double>::infinity() : or_infinite(limit);
}

}  // namespace

Joints::Joints(Assembly& assembly, const Sources& sources, RobotBuilder& builder, Problems& problems)
    : a_(assembly), sources_(sources), builder_(builder), problems_(problems) {
  for (const Bond& bond : a_.bonds) hinges_.push_back(hinges_of(bond));
  take_mimics();
  for (const Bond& bond : a_.bonds)
    if (bond.joint->Type() == Type::GEARBOX) take_gear(bond);
  resolve_followers();
}

std::vector<Joints::Hinge> Joints::hinges_of(const Bond& bond) {
  const auto part = [&](const char* suffix) { return a_.unique(bond.name + suffix, "_joint"); };
  switch (bond.joint->Type()) {
    case Type::REVOLUTE:
    case Type::CONTINUOUS:
      return {{bond.name, 0, false, axis_of(bond, 0)}};
    case Type::PRISMATIC:
      return {{bond.name, 0, true, axis_of(bond, 0)}};
    case Type::UNIVERSAL:
    case Type::REVOLUTE2:
      return {{part("_axis"), 0, false, axis_of(bond, 0)}, {part("_axis2"), 1, false, axis_of(bond, 1)}};
    case Type::SCREW: {
      const Vec3 axis = axis_of(bond, 0);
      std::vector<Hinge> hinges = {{bond.name, 0, false, axis}, {part("_slide"), 0, true, axis}};
      followers_[hinges[1].name] = {bond.name, -1 / bond.joint->ThreadPitch(), 0};
      return hinges;
    }
    case Type::BALL: {
      std::vector<Hinge> hinges = {{part("_x"), 0, false, Vec3::UnitX()},
                                   {part("_y"), 0, false, Vec3::UnitY()},
                                   {part("_z"), 0, false, Vec3::UnitZ()}};
      problems_.warning(bond.at, say("joint ", cited(bond.name), " is a ball; it is made of the revolute joints ",
                                     cited(hinges[0].name), ", ", cited(hinges[1].name), " and ", cited(hinges[2].name),
                                     ", which cannot turn freely where the second is at 90 degrees"));
      return hinges;
    }
    default:
      return {};
  }
}

Vec3 Joints::axis_of(const Bond& bond, unsigned number) {
  const ::sdf::JointAxis* axis = bond.joint->Axis(number);
  if (!axis) return Vec3::UnitZ();
  ignition::math::Vector3d v = axis->Xyz();
  const ::sdf::Errors errors = axis->ResolveXyz(v);
  if (!errors.empty()) problems_.error(bond.at, "libsdformat: " + errors.front().Message());
  const Vec3 direction(v.X(), v.Y(), v.Z());
  return direction.norm() > no_length ? Vec3(direction.normalized()) : Vec3::UnitZ();
}

JointLimits Joints::limits_of(const Bond& bond, const Hinge& hinge) {
  JointLimits limits;
  const ::sdf::JointAxis* axis = bond.joint->Axis(hinge.number);
  // the slide of a screw goes where the turn takes it
  if (!axis || (bond.joint->Type() == Type::SCREW && hinge.slides)) return limits;
  const std::string owner = "joint " + cited(hinge.name);
  if (bond.joint->Type() != Type::CONTINUOUS) {
    limits.lower = or_infinite(axis->Lower());
    limits.upper = or_infinite(axis->Upper());
    if (limits.lower > limits.upper) {
      problems_.warning(bond.at, say(owner, ": its lower limit ", limits.lower, " is above the upper one ",
                                     limits.upper, "; they are exchanged"));
      std::swap(limits.lower, limits.upper);
    }
  }
  limits.velocity = positive_or_infinite(axis->MaxVelocity());
  limits.effort = positive_or_infinite(axis->Effort());
  const auto loss = [&](const char* what, double value) {
    if (value >= 0) return value;
    problems_.warning(bond.at, say(owner, ": its ", what, " ", value, " is negative and taken as 0"));
    return 0.0;
  };
  limits.damping = loss("damping", axis->Damping());
  limits.friction = loss("friction", axis->Friction());
  if (axis->SpringStiffness() != 0)
    problems_.warning(bond.at, say(owner, " has a spring of stiffness ", axis->SpringStiffness(),
                                   ", which is left out: joints have no springs; a controller may act as one"));
  return limits;
}

void Joints::place(const Pose& pose) {
  if (pose.position.norm() > no_length) builder_.translation(pose.position);
  if (pose.orientation.vec().norm() > 1e-15) builder_.rotation(pose.orientation);
}

/// `turn`: of the present frame in that of the joint.
void Joints::put(const Bond& bond, const Hinge& hinge, const Quat& turn) {
  const Vec3 axis = turn.conjugate() * hinge.axis;
  const JointLimits limits = limits_of(bond, hinge);
  hinge.slides ? builder_.prismatic(hinge.name, axis, limits) : builder_.revolute(hinge.name, axis, limits);
  const auto follower = followers_.find(hinge.name);
  if (follower == followers_.end()) return;
  builder_.mimic(follower->second.leader, follower->second.multiplier, follower->second.offset);
}

void Joints::add(int number) {
  const Bond& bond = a_.bonds[std::size_t(number)];
  const Pose& child = a_.bodies[std::size_t(bond.child)].pose;
  Pose before = a_.bodies[std::size_t(bond.parent)].pose.inverse() * bond.pose;
  const Pose behind = bond.pose.inverse() * child;
  const std::vector<Hinge>& hinges = hinges_[std::size_t(number)];
  if (hinges.empty()) return place(before * behind);  // fixed
  for (std::size_t i = 0; i + 1 < hinges.size(); ++i) {
    place(std::exchange(before, Pose{}));
    put(bond, hinges[i], Quat::Identity());
    builder_.body(a_.unique(hinges[i].name + "_body", "_body"));
  }
  // Where the child's origin lies on the axis, its frame is that of the joint as well.
  const Hinge& last = hinges.back();
  if (last.slides || behind.position.cross(last.axis).norm() <= no_length) {
    place(before * behind);
    return put(bond, last, behind.orientation);
  }
  place(before);
  put(bond, last, Quat::Identity());
  builder_.body(a_.unique(last.name + "_frame", "_body"));
  place(behind);
}

void Joints::take_mimics() {
  for (std::size_t b = 0; b < a_.bonds.size(); ++b) {
    const Bond& bond = a_.bonds[b];
    for (const Hinge& hinge : hinges_[b]) {
      const auto mimic = sources_.mimics.find({bond.at, int(hinge.number)});
      if (mimic == sources_.mimics.end() || followers_.count(hinge.name) != 0) continue;
      const Mimic& m = mimic->second;
      const auto leader = a_.joints_by_name.find(bond.scope + m.joint);
      const unsigned wanted = m.axis == "axis2" ? 1 : 0;
      const Hinge* found = nullptr;
      if (leader != a_.joints_by_name.end())
        for (const Hinge& h : hinges_[std::size_t(leader->second)])
          if (h.number == wanted && !found) found = &h;
      if (!found) {
        problems_.warning(m.at, say("joint ", cited(bond.name), " mimics ", cited(m.joint),
                                    ", which is no joint that moves; it moves on its own"));
        continue;
      }
      followers_[hinge.name] = {found->name, m.multiplier, m.offset - m.multiplier * m.reference};
    }
  }
}

/// The revolute joint between the carrier of a gear and one of its wheels, and which way its position turns the
/// wheel about `axis` (in the frame of the model): 1 or -1, 0 when there is no such joint.
std::pair<int, double> Joints::wheel(int carrier, int link, const Vec3& axis) const {
  for (std::size_t b = 0; b < a_.bonds.size(); ++b) {
    const Bond& bond = a_.bonds[b];
    const bool forward = bond.parent == carrier && bond.child == link,
               back = bond.parent == link && bond.child == carrier;
    if ((!forward && !back) || hinges_[b].size() != 1 || hinges_[b][0].slides) continue;
    const double along = (bond.pose.orientation * hinges_[b][0].axis).dot(axis);
    if (std::abs(along) < 1 - 1e-6) continue;
    return {int(b), (along > 0) == forward ? 1.0 : -1.0};
  }
  return {-1, 0};
}

/// With theta_1 the angle of the parent and theta_2 that of the child, seen from the body that carries both:
/// theta_2 = -ratio theta_1 (SDFormat, <gearbox_ratio>).
void Joints::take_gear(const Bond& bond) {
  const ::sdf::ElementPtr element = bond.joint->Element();
  const auto carrier = a_.bodies_by_name.find(bond.scope + element->Get<std::string>("gearbox_reference_body"));
  const Vec3 first = bond.pose.orientation * axis_of(bond, 0), second = bond.pose.orientation * axis_of(bond, 1);
  const double ratio = element->Get<double>("gearbox_ratio", 1.0).first;
  std::pair<int, double> leader{-1, 0}, led{-1, 0};
  if (carrier != a_.bodies_by_name.end()) {
    leader = wheel(carrier->second, bond.parent, first);
    led = wheel(carrier->second, bond.child, second);
  }
  if (leader.first < 0 || led.first < 0 || leader.first == led.first)
    return problems_.warning(
        bond.at, say("gearbox ", cited(bond.name), " is left out: its parent and its child each need a ",
                     "revolute joint with the <gearbox_reference_body>, about the gearbox's axis and axis2"));
  const std::string& name = hinges_[std::size_t(led.first)][0].name;
  if (followers_.count(name) != 0)
    return problems_.warning(bond.at, say("gearbox ", cited(bond.name), " is left out: joint ", cited(name),
                                          " follows another one already"));
  followers_[name] = {hinges_[std::size_t(leader.first)][0].name, -led.second * ratio * leader.second, 0};
}

/// The host knows one level: who follows a follower follows the first of them.
void Joints::resolve_followers() {
  for (auto& [name, follower] : followers_) {
    for (std::size_t steps = 0; followers_.count(follower.leader) != 0; ++steps) {
      if (follower.leader == name || steps > followers_.size()) {
        problems_.error({}, say("joint ", cited(name), " mimics itself, over other joints"));
        break;
      }
      const Follower& next = followers_.at(follower.leader);
      follower.offset += follower.multiplier * next.offset;
      follower.multiplier *= next.multiplier;
      follower.leader = next.leader;
    }
  }
}

}  // namespace muro::sdf
