// SPDX-License-Identifier: MIT
// Contacts of a world of ODE: their parameters before a step, and the report of their forces.
#include <algorithm>
#include <cmath>

#include "ode_world.hpp"

namespace muro::ode {

using multibody::MotionType;

namespace {

constexpr double deep_softness = 0.1;               ///< part of the inverse effective mass
constexpr double resting_softness_at_1_kHz = 0.02;  ///< part of the same: points of a line or face share its load
constexpr double rebound_softness = 1e-6;           ///< part of the same
constexpr double slow_correction = 1e-2;            ///< m/s: a body that lands may rebound at this speed
constexpr double shallow = 1e-3;                    ///< m: shallower overlaps get this correction, without a SplitStep
constexpr double sliding_speed = 1e-2;              ///< m/s: friction is along the slip
constexpr double min_slip = 1e-9;                   ///< m/s: a slower slip has no direction
constexpr double min_load = 0.05;                   ///< part of the friction: a smaller load has no direction
constexpr double at_limit = 0.98;                   ///< part of the friction: a contact with more load may slide
constexpr double narrowest = 0.995;                 ///< part of the friction: along a load at the limit
constexpr double near_limit = 0.9;                  ///< part of the friction: a larger load counts as limited by it

Vec3 spin_of(dGeomID geom) {
  const dBodyID body = dGeomGetBody(geom);
  return body ? vector_of(dBodyGetAngularVel(body)) : Vec3::Zero();
}

}  // namespace

/// 1/kg: inverse effective mass along the normal.
double OdeWorld::inverse_mass_of(const FoundContact& found) const {
  double sum = 0;
  for (const GeomOwner* owner : {found.first, found.second})
    if (owner->robot >= 0)
      sum += robots_[std::size_t(owner->robot)].inverse_effective_mass(owner->body, found.point(), found.normal());
  return sum;
}

/// Spreads friction over lines and faces. Their points get the same softness, so that they share the load in the way of
/// a pressure over the patch.
void OdeWorld::find_patches() {
  FoundContact* const all = found_contacts_.data();
  const auto belongs = [&](std::size_t begin, std::size_t i) {
    const FoundContact &first = all[begin], &c = all[i];
    return c.first == first.first && c.second == first.second &&
           c.normal().dot(first.normal()) > contact_geometry::same_direction;
  };
  contact_geometry::each_patch(contact_count_, belongs, [&](std::size_t begin, std::size_t end) {
    const std::span<FoundContact> patch(all + begin, end - begin);
    double sum = 0;
    for (const FoundContact& c : patch) sum += inverse_mass_of(c);
    for (FoundContact& c : patch) c.inverse_mass = sum / double(patch.size()), c.cell.setZero();
    contact_geometry::find_cells(
        patch.size(), contact_geometry::is_of_disc(patch[0].first->extent, patch[0].second->extent),
        [&](std::size_t i) { return patch[i].contact.geom.pos; },
        [&](std::size_t i, const Vec3& cell) { patch[i].cell = cell; });
  });
}

void OdeWorld::describe_contacts() {
  find_patches();
  for (std::size_t i = 0; i < contact_count_; ++i) {
    FoundContact& found = found_contacts_[i];
    const dContactGeom& geom = found.contact.geom;
    OdeRobot& robot = robots_[std::size_t(found.first->robot)];
    if (found.second->scenery) robot.state().overlap.add(geom.depth, found.first->loaded_link, *found.second->scenery);
    const dReal* p = geom.pos;
    dVector3 of_first{}, of_second{};
    dBodyGetPointVel(dGeomGetBody(geom.g1), p[0], p[1], p[2], of_first);
    if (const dBodyID b = dGeomGetBody(geom.g2)) dBodyGetPointVel(b, p[0], p[1], p[2], of_second);
    found.velocity = vector_of(of_first) - vector_of(of_second);
    robot.history().recall(found);
    found.spin = found.normal().dot(spin_of(geom.g1) - spin_of(geom.g2));
    found.contact.surface.mode = dContactApprox1;  // ODE does not read fields without a flag in the mode
    const Surface pair = pair_surface(found.first->surface, found.second->surface, settings_.friction_rule);
    found.friction = pair.friction;
    describe_normal(found, pair.restitution);
    describe_friction(found);
    move_friction(found);
    dSurfaceParameters& surface = found.contact.surface;
    if (pair.rolling_resistance > 0 || pair.spinning_resistance > 0) {
      surface.mode |= dContactRolling;
      surface.rho = surface.rho2 = pair.rolling_resistance;
      surface.rhoN = pair.spinning_resistance;
    }
  }
}

/// Sets the normal direction. The CFM is in 1/(N s/m): ODE divides it by the time step and adds it to the inverse
/// effective mass.
void OdeWorld::describe_normal(FoundContact& found, double restitution) const {
  dSurfaceParameters& surface = found.contact.surface;
  const double approach = -found.velocity.dot(found.normal()),
               correction = settings_.erp * found.contact.geom.depth / dt_;
  found.is_rebound = restitution > 0 && approach > settings_.bounce_speed;
  const bool is_fast = !found.is_rebound && correction > slow_correction;
  found.splits = is_fast && found.contact.geom.depth > shallow;
  // A body deep inside another is often pushed from several sides at once; no forces can fulfil that.
  double softness = resting_softness(found);
  if (found.is_rebound)
    softness = std::min(softness, rebound_softness);
  else if (correction > settings_.correcting_speed)
    softness = std::max(softness, deep_softness);
  surface.mode |= dContactSoftCFM;
  surface.soft_cfm = settings_.cfm + softness * dt_ * found.inverse_mass;
  if (is_fast && !found.splits) {
    surface.mode |= dContactSoftERP;
    surface.soft_erp = settings_.erp * slow_correction / correction;
  }
  if (!found.is_rebound) return;
  surface.mode |= dContactBounce | dContactSoftERP;
  surface.bounce = rebound_speed(found, restitution, approach) / approach;
  surface.bounce_vel = 0;
  surface.soft_erp = 0;
}

/// Returns a softness with which robots on wheels, and bodies that spin on a face, sink in by some micrometres at any
/// rate. This holds for light links that carry a robot, too.
double OdeWorld::resting_softness(const FoundContact& found) const {
  constexpr double points = 6;
  const OdeRobot& robot = robots_[std::size_t(found.first->robot)];
  if (!robot.has_wheels() && !(found.speed_of_ends() > 0)) return settings_.softness;
  double lightest = robot.model().mass;
  if (found.second->robot >= 0) lightest = std::min(lightest, robots_[std::size_t(found.second->robot)].model().mass);
  return std::max(settings_.softness, resting_softness_at_1_kHz * std::min(1.0, 1e-6 / (dt_ * dt_)) *
                                          std::min(1.0, points / (lightest * found.inverse_mass)));
}

/// m/s: rebound speed, for velocities that belong to the middle of the step, like all velocities here. The impact was
/// earlier in the step. Since then bodies have been pulled together along their depth. They separate with the energy
/// that Newton's law leaves at the impact, plus the energy that the pull takes on the way back.
double OdeWorld::rebound_speed(const FoundContact& found, double restitution, double approach) const {
  Vec3 acceleration = Vec3::Zero();
  for (const GeomOwner* owner : {found.first, found.second})
    if (owner->robot >= 0)
      acceleration +=
          (owner == found.first ? -1 : 1) * robots_[std::size_t(owner->robot)].free_acceleration(owner->body);
  const double pull = acceleration.dot(found.normal()), of_depth = 2 * pull * found.contact.geom.depth,
               half_step = 0.5 * pull * dt_, speed = approach + half_step;
  const double in = std::max(0.0, speed * speed - of_depth);
  return std::max(0.0, std::sqrt(std::max(0.0, restitution * restitution * in + of_depth)) - half_step);
}

/// ODE limits friction along two directions separately. A sliding contact has friction along its slip and none across
/// it. A holding contact has friction along the load of the last step, within a rectangle inside the circle of
/// friction. The nearer the load is to the limit, the narrower is the rectangle.
void OdeWorld::describe_friction(FoundContact& found) const {
  dSurfaceParameters& surface = found.contact.surface;
  surface.mode |= dContactMu2 | dContactSlip1 | dContactSlip2;
  surface.slip1 = surface.slip2 = settings_.cfm + settings_.softness * dt_ * found.inverse_mass;
  const double friction = found.bound * found.friction;
  surface.mu = surface.mu2 = friction;
  if (friction == 0) return;
  const Vec3 normal = found.normal(), slip = found.slip();
  const double speed = slip.norm();
  const auto set_direction = [&](const Vec3& direction) {
    surface.mode |= dContactFDir1;
    std::copy_n(direction.data(), 3, found.contact.fdir1);
  };
  if (speed > sliding_speed) {
    found.drift = Vec3::Zero();
    set_direction(slip / speed);
    surface.mu2 = 0;
    return;
  }
  found.drift -= normal * normal.dot(found.drift);
  found.load -= normal * normal.dot(found.load);
  const double load = found.load.norm(), part = load / found.friction;
  if (part > min_load)
    set_direction(found.load / load);
  else if (speed > min_slip)
    set_direction(slip / speed);
  const double along = std::clamp(part + 0.1, M_SQRT1_2, narrowest);
  surface.mu = along * friction;
  surface.mu2 = std::sqrt(1 - along * along) * friction;
  if (found.speed_of_ends() > 0) found.drift.setZero();
  if (found.drift.isZero(0) || (surface.mode & dContactFDir1) == 0) return;
  const Vec3 first = vector_of(found.contact.fdir1), back = -settings_.erp / dt_ * found.drift;
  surface.mode |= dContactMotion1 | dContactMotion2;
  surface.motion1 = back.dot(first);
  surface.motion2 = back.dot(normal.cross(first));
}

/// Moves friction to the middle of the cell when a patch spins. ODE applies friction at the point, so the point gets
/// the speed of the middle, and the moment about the normal is corrected with the friction of the last step. The ends
/// of the cell move relative to its middle. While the middle is slower than the ends, friction of the cell is reduced
/// by the ratio of these speeds: its rows are softened for this.
void OdeWorld::move_friction(FoundContact& found) const {
  found.moment.setZero();
  const double ends = found.speed_of_ends();
  if (!(ends > 0) || found.friction == 0) return;
  dSurfaceParameters& surface = found.contact.surface;
  const Vec3 normal = found.normal(), against = -found.of_spin();
  if ((surface.mode & dContactFDir1) == 0 && !against.isZero(0)) {
    surface.mode |= dContactFDir1;
    std::copy_n(against.normalized().eval().data(), 3, found.contact.fdir1);
  }
  if ((surface.mode & dContactFDir1) != 0) {  // a spinning patch has no drift to correct
    const Vec3 first = vector_of(found.contact.fdir1);
    surface.mode |= dContactMotion1 | dContactMotion2;
    surface.motion1 = against.dot(first);
    surface.motion2 = against.dot(normal.cross(first));
  }
  const double limit = found.friction * found.pressure;
  if (!(limit > 0)) return;
  const double yield = ends / limit;
  surface.slip1 += yield;
  surface.slip2 += yield;
  const Vec3 force = found.pressure * (found.load - normal * normal.dot(found.load));
  found.moment = found.cell.cross(force);
  const auto add = [](dGeomID geom, const Vec3& torque) {
    if (const dBodyID body = dGeomGetBody(geom)) dBodyAddTorque(body, torque.x(), torque.y(), torque.z());
  };
  add(found.contact.geom.g1, found.moment);
  add(found.contact.geom.g2, -found.moment);
}

/// Sets the contact for the second pass of a SplitStep.
void OdeWorld::leave_overlap(FoundContact& found) const {
  dSurfaceParameters& surface = found.contact.surface;
  surface.mode |= dContactSoftERP;
  surface.soft_erp = 0;
  surface.soft_cfm = settings_.cfm + resting_softness(found) * dt_ * found.inverse_mass;
}

void OdeWorld::create_contact_joint(FoundContact& found) {
  const dJointID joint = dJointCreateContact(world_, contact_joints_, &found.contact);
  dJointAttach(joint, dGeomGetBody(found.contact.geom.g1), dGeomGetBody(found.contact.geom.g2));
  found.feedback = {};
  if (settings_.reactions || found.splits || found.friction > 0) dJointSetFeedback(joint, &found.feedback);
}

bool OdeWorld::moves(const GeomOwner& owner) const {
  return owner.robot >= 0 && robots_[std::size_t(owner.robot)].motion_type() == MotionType::dynamic;
}

/// Reports the contact to one of the two robots. ODE's torque is about the centre of mass.
void OdeWorld::tell_contact(const FoundContact& found, bool to_first) {
  const GeomOwner &self = to_first ? *found.first : *found.second, &other = to_first ? *found.second : *found.first;
  const dContactGeom& geom = found.contact.geom;
  multibody::RobotState& state = robots_[std::size_t(self.robot)].state();
  if (!state.tells_contacts) return;
  const Vec3 point = found.point(), normal = found.normal();
  ContactWrench told{self.object, other.object, point, to_first ? normal : Vec3(-normal), geom.depth};
  if (settings_.reactions) {
    told.wrench.force = vector_of(to_first ? found.feedback.f1 : found.feedback.f2);
    const dBodyID body = dGeomGetBody(to_first ? geom.g1 : geom.g2);
    const Vec3 centre = vector_of(dBodyGetPosition(body)) - dt_ * vector_of(dBodyGetLinearVel(body));  // at the start
    told.wrench.torque = found.torque(to_first) - (point - centre).cross(told.wrench.force);
  } else {
    told.wrench.force.setConstant(NAN);
    told.wrench.torque.setConstant(NAN);
  }
  state.contacts.push_back(told);
}

/// Stores the contact for the next step. The remaining slip of a contact that holds, or nearly holds, adds to its
/// drift.
void OdeWorld::remember(FoundContact& found) {
  if (found.friction == 0) return;
  const Vec3 normal = found.normal(), force = found.force();
  const double pressure = force.dot(normal);
  if (pressure <= 0) return;
  const Vec3 point = found.point();
  const auto velocity_of = [&](dGeomID geom) -> Vec3 {
    const dBodyID body = dGeomGetBody(geom);
    if (!body) return Vec3::Zero();
    const Vec3 velocity = vector_of(dBodyGetLinearVel(body));
    const Vec3 centre = vector_of(dBodyGetPosition(body)) - dt_ * velocity;  // at the start
    return velocity + vector_of(dBodyGetAngularVel(body)).cross(point - centre);
  };
  const double spin = normal.dot(spin_of(found.contact.geom.g1) - spin_of(found.contact.geom.g2));
  const Vec3 velocity =
      velocity_of(found.contact.geom.g1) - velocity_of(found.contact.geom.g2) + spin * normal.cross(found.cell);
  const Vec3 friction = force - normal * pressure, slip = velocity - normal * normal.dot(velocity);
  found.load = friction / pressure;
  found.pressure = pressure;
  const double part = found.load.norm() / found.friction;
  if (settings_.exact) {
    found.bound =
        part > near_limit ? std::clamp(narrowest * found.bound / part, 0.3, 1.0) : 1 + 0.9 * (found.bound - 1);
  }
  // The direct solver leaves slip only where friction is at its limit. Such slip is not corrected.
  if (slip.norm() < sliding_speed && !(settings_.exact && part > at_limit)) {
    found.drift += dt_ * slip;
    const double most = sliding_speed * dt_, far = found.drift.norm();
    if (far > most) found.drift *= most / far;
  }
  const Vec3 carried = vector_of(dBodyGetLinearVel(dGeomGetBody(found.contact.geom.g1)));
  robots_[std::size_t(found.first->robot)].history().store(found, point + dt_ * carried);
}

void OdeWorld::export_contacts() {
  for (OdeRobot& r : robots_) r.history().begin();
  const Vec3 unknown = Vec3::Constant(NAN);
  for (std::size_t i = 0; i < contact_count_; ++i) {
    FoundContact& found = found_contacts_[i];
    remember(found);
    if (moves(*found.first)) tell_contact(found, true);
    if (moves(*found.second) && found.second->robot != found.first->robot) tell_contact(found, false);
    const bool is_known = settings_.reactions;
    robots_[std::size_t(found.first->robot)].add_contact(
        *found.first, is_known ? vector_of(found.feedback.f1) : unknown, is_known ? found.torque(true) : unknown);
    if (found.second->robot >= 0)
      robots_[std::size_t(found.second->robot)].add_contact(
          *found.second, is_known ? vector_of(found.feedback.f2) : unknown, is_known ? found.torque(false) : unknown);
  }
}

}  // namespace muro::ode
