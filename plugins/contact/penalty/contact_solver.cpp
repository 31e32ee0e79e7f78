// SPDX-License-Identifier: MIT
#include "contact_solver.hpp"

#include <algorithm>
#include <cmath>

#include "plugins/common/lanes/vectors.hpp"

namespace muro::penalty {
namespace {

using Block = BlockSystem::Block;

/// Returns the matrix of a damper of `across`, and of `along` in the direction of `n`.
MURO_INLINE Mat3 damper(double along, double across, const Vec3& n) {
  const Vec3 more = (along - across) * n;
  Mat3 k;
  for (int j = 0; j < 3; ++j) k.col(j) = n[j] * more, k(j, j) += across;
  return k;
}

/// Adds J_a' K J_b of a damper K in a point, at levers `a` and `b`, with J = (1, -r x).
void add_at_levers(Block& block, const Mat3& k, const Vec3& a, const Vec3& b) {
  Mat3 turned;
  for (int i = 0; i < 3; ++i) {
    const double x = k(i, 0), y = k(i, 1), z = k(i, 2);
    turned(i, 0) = b.y() * z - b.z() * y;
    turned(i, 1) = b.z() * x - b.x() * z;
    turned(i, 2) = b.x() * y - b.y() * x;
  }
  const auto add = [&](int column, const Mat3& m) __attribute__((always_inline)) {
    for (int j = 0; j < 3; ++j) {
      double* const to = block.data() + 6 * (column + j);
      const double x = m(0, j), y = m(1, j), z = m(2, j);
      to[0] += x, to[1] += y, to[2] += z;
      to[3] += a.y() * z - a.z() * y;
      to[4] += a.z() * x - a.x() * z;
      to[5] += a.x() * y - a.y() * x;
    }
  };
  add(0, k);
  add(3, turned);
}

/// Tolerances, as parts of the limit of friction: of friction that holds, and of the limit itself, since forces are
/// brought into the cone at the end.
constexpr double precision = 2e-3, near = 1e-3;
/// Tolerances, m/s: of the solution of a linear system, and of a change that changes no force noticeably.
constexpr double least_speed = 1e-8, slight = 1e-6;

MURO_INLINE Vec3 along(const Vec3& v, const Vec3& n) { return n.dot(v) * n; }

/// Returns the velocity of a body at a lever from the centre of mass.
MURO_INLINE Vec3 velocity_at(const BlockSystem::Vector& body, const Vec3& lever) {
  const double x = body[3], y = body[4], z = body[5];
  return {body[0] + (y * lever.z() - z * lever.y()), body[1] + (z * lever.x() - x * lever.z()),
          body[2] + (x * lever.y() - y * lever.x())};
}

/// Returns the ratio of a force within its limit to the whole force.
MURO_INLINE double part_within(const Vec3& force, double most) {
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

std::uint32_t ContactSolver::add_body(const law::Mobility<double>& mobility, const Vec3& velocity, const Vec3& spin,
                                      const Vec3& gained, const Vec3& turned) {
  const law::Symmetric<double>& i = mobility.inertia;
  const Mat3 inverse = (Mat3() << i.xx, i.xy, i.xz, i.xy, i.yy, i.yz, i.xz, i.yz, i.zz).finished();
  const Mat3 inertia = inverse.inverse();
  Body& body = bodies_.emplace_back();
  body.mass.setZero();
  body.mass.topLeftCorner<3, 3>().diagonal().setConstant(1 / mobility.mass);
  body.mass.bottomRightCorner<3, 3>() = 0.5 * (inertia + inertia.transpose());
  BlockSystem::Vector& v = velocities_.emplace_back();
  v << velocity, spin;
  BlockSystem::Vector end;
  end << velocity + gained, spin + turned;
  body.momentum.noalias() = body.mass * end;
  return std::uint32_t(bodies_.size() - 1);
}

void ContactSolver::hold(bool body, bool other) {
  SolverContact& c = contacts_.back();
  Vec3 given = Vec3::Zero();
  if (body) given += velocity_at(velocities_[c.body], c.lever + c.cell);
  if (other && c.other != SolverContact::none) given -= velocity_at(velocities_[c.other], c.other_lever + c.cell);
  c.touched -= given - along(given, c.normal);
  c.moves_body = !body;
  c.moves_other = !other;
}

/// Returns the velocity (m/s) of the own point over the other: along the normal that of the point, across it that of
/// the place where friction acts.
Vec3 ContactSolver::velocity_in(const SolverContact& c, const std::vector<BlockSystem::Vector>& velocities) {
  const bool has_cell = !c.cell.isZero(0);
  const auto of = [&](const BlockSystem::Vector& body, const Vec3& lever, bool moves) __attribute__((always_inline))
                      ->Vec3 {
    const Vec3 v = velocity_at(body, lever);
    if (!moves) return along(v, c.normal);
    if (!has_cell) return v;
    const Vec3 turning = body.tail<3>().cross(c.cell);
    return v + turning - along(turning, c.normal);
  };
  const Vec3 velocity = of(velocities[c.body], c.lever, c.moves_body) - c.touched;
  return c.other == SolverContact::none ? velocity : velocity - of(velocities[c.other], c.other_lever, c.moves_other);
}

/// Adds the force of a contact and its change with velocity, at the velocities so far.
void ContactSolver::add_terms(SolverContact& c) {
  c.impulse.setZero();
  c.yields.setZero();
  if (!c.pushes && c.hold == 0) return;
  constexpr double straight = 0.98;  // part of the damping that is removed along the drag: a system is never singular
  const Vec3& velocity = c.velocity;
  const auto [load, drag] = reaction_at(c, velocity);
  const double normal = c.pushes ? step_ : 0, tangential = step_ * c.hold;
  Mat3& k = c.yields;
  k = damper(normal * c.along, tangential * c.across, c.normal);
  if (c.hold < 1) {
    const Vec3 less = (straight * tangential * c.across / drag.squaredNorm()) * drag;
    for (int j = 0; j < 3; ++j) k.col(j) -= drag[j] * less;
  }
  c.impulse = (normal * load) * c.normal - tangential * drag + k * (velocity + c.touched);
  const bool is_one_point = c.moves_body && c.moves_other && c.cell.isZero(0);
  if (is_one_point) return add_damper(c, k, c.impulse, Vec3::Zero(), true, true);
  const Mat3 pressure = damper(normal * c.along, 0, c.normal);
  const Vec3 push = along(c.impulse, c.normal);
  add_damper(c, pressure, push, Vec3::Zero(), true, true);
  add_damper(c, k - pressure, c.impulse - push, c.cell, c.moves_body, c.moves_other);
}

/// Adds to the linear system: `k` (N s/(m/s)) and the impulse at rest (N s), at `arm` (m) from the point.
void ContactSolver::add_damper(const SolverContact& c, const Mat3& k, const Vec3& impulse, const Vec3& arm,
                               bool moves_body, bool moves_other) {
  const Vec3 own = c.lever + arm, other = c.other_lever + arm;
  const auto add = [&](std::uint32_t body, const Vec3& lever, double sign) {
    add_at_levers(system_.diagonal(body), k, lever, lever);
    right_[body].head<3>() += sign * impulse;
    right_[body].tail<3>() += sign * lever.cross(impulse);
  };
  if (moves_body) add(c.body, own, 1);
  if (c.other == SolverContact::none || !moves_other) return;
  add(c.other, other, -1);
  if (!moves_body) return;
  Block coupling = Block::Zero();
  add_at_levers(coupling, -k, own, other);
  system_.add(c.coupling, c.body, coupling);
}

void ContactSolver::assemble() {
  system_.set_zero();
  for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
    system_.diagonal(i) = bodies_[i].mass;
    right_[i] = bodies_[i].momentum;
  }
  for (SolverContact& c : contacts_) add_terms(c);
}

ContactSolver::Reaction ContactSolver::reaction_at(const SolverContact& c, const Vec3& velocity) {
  const double away = c.normal.dot(velocity);
  return {c.push - c.along * away, c.spring + c.across * (velocity - away * c.normal)};
}

/// Whether a contact differs from the assumptions of the linear system. `hold`: its ratio of friction.
bool ContactSolver::differs(const SolverContact& c, const Reaction& r, double hold) {
  return ((r.load > 0) != c.pushes && std::abs(r.load) > c.along * slight) ||
         (c.has_friction_in_it() && std::abs(hold - c.hold) * r.drag.norm() > precision * c.limit + c.across * slight);
}

/// Whether all contacts at the solution of the linear system agree with its assumptions, so that it is the minimum.
bool ContactSolver::is_solution() const {
  return std::all_of(contacts_.begin(), contacts_.end(), [](const SolverContact& c) {
    if (c.only_damps) return true;
    const Reaction r = reaction_at(c, c.velocity + c.way);
    return !differs(c, r, part_within(r.drag, c.limit));
  });
}

/// Updates the contact for the velocities so far. Returns whether it differed from the assumptions of the linear
/// system.
bool ContactSolver::revise(SolverContact& c) {
  if (c.only_damps) return false;
  const Reaction r = reaction_at(c, c.velocity);
  const double load = r.load, hold = part_within(r.drag, c.limit);
  const bool changed = differs(c, r, hold);
  c.pushes = load > 0;
  c.hold = hold;
  c.load = std::max(load, 0.0);
  return changed;
}

/// Returns the change (J) of the sum of all potentials along the way from the velocities so far to the solution, at
/// `part` of the way.
double ContactSolver::slope_at(double part) const {
  double slope = 0;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BlockSystem::Vector way = solution_[i] - velocities_[i];
    slope += way.dot(bodies_[i].mass * (velocities_[i] + part * way) - bodies_[i].momentum);
  }
  for (const SolverContact& c : contacts_) {
    const auto [load, drag] = reaction_at(c, c.velocity + part * c.way);
    slope -= step_ * (c.only_damps ? load : std::max(load, 0.0)) * c.normal.dot(c.way);
    slope += step_ * (c.only_damps ? 1 : part_within(drag, c.limit)) * drag.dot(c.way);  // drag is across the normal
  }
  return slope;
}

/// Moves the velocities towards the solution of the linear system, about as far as potentials fall. Returns whether
/// that is the whole way.
bool ContactSolver::approach_solution() {
  for (SolverContact& c : contacts_) c.way = velocity_in(c, solution_) - c.velocity;
  if (is_solution()) {
    velocities_.assign(solution_.begin(), solution_.end());
    for (SolverContact& c : contacts_) c.velocity += c.way;
    return true;
  }
  constexpr double flat = 0.1;  // of the slope at the start: close enough to the minimum
  double part = 1;
  const double most = -flat * slope_at(0);
  if (most > 0 && slope_at(1) > most) {
    double low = 0, high = 1;
    for (int i = 0; i < 20; ++i) {
      part = 0.5 * (low + high);
      const double slope = slope_at(part);
      if (std::abs(slope) <= most) break;
      (slope > 0 ? high : low) = part;
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) velocities_[i] += part * (solution_[i] - velocities_[i]);
  for (SolverContact& c : contacts_) c.velocity += part * c.way;
  return part == 1;
}

/// Runs Newton's method with the present limits of friction. `left`: number of linear systems that may still be solved
/// in this step. Returns whether it has found the minimum.
bool ContactSolver::find_velocities(int most_iterations, int& left) {
  double mass = 0;
  for (const Body& b : bodies_) mass += b.mass(0, 0);
  bool changed = true;
  for (int iteration = 0; changed && iteration < most_iterations && left > 0; ++iteration, --left) {
    assemble();
    solution_.assign(velocities_.begin(), velocities_.end());
    system_.solve(right_, solution_, mass * least_speed * least_speed);
    changed = !approach_solution();
    for (SolverContact& c : contacts_) changed = revise(c) || changed;
  }
  return !changed;
}

/// Returns the part of the last change of limits found that the next limits take back, so that both changes together
/// come as near as they can to limits that belong to their loads.
double ContactSolver::part_of_last_change() const {
  constexpr double most = 0.5;
  double change = 0, square = 0;
  for (const SolverContact& c : contacts_) {
    if (c.limit_before < 0) return 0;
    const double lacks = c.friction * c.load - c.limit, lacked = c.limit_found - c.limit_before;
    change += lacks * (lacks - lacked), square += (lacks - lacked) * (lacks - lacked);
  }
  return square > 0 ? std::clamp(change / square, 0.0, most) : 0;
}

/// Moves limits of friction by `part` towards their present values. Returns whether the limit of a sliding contact has
/// changed.
bool ContactSolver::revise_limits(double part) {
  bool changed = false;
  const double back = part_of_last_change();
  for (SolverContact& c : contacts_) {
    const double limit = c.friction * c.load;
    const Vec3 drag = reaction_at(c, c.velocity).drag;
    const bool slides = c.has_friction_in_it() && (c.hold < 1 || drag.norm() > limit);
    const double most = std::max(limit, c.limit);
    changed = changed || (slides && std::abs(limit - c.limit) > near * most + c.across * slight);
    const double next = std::max(limit - back * (limit - c.limit_found), 0.0);
    c.limit_before = c.limit, c.limit_found = limit;
    c.limit += part * (next - c.limit);
    if (!c.only_damps) c.hold = part_within(drag, c.limit);
  }
  return changed;
}

/// Finds the force from the last linear system, within the cone. So it keeps momenta and moves bodies as found.
void ContactSolver::find_force(SolverContact& c) const {
  const Vec3 velocity = velocity_in(c, solution_);
  c.away = c.normal.dot(velocity);
  if (c.only_damps) return;
  const Vec3 force = (c.impulse - c.yields * (velocity + c.touched)) / step_;
  c.load = std::max(c.normal.dot(force), 0.0);
  const Vec3 across =
      c.has_friction_in_it() ? Vec3(force - along(force, c.normal)) : Vec3(-reaction_at(c, velocity).drag);
  c.force = c.load * c.normal + part_within(across, c.friction * c.load) * across;
  c.hold = part_within(reaction_at(c, velocity).drag, c.friction * c.load);
}

std::span<const SolverContact> ContactSolver::solve() {
  constexpr int sure_iterations = 12, eager_iterations = 24, most_of_newton = 12, most_systems = 96;
  system_.start(std::uint32_t(bodies_.size()));
  right_.resize(bodies_.size());
  for (SolverContact& c : contacts_)
    if (c.other != SolverContact::none) c.coupling = system_.couple(c.body, c.other);
  system_.find_order();
  for (SolverContact& c : contacts_) {
    c.velocity = velocity_in(c, velocities_);
    revise(c);
  }
  int left = most_systems;
  for (int iteration = 1; left > 0; ++iteration) {
    const bool is_found = find_velocities(iteration > eager_iterations ? most_of_newton : 1, left);
    if (!revise_limits(iteration > sure_iterations ? 0.5 : 1) && is_found) break;
  }
  for (SolverContact& c : contacts_) find_force(c);
  return contacts_;
}

}  // namespace muro::penalty
