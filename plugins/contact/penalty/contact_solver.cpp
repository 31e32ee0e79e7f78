// SPDX-License-Identifier: MIT
#include "contact_solver.hpp"

#include <algorithm>
#include <cmath>

#include "vectors.hpp"

namespace muro::penalty {
namespace {

using Block = BlockSystem::Block;

Mat3 crossing(const Vec3& r) { return (Mat3() << 0, -r.z(), r.y(), r.z(), 0, -r.x(), -r.y(), r.x(), 0).finished(); }

/// A damper of `across`, and of `along` in the direction of `n`.
Mat3 damper(double along, double across, const Vec3& n) {
  return across * Mat3::Identity() + ((along - across) * n) * n.transpose();
}

/// J_a' K J_b of a damper K in a point, at levers `a` and `b`, with J = (1, -r x).
Block at_levers(const Mat3& k, const Vec3& a, const Vec3& b) {
  const Mat3 of_a = crossing(a), turned = -k * crossing(b);
  Block block;
  block.topLeftCorner<3, 3>() = k;
  block.topRightCorner<3, 3>() = turned;
  block.bottomLeftCorner<3, 3>() = of_a * k;
  block.bottomRightCorner<3, 3>() = of_a * turned;
  return block;
}

Vec3 along(const Vec3& v, const Vec3& n) { return n.dot(v) * n; }

/// The part of a force that its limit leaves.
double part_within(const Vec3& force, double most) {
  const double size = force.norm();
  return size > most ? most / size : 1;
}

}  // namespace

void ContactSolver::start(double step) {
  step_ = step;
  bodies_.clear();
  contacts_.clear();
  velocities_.clear();
}

std::uint32_t ContactSolver::add_body(const law::Mobility<double>& mobility, const Vec3& velocity, const Vec3& spin) {
  const law::Symmetric<double>& i = mobility.inertia;
  const Mat3 inverse = (Mat3() << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz).finished();
  const Mat3 inertia = inverse.inverse();
  Body& body = bodies_.emplace_back();
  body.mass.setZero();
  body.mass.topLeftCorner<3, 3>().diagonal().setConstant(1 / mobility.mass);
  body.mass.bottomRightCorner<3, 3>() = 0.5 * (inertia + inertia.transpose());
  BlockSystem::Vector& v = velocities_.emplace_back();
  v << velocity, spin;
  body.momentum.noalias() = body.mass * v;
  return std::uint32_t(bodies_.size() - 1);
}

/// Of the own point over the other, m/s.
Vec3 ContactSolver::velocity_in(const SolverContact& c) const {
  const auto& own = velocities_[c.body];
  const Vec3 velocity = own.head<3>() + own.tail<3>().cross(c.lever) - c.touched;
  if (c.other == SolverContact::none) return velocity;
  const auto& other = velocities_[c.other];
  return velocity - other.head<3>() - other.tail<3>().cross(c.other_lever);
}

/// Its dampers on the left, its springs on the right.
void ContactSolver::add_terms(const SolverContact& c) {
  if (!c.pushes) return;
  const Mat3 k = damper(step_ * c.along, step_ * c.hold * c.across, c.normal);
  const Vec3 impulse = (step_ * c.push) * c.normal - (step_ * c.hold) * c.spring + k * c.touched;
  system_.diagonal(c.body) += at_levers(k, c.lever, c.lever);
  right_[c.body].head<3>() += impulse;
  right_[c.body].tail<3>() += c.lever.cross(impulse);
  if (c.other == SolverContact::none) return;
  system_.diagonal(c.other) += at_levers(k, c.other_lever, c.other_lever);
  system_.add(c.coupling, c.body, -at_levers(k, c.lever, c.other_lever));
  right_[c.other].head<3>() -= impulse;
  right_[c.other].tail<3>() -= c.other_lever.cross(impulse);
}

void ContactSolver::assemble() {
  system_.set_zero();
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    system_.diagonal(i) = bodies_[i].mass;
    right_[i] = bodies_[i].momentum;
  }
  for (const SolverContact& c : contacts_) add_terms(c);
}

/// What the contact does at the velocities that were found, within its limits. Returns whether that is something else
/// than what was taken for granted. `caution`: the part of a change that is taken back, from 0.
bool ContactSolver::revise(SolverContact& c, double caution) const {
  if (c.only_damps) return false;
  constexpr double precision = 2e-3;  // of the cone
  const Vec3 velocity = velocity_in(c);
  const bool pushed = c.pushes;
  const double load = c.push - c.along * c.normal.dot(velocity);
  c.pushes = load > 0;
  c.load = std::max(load, 0.0);
  if (!c.pushes) return pushed;
  const Vec3 across = c.spring + c.across * (velocity - along(velocity, c.normal));
  const double most = c.friction * c.load, found = part_within(across, most);
  const bool changed = !pushed || std::abs(found - c.hold) * across.norm() > precision * most;
  c.hold = found + caution * (c.hold - found);
  return changed;
}

/// At the velocities that were found, and within the cone.
void ContactSolver::find_force(SolverContact& c) const {
  c.force = Vec3::Zero();
  const Vec3 velocity = velocity_in(c);
  c.load = c.only_damps ? 0 : std::max(c.push - c.along * c.normal.dot(velocity), 0.0);
  if (!(c.load > 0)) return;
  const Vec3 across = c.spring + c.across * (velocity - along(velocity, c.normal));
  c.hold = std::min(c.hold, part_within(across, c.friction * c.load));
  c.force = c.load * c.normal - c.hold * across;
}

std::span<const SolverContact> ContactSolver::solve() {
  constexpr int most_iterations = 24, sure_iterations = 6;
  constexpr double precision = 1e-9;  // m/s
  system_.start(std::uint32_t(bodies_.size()));
  right_.resize(bodies_.size());
  double mass = 0;
  for (const Body& b : bodies_) mass += b.mass(0, 0);
  for (SolverContact& c : contacts_)
    if (c.other != SolverContact::none) c.coupling = system_.couple(c.body, c.other);
  system_.find_order();
  for (int iteration = 1; iteration <= most_iterations; ++iteration) {
    assemble();
    system_.solve(right_, velocities_, mass * precision * precision);
    bool changed = false;
    for (SolverContact& c : contacts_) changed = revise(c, iteration > sure_iterations ? 0.5 : 0) || changed;
    if (!changed) break;
  }
  for (SolverContact& c : contacts_) find_force(c);
  return contacts_;
}

}  // namespace muro::penalty
