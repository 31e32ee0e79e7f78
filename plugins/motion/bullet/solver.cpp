// SPDX-License-Identifier: MIT
#include "solver.hpp"

#include <algorithm>
#include <cmath>

namespace muro::bullet {

using multibody::Demand, multibody::JointState, multibody::Part;

namespace {

constexpr double unbounded = 1e30;
constexpr double least_parting = 1e-4;  ///< m/s: slower speeds are left in velocities
constexpr double slow = 1e-3;           ///< m/s: below, friction has no direction of its own
constexpr double near_stop = 0.02;      ///< rad or m: joints that are nearer to a limit have a row for it

}  // namespace

Solver::Solver(const Settings& settings) : settings_(settings) {
  info_.m_numIterations = settings.iterations;
  info_.m_numNonContactInnerIterations = 1;
  info_.m_solverMode = SOLVER_USE_2_FRICTION_DIRECTIONS;
}

void Solver::begin(double dt) {
  dt_ = dt;
  m_multiBodyNonContactConstraints.resizeNoInitialize(0);
  m_multiBodyNormalContactConstraints.resizeNoInitialize(0);
  m_multiBodyFrictionContactConstraints.resizeNoInitialize(0);
  m_data.m_jacobians.resizeNoInitialize(0);
  m_data.m_deltaVelocitiesUnitImpulse.resizeNoInitialize(0);
  m_data.m_deltaVelocities.resizeNoInitialize(0);
  drive_rows_.clear();
  first_drives_.clear();
  partings_.clear();
}

int Solver::append(const Robot& robot) {
  const int index = m_data.m_jacobians.size(), n = robot.size();
  m_data.m_jacobians.resize(index + n, 0);
  m_data.m_deltaVelocitiesUnitImpulse.resizeNoInitialize(index + n);
  return index;
}

void Solver::answer(const Robot& robot, int index, Row& row) {
  const int n = robot.size();
  const double *jacobian = &m_data.m_jacobians[index], *speed = robot.velocity();
  double* response = &m_data.m_deltaVelocitiesUnitImpulse[index];
  std::fill_n(response, n, 0);
  for (int k = 0; k < n; ++k) {
    const double factor = jacobian[k];
    if (factor == 0) continue;
    row.speed += factor * speed[k];
    const double* column = robot.response().data() + std::ptrdiff_t(k) * n;
    for (int i = 0; i < n; ++i) response[i] += factor * column[i];
  }
  for (int k = 0; k < n; ++k) row.answer += jacobian[k] * response[k];
}

btMultiBodySolverConstraint& Solver::put(btMultiBodyConstraintArray& rows, const Row& row, double target, double low,
                                         double high, double cfm, double start) {
  btMultiBodySolverConstraint& c = rows.expandNonInitializing();
  c.m_multiBodyA = row.a;
  c.m_multiBodyB = row.b;
  c.m_solverBodyIdA = c.m_solverBodyIdB = -1;
  c.m_jacAindex = row.row_a;
  c.m_jacBindex = row.row_b;
  c.m_deltaVelAindex = row.a->getCompanionId();
  c.m_deltaVelBindex = row.b ? row.b->getCompanionId() : -1;
  const double whole = row.answer + cfm / dt_;
  c.m_jacDiagABInv = whole > SIMD_EPSILON ? 1 / whole : 0;
  c.m_rhs = (target - row.speed) * c.m_jacDiagABInv;
  c.m_cfm = cfm / dt_ * c.m_jacDiagABInv;
  c.m_lowerLimit = low;
  c.m_upperLimit = high;
  c.m_appliedImpulse = std::clamp(start, low, high);
  if (c.m_appliedImpulse != 0) {
    applyDeltaVee(&m_data.m_deltaVelocitiesUnitImpulse[row.row_a], c.m_appliedImpulse, c.m_deltaVelAindex,
                  row.a->getNumDofs() + 6);
    if (row.b)
      applyDeltaVee(&m_data.m_deltaVelocitiesUnitImpulse[row.row_b], c.m_appliedImpulse, c.m_deltaVelBindex,
                    row.b->getNumDofs() + 6);
  }
  return c;
}

void Solver::add(Robot& robot, const Memory& memory) {
  const int index = m_data.m_deltaVelocities.size();
  robot.bullet_body().setCompanionId(index);
  first_drives_.push_back(int(drive_rows_.size()));
  m_data.m_deltaVelocities.resize(index + robot.size(), 0);
  for (std::size_t i = 1; i < robot.model().parts.size(); ++i) add_joint(robot, i, memory);
}

double Solver::stop(double gap) const {
  return gap > 0 ? -gap / dt_ : std::min(-gap * settings_.erp / dt_, settings_.correcting_speed);
}

void Solver::add_joint(Robot& robot, std::size_t number, const Memory& memory) {
  const JointLimits& limits = robot.model().parts[number].limits;
  const JointState& joint = robot.state().joints[number];
  const Demand& d = joint.demand;
  const double speed = robot.velocity()[5 + number], near = near_stop + 2 * dt_ * std::abs(speed);
  const double below = joint.position - limits.lower, above = limits.upper - joint.position;
  const double slowest = below < near ? stop(below) : -unbounded, fastest = above < near ? -stop(above) : unbounded;
  const double most = std::min(dt_ * (d.by_speed ? d.most : limits.friction), unbounded);
  drive_rows_.push_back(-1);
  if (most == 0 && below >= near && above >= near) return;

  Row row;
  row.a = &robot.bullet_body();
  row.row_a = append(robot);
  m_data.m_jacobians[row.row_a + 5 + int(number)] = 1;
  const auto column = robot.response().col(Eigen::Index(5 + number));
  std::copy_n(column.data(), robot.size(), &m_data.m_deltaVelocitiesUnitImpulse[row.row_a]);
  row.answer = column[Eigen::Index(5 + number)];
  row.speed = speed;
  if (most > 0) {
    drive_rows_.back() = m_multiBodyNonContactConstraints.size();
    const double wanted = d.by_speed ? std::clamp(d.speed, slowest, fastest) : 0;
    put(m_multiBodyNonContactConstraints, row, wanted, -most, most, 0, settings_.warm * memory.drive(number));
  }
  if (below < near) put(m_multiBodyNonContactConstraints, row, slowest, 0, unbounded, 0, 0);
  if (above < near) put(m_multiBodyNonContactConstraints, row, fastest, -unbounded, 0, 0, 0);
}

Solver::Row Solver::contact_row(const Touch& t, Robot& a, Robot* b, const Vec3& moving, const Vec3& direction) {
  Row row;
  row.a = &a.bullet_body();
  row.row_a = append(a);
  const Robot::Wrench6 wrench = a.wrench(t.at.point, direction);
  a.add_row(t.a->part, wrench, 1, &m_data.m_jacobians[row.row_a]);
  if (b == &a) a.add_row(t.b->part, wrench, -1, &m_data.m_jacobians[row.row_a]);
  answer(a, row.row_a, row);
  if (b && b != &a) {
    row.b = &b->bullet_body();
    row.row_b = append(*b);
    b->add_row(t.b->part, b->wrench(t.at.point, direction), -1, &m_data.m_jacobians[row.row_b]);
    answer(*b, row.row_b, row);
  }
  if (!b) row.speed -= direction.dot(moving);
  return row;
}

/// Speed of parting that a contact must leave. Bodies that bounce meet in the step that begins or ends nearest to the
/// instant of impact, and part with the energy that Newton's law leaves of that with which they would meet; others meet
/// where their surfaces, less the slop, do.
double Solver::target(const Touch& t, double speed, double restitution, bool& matters, bool& lasts) const {
  matters = true;
  lasts = restitution > 0 && speed < -settings_.bounce_speed;
  if (!lasts) return stop(t.at.gap + settings_.slop);
  const double before = t.slip.dot(t.at.normal), pull = (before - speed) / dt_;  // m/s^2: towards each other
  matters = t.at.gap + 0.25 * dt_ * (before + speed) < 0;
  const double in = restitution * restitution * (before * before + 2 * pull * t.at.gap);
  const double drop = pull * dt_;
  return std::max(0.0, std::sqrt(std::max(0.0, drop * drop + in - 2 * pull * t.at.gap)) - drop);
}

void Solver::add(Touch& t, Robot& a, Robot* b, const Vec3& moving) {
  const Row normal = contact_row(t, a, b, moving, t.at.normal);
  bool matters = false, lasts = false;
  const double wanted = target(t, normal.speed, std::max(t.a->restitution, t.b->restitution), matters, lasts);
  t.row = -1;
  if (!matters) return;
  const Vec3 slip = t.slip - t.at.normal * t.at.normal.dot(t.slip);
  const double speed = slip.norm();
  t.along = speed > slow ? Vec3(slip / speed) : t.at.normal.unitOrthogonal();
  t.across = t.at.normal.cross(t.along);
  t.row = m_multiBodyNormalContactConstraints.size();
  const Vec3 start = settings_.warm * t.impulse;
  const btMultiBodySolverConstraint& row = put(m_multiBodyNormalContactConstraints, normal, wanted, 0, unbounded,
                                               settings_.cfm, std::max(0.0, start.dot(t.at.normal)));
  if (wanted > least_parting && !lasts) partings_.push_back({t.row, -normal.speed * row.m_jacDiagABInv});
  for (const Vec3& direction : {t.along, t.across}) {
    const Row tangent = contact_row(t, a, b, moving, direction);
    btMultiBodySolverConstraint& c =
        put(m_multiBodyFrictionContactConstraints, tangent, 0, -unbounded, unbounded, 0, start.dot(direction));
    c.m_frictionIndex = t.row;
    c.m_friction = std::sqrt(t.a->friction * t.b->friction);
  }
}

void Solver::solve() {
  const auto iterate = [&](int times) {
    for (int i = 0; i < times; ++i) solveSingleIteration(i, nullptr, 0, nullptr, 0, nullptr, 0, info_, nullptr);
  };
  iterate(settings_.iterations);
  moving_.copyFromArray(m_data.m_deltaVelocities);
  if (partings_.empty()) return;
  for (const Parting& p : partings_) m_multiBodyNormalContactConstraints[p.row].m_rhs = p.rhs;
  iterate((settings_.iterations + 1) / 2);
}

void Solver::finish(Robot& robot, std::size_t number, const Memory& memory) {
  const int index = robot.bullet_body().getCompanionId();
  for (int i = 0; i < robot.size(); ++i) {
    robot.moving()[i] = robot.velocity()[i] + moving_[index + i];
    robot.velocity()[i] += m_data.m_deltaVelocities[index + i];
  }
  for (std::size_t i = 1; i < robot.model().parts.size(); ++i) {
    const int row = drive_rows_[std::size_t(first_drives_[number]) + i - 1];
    const double impulse = row < 0 ? 0 : double(m_multiBodyNonContactConstraints[row].m_appliedImpulse);
    memory.drive(i) = impulse;
    JointState& joint = robot.state().joints[i];
    joint.effort = joint.demand.by_speed ? impulse / dt_ : joint.demand.effort;
  }
}

void Solver::finish(Touch& t) {
  t.impulse = Vec3::Zero();
  if (t.row < 0) return;
  t.impulse = double(m_multiBodyNormalContactConstraints[t.row].m_appliedImpulse) * t.at.normal +
              double(m_multiBodyFrictionContactConstraints[2 * t.row].m_appliedImpulse) * t.along +
              double(m_multiBodyFrictionContactConstraints[2 * t.row + 1].m_appliedImpulse) * t.across;
}

}  // namespace muro::bullet
