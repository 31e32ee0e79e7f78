// SPDX-License-Identifier: MIT
#include "mujoco_contacts.hpp"

#include <cmath>

#include "muro/toolkit/elementary.hpp"

namespace muro::mujoco {

namespace {

using Frame = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

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

void MujocoContacts::set_friction(mjData& d) {
  references_.resize(std::size_t(d.ncon));
  for (int i = 0; i < d.ncon; ++i) {
    mjContact& c = d.contact[i];
    const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    const double friction = pair_surface(a.surface, b.surface, settings_.friction_rule).friction;
    if (friction < mjMINMU) c.dim = 1;
    c.friction[0] = c.friction[1] = std::max(friction, mjMINMU);
  }
}

/// m/s, axes of the contact: what the rows do not know of the speed of the second body over the first.
Vec3 MujocoContacts::external_velocity(const mjContact& c) const {
  Vec3 speed = Vec3::Zero();
  const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
  if (a.twist) speed -= a.twist->at(vector_of(c.pos) - a.pose->position);
  if (b.twist) speed += b.twist->at(vector_of(c.pos) - b.pose->position);
  return a.twist || b.twist ? Vec3(Frame(c.frame) * speed) : speed;
}

void MujocoContacts::set_reference(mjData& d, int id, int row, double dt) {
  const mjContact& c = d.contact[id];
  const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
  Vec3 speed = external_velocity(c);
  for (int k = 0; k < c.dim; ++k) speed[k] += d.efc_vel[row + k];
  mjtNum* target = d.efc_aref + row;
  const double restitution = pair_surface(a.surface, b.surface, settings_.friction_rule).restitution;
  const double recovery = std::min(-c.dist / std::max(settings_.time_constant, 2 * dt), settings_.correcting_speed);
  const bool impact = speed[0] < -settings_.bounce_speed, bounces = impact && restitution > 0;
  target[0] = ((bounces ? std::max(-restitution * speed[0], recovery) : recovery) - speed[0]) / dt;
  for (int k = 1; k < c.dim; ++k) target[k] = -speed[k] / dt;
  Reference& reference = references_[std::size_t(id)];
  reference = {target[0], infinity};
  // accelerations of the last step say nothing of an impact, and must not hide it
  if (impact && c.dim == 3)
    reference.max_friction = elementary::hypot(target[1] - d.efc_b[row + 1], target[2] - d.efc_b[row + 2]);
  for (int k = 0; bounces && k < c.dim; ++k) {
    d.efc_R[row + k] *= (1 / mjMAXIMP - 1) / (1 / settings_.impedance - 1);
    d.efc_D[row + k] = 1 / d.efc_R[row + k];
  }
}

double MujocoContacts::correct_for_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration) {
  if (d.ncon == 0) return 0;
  rows_.resize(std::size_t(d.nefc));
  mj_mulJacVec(&m, &d, rows_.data(), acceleration);
  double largest_change = 0;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    const int row = c.efc_address;
    if (row < 0 || c.dim < 3) continue;
    const Reference& reference = references_[std::size_t(i)];
    const double x = rows_[std::size_t(row) + 1] - d.efc_aref[row + 1];
    const double y = rows_[std::size_t(row) + 2] - d.efc_aref[row + 2];
    const double normal = reference.normal - c.friction[0] * std::min(elementary::hypot(x, y), reference.max_friction);
    largest_change = std::max(largest_change, std::abs(normal - d.efc_aref[row]));
    d.efc_aref[row] = normal;
  }
  return largest_change;
}

void MujocoContacts::export_wrenches(const mjData& d, std::deque<MujocoRobot>& robots) const {
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    if (c.efc_address < 0) continue;
    Vec3 local = Vec3::Zero();
    for (int k = 0; k < c.dim; ++k) local[k] = d.efc_force[c.efc_address + k];
    const Vec3 force = Frame(c.frame).transpose() * local, point = vector_of(c.pos);
    const GeomOwner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    if (a.robot >= 0) robots[std::size_t(a.robot)].add_contact(d, a.body, a.loaded_link, -force, point);
    if (b.robot >= 0) robots[std::size_t(b.robot)].add_contact(d, b.body, b.loaded_link, force, point);
  }
}

}  // namespace muro::mujoco
