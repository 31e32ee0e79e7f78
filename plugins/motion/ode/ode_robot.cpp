// SPDX-License-Identifier: MIT
#include "ode_robot.hpp"

#include <algorithm>
#include <cmath>

#include "muro/base/elementary.hpp"
#include "plugins/motion/common/multibody/free_rotation.hpp"

namespace muro::ode {

using multibody::JointState, multibody::RigidBody, multibody::BodyState, multibody::MotionType;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double min_far_stop = 3;  ///< rad

void set_pose(dBodyID body, const Vec3& centre, const Quat& q) {
  dQuaternion orientation;
  copy_quaternion(orientation, q);
  dBodySetPosition(body, centre.x(), centre.y(), centre.z());
  dBodySetQuaternion(body, orientation);
}

void set_velocity(dBodyID body, const Vec3& v, const Vec3& w) {
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

dReal ode_effort(double max_effort) { return std::isfinite(max_effort) ? max_effort : dInfinity; }

/// Returns `angle` wrapped to [-pi, pi].
double wrapped(double angle) { return angle - 2 * M_PI * std::nearbyint(angle / (2 * M_PI)); }

/// Whether ODE leaves the quaternion unchanged. ODE normalises what is set, and this can change the last bit of a unit
/// quaternion.
bool is_normalized(const dReal* q) {
  if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == 1) return true;
  dQuaternion normalized = {q[0], q[1], q[2], q[3]};
  dNormalize4(normalized);
  return std::equal(normalized, normalized + 4, q);
}

/// Whether a joint may have a rotor: its drive may set one in mode effort.
bool may_have_rotor(const RigidBody& body) {
  return body.limits.armature > 0 ||
         (body.joint != JointKind::fixed && body.drive == DriveMode::effort && body.leader < 0);
}

bool is_wheel(const RigidBody& body) {
  if (body.joint != JointKind::revolute || std::isfinite(body.limits.lower) || std::isfinite(body.limits.upper))
    return false;
  return std::any_of(body.shapes.begin(), body.shapes.end(), [](const multibody::BodyShape& s) {
    return s.shape.kind == ShapeKind::cylinder || s.shape.kind == ShapeKind::mesh;
  });
}
bool slides(const RigidBody& body) { return body.joint == JointKind::prismatic; }

}  // namespace

bool OdeRobot::keeps_rotors(const multibody::RobotModel& model, bool exact) {
  return !exact && std::any_of(model.bodies.begin(), model.bodies.end(), may_have_rotor);
}

std::size_t OdeRobot::memory_of(const multibody::RobotModel& model, bool exact) {
  const std::size_t count = model.bodies.size();
  return numbers * count + (keeps_rotors(model, exact) ? count : 0) + ContactHistory::size_of(model);
}

OdeRobot::OdeRobot(dWorldID world, dSpaceID space, const multibody::RobotModel& model, multibody::RobotState& state,
                   std::int32_t number, std::deque<GeomOwner>& owners, const OdeMeshes& meshes,
                   const OdeSettings& settings)
    : world_(world),
      space_(space),
      model_(&model),
      state_(&state),
      settings_(settings),
      rotates_exactly_(settings.exact_attitude && model.bodies.size() == 1 && !model.fixed_base),
      keeps_rotors_(keeps_rotors(model, settings.exact)),
      has_wheels_(std::any_of(model.bodies.begin(), model.bodies.end(), is_wheel) &&
                  std::none_of(model.bodies.begin(), model.bodies.end(), slides)),
      history_(state.memory.last(ContactHistory::size_of(model))),
      body_states_(model.bodies.size()) {
  multibody::RobotState zero;  // joints are created with all positions at 0
  zero.joints.resize(model.bodies.size());
  forward_kinematics(model, zero, body_states_);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    add_body(i);
    for (const multibody::BodyShape& s : model.bodies[i].shapes) {
      Pose pose = s.shape.origin;
      pose.position -= bodies_[i].com;
      const dGeomID geom = create_geom(s.shape, pose, bodies_[i].id, space, meshes);
      if (!geom) continue;
      owners.push_back({std::uint32_t(owners.size()), number, std::uint32_t(i), s.loaded_link, s.shape.surface,
                        contact_geometry::extent_of(s.shape)});
      owners.back().object = s.object;
      owners.back().convex = meshes.convex_shape(s.shape);
      dGeomSetData(geom, &owners.back());
      geoms_.push_back(geom);
    }
    if (i > 0) add_joint(i);
  }
}

void OdeRobot::add_body(std::size_t number) {
  const Inertia& inertia = model_->bodies[number].inertia;
  OdeBody& b = bodies_.emplace_back();
  b.id = dBodyCreate(world_);
  b.com = inertia.com;
  b.inertia = inertia.tensor();
  b.inverse_inertia = b.inertia.inverse();
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, inertia.ixx, inertia.iyy, inertia.izz, inertia.ixy, inertia.ixz,
                     inertia.iyz);
  dBodySetMass(b.id, &mass);
  dBodySetFiniteRotationMode(b.id, 1);
  dBodySetAutoDisableFlag(b.id, 0);
  if (rotates_exactly_) dBodySetGyroscopicMode(b.id, 0);
  if (number == 0 && model_->fixed_base) dBodySetKinematic(b.id);
  set_pose(b.id, body_states_[number].pose * b.com, body_states_[number].pose.orientation);
}

void OdeRobot::add_joint(std::size_t number) {
  const RigidBody& body = model_->bodies[number];
  OdeBody& b = bodies_[number];
  const dBodyID parent = bodies_[std::size_t(body.parent)].id;
  const Vec3 axis = body_states_[number].pose.orientation * body.axis, anchor = body_states_[number].pose.position;
  const double damping = body.limits.damping;
  if (body.joint == JointKind::revolute) {
    b.joint = dJointCreateHinge(world_, nullptr);
    dJointAttach(b.joint, b.id, parent);
    dJointSetHingeAnchor(b.joint, anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(b.joint, axis.x(), axis.y(), axis.z());
  } else {
    b.joint = dJointCreateSlider(world_, nullptr);
    dJointAttach(b.joint, b.id, parent);
    dJointSetSliderAxis(b.joint, axis.x(), axis.y(), axis.z());
  }
  b.only_rotates = body.joint == JointKind::revolute;
  if (!b.only_rotates) bodies_[std::size_t(body.parent)].only_rotates = false;
  // At a stop, the motor of ODE's hinge or slider gives its full effort at any speed. So a joint with stops gets its
  // own motor.
  if (std::isfinite(body.limits.lower) || std::isfinite(body.limits.upper)) b.drive = create_motor(number, axis);
  if (damping > 0 || may_have_rotor(body)) b.damper = create_motor(number, axis);
  if (keeps_rotors_ && may_have_rotor(body)) dJointSetFeedback(b.damper, &b.of_damper);
  if (damping > 0) {
    const auto set = body.joint == JointKind::revolute ? &dJointSetAMotorParam : &dJointSetLMotorParam;
    set(b.damper, dParamFMax, dInfinity);
    set(b.damper, dParamCFM, 1 / damping);
  }
  if (body.drive == DriveMode::position && body.leader < 0 && body.limits.friction > 0) {
    const dJointID brake = create_motor(number, axis);
    const auto set = body.joint == JointKind::revolute ? &dJointSetAMotorParam : &dJointSetLMotorParam;
    set(brake, dParamVel, 0);
    set(brake, dParamFMax, ode_effort(body.limits.friction));
  }
  if (settings_.reactions) dJointSetFeedback(b.drive ? b.drive : b.joint, &b.feedback);
  b.has_far_stops =
      body.joint == JointKind::revolute && ((std::isfinite(body.limits.lower) && body.limits.lower < -min_far_stop) ||
                                            (std::isfinite(body.limits.upper) && body.limits.upper > min_far_stop));
  if (!b.has_far_stops) set_stops(b, body.joint, body.limits.lower, body.limits.upper);
}

/// Creates a motor along or about `axis` (world) of the joint of a body.
dJointID OdeRobot::create_motor(std::size_t number, const Vec3& axis) const {
  const RigidBody& body = model_->bodies[number];
  const bool turns = body.joint == JointKind::revolute;
  const dJointID motor = turns ? dJointCreateAMotor(world_, nullptr) : dJointCreateLMotor(world_, nullptr);
  dJointAttach(motor, bodies_[number].id, bodies_[std::size_t(body.parent)].id);
  if (turns) {
    dJointSetAMotorNumAxes(motor, 1);
    dJointSetAMotorAxis(motor, 0, 1, axis.x(), axis.y(), axis.z());
  } else {
    dJointSetLMotorNumAxes(motor, 1);
    dJointSetLMotorAxis(motor, 0, 1, axis.x(), axis.y(), axis.z());
  }
  return motor;
}

double OdeRobot::inverse_effective_mass(std::size_t number, const Vec3& point, const Vec3& normal) const {
  if (motion_type_ != MotionType::dynamic || (number == 0 && model_->fixed_base)) return 0;
  const OdeBody& b = bodies_[number];
  const Quat to_body = quaternion_of(dBodyGetQuaternion(b.id)).conjugate();
  const Vec3 lever = to_body * Vec3((point - vector_of(dBodyGetPosition(b.id))).cross(normal));
  return 1 / model_->bodies[number].inertia.mass + lever.dot(b.inverse_inertia * lever);
}

Vec3 OdeRobot::free_acceleration(std::size_t number) const {
  if (motion_type_ != MotionType::dynamic || (number == 0 && model_->fixed_base)) return Vec3::Zero();
  return settings_.gravity + vector_of(dBodyGetForce(bodies_[number].id)) / model_->bodies[number].inertia.mass;
}

/// 1/kg or 1/(kg m^2): inverse inertia that the joint of each body moves. For the exact solver all links behind a joint
/// count as one body, which may be far heavier than the body next to the joint. This is too stiff for the iterations of
/// the quick solver: there only the two bodies at the joint count.
std::vector<double> OdeRobot::inverse_joint_inertias() const {
  const auto& bodies = model_->bodies;
  std::vector<Inertia> moved(bodies.size());  // in the frame of each body
  for (std::size_t i = bodies.size(); i-- > 0;) {
    moved[i] = moved[i] + bodies[i].inertia;
    if (i == 0 || !settings_.exact) continue;
    Inertia& parent = moved[std::size_t(bodies[i].parent)];
    parent = parent + moved[i].in(bodies[i].origin);
  }
  std::vector<double> inverses(bodies.size(), 0.0);
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const RigidBody& body = bodies[i];
    const auto inverse = [&](const Inertia& inertia, const Vec3& axis) {
      return body.joint == JointKind::revolute ? axis.dot(inertia.tensor().inverse() * axis) : 1 / inertia.mass;
    };
    inverses[i] = inverse(moved[i], body.axis);
    if (body.parent > 0 || !model_->fixed_base)
      inverses[i] += inverse(moved[std::size_t(body.parent)], body.origin.orientation * body.axis);
  }
  return inverses;
}

void OdeRobot::set_step(double dt) {
  dt_ = dt;
  const std::vector<double> inverse_inertias = inverse_joint_inertias();
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    OdeBody& b = bodies_[i];
    const bool turns = model_->bodies[i].joint == JointKind::revolute;
    constexpr double part =
        0.01;  // of the softness of contacts: a drive that gives way creeps, and its robot falls over
    const double cfm = settings_.cfm + part * settings_.softness * dt * inverse_inertias[i];
    const auto set_joint = turns ? &dJointSetHingeParam : &dJointSetSliderParam;
    set_joint(b.joint, dParamCFM, cfm);
    set_joint(b.joint, dParamStopCFM, cfm);
    if (b.drive) (turns ? dJointSetAMotorParam : dJointSetLMotorParam)(b.drive, dParamCFM, cfm);
    b.cfm = b.least_cfm = cfm;
  }
}

void OdeRobot::set_motion_type(MotionType motion_type) {
  if (motion_type == motion_type_) return;
  motion_type_ = motion_type;
  for (const dGeomID geom : geoms_) motion_type == MotionType::disabled ? dGeomDisable(geom) : dGeomEnable(geom);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    motion_type == MotionType::disabled ? dBodyDisable(bodies_[i].id) : dBodyEnable(bodies_[i].id);
    const bool moved = motion_type == MotionType::dynamic && !(i == 0 && model_->fixed_base);
    moved ? dBodySetDynamic(bodies_[i].id) : dBodySetKinematic(bodies_[i].id);
  }
}

void OdeRobot::import() {
  set_motion_type(state_->motion_type);
  if (motion_type_ == MotionType::disabled) return;
  if (motion_type_ == MotionType::kinematic || state_->moved_from_outside)
    set_bodies_from_state();
  else if (!bodies_match_memory_)
    set_bodies_from_memory();
  bodies_match_memory_ = false;
  if (state_->moved_from_outside) history_.clear();
  for (OdeBody& b : bodies_) b.start = quaternion_of(dBodyGetQuaternion(b.id));
  state_->clear_contacts();
  if (motion_type_ != MotionType::dynamic) return;
  set_forces();
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    if (keeps_rotors_ && state_->moved_from_outside) rotor_speed(i) = state_->joints[i].velocity;
    set_drive_target(i);
    const double armature = model_->bodies[i].limits.armature + state_->joints[i].drive_armature;
    if (armature != 0 || bodies_[i].armature != 0) set_rotor(i, armature);
  }
}

/// Models a rotor (kg m^2 or kg) as a damper relative to its present speed, of armature / dt. It takes the impulse
/// armature (v - v') within the step, whatever drives the joint. Iterations do not end with equal speeds of joint and
/// rotor, so there the rotor keeps its own speed. Otherwise the rotor would gain energy from the remaining error.
void OdeRobot::set_rotor(std::size_t number, double armature) {
  OdeBody& b = bodies_[number];
  const RigidBody& body = model_->bodies[number];
  const double rotor = armature / dt_, damping = body.limits.damping + rotor;
  const auto set = body.joint == JointKind::revolute ? &dJointSetAMotorParam : &dJointSetLMotorParam;
  const double speed = keeps_rotors_ ? rotor_speed(number) : state_->joints[number].velocity;
  b.damper_speed = damping > 0 ? speed * (rotor / damping) : 0;
  b.damper_cfm = damping > 0 ? 1 / damping : 0;
  set(b.damper, dParamVel, b.damper_speed);
  set(b.damper, dParamFMax, damping > 0 ? dInfinity : 0);
  if (damping > 0) set(b.damper, dParamCFM, b.damper_cfm);
  b.armature = armature;
}

double& OdeRobot::rotor_speed(std::size_t number) const { return state_->memory[numbers * bodies_.size() + number]; }

/// rad/s or m/s: speed of the rotor after the step, from the effort of its damper.
double OdeRobot::speed_of_rotor(std::size_t number) const {
  const OdeBody& b = bodies_[number];
  if (b.armature == 0) return state_->joints[number].velocity;
  const RigidBody& body = model_->bodies[number];
  const Vec3 effort = vector_of(body.joint == JointKind::revolute ? b.of_damper.t1 : b.of_damper.f1);
  return b.damper_speed - b.damper_cfm * Vec3(b.start * body.axis).dot(effort);
}

void OdeRobot::set_bodies_from_state() {
  forward_kinematics(*model_, *state_, body_states_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyState& m = body_states_[i];
    const Vec3 arm = m.pose.orientation * bodies_[i].com;
    set_pose(bodies_[i].id, m.pose.position + arm, m.pose.orientation);
    set_velocity(bodies_[i].id, m.twist.at(arm), m.twist.angular);
  }
}

/// Places bodies from the memory. A step begins with the same bits as when bodies stay where the last step ended: see
/// export_state().
void OdeRobot::set_bodies_from_memory() {
  const double* m = state_->memory.data();
  for (const OdeBody& b : bodies_) {
    set_pose(b.id, vector_of(m), quaternion_of(m + 3));
    set_velocity(b.id, vector_of(m + 7), vector_of(m + 10));
    m += numbers;
  }
}

void OdeRobot::set_forces() {
  if (!state_->has_external_wrench) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Wrench& w = state_->external[i];
    if (w.force.isZero(0) && w.torque.isZero(0)) continue;
    const Vec3 arm = quaternion_of(dBodyGetQuaternion(bodies_[i].id)) * bodies_[i].com;
    const Vec3 torque = w.torque - arm.cross(w.force);
    dBodyAddForce(bodies_[i].id, w.force.x(), w.force.y(), w.force.z());
    dBodyAddTorque(bodies_[i].id, torque.x(), torque.y(), torque.z());
  }
}

void OdeRobot::set_drive_target(std::size_t number) {
  const RigidBody& body = model_->bodies[number];
  const multibody::DriveTarget& target = state_->joints[number].target;
  const bool turns = body.joint == JointKind::revolute;
  const dJointID joint = bodies_[number].joint, drive = bodies_[number].drive;
  const double velocity = target.tracks_velocity ? target.velocity : 0;
  const double max_effort = target.tracks_velocity ? target.max_effort : target.friction;
  const auto set = drive ? (turns ? &dJointSetAMotorParam : &dJointSetLMotorParam)
                         : (turns ? &dJointSetHingeParam : &dJointSetSliderParam);
  if (velocity != bodies_[number].velocity) set(drive ? drive : joint, dParamVel, velocity);
  if (max_effort != bodies_[number].max_effort) set(drive ? drive : joint, dParamFMax, ode_effort(max_effort));
  const double least_cfm = bodies_[number].least_cfm;
  const double cfm = target.tracks_velocity ? std::max(least_cfm, target.softness()) : least_cfm;
  if (cfm != bodies_[number].cfm) set(drive ? drive : joint, dParamCFM, cfm);
  bodies_[number].cfm = cfm;
  bodies_[number].velocity = velocity;
  bodies_[number].max_effort = max_effort;
  if (!target.tracks_velocity && target.effort != 0)
    turns ? dJointAddHingeTorque(joint, target.effort) : dJointAddSliderForce(joint, target.effort);
  if (bodies_[number].has_far_stops) set_near_stops(number);
}

void OdeRobot::set_stops(const OdeBody& body, JointKind kind, double low, double high) {
  const auto set = kind == JointKind::revolute ? &dJointSetHingeParam : &dJointSetSliderParam;
  set(body.joint, dParamLoStop, std::isfinite(low) ? low : -dInfinity);
  set(body.joint, dParamHiStop, std::isfinite(high) ? high : dInfinity);
  set(body.joint, dParamLoStop, std::isfinite(low) ? low : -dInfinity);  // ignored while above the other
}

/// Sets the stops that are near. ODE knows the angle of a hinge only up to whole turns, so a stop that may be more than
/// half a turn away is set only when it is near.
void OdeRobot::set_near_stops(std::size_t number) const {
  const JointLimits& l = model_->bodies[number].limits;
  const double q = state_->joints[number].position;
  const auto near = [&](double limit) {
    return std::isfinite(limit) && std::abs(q - limit) < std::min(1.0, M_PI - std::abs(wrapped(limit)));
  };
  set_stops(bodies_[number], JointKind::revolute, near(l.lower) ? wrapped(l.lower) : -infinity,
            near(l.upper) ? wrapped(l.upper) : infinity);
}

/// Returns the state that its joints need: pose and twist of a base and of bodies on sliders, the rotation of the
/// others.
BodyState OdeRobot::body_state_of(std::size_t number) const {
  const OdeBody& b = bodies_[number];
  const double* const memory = state_->memory.data() + numbers * number;
  BodyState s;
  s.pose.orientation = quaternion_of(memory + 3);
  s.twist.angular = vector_of(memory + 10);
  if (b.only_rotates) return s;
  const Vec3 arm = s.pose.orientation * b.com;
  s.pose.position = vector_of(memory) - arm;
  s.twist.linear = vector_of(memory + 7) - s.twist.angular.cross(arm);
  return s;
}

void OdeRobot::export_state(double dt) {
  if (motion_type_ != MotionType::dynamic) return;
  if (rotates_exactly_) rotate_exactly(dt);
  double* m = state_->memory.data();
  for (const OdeBody& b : bodies_) {
    std::copy_n(dBodyGetPosition(b.id), 3, m);
    std::copy_n(dBodyGetQuaternion(b.id), 4, m + 3);
    if (!is_normalized(m + 3)) dBodySetQuaternion(b.id, m + 3);
    std::copy_n(dBodyGetLinearVel(b.id), 3, m + 7);
    std::copy_n(dBodyGetAngularVel(b.id), 3, m + 10);
    m += numbers;
  }
  bodies_match_memory_ = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) body_states_[i] = body_state_of(i);
  if (!model_->fixed_base) {
    state_->pose = body_states_[0].pose;
    state_->twist = body_states_[0].twist;
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) {
    export_joint(i, dt);
    if (keeps_rotors_) rotor_speed(i) = speed_of_rotor(i);
  }
}

/// Replaces ODE's orientation. ODE has changed the spin by torques only.
void OdeRobot::rotate_exactly(double dt) {
  const OdeBody& b = bodies_[0];
  multibody::FreeRotation free{b.start, vector_of(dBodyGetAngularVel(b.id))};
  free.advance(b.inertia, b.inverse_inertia, dt);
  dQuaternion orientation;
  copy_quaternion(orientation, free.orientation);
  dBodySetQuaternion(b.id, orientation);
  dBodySetAngularVel(b.id, free.spin.x(), free.spin.y(), free.spin.z());
}

void OdeRobot::export_joint(std::size_t number, double dt) {
  const RigidBody& body = model_->bodies[number];
  const BodyState &child = body_states_[number], &parent = body_states_[std::size_t(body.parent)];
  JointState& joint = state_->joints[number];
  const Vec3 axis = child.pose.orientation * body.axis;
  const OdeBody& b = bodies_[number];
  // forces belong to the pose at the start of the step
  const Vec3 effort_axis = b.start * body.axis;
  const Vec3 force = vector_of(b.feedback.f1), torque = vector_of(b.feedback.t1);
  if (body.joint == JointKind::revolute) {
    const Quat rotation = (parent.pose.orientation * body.origin.orientation).conjugate() * child.pose.orientation;
    const double angle = 2 * elementary::atan2(rotation.vec().dot(body.axis), rotation.w());
    const double expected = joint.position + dt * joint.velocity;
    joint.position = expected + wrapped(angle - expected);
    joint.velocity = axis.dot(child.twist.angular - parent.twist.angular);
    if (settings_.reactions) joint.effort = effort_axis.dot(torque + Vec3(b.start * b.com).cross(force));
  } else {
    const Vec3 zero = parent.pose * body.origin.position;  // position of the child with the joint at 0
    joint.position = axis.dot(child.pose.position - zero);
    joint.velocity = axis.dot(child.twist.linear - parent.twist.at(child.pose.position - parent.pose.position));
    joint.effort = effort_axis.dot(force);
  }
  if (!joint.target.tracks_velocity) joint.effort = joint.target.effort;
}

void OdeRobot::add_contact(const GeomOwner& owner, const Vec3& force, const Vec3& torque) {
  const OdeBody& b = bodies_[owner.body];
  const Vec3 arm = quaternion_of(dBodyGetQuaternion(b.id)) * b.com;
  Wrench& sum = state_->contact[owner.loaded_link];
  sum.add_force(force, arm);
  sum.torque += torque;
}

}  // namespace muro::ode
