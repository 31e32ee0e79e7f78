// SPDX-License-Identifier: MIT
#include "world_robot.hpp"

#include <cmath>
#include <utility>

#include "joint_drive_target.hpp"
#include "muro/base/number_text.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/position_drive/joint_target.hpp"
#include "plugins/motion/common/position_drive/settled_modes.hpp"

namespace muro::multibody {

WorldRobot::WorldRobot(RobotModel model, std::uint32_t level) : model_(std::move(model)), level_(level) {
  const std::size_t bodies = model_.bodies.size();
  state_.joints.resize(bodies);
  state_.external.resize(bodies);
  state_.contact.resize(model_.loaded_links.size());
  body_states_.resize(bodies);
}

void WorldRobot::connect(Connector& c, const RobotView& view, const Parameters& p, const WorldTraits& traits,
                         std::size_t engine_memory) {
  const watch::Reach reach = watch::reach_of(c, view);
  watch_ = watch::Watch(c, p, reach);
  advice_ = traits.advice;
  active_level_ = c.input(view.base(), keys::motion_level, std::uint32_t{0});
  contact_role_ = ContactRole(c, view.base(), traits.contact_world, traits.twist_lag);
  pose_ = c.variable(view.base(), keys::pose, c.constant(view.base(), keys::initial_pose).value_or(Pose{}));
  const Twist initial_twist = c.constant(view.base(), keys::initial_twist).value_or(Twist{});
  twist_ = c.variable(view.base(), keys::twist, model_.fixed_base ? Twist{} : initial_twist);
  contacts_ = c.derived_list(view.base(), keys::contact_wrenches_of_motion);
  connect_joints(c, view, p, reach);
  connect_links(c, view);
  connect_memory(c, view, traits.motion, engine_memory);
}

void WorldRobot::connect_joints(Connector& c, const RobotView& view, const Parameters& p, const watch::Reach& reach) {
  std::vector<bool> is_open;
  drive_modes_of(c, view, p, &is_open);
  joints_.resize(model_.bodies.size());
  joint_names_.resize(joints_.size());
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const RigidBody& body = model_.bodies[i];
    const ObjectId object = view.links[body.link].joint_object;
    const double start = model_.initial_positions[i];
    check_start(c, object, body.limits, start);
    Joint& j = joints_[i];
    j.object = object;
    joint_names_[i] = c.object_name(object);
    j.reach_square = body.joint == JointKind::revolute ? std::pow(reach.of_link[body.link], 2) : 1;
    j.position = c.variable(object, keys::joint_position, start);
    j.velocity = c.variable(object, keys::joint_velocity, 0.0);
    j.effort = c.derived(object, keys::joint_effort);
    if (body.leader < 0) j.target = connect_joint_target(c, object, body.drive, start);
    if (follows_positions(i) || is_open[body.link])
      j.position_target = PositionTarget(object, j.target.get(), p.real(interpolate.name));
  }
}

/// Connects the drives, when it is known which targets algorithms write.
void WorldRobot::connect_drives(Connector& c, const RobotView& view, const Parameters& p) {
  const std::vector<DriveMode> modes = settled_modes(c, view, p);
  const std::vector<PositionDrive> drives = position_drives_of(c, view, modes, p);
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    RigidBody& body = model_.bodies[i];
    Joint& j = joints_[i];
    const bool is_settled = body.drive != modes[body.link];
    body.drive = modes[body.link];
    if (is_settled && body.leader < 0)
      j.target = connect_joint_target(c, j.object, body.drive, model_.initial_positions[i]);
    has_speed_limits_ = has_speed_limits_ || (body.drive == DriveMode::effort && std::isfinite(body.limits.velocity));
    if (!follows_positions(i)) continue;
    has_position_drives_ = true;
    j.position_drive = drives[body.link];
    j.position_target.follow(j.target.get());
  }
  if (!has_position_drives_ && !has_speed_limits_) return;
  std::vector<MovedInertias::Body> bodies(joints_.size());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const RigidBody& body = model_.bodies[i];
    Link& link = bodies[i].link;
    link.parent = body.parent, link.joint = body.joint, link.origin = body.origin, link.axis = body.axis;
    link.limits = body.limits;
    bodies[i].inertia = body.inertia;
  }
  moved_inertias_ = MovedInertias(bodies, model_.fixed_base);
  positions_.resize(joints_.size());
}

bool WorldRobot::follows_positions(std::size_t body) const {
  return body > 0 && model_.bodies[body].drive == DriveMode::position && model_.bodies[body].leader < 0;
}

void WorldRobot::connect_by_name(Connector& c, const RobotView& view, const Parameters& p) {
  connect_drives(c, view, p);
  state_.tells_contacts = c.is_used(view.base(), keys::contact_wrenches_of_motion, usage::read);
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const ObjectId link = view.links[model_.loaded_links[i].link].object;
    if (!c.is_used(link, keys::applied_wrench, usage::read)) continue;
    wrenches_[i].applied = c.derived(link, keys::applied_wrench);
    tells_applied_ = true;
  }
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    if (follows_positions(i)) joints_[i].position_target.connect_by_name(c);
    if (model_.bodies[i].drive == DriveMode::effort && model_.bodies[i].leader < 0)
      joints_[i].losses.connect_by_name(c, joints_[i].object);
  }
}

void WorldRobot::connect_links(Connector& c, const RobotView& view) {
  for (const LoadedLink& loaded : model_.loaded_links) {
    const ObjectId object = view.links[loaded.link].object;
    LinkWrenches& w = wrenches_.emplace_back();
    link_names_.emplace_back(c.object_name(object));
    w.external = c.read_sum(object, keys::external_wrench);
    if (loaded.has_shapes) w.contact = c.derived(object, keys::contact_wrench);
  }
}

/// Allocates one state block for the last state, the memory of the engine, and the memory of interpolated targets.
void WorldRobot::connect_memory(Connector& c, const RobotView& view, std::string_view motion,
                                std::size_t engine_memory) {
  const std::size_t last = LastState::size_for(model_.bodies.size());
  const bool has_levels = !c.constant_array(view.base(), keys::motion_level_names).empty();
  const std::string name = std::string(motion) + (has_levels ? "." + std::to_string(level_) : "");
  std::size_t count = last + engine_memory;
  for (const Joint& joint : joints_) count += joint.position_target.memory_size();
  auto* block = static_cast<double*>(c.state_block(view.base(), name, std::uint32_t(count * sizeof(double))));
  last_ = LastState({block, last});
  state_.memory = {block + last, engine_memory};
  double* next = block + last + engine_memory;
  for (Joint& joint : joints_) {
    const std::size_t size = joint.position_target.memory_size();
    if (size > 0) joint.position_target.keep_in({next, size});
    next += size;
  }
}

void WorldRobot::begin_watch() {
  watch_begins_ = true;
  for (const LinkWrenches& w : wrenches_)
    if (w.external.size() > (has_contact_law_ ? 1 : 0)) watch_.allow_pushes();
}

void WorldRobot::take_over() {
  contact_role_.take_over();
  last_.invalidate();
  for (const Joint& joint : joints_) joint.position_target.take_over();
  if (model_.fixed_base) *twist_ = Twist{};
}

void WorldRobot::import() {
  RobotState& s = state_;
  s.motion_type = *active_level_ == level_                            ? MotionType::dynamic
                  : is_moved_by_forces(contact_role_.present_world()) ? MotionType::disabled
                                                                      : MotionType::kinematic;
  s.pose = *pose_;
  s.twist = *twist_;
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    s.joints[i].position = *joints_[i].position;
    s.joints[i].velocity = *joints_[i].velocity;
  }
  if (!is_dynamic()) {
    if (last_.is_valid() && !is_in_world(contact_role_.present_world())) clear_outputs();
    last_.invalidate();
    check_input();
    return;
  }
  s.moved_from_outside = !last_.matches(s);
  if (s.moved_from_outside) check_input();
  if (s.moved_from_outside || watch_begins_) {
    watch_.begin(s.pose.position, s.twist);
    watch_begins_ = true;
  }
  s.overlap = {};
  import_wrenches();
}

/// Clears the outputs that another motion, which has taken over the robot, does not write.
void WorldRobot::clear_outputs() const {
  for (const LinkWrenches& w : wrenches_) {
    if (w.contact) *w.contact = Wrench{};
    if (w.applied) *w.applied = Wrench{};
  }
  for (std::size_t i = 1; i < joints_.size(); ++i) *joints_[i].effort = 0;
}

void WorldRobot::import_wrenches() {
  state_.has_external_wrench = false;
  for (const LinkWrenches& link : wrenches_)
    for (std::uint64_t k = 0; k < link.external.size(); ++k) {
      const Wrench& w = *link.external.contribution(k);
      state_.has_external_wrench = state_.has_external_wrench || !w.force.isZero(0) || !w.torque.isZero(0);
      if (!std::isfinite(w.force.sum() + w.torque.sum()))
        throw Error("the sum of the external wrenches on " + quote(link_names_[std::size_t(&link - wrenches_.data())]) +
                    " is not finite; look at what adds to its `wrench.external`");
    }
  for (Wrench& w : state_.external) w = Wrench{};
  for (LinkWrenches& w : wrenches_) w.used = w.mean_contact = Wrench{};
  if (!state_.has_external_wrench) return;
  forward_kinematics(model_, state_, body_states_);
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const LinkPlacement& placement = model_.loaded_links[i].placement;
    const Wrench w = wrenches_[i].used = wrenches_[i].external.value();
    Wrench& sum = state_.external[placement.body];
    sum.add_force(w.force, body_states_[placement.body].pose.orientation * placement.pose.position);
    sum.torque += w.torque;
  }
}

void WorldRobot::set_drive_targets(const WorldTraits& traits, double dt, double gain_of_mimics) {
  bool knows_inertias = false;
  const auto update_inertias = [&] {
    if (std::exchange(knows_inertias, true)) return;
    for (std::size_t i = 1; i < joints_.size(); ++i) positions_[i] = state_.joints[i].position;
    moved_inertias_.update(positions_);
  };
  if (has_position_drives_ && is_dynamic()) update_inertias();
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const RigidBody& body = model_.bodies[i];
    JointState& joint = state_.joints[i];
    joint.drive_friction = joints_[i].losses.friction();
    joint.drive_armature = joints_[i].losses.armature();
    if (follows_positions(i)) {
      if (!is_dynamic()) continue;
      const PdGains gains = joints_[i].position_drive.gains(moved_inertias_.driven(i));
      const Reference reference = joints_[i].position_target.advance(joint.position, body.limits, dt);
      joint.target = position_drive_target(body, joint, gains, reference, moved_inertias_.free(i), dt);
    } else if (body.leader >= 0) {
      const JointState& leader = state_.joints[std::size_t(body.leader)];
      joint.target = mimic_target(body, joint, leader, gain_of_mimics, traits.couples_mimics);
    } else {
      joint.target = drive_target_of(body, joint, joints_[i].target.get());
      if (has_speed_limits_ && is_dynamic() && nears_speed_limit(joint.target.effort, body, joint)) {
        update_inertias();
        const double inertia = moved_inertias_.free(i) + joint.drive_armature;
        joint.target.effort = within_speed_limit(joint.target.effort, body, joint, inertia, dt);
      }
    }
    if (!std::isfinite(joint.target.velocity + joint.target.mimic_lead + joint.target.effort + joint.drive_friction +
                       joint.drive_armature))
      throw Error("the target of " + quote(joint_names_[i]) +
                  " is not finite; look at what writes its `joint.*.target`");
  }
}

void WorldRobot::export_state() {
  const RobotState& s = state_;
  *pose_ = s.pose;
  *twist_ = s.twist;
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const JointState& j = s.joints[i];
    *joints_[i].position = j.position;
    *joints_[i].velocity = j.velocity;
    *joints_[i].effort = j.effort;
  }
  if (watch_begins_) watch_.begin_overlap(s.overlap.depth);
  watch_begins_ = false;
  if (!is_within_limits()) {
    const bool too_deep = !watch_.allows_depth(s.overlap.depth);
    throw Error(failure_text(broken_limit()) +
                (std::isfinite(wildness()) ? watch::how_to_go_on(too_deep ? "watch_depth" : "watch_speed") : ""));
  }
  export_contacts();
  last_.store(s);
}

bool WorldRobot::is_within_limits() const {
  const RobotState& s = state_;
  bool fine = watch_.allows(s.pose.position, s.twist) && watch_.allows_depth(s.overlap.depth);
  const double square = watch_.allowed_square(s.pose.position);
  for (std::size_t i = 1; i < joints_.size(); ++i)
    fine = fine && s.joints[i].velocity * s.joints[i].velocity * joints_[i].reach_square < square &&
           std::abs(s.joints[i].position) < watch::beyond;
  return fine;
}

double WorldRobot::wildness() const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const RobotState& s = state_;
  if (!watch::is_somewhere(s.pose, s.twist)) return infinity;
  double square = s.twist.linear.squaredNorm();
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const double velocity = s.joints[i].velocity;
    if (!(std::abs(velocity) + std::abs(s.joints[i].position) < watch::beyond)) return infinity;
    square = std::max(square, velocity * velocity * joints_[i].reach_square);
  }
  return std::max(std::sqrt(square / watch_.allowed_square(s.pose.position)), s.overlap.depth / watch_.depth());
}

/// Describes the limit of the watch that the present state exceeds.
std::string WorldRobot::broken_limit() const {
  const RobotState& s = state_;
  if (!watch_.allows_depth(s.overlap.depth))
    return watch_.depth_text(quote(link_names_[s.overlap.loaded_link]), quote(*s.overlap.obstacle), s.overlap.depth);
  if (!watch_.allows(s.pose.position, s.twist)) return watch_.speed_text(s.pose.position, s.twist);
  for (std::size_t i = 1; i < joints_.size(); ++i) {
    const double speed = std::abs(s.joints[i].velocity) * std::sqrt(joints_[i].reach_square);
    if (!(speed * speed < watch_.allowed_square(s.pose.position)))
      return watch_.speed_text(s.pose.position, "what " + quote(joint_names_[i]) + " carries moves", speed);
  }
  return "its joints are no longer finite";
}

std::string WorldRobot::likely_cause() const {
  const RobotState& s = state_;
  if (!watch_.allows_depth(s.overlap.depth)) return watch::cause_of_depth;
  if (s.overlap.obstacle && s.overlap.depth > 0.01)
    return "it is " + number_text(s.overlap.depth) + " m deep in " + quote(*s.overlap.obstacle) +
           ": start it clear of that";
  double force = 0, least = model_.mass, most = 0;
  for (const Wrench& w : s.external) force = std::max(force, w.force.norm());
  for (const RigidBody& body : model_.bodies) {
    least = std::min(least, body.inertia.mass);
    most = std::max(most, body.inertia.mass);
  }
  if (constexpr double hard_push = 1e4; force > hard_push * model_.mass)  // m/s^2
    return "an external force of " + number_text(force) + " N acts on it";
  if (constexpr double far_apart = 1e3; most > far_apart * least)
    return "masses of its links differ by a factor of " + std::to_string(std::llround(most / least));
  return "forces that grow from step to step, since steps are too long for its drives, joints or contacts";
}

std::string WorldRobot::failure_text(const std::string& failure) const {
  return quote(model_.name) + ": " + failure + ". Likely cause: " + likely_cause() + "; try " + std::string(advice_);
}

void WorldRobot::check_input() const {
  bool fine = watch::is_somewhere(state_.pose, state_.twist);
  for (std::size_t i = 1; i < joints_.size(); ++i)
    fine = fine && std::abs(state_.joints[i].position) + std::abs(state_.joints[i].velocity) < watch::beyond;
  if (!fine)
    throw Error(quote(model_.name) +
                " has a pose, a twist or a joint that is not finite, or no orientation; look at what writes them");
}

void WorldRobot::add_contacts(int count) {
  if (!tells_applied_) return;
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    wrenches_[i].mean_contact.force += state_.contact[i].force / count;
    wrenches_[i].mean_contact.torque += state_.contact[i].torque / count;
  }
}

void WorldRobot::export_contacts() {
  if (state_.tells_contacts) {
    contacts_.clear();
    for (const ContactWrench& contact : state_.contacts) contacts_.push_back(contact);
  }
  bool has_body_states = false;
  for (std::size_t i = 0; i < wrenches_.size(); ++i) {
    const LinkWrenches& w = wrenches_[i];
    if (w.contact) *w.contact = at_link(i, state_.contact[i], has_body_states);
    if (w.applied) (*w.applied = at_link(i, w.mean_contact, has_body_states)) += w.used;
  }
}

/// Moves a wrench from the origin of a loaded link's body to the origin of the link. `has_body_states`: whether the
/// body states are those of this step.
Wrench WorldRobot::at_link(std::size_t number, const Wrench& at_body, bool& has_body_states) {
  Wrench w = at_body;
  const LinkPlacement& placement = model_.loaded_links[number].placement;
  if (placement.pose.position.isZero(0) || w.force.isZero(0)) return w;
  if (!has_body_states) forward_kinematics(model_, state_, body_states_);
  has_body_states = true;
  w.torque -= Vec3(body_states_[placement.body].pose.orientation * placement.pose.position).cross(w.force);
  return w;
}

}  // namespace muro::multibody
