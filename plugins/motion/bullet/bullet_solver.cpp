// SPDX-License-Identifier: MIT
#include "bullet_solver.hpp"

#include <algorithm>
#include <cmath>

namespace muro::bullet {

using multibody::DriveTarget, multibody::JointState;

namespace {

constexpr double unbounded = 1e30;
constexpr double min_split_velocity = 2e-3;  ///< m/s: slower corrections, e.g. by softness, stay in velocities
constexpr double softness = 0.01;            ///< part of the inverse effective mass, see add()
constexpr double deep_softness = 0.1;        ///< part of the inverse effective mass, for deep overlaps
constexpr double min_slip = 1e-3;            ///< m/s: a slower slip gives friction no direction
constexpr double near_limit = 0.02;          ///< rad or m: joints nearer to a limit have a row for it

}  // namespace

BulletSolver::BulletSolver(const BulletSettings& settings) : settings_(settings) {
  info_.m_numIterations = settings.iterations;
  info_.m_numNonContactInnerIterations = 1;
  info_.m_solverMode = SOLVER_USE_2_FRICTION_DIRECTIONS;
}

void BulletSolver::begin(double dt) {
  dt_ = dt;
  m_multiBodyNonContactConstraints.resizeNoInitialize(0);
  m_multiBodyNormalContactConstraints.resizeNoInitialize(0);
  m_multiBodyFrictionContactConstraints.resizeNoInitialize(0);
  m_multiBodySpinningFrictionContactConstraints.resizeNoInitialize(0);
  m_multiBodyTorsionalFrictionContactConstraints.resizeNoInitialize(0);
  m_data.m_jacobians.resizeNoInitialize(0);
  m_data.m_deltaVelocitiesUnitImpulse.resizeNoInitialize(0);
  m_data.m_deltaVelocities.resizeNoInitialize(0);
  drive_rows_.clear();
  first_drives_.clear();
  split_impulses_.clear();
}

int BulletSolver::append(const BulletRobot& robot) {
  const int index = m_data.m_jacobians.size(), n = robot.size();
  m_data.m_jacobians.resize(index + n, 0);
  m_data.m_deltaVelocitiesUnitImpulse.resizeNoInitialize(index + n);
  return index;
}

void BulletSolver::find_unit_impulse_response(const BulletRobot& robot, int index, ConstraintRow& row) {
  const int n = robot.size();
  const double *jacobian = &m_data.m_jacobians[index], *speed = robot.velocity();
  double* response = &m_data.m_deltaVelocitiesUnitImpulse[index];
  std::fill_n(response, n, 0);
  for (int k = 0; k < n; ++k) {
    const double factor = jacobian[k];
    if (factor == 0) continue;
    row.speed += factor * speed[k];
    const double* column = robot.inverse_inertia().data() + std::ptrdiff_t(k) * n;
    for (int i = 0; i < n; ++i) response[i] += factor * column[i];
  }
  for (int k = 0; k < n; ++k) row.inverse_effective_mass += jacobian[k] * response[k];
}

btMultiBodySolverConstraint& BulletSolver::add_row(btMultiBodyConstraintArray& rows, const ConstraintRow& row,
                                                   double target, double low, double high, double cfm,
                                                   double initial_impulse) {
  btMultiBodySolverConstraint& c = rows.expandNonInitializing();
  c.m_multiBodyA = row.a;
  c.m_multiBodyB = row.b;
  c.m_solverBodyIdA = c.m_solverBodyIdB = -1;
  c.m_jacAindex = row.row_a;
  c.m_jacBindex = row.row_b;
  c.m_deltaVelAindex = row.a->getCompanionId();
  c.m_deltaVelBindex = row.b ? row.b->getCompanionId() : -1;
  const double diagonal = row.inverse_effective_mass + cfm / dt_;
  c.m_jacDiagABInv = diagonal > SIMD_EPSILON ? 1 / diagonal : 0;
  c.m_rhs = (target - row.speed) * c.m_jacDiagABInv;
  c.m_cfm = cfm / dt_ * c.m_jacDiagABInv;
  c.m_lowerLimit = low;
  c.m_upperLimit = high;
  c.m_appliedImpulse = std::clamp(initial_impulse, low, high);
  if (c.m_appliedImpulse != 0) {
    applyDeltaVee(&m_data.m_deltaVelocitiesUnitImpulse[row.row_a], c.m_appliedImpulse, c.m_deltaVelAindex,
                  row.a->getNumDofs() + 6);
    if (row.b)
      applyDeltaVee(&m_data.m_deltaVelocitiesUnitImpulse[row.row_b], c.m_appliedImpulse, c.m_deltaVelBindex,
                    row.b->getNumDofs() + 6);
  }
  return c;
}

void BulletSolver::add(BulletRobot& robot, const ImpulseCache& cache) {
  const int index = m_data.m_deltaVelocities.size();
  robot.bullet_body().setCompanionId(index);
  first_drives_.push_back(int(drive_rows_.size()));
  m_data.m_deltaVelocities.resize(index + robot.size(), 0);
  for (std::size_t i = 1; i < robot.model().bodies.size(); ++i) add_joint(robot, i, cache);
}

double BulletSolver::limit_velocity(double gap) const {
  return gap > 0 ? -gap / dt_ : std::min(-gap * settings_.erp / dt_, settings_.correcting_speed);
}

void BulletSolver::add_joint(BulletRobot& robot, std::size_t number, const ImpulseCache& cache) {
  const JointLimits& limits = robot.model().bodies[number].limits;
  const JointState& joint = robot.state().joints[number];
  const DriveTarget& target = joint.target;
  const double speed = robot.velocity()[5 + number], near = near_limit + 2 * dt_ * std::abs(speed);
  const double below = joint.position - limits.lower, above = limits.upper - joint.position;
  const double slowest = below < near ? limit_velocity(below) : -unbounded,
               fastest = above < near ? -limit_velocity(above) : unbounded;
  const double max_impulse = std::min(dt_ * (target.tracks_velocity ? target.max_effort : target.friction), unbounded);
  const double max_friction = target.tracks_velocity ? std::min(dt_ * target.friction, unbounded) : 0;
  drive_rows_.push_back(-1);
  if (max_impulse == 0 && max_friction == 0 && below >= near && above >= near) return;

  ConstraintRow row;
  row.a = &robot.bullet_body();
  row.row_a = append(robot);
  m_data.m_jacobians[row.row_a + 5 + int(number)] = 1;
  const auto column = robot.inverse_inertia().col(Eigen::Index(5 + number));
  std::copy_n(column.data(), robot.size(), &m_data.m_deltaVelocitiesUnitImpulse[row.row_a]);
  row.inverse_effective_mass = column[Eigen::Index(5 + number)];
  row.speed = speed;
  if (max_impulse > 0) {
    drive_rows_.back() = m_multiBodyNonContactConstraints.size();
    const double velocity = target.tracks_velocity ? std::clamp(target.velocity, slowest, fastest) : 0;
    const double cfm = target.tracks_velocity ? target.softness() : 0;
    add_row(m_multiBodyNonContactConstraints, row, velocity, -max_impulse, max_impulse, cfm,
            settings_.warm_start * cache.drive(number));
  }
  if (max_friction > 0) add_row(m_multiBodyNonContactConstraints, row, 0, -max_friction, max_friction, 0, 0);
  if (below < near) add_row(m_multiBodyNonContactConstraints, row, slowest, 0, unbounded, 0, 0);
  if (above < near) add_row(m_multiBodyNonContactConstraints, row, fastest, -unbounded, 0, 0, 0);
}

BulletSolver::ConstraintRow BulletSolver::contact_row(const SolverContact& c, BulletRobot& a, BulletRobot* b,
                                                      const Vec3& at, const Vec3& other_velocity,
                                                      const Vec3& direction) {
  ConstraintRow row = pair_row(c, a, b, a.wrench(at, direction), (b ? *b : a).wrench(at, direction));
  if (!b) row.speed -= direction.dot(other_velocity);
  return row;
}

BulletSolver::ConstraintRow BulletSolver::turning_row(const SolverContact& c, BulletRobot& a, BulletRobot* b,
                                                      const Vec3& other_spin, const Vec3& axis) {
  BulletRobot::SpatialForce torque;
  torque << axis, Vec3::Zero();
  ConstraintRow row = pair_row(c, a, b, torque, torque);
  if (!b) row.speed -= axis.dot(other_spin);
  return row;
}

BulletSolver::ConstraintRow BulletSolver::pair_row(const SolverContact& c, BulletRobot& a, BulletRobot* b,
                                                   const BulletRobot::SpatialForce& on_a,
                                                   const BulletRobot::SpatialForce& on_b) {
  ConstraintRow row;
  row.a = &a.bullet_body();
  row.row_a = append(a);
  a.add_jacobian(c.a->body, on_a, 1, &m_data.m_jacobians[row.row_a]);
  if (b == &a) a.add_jacobian(c.b->body, on_a, -1, &m_data.m_jacobians[row.row_a]);
  find_unit_impulse_response(a, row.row_a, row);
  if (b && b != &a) {
    row.b = &b->bullet_body();
    row.row_b = append(*b);
    b->add_jacobian(c.b->body, on_b, -1, &m_data.m_jacobians[row.row_b]);
    find_unit_impulse_response(*b, row.row_b, row);
  }
  return row;
}

/// Returns the velocity along the normal after the contact. Rebounding bodies touch in the step that begins or ends
/// nearest to the instant of impact. They separate with the part of their approach energy that Newton's law leaves.
/// Other bodies touch when their surfaces, less the slop, touch.
double BulletSolver::target_velocity(const SolverContact& c, double speed, double restitution, bool& is_active,
                                     bool& is_rebound) const {
  is_active = true;
  is_rebound = restitution > 0 && speed < -settings_.bounce_speed;
  if (!is_rebound) return limit_velocity(c.point.gap + settings_.slop);
  const double before = c.relative_velocity.dot(c.point.normal),
               pull = (before - speed) / dt_;  // m/s^2: towards each other
  is_active = c.point.gap + 0.25 * dt_ * (before + speed) < 0;
  const double in = restitution * restitution * (before * before + 2 * pull * c.point.gap);
  const double drop = pull * dt_;
  return std::max(0.0, std::sqrt(std::max(0.0, drop * drop + in - 2 * pull * c.point.gap)) - drop);
}

/// Adds the contacts of a pair. Points of one line or face get the same softness, so that they share its load like a
/// pressure.
void BulletSolver::add(std::span<SolverContact> contacts, BulletRobot& a, BulletRobot* b,
                       const multibody::BodyState& other) {
  Twist velocities[NarrowPhase::max_points];  // of the other body at the points
  ConstraintRow normals[NarrowPhase::max_points];
  double sum = 0;
  int touching = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const SolverContact& c = contacts[i];
    velocities[i] = {other.twist.at(c.point.position - other.pose.position), other.twist.angular};
    normals[i] = contact_row(c, a, b, c.point.position, velocities[i].linear, c.point.normal);
    if (c.cell.isZero(0)) continue;
    sum += normals[i].inverse_effective_mass;
    ++touching;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const bool is_alone = contacts[i].cell.isZero(0);
    add(contacts[i], normals[i], is_alone ? normals[i].inverse_effective_mass : sum / touching, a, b, velocities[i]);
  }
}

void BulletSolver::add(SolverContact& c, const ConstraintRow& normal, double inverse_mass, BulletRobot& a,
                       BulletRobot* b, const Twist& other_velocity) {
  bool is_active = false, is_rebound = false;
  const Surface surface = pair_surface(c.a->surface, c.b->surface, settings_.friction_rule);
  const double velocity = target_velocity(c, normal.speed, surface.restitution, is_active, is_rebound);
  c.row = c.spinning_row = c.rolling_row = -1;
  if (!is_active) return;
  const Vec3 slip = c.slip();
  const double speed = slip.norm();
  c.tangent = speed > min_slip ? Vec3(slip / speed) : c.point.normal.unitOrthogonal();
  c.bitangent = c.point.normal.cross(c.tangent);
  c.row = m_multiBodyNormalContactConstraints.size();
  // A body deep inside another is often pushed from several sides at once. No impulses can fulfil that, and they would
  // grow from step to step. Softness and a start at zero limit them; this takes a thousandth of g from the speed. When
  // many points share a load, many distributions are valid, and the solver would keep the first one, for example all
  // load and friction on one corner. Softness leads to the distribution of least work.
  const bool is_deep = !is_rebound && velocity >= settings_.correcting_speed;
  const Vec3 initial_impulse = (is_deep ? 0 : settings_.warm_start) * c.impulse;
  const double part = is_rebound ? 0 : is_deep ? deep_softness : softness;
  const double cfm = settings_.cfm + part * dt_ * inverse_mass;
  const btMultiBodySolverConstraint& row = add_row(m_multiBodyNormalContactConstraints, normal, velocity, 0, unbounded,
                                                   cfm, std::max(0.0, initial_impulse.dot(c.point.normal)));
  if (velocity > min_split_velocity && !is_rebound)
    split_impulses_.push_back({c.row, -normal.speed * row.m_jacDiagABInv});
  add_friction(c, a, b, other_velocity, surface.friction, initial_impulse);
  add_resistances(c, a, b, other_velocity.angular, surface);
}

/// Adds friction in the middle of the contact's cell. When the patch spins, the ends of the cell move relative to its
/// middle. While the middle is slower than the ends, friction is reduced by the ratio of these speeds: the rows are
/// softened for this.
void BulletSolver::add_friction(const SolverContact& c, BulletRobot& a, BulletRobot* b, const Twist& other_velocity,
                                double friction, const Vec3& initial_impulse) {
  const double limit = friction * c.impulse.dot(c.point.normal) / dt_, ends = c.speed_of_ends();
  const double cfm = ends > 0 && limit > 0 ? ends / limit : 0;
  const Vec3 middle = c.point.position + c.cell, other = other_velocity.at(c.cell);
  for (const Vec3& direction : {c.tangent, c.bitangent}) {
    const ConstraintRow tangent = contact_row(c, a, b, middle, other, direction);
    btMultiBodySolverConstraint& row = add_row(m_multiBodyFrictionContactConstraints, tangent, 0, -unbounded, unbounded,
                                               cfm, initial_impulse.dot(direction));
    row.m_frictionIndex = c.row;
    row.m_friction = friction;
  }
}

/// Adds Bullet's rows of spinning and rolling friction. They are torques against turning about the normal and about two
/// axes perpendicular to it. Their limit is a length times the normal impulse, on a cone for rolling.
void BulletSolver::add_resistances(SolverContact& c, BulletRobot& a, BulletRobot* b, const Vec3& other_spin,
                                   const Surface& surface) {
  const auto add_torque = [&](btMultiBodyConstraintArray& rows, const Vec3& axis, double lever) {
    const ConstraintRow turning = turning_row(c, a, b, other_spin, axis);
    btMultiBodySolverConstraint& row = add_row(rows, turning, 0, -unbounded, unbounded, 0, 0);
    row.m_frictionIndex = c.row;
    row.m_friction = lever;
  };
  if (surface.spinning_resistance > 0) {
    c.spinning_row = m_multiBodySpinningFrictionContactConstraints.size();
    add_torque(m_multiBodySpinningFrictionContactConstraints, c.point.normal, surface.spinning_resistance);
  }
  if (surface.rolling_resistance > 0) {
    c.rolling_row = m_multiBodyTorsionalFrictionContactConstraints.size();
    for (const Vec3& axis : {c.tangent, c.bitangent})
      add_torque(m_multiBodyTorsionalFrictionContactConstraints, axis, surface.rolling_resistance);
  }
}

void BulletSolver::solve() {
  const auto iterate = [&](int times) {
    for (int i = 0; i < times; ++i) solveSingleIteration(i, nullptr, 0, nullptr, 0, nullptr, 0, info_, nullptr);
  };
  iterate(settings_.iterations);
  position_velocity_.copyFromArray(m_data.m_deltaVelocities);
  if (split_impulses_.empty()) return;
  for (const SplitImpulse& s : split_impulses_) m_multiBodyNormalContactConstraints[s.row].m_rhs = s.rhs;
  iterate((settings_.iterations + 1) / 2);
}

void BulletSolver::finish(BulletRobot& robot, std::size_t number, const ImpulseCache& cache) {
  const int index = robot.bullet_body().getCompanionId();
  for (int i = 0; i < robot.size(); ++i) {
    robot.position_velocity()[i] = robot.velocity()[i] + position_velocity_[index + i];
    robot.velocity()[i] += m_data.m_deltaVelocities[index + i];
  }
  for (std::size_t i = 1; i < robot.model().bodies.size(); ++i) {
    const int row = drive_rows_[std::size_t(first_drives_[number]) + i - 1];
    const double impulse = row < 0 ? 0 : double(m_multiBodyNonContactConstraints[row].m_appliedImpulse);
    cache.drive(i) = impulse;
    JointState& joint = robot.state().joints[i];
    joint.effort = joint.target.tracks_velocity ? impulse / dt_ : joint.target.effort;
  }
}

void BulletSolver::finish(SolverContact& c) {
  c.impulse = c.angular_impulse = Vec3::Zero();
  if (c.row < 0) return;
  const auto impulse_of = [](const btMultiBodyConstraintArray& rows, int row) {
    return double(rows[row].m_appliedImpulse);
  };
  if (c.spinning_row >= 0)
    c.angular_impulse = impulse_of(m_multiBodySpinningFrictionContactConstraints, c.spinning_row) * c.point.normal;
  if (c.rolling_row >= 0)
    c.angular_impulse += impulse_of(m_multiBodyTorsionalFrictionContactConstraints, c.rolling_row) * c.tangent +
                         impulse_of(m_multiBodyTorsionalFrictionContactConstraints, c.rolling_row + 1) * c.bitangent;
  const Vec3 friction = impulse_of(m_multiBodyFrictionContactConstraints, 2 * c.row) * c.tangent +
                        impulse_of(m_multiBodyFrictionContactConstraints, 2 * c.row + 1) * c.bitangent;
  c.impulse = impulse_of(m_multiBodyNormalContactConstraints, c.row) * c.point.normal + friction;
  c.angular_impulse += c.cell.cross(friction);
}

}  // namespace muro::bullet
