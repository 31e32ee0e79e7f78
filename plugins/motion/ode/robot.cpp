// SPDX-License-Identifier: MIT
#include "robot.hpp"

#include <cmath>

namespace muro::ode {

using multibody::JointState, multibody::Part, multibody::PartMotion, multibody::Presence;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nearest_far_stop = 3;  ///< rad

void set_place(dBodyID body, const Vec3& centre, const Quat& q) {
  const dQuaternion turn = {q.w(), q.x(), q.y(), q.z()};
  dBodySetPosition(body, centre.x(), centre.y(), centre.z());
  dBodySetQuaternion(body, turn);
}

void set_velocity(dBodyID body, const Vec3& v, const Vec3& w) {
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

dReal force_of(double most) { return std::isfinite(most) ? most : dInfinity; }

/// `angle` brought to [-pi, pi].
double wrapped(double angle) { return angle - 2 * M_PI * std::nearbyint(angle / (2 * M_PI)); }

/// ODE normalises what is set, which can change the last bit of what is normalised already.
bool stays_as_set(const dReal* q) {
  if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] == 1) return true;
  dQuaternion turn = {q[0], q[1], q[2], q[3]};
  dNormalize4(turn);
  return std::equal(turn, turn + 4, q);
}

}  // namespace

Robot::Robot(dWorldID world, dSpaceID space, const multibody::RobotModel& model, multibody::RobotState& state,
             std::int32_t number, std::deque<Owner>& owners, const Meshes& meshes, bool reactions)
    : world_(world), space_(space), model_(&model), state_(&state), reactions_(reactions), parts_(model.parts.size()) {
  multibody::RobotState straight;  // joints are made where all of them are at 0
  straight.joints.resize(model.parts.size());
  place_parts(model, straight, parts_);
  for (std::size_t i = 0; i < model.parts.size(); ++i) {
    add_body(i);
    for (const multibody::PartShape& s : model.parts[i].shapes) {
      Pose pose = s.shape.origin;
      pose.position -= bodies_[i].com;
      const dGeomID geom = make_geom(s.shape, pose, bodies_[i].id, space, meshes);
      if (!geom) continue;
      owners.push_back(
          {std::uint32_t(owners.size()), number, std::uint32_t(i), s.body, s.shape.friction, s.shape.restitution});
      dGeomSetData(geom, &owners.back());
      geoms_.push_back(geom);
    }
    if (i > 0) add_joint(i);
  }
}

void Robot::add_body(std::size_t part) {
  const Inertia& inertia = model_->parts[part].inertia;
  Body& b = bodies_.emplace_back();
  b.id = dBodyCreate(world_);
  b.com = inertia.com;
  dMass mass;
  dMassSetParameters(&mass, inertia.mass, 0, 0, 0, inertia.ixx, inertia.iyy, inertia.izz, inertia.ixy, inertia.ixz,
                     inertia.iyz);
  dBodySetMass(b.id, &mass);
  dBodySetFiniteRotationMode(b.id, 1);
  dBodySetAutoDisableFlag(b.id, 0);
  if (part == 0 && model_->fixed_base) dBodySetKinematic(b.id);
  set_place(b.id, parts_[part].pose * b.com, parts_[part].pose.orientation);
}

void Robot::add_joint(std::size_t number) {
  const Part& part = model_->parts[number];
  Body& b = bodies_[number];
  const dBodyID parent = bodies_[std::size_t(part.parent)].id;
  const Vec3 axis = parts_[number].pose.orientation * part.axis, anchor = parts_[number].pose.position;
  const double damping = part.limits.damping;
  if (part.joint == JointKind::revolute) {
    b.joint = dJointCreateHinge(world_, nullptr);
    dJointAttach(b.joint, b.id, parent);
    dJointSetHingeAnchor(b.joint, anchor.x(), anchor.y(), anchor.z());
    dJointSetHingeAxis(b.joint, axis.x(), axis.y(), axis.z());
  } else {
    b.joint = dJointCreateSlider(world_, nullptr);
    dJointAttach(b.joint, b.id, parent);
    dJointSetSliderAxis(b.joint, axis.x(), axis.y(), axis.z());
  }
  b.turns_alone = part.joint == JointKind::revolute;
  if (!b.turns_alone) bodies_[std::size_t(part.parent)].turns_alone = false;
  // At a stop, the motor of a hinge or slider of ODE gives all its effort whatever the speed: it needs one of its own.
  if (std::isfinite(part.limits.lower) || std::isfinite(part.limits.upper)) b.drive = make_motor(number, axis);
  if (damping > 0) {
    b.damper = make_motor(number, axis);
    const auto set = part.joint == JointKind::revolute ? &dJointSetAMotorParam : &dJointSetLMotorParam;
    set(b.damper, dParamFMax, dInfinity);
    set(b.damper, dParamCFM, 1 / damping);
  }
  if (reactions_) dJointSetFeedback(b.drive ? b.drive : b.joint, &b.feedback);
  b.far_stops = part.joint == JointKind::revolute &&
                ((std::isfinite(part.limits.lower) && part.limits.lower < -nearest_far_stop) ||
                 (std::isfinite(part.limits.upper) && part.limits.upper > nearest_far_stop));
  if (!b.far_stops) set_stops(b, part.joint, part.limits.lower, part.limits.upper);
}

/// A motor along or about `axis` (world) of the joint of a part.
dJointID Robot::make_motor(std::size_t number, const Vec3& axis) const {
  const Part& part = model_->parts[number];
  const bool turns = part.joint == JointKind::revolute;
  const dJointID motor = turns ? dJointCreateAMotor(world_, nullptr) : dJointCreateLMotor(world_, nullptr);
  dJointAttach(motor, bodies_[number].id, bodies_[std::size_t(part.parent)].id);
  if (turns) {
    dJointSetAMotorNumAxes(motor, 1);
    dJointSetAMotorAxis(motor, 0, 1, axis.x(), axis.y(), axis.z());
  } else {
    dJointSetLMotorNumAxes(motor, 1);
    dJointSetLMotorAxis(motor, 0, 1, axis.x(), axis.y(), axis.z());
  }
  return motor;
}

void Robot::set_presence(Presence presence) {
  if (presence == presence_) return;
  presence_ = presence;
  for (const dGeomID geom : geoms_) presence == Presence::absent ? dGeomDisable(geom) : dGeomEnable(geom);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    presence == Presence::absent ? dBodyDisable(bodies_[i].id) : dBodyEnable(bodies_[i].id);
    const bool moved = presence == Presence::simulated && !(i == 0 && model_->fixed_base);
    moved ? dBodySetDynamic(bodies_[i].id) : dBodySetKinematic(bodies_[i].id);
  }
}

void Robot::import() {
  set_presence(state_->presence);
  if (presence_ == Presence::absent) return;
  if (presence_ == Presence::obstacle || state_->moved_from_outside)
    place_by_parts();
  else if (!in_place_)
    place_from_memory();
  in_place_ = false;
  for (Wrench& w : state_->contact) w = Wrench{};
  if (presence_ != Presence::simulated) return;
  set_forces();
  for (std::size_t i = 1; i < bodies_.size(); ++i) set_drive(i);
}

void Robot::place_by_parts() {
  place_parts(*model_, *state_, parts_);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const PartMotion& m = parts_[i];
    const Vec3 arm = m.pose.orientation * bodies_[i].com;
    set_place(bodies_[i].id, m.pose.position + arm, m.pose.orientation);
    set_velocity(bodies_[i].id, m.twist.at(arm), m.twist.angular);
  }
}

/// A step begins with the same bits whether bodies are placed here or have stayed where the last step left them: see
/// export_state().
void Robot::place_from_memory() {
  const double* m = state_->memory.data();
  for (const Body& b : bodies_) {
    set_place(b.id, vector_of(m), quaternion_of(m + 3));
    set_velocity(b.id, vector_of(m + 7), vector_of(m + 10));
    m += numbers;
  }
}

void Robot::set_forces() {
  if (!state_->applied) return;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Wrench& w = state_->external[i];
    if (w.force.isZero(0) && w.torque.isZero(0)) continue;
    const Vec3 arm = quaternion_of(dBodyGetQuaternion(bodies_[i].id)) * bodies_[i].com;
    const Vec3 torque = w.torque - arm.cross(w.force);
    dBodyAddForce(bodies_[i].id, w.force.x(), w.force.y(), w.force.z());
    dBodyAddTorque(bodies_[i].id, torque.x(), torque.y(), torque.z());
  }
}

void Robot::set_drive(std::size_t number) {
  const Part& part = model_->parts[number];
  const multibody::Demand& d = state_->joints[number].demand;
  const bool turns = part.joint == JointKind::revolute;
  const dJointID joint = bodies_[number].joint, drive = bodies_[number].drive;
  const double speed = d.by_speed ? d.speed : 0, most = d.by_speed ? d.most : part.limits.friction;
  const auto set = drive ? (turns ? &dJointSetAMotorParam : &dJointSetLMotorParam)
                         : (turns ? &dJointSetHingeParam : &dJointSetSliderParam);
  if (speed != bodies_[number].speed) set(drive ? drive : joint, dParamVel, speed);
  if (most != bodies_[number].most) set(drive ? drive : joint, dParamFMax, force_of(most));
  bodies_[number].speed = speed;
  bodies_[number].most = most;
  if (!d.by_speed && d.effort != 0)
    turns ? dJointAddHingeTorque(joint, d.effort) : dJointAddSliderForce(joint, d.effort);
  if (bodies_[number].far_stops) set_near_stops(number);
}

void Robot::set_stops(const Body& body, JointKind kind, double low, double high) {
  const auto set = kind == JointKind::revolute ? &dJointSetHingeParam : &dJointSetSliderParam;
  set(body.joint, dParamLoStop, std::isfinite(low) ? low : -dInfinity);
  set(body.joint, dParamHiStop, std::isfinite(high) ? high : dInfinity);
  set(body.joint, dParamLoStop, std::isfinite(low) ? low : -dInfinity);  // not taken while it is above the other
}

/// Hinges of ODE know their angle up to whole turns: a stop that is farther off than half a turn is set when it is
/// near.
void Robot::set_near_stops(std::size_t number) const {
  const JointLimits& l = model_->parts[number].limits;
  const double q = state_->joints[number].position;
  const auto near = [&](double limit) {
    return std::isfinite(limit) && std::abs(q - limit) < std::min(1.0, M_PI - std::abs(wrapped(limit)));
  };
  set_stops(bodies_[number], JointKind::revolute, near(l.lower) ? wrapped(l.lower) : -infinity,
            near(l.upper) ? wrapped(l.upper) : infinity);
}

/// Of its pose and twist what its joints need: of a base and of what shifts all, of what turns the turning.
PartMotion Robot::motion_of(std::size_t part) const {
  const Body& b = bodies_[part];
  const double* const memory = state_->memory.data() + numbers * part;
  PartMotion m;
  m.pose.orientation = quaternion_of(memory + 3);
  m.twist.angular = vector_of(memory + 10);
  if (b.turns_alone) return m;
  const Vec3 arm = m.pose.orientation * b.com;
  m.pose.position = vector_of(memory) - arm;
  m.twist.linear = vector_of(memory + 7) - m.twist.angular.cross(arm);
  return m;
}

void Robot::export_state(double dt) {
  if (presence_ != Presence::simulated) return;
  double* m = state_->memory.data();
  for (const Body& b : bodies_) {
    std::copy_n(dBodyGetPosition(b.id), 3, m);
    std::copy_n(dBodyGetQuaternion(b.id), 4, m + 3);
    if (!stays_as_set(m + 3)) dBodySetQuaternion(b.id, m + 3);
    std::copy_n(dBodyGetLinearVel(b.id), 3, m + 7);
    std::copy_n(dBodyGetAngularVel(b.id), 3, m + 10);
    m += numbers;
  }
  in_place_ = true;
  for (std::size_t i = 0; i < bodies_.size(); ++i) parts_[i] = motion_of(i);
  if (!model_->fixed_base) {
    state_->pose = parts_[0].pose;
    state_->twist = parts_[0].twist;
  }
  for (std::size_t i = 1; i < bodies_.size(); ++i) export_joint(i, dt);
}

void Robot::export_joint(std::size_t number, double dt) {
  const Part& part = model_->parts[number];
  const PartMotion &child = parts_[number], &parent = parts_[std::size_t(part.parent)];
  JointState& joint = state_->joints[number];
  const Vec3 axis = child.pose.orientation * part.axis;
  const Body& b = bodies_[number];
  const Vec3 force = vector_of(b.feedback.f1), torque = vector_of(b.feedback.t1);
  if (part.joint == JointKind::revolute) {
    const Quat turn = (parent.pose.orientation * part.origin.orientation).conjugate() * child.pose.orientation;
    const double angle = 2 * std::atan2(turn.vec().dot(part.axis), turn.w());
    const double expected = joint.position + dt * joint.velocity;
    joint.position = expected + wrapped(angle - expected);
    joint.velocity = axis.dot(child.twist.angular - parent.twist.angular);
    if (reactions_) joint.effort = axis.dot(torque + Vec3(child.pose.orientation * b.com).cross(force));
  } else {
    const Vec3 seat = parent.pose * part.origin.position;  // of the joint at 0
    joint.position = axis.dot(child.pose.position - seat);
    joint.velocity = axis.dot(child.twist.linear - parent.twist.at(child.pose.position - parent.pose.position));
    joint.effort = axis.dot(force);
  }
  if (!joint.demand.by_speed) joint.effort = joint.demand.effort;
}

void Robot::add_contact(const Owner& owner, const Vec3& force, const Vec3& torque) {
  const Body& b = bodies_[owner.part];
  const Vec3 arm = quaternion_of(dBodyGetQuaternion(b.id)) * b.com;
  Wrench& sum = state_->contact[owner.body];
  sum.add_force(force, arm);
  sum.torque += torque;
}

}  // namespace muro::ode
