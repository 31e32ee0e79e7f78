// SPDX-License-Identifier: MIT
#include "mujoco_contacts.hpp"

#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::mujoco {

namespace {

using Frame = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double slow_recovery = 2e-2;  ///< m/s: a body that lands may rebound at this speed
constexpr double shallow = 1e-3;        ///< m: overlaps up to this are corrected at that speed, in one solution
/// A contact is no softer than for a link with the mass of the lighter robot divided by this.
constexpr double most_carried = 100;

/// m/s^2: lift by the cone of a contact that slides, spins and rolls by `slip(k)` in its row k.
template <class Slip>
double lift_of(const mjContact& c, const Slip& slip) {
  if (c.dim == 3) return c.friction[0] * elementary::hypot(slip(1), slip(2));
  double sum = 0;
  for (int k = 1; k < c.dim; ++k) sum += c.friction[k - 1] * c.friction[k - 1] * slip(k) * slip(k);
  return std::sqrt(sum);
}

/// m/s: rebound speed of bodies that meet with the speed `approach` (m/s), both in the middle of a step. The impact was
/// earlier in the step. Since then `pull` (m/s^2) has accelerated the bodies along their depth (m). They separate with
/// the energy that Newton's law leaves at the impact, plus the energy that the pull takes on the way back.
double rebound_speed(double restitution, double approach, double pull, double depth, double dt) {
  const double half_step = 0.5 * pull * dt, of_depth = 2 * pull * depth;
  const double in = std::max(0.0, (approach + half_step) * (approach + half_step) - of_depth);
  return std::max(0.0, std::sqrt(std::max(0.0, restitution * restitution * in + of_depth)) - half_step);
}

}  // namespace

void MujocoContacts::prepare(const MujocoSettings& settings, std::size_t geoms) {
  settings_ = settings;
  owners_.assign(geoms, {});
}

void MujocoContacts::report_overlaps(const mjData& d, std::deque<MujocoRobot>& robots) const {
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    const GeomOwner &robot = a.robot >= 0 ? a : b, &other = a.robot >= 0 ? b : a;
    if (other.scenery && robot.robot >= 0)
      robots[std::size_t(robot.robot)].state().overlap.add(-c.dist, robot.loaded_link, *other.scenery);
  }
}

void MujocoContacts::find_terrain_contacts(const mjModel& m, mjData& d, const std::deque<MujocoRobot>& robots) const {
  if (terrains_.empty()) return;
  terrain_contact::TerrainContacts found;
  for (int g = 0; g < m.ngeom; ++g) {
    const GeomOwner& owner = owners_[std::size_t(g)];
    const int body = m.geom_bodyid[g];
    if (owner.robot < 0 || m.body_weldid[body] == 0 ||
        robots[std::size_t(owner.robot)].state().motion_type != multibody::MotionType::dynamic)
      continue;
    const mjtNum* const q = d.xquat + 4 * body;
    terrain_contact::ConvexShape shape = owner.convex;
    shape.pose = Pose{vector_of(d.xpos + 3 * body), Quat(q[0], q[1], q[2], q[3])} * owner.in_body;
    for (const Terrain& terrain : terrains_) {
      const int count = terrain_contact::find_contacts(terrain.map, terrain.pose, shape, 0, found);
      for (int i = 0; i < count; ++i) {
        const terrain_contact::TerrainContact& contact = found[std::size_t(i)];
        mjContact c{};
        c.dist = contact.gap;
        std::copy_n(contact.position.data(), 3, c.pos);
        const Vec3 tangent = contact.normal.unitOrthogonal(), bitangent = contact.normal.cross(tangent);
        std::copy_n(contact.normal.data(), 3, c.frame);
        std::copy_n(tangent.data(), 3, c.frame + 3);
        std::copy_n(bitangent.data(), 3, c.frame + 6);
        std::copy_n(m.geom_solref + mjNREF * g, mjNREF, c.solref);
        std::copy_n(m.geom_solimp + mjNIMP * g, mjNIMP, c.solimp);
        c.dim = 3;
        c.geom1 = terrain.geom;
        c.geom2 = g;
        c.efc_address = -1;
        mj_addContact(&m, &d, &c);
      }
    }
  }
}

void MujocoContacts::set_friction(mjData& d) {
  references_.resize(std::size_t(d.ncon));
  for (int i = 0; i < d.ncon; ++i) {
    mjContact& c = d.contact[i];
    const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    const Surface s = pair_surface(a.surface, b.surface, settings_.friction_rule);
    c.dim = s.rolling_resistance > mjMINMU ? 6 : s.spinning_resistance > mjMINMU ? 4 : s.friction < mjMINMU ? 1 : 3;
    c.friction[0] = c.friction[1] = std::max(s.friction, mjMINMU);
    c.friction[2] = std::max(s.spinning_resistance, mjMINMU);
    c.friction[3] = c.friction[4] = std::max(s.rolling_resistance, mjMINMU);
  }
  cells_.find(d, [this](const mjContact& c) {
    return contact_geometry::is_of_disc(owners_[std::size_t(c.geom1)].extent, owners_[std::size_t(c.geom2)].extent);
  });
}

/// Returns the part of the velocity of the second body relative to the first that is not in the rows.
MujocoContacts::ContactVelocity MujocoContacts::external_velocity(const mjContact& c, const ContactCell& cell) const {
  Vec3 speed = Vec3::Zero(), spin = Vec3::Zero();
  const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
  if (a.twist) speed -= a.twist->at(vector_of(c.pos) - a.pose->position), spin -= a.twist->angular;
  if (b.twist) speed += b.twist->at(vector_of(c.pos) - b.pose->position), spin += b.twist->angular;
  ContactVelocity velocity = ContactVelocity::Zero();
  if (!a.twist && !b.twist) return velocity;
  velocity << Frame(c.frame) * speed, Frame(c.frame) * spin;
  velocity.segment<2>(1) += (Frame(c.frame) * spin.cross(cell.shift)).tail<2>();
  return velocity;
}

/// kg: mass of the lighter of the touching robots.
double MujocoContacts::lighter_mass(const mjModel& m, const mjContact& c) const {
  double mass = infinity;
  for (const int geom : {c.geom1, c.geom2})
    if (owners_[std::size_t(geom)].robot >= 0)
      mass = std::min(mass, m.body_subtreemass[m.body_rootid[m.geom_bodyid[geom]]]);
  return mass;
}

void MujocoContacts::set_reference(const mjModel& m, mjData& d, int id, int row, double dt) {
  const mjContact& c = d.contact[id];
  const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
  const ContactCell& cell = cells_[id];
  ContactVelocity speed = external_velocity(c, cell);
  // PGS has computed its matrix already
  const bool may_yield = c.dim == 3 && m.opt.solver != mjSOL_PGS;
  const double ends = may_yield ? contact_geometry::speed_of_ends(cell.spin + speed[3], cell.shift) : 0;
  for (int k = 0; k < c.dim; ++k) speed[k] += d.efc_vel[row + k];
  mjtNum* target = d.efc_aref + row;
  const double restitution = pair_surface(a.surface, b.surface, settings_.friction_rule).restitution;
  const bool impact = speed[0] < -settings_.bounce_speed, bounces = impact && restitution > 0;
  const bool splits = !bounces && -c.dist > shallow;
  const double fastest = splits ? settings_.correcting_speed : std::min(slow_recovery, settings_.correcting_speed);
  const double recovery = bounces ? 0 : std::min(-c.dist / std::max(settings_.time_constant, 2 * dt), fastest);
  const double pull = -d.efc_b[row];  // m/s^2: towards each other
  const double wanted = bounces ? rebound_speed(restitution, -speed[0], pull, -c.dist, dt) : recovery;
  target[0] = (wanted - speed[0]) / dt;
  for (int k = 1; k < c.dim; ++k) target[k] = -speed[k] / dt;
  Reference& reference = references_[std::size_t(id)];
  reference = {target[0], infinity, splits && recovery > slow_recovery ? recovery / dt : 0, 0, ends / dt};
  // accelerations of the last step know nothing of an impact and must not hide it
  if (impact && c.dim >= 3) reference.max_lift = lift_of(c, [&](int k) { return target[k] - d.efc_b[row + k]; });
  const double unit_softness = 1 / settings_.impedance - 1;
  double softness = bounces ? (1 / mjMAXIMP - 1) / unit_softness : 1;
  softness = std::min(softness, unit_softness * most_carried / (lighter_mass(m, c) * d.efc_R[row]));
  for (int k = 0; softness < 1 && k < c.dim; ++k) {
    d.efc_R[row + k] *= softness;
    d.efc_D[row + k] = 1 / d.efc_R[row + k];
  }
  if (c.dim == 3) reference.least_softness = d.efc_R[row + 1];
}

bool MujocoContacts::leave_overlaps(mjData& d) {
  bool pushes = false;
  for (int i = 0; i < d.ncon; ++i) {
    const int row = d.contact[i].efc_address;
    pushes = pushes || (row >= 0 && references_[std::size_t(i)].recovery > 0 && d.efc_force[row] > 0);
  }
  for (int i = 0; pushes && i < d.ncon; ++i) {
    const int row = d.contact[i].efc_address;
    if (row < 0) continue;
    Reference& reference = references_[std::size_t(i)];
    reference.normal -= reference.recovery;
    d.efc_aref[row] -= reference.recovery;
  }
  return pushes;
}

/// Sets the softness of a contact's friction rows for a normal force of `pressure` (N). Returns the change (m/s^2) by
/// the new softness.
double MujocoContacts::soften(mjData& d, int id, double pressure) const {
  mjContact& c = d.contact[id];
  const Reference& reference = references_[std::size_t(id)];
  const double limit = c.friction[0] * pressure, before = d.efc_R[c.efc_address + 1];
  const double now = limit > 0 ? std::max(reference.ends / limit, reference.least_softness) : reference.least_softness;
  for (int k = 1; k < 3; ++k) {
    d.efc_R[c.efc_address + k] = now;
    d.efc_D[c.efc_address + k] = 1 / now;
  }
  c.mu = c.friction[0] * std::sqrt(now / d.efc_R[c.efc_address]);
  return std::abs(now - before) * limit;
}

double MujocoContacts::correct_for_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration, bool is_solved) {
  if (d.ncon == 0) return 0;
  constexpr double at_rest = 1;  // m/s^2: up to this acceleration, forces of the last step are a good guess
  rows_.resize(std::size_t(d.nefc));
  mj_mulJacVec(&m, &d, rows_.data(), acceleration);
  double largest_change = 0;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    const int row = c.efc_address;
    if (row < 0 || c.dim < 3) continue;
    const Reference& reference = references_[std::size_t(i)];
    double by_ends = 0;
    if (reference.ends > 0) {
      const double away = rows_[std::size_t(row)];
      const double pressure = is_solved                  ? d.efc_force[row]
                              : std::abs(away) < at_rest ? (reference.normal - away) * d.efc_D[row]
                                                         : 0;
      largest_change = std::max(largest_change, soften(d, i, pressure));
      by_ends = c.friction[0] * c.friction[0] * d.efc_R[row + 1] * std::max(pressure, 0.0);
    }
    const double lift =
        std::max(0.0, lift_of(c, [&](int k) { return rows_[std::size_t(row + k)] - d.efc_aref[row + k]; }) - by_ends);
    const double normal = reference.normal - std::min(lift, reference.max_lift);
    largest_change = std::max(largest_change, std::abs(normal - d.efc_aref[row]));
    d.efc_aref[row] = normal;
  }
  return largest_change;
}

void MujocoContacts::export_wrenches(const mjData& d, std::deque<MujocoRobot>& robots) const {
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    if (c.efc_address < 0) continue;
    ContactVelocity local = ContactVelocity::Zero();
    for (int k = 0; k < c.dim; ++k) local[k] = d.efc_force[c.efc_address + k];
    const Vec3 force = Frame(c.frame).transpose() * local.head<3>(), point = vector_of(c.pos),
               friction = force - local[0] * vector_of(c.frame);
    const Vec3 torque = Frame(c.frame).transpose() * local.tail<3>() + cells_[i].shift.cross(friction);
    const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    if (a.robot >= 0) robots[std::size_t(a.robot)].add_contact(d, a.body, a.loaded_link, -force, -torque, point);
    if (b.robot >= 0) robots[std::size_t(b.robot)].add_contact(d, b.body, b.loaded_link, force, torque, point);
    // MuJoCo's normal points from the first to the second
    const auto is_dynamic = [&robots](const GeomOwner& owner) {
      return owner.robot >= 0 && robots[std::size_t(owner.robot)].state().motion_type == multibody::MotionType::dynamic;
    };
    const auto tell = [&](const GeomOwner& self, const GeomOwner& other, double sign) {
      multibody::RobotState& state = robots[std::size_t(self.robot)].state();
      if (state.tells_contacts)
        state.contacts.push_back(
            {self.object, other.object, point, sign * vector_of(c.frame), -c.dist, {sign * force, sign * torque}});
    };
    if (is_dynamic(a)) tell(a, b, -1);
    if (is_dynamic(b) && b.robot != a.robot) tell(b, a, 1);
  }
}

}  // namespace muro::mujoco
