// SPDX-License-Identifier: MIT
#include "world_robot.hpp"

#include <cmath>

#include "joint_drive_target.hpp"
#include "joint_target.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::multibody {

namespace {

/// m, rad, m/s, rad/s: engines that diverge pass this on their way to infinity, and may stay beyond it.
constexpr double diverged = 1e12;

}  // namespace

WorldRobot::WorldRobot(RobotModel model, std::uint32_t level) : model_(std::move(model)), level_(level) {
  const std::size_t bodies = model_.bodies.size();
  state_.joints.resize(bodies);
  state_.external.resize(bodies);
  state_.contact.resize(model_.loaded_links.size());
  body_states_.resize(bodies);
}

void WorldRobot::connect(Connector& c, const RobotView& view, const WorldTraits& traits, std::size_t engine_memory) {
  active_level_ = c.input(view.base(), keys::motion_level, std::uint32_t{0});
  contact_world_ = c.variable(view.base(), keys::contact_world, traits.contact_world);
  twist_lag_ = c.variable(view.base(), keys::twist_lag, traits.twist_lag);
  pose_ = c.variable(view.base(), keys::pose, c.constant(view.base(), keys::initial_pose).value_or(Pose{}));
  const Twist initial_twist = c.constant(view.base(), keys::initial_twist).value_or(Twist{});
  twist_ = c.variable(view.base(), keys::twist, model_.fixed_base ? Twist{} : initial_twist);
  connect_joints(c, view);
  connect_links(c, view);
  connect_memory(c, view, traits.motion, engine_memory);
}

void WorldRobot::connect_joints(Connector& c, const RobotView& view) {
  joints_.resize(model_.bodies.size());
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const RigidBody& body = model_.bodies[i];
    const ObjectId object = view.links[body.link].joint_object;
    const double start = model_.initial_positions[i];
    check_start(c, object, body.limits, start);
    Joint& j = joints_[i];
    j.position = c.variable(object, keys::joint_position, start);
    j.velocity = c.variable(object, keys::joint_velocity, 0.0);
    j.effort = c.derived(object, keys::joint_effort);
    if (body.leader < 0) j.target = connect_joint_target(c, object, body.drive, start);
  }
}

void WorldRobot::connect_links(Connector& c, const RobotView& view) {
  for (const LoadedLink& loaded : model_.loaded_links) {
    const ObjectId object = view.links[loaded.link].object;
    LinkWrenches& w = wrenches_.emplace_back();
    w.external = c.read_sum(object, keys::external_wrench);
    if (loaded.has_shapes) w.contact = c.derived(object, keys::contact_wrench);
  }
}

/// One state block holds the last state, then what the engine keeps.
void WorldRobot::connect_memory(Connector& c, const RobotView& view, std::string_view motion,
                                std::size_t engine_memory) {
  const std::size_t last = LastState::size_for(model_.bodies.size());
  const bool has_levels = !c.constant_array(view.base(), keys::motion_level_names).empty();
  const std::string name = std::string(motion) + (has_levels ? "." + std::to_string(level_) : "");
  const auto bytes = std::uint32_t((last + engine_memory) * sizeof(double));
  auto* block = static_cast<double*>(c.state_block(view.base(), name, bytes));
  last_ = LastState({block, last});
  state_.memory = {block + last, engine_memory};
}

void WorldRobot::take_over(const WorldTraits& traits) {
  *contact_world_ = traits.contact_world;
  *twist_lag_ = traits.twist_lag;
  last_.invalidate();
  if (model_.fixed_base) *twist_ = Twist{};
}

void WorldRobot::import() {
  RobotState& s = state_;
  s.motion_type = *active_level_ == level_              ? MotionType::dynamic
                  : is_moved_by_forces(*contact_world_) ? MotionType::disabled
                                                        : MotionType::kinematic;
  s.pose = *pose_;
  s.twist = *twist_;
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    s.joints[i].position = *joints_[i].position;
    s.joints[i].velocity = *joints_[i].velocity;
  }
  if (!is_dynamic()) {
    if (last_.is_valid() && !is_in_world(*contact_world_)) clear_outputs();
    last_.invalidate();
    return;
  }
  s.moved_from_outside = !last_.matches(s);
  import_wrenches();
}

/// Another motion has taken the robot over, which does not write them.
void WorldRobot::clear_outputs() const {
  for (const LinkWrenches& w : wrenches_)
    if (w.contact) *w.contact = Wrench{};
  for (std::size_t i = 1; i < joints_.size(); ++i) *joints_[i].effort = 0;
}

void WorldRobot::import_wrenches() {
  state_.has_external_wrench = false;
  for (const LinkWrenches& link : wrenches_)
    for (std::uint64_t k = 0; k < link.external.size(); ++k) {
      const Wrench& w = *link.external.contribution(k);
      state_.has_external_wrench = state_.has_external_wrench || !w.force.isZero(0) || !w.torque.isZero(0);
    }
  for (Wrench& w : state_.external) w = Wrench{};
  if (!state_.has_external_wrench) return;
  forward_kinematics(model_, state_, body_states_);
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const LinkPlacement& placement = model_.loaded_links[i].placement;
    const Wrench w = wrenches_[i].external.value();
    Wrench& sum = state_.external[placement.body];
    sum.add_force(w.force, body_states_[placement.body].pose.orientation * placement.pose.position);
    sum.torque += w.torque;
  }
}

void WorldRobot::set_drive_targets(double position_gain) {
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const RigidBody& body = model_.bodies[i];
    JointState& joint = state_.joints[i];
    const JointState* const leader = body.leader >= 0 ? &state_.joints[std::size_t(body.leader)] : nullptr;
    joint.target = drive_target_of(body, joint, leader, joints_[i].target.get(), position_gain);
  }
}

void WorldRobot::export_state() {
  const RobotState& s = state_;
  double sum = s.pose.position.lpNorm<1>() + s.twist.linear.lpNorm<1>() + s.twist.angular.lpNorm<1>();
  *pose_ = s.pose;
  *twist_ = s.twist;
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const JointState& j = s.joints[i];
    *joints_[i].position = j.position;
    *joints_[i].velocity = j.velocity;
    *joints_[i].effort = j.effort;
    sum += std::abs(j.position) + std::abs(j.velocity);
  }
  if (!(sum < diverged))
    throw Error("the motion of " + quote(model_.name) +
                " is no longer finite: forces grow from step to step; raise the rate or `substeps`, or look at what "
                "commands its joints and at masses of its links that differ much");
  export_contacts();
  last_.store(s);
}

void WorldRobot::export_contacts() {
  bool has_body_states = false;
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    if (!wrenches_[i].contact) continue;
    Wrench w = state_.contact[i];
    const LinkPlacement& placement = model_.loaded_links[i].placement;
    if (!placement.pose.position.isZero(0) && !w.force.isZero(0)) {
      if (!has_body_states) forward_kinematics(model_, state_, body_states_);
      has_body_states = true;
      w.torque -= Vec3(body_states_[placement.body].pose.orientation * placement.pose.position).cross(w.force);
    }
    *wrenches_[i].contact = w;
  }
}

}  // namespace muro::multibody
