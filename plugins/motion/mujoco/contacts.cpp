// SPDX-License-Identifier: MIT
#include "contacts.hpp"

#include <cmath>

namespace muro::mujoco {

namespace {

using Frame = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>;

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 vector_of(const mjtNum* v) { return {v[0], v[1], v[2]}; }

}  // namespace

void Contacts::prepare(const Settings& settings, std::size_t geoms) {
  settings_ = settings;
  owners_.assign(geoms, {});
}

void Contacts::set_friction(mjData& d) {
  aims_.resize(std::size_t(d.ncon));
  for (int i = 0; i < d.ncon; ++i) {
    mjContact& c = d.contact[i];
    const Owner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    const double friction = std::sqrt(a.friction * b.friction);
    if (friction < mjMINMU) c.dim = 1;
    c.friction[0] = c.friction[1] = std::max(friction, mjMINMU);
  }
}

/// m/s, axes of the contact: what the rows do not know of the speed of the second body over the first.
Vec3 Contacts::speed_of_fixtures(const mjContact& c) const {
  Vec3 speed = Vec3::Zero();
  const Owner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
  if (a.twist) speed -= a.twist->at(vector_of(c.pos) - a.pose->position);
  if (b.twist) speed += b.twist->at(vector_of(c.pos) - b.pose->position);
  return a.twist || b.twist ? Vec3(Frame(c.frame) * speed) : speed;
}

void Contacts::set_reference(mjData& d, int id, int row, double dt) {
  const mjContact& c = d.contact[id];
  const Owner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
  Vec3 speed = speed_of_fixtures(c);
  for (int k = 0; k < c.dim; ++k) speed[k] += d.efc_vel[row + k];
  mjtNum* aim = d.efc_aref + row;
  const double restitution = std::max(a.restitution, b.restitution);
  const double recovery = -c.dist / std::max(settings_.time_constant, 2 * dt);
  const bool impact = speed[0] < -settings_.bounce_speed, bounces = impact && restitution > 0;
  aim[0] = ((bounces ? std::max(-restitution * speed[0], recovery) : recovery) - speed[0]) / dt;
  for (int k = 1; k < c.dim; ++k) aim[k] = -speed[k] / dt;
  Aim& kept = aims_[std::size_t(id)];
  kept = {aim[0], infinity};
  // accelerations of the last step say nothing of an impact, and must not hide it
  if (impact && c.dim == 3) kept.grip = std::hypot(aim[1] - d.efc_b[row + 1], aim[2] - d.efc_b[row + 2]);
  for (int k = 0; bounces && k < c.dim; ++k) {
    d.efc_R[row + k] *= (1 / mjMAXIMP - 1) / (1 / settings_.impedance - 1);
    d.efc_D[row + k] = 1 / d.efc_R[row + k];
  }
}

double Contacts::release_sliding(const mjModel& m, mjData& d, const mjtNum* acceleration) {
  if (d.ncon == 0) return 0;
  rows_.resize(std::size_t(d.nefc));
  mj_mulJacVec(&m, &d, rows_.data(), acceleration);
  double most = 0;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    const int row = c.efc_address;
    if (row < 0 || c.dim < 3) continue;
    const Aim& aim = aims_[std::size_t(i)];
    const double x = rows_[std::size_t(row) + 1] - d.efc_aref[row + 1];
    const double y = rows_[std::size_t(row) + 2] - d.efc_aref[row + 2];
    const double normal = aim.normal - c.friction[0] * std::min(std::hypot(x, y), aim.grip);
    most = std::max(most, std::abs(normal - d.efc_aref[row]));
    d.efc_aref[row] = normal;
  }
  return most;
}

void Contacts::export_wrenches(const mjData& d, std::deque<Robot>& robots) const {
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& c = d.contact[i];
    if (c.efc_address < 0) continue;
    Vec3 local = Vec3::Zero();
    for (int k = 0; k < c.dim; ++k) local[k] = d.efc_force[c.efc_address + k];
    const Vec3 force = Frame(c.frame).transpose() * local, point = vector_of(c.pos);
    const Owner &a = owners_[std::size_t(c.geom1)], &b = owners_[std::size_t(c.geom2)];
    if (a.robot >= 0) robots[std::size_t(a.robot)].add_contact(d, a.part, a.body, -force, point);
    if (b.robot >= 0) robots[std::size_t(b.robot)].add_contact(d, b.part, b.body, force, point);
  }
}

}  // namespace muro::mujoco
