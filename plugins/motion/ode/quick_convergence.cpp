// SPDX-License-Identifier: MIT
#include "quick_convergence.hpp"

#include <cmath>

#include "plugins/motion/common/multibody/forward_kinematics.hpp"

namespace muro::ode {

namespace {

using multibody::RobotModel;

constexpr double over_relaxation = 1.3;  ///< dWorldSetQuickStepW

struct FreeBody {
  double inverse_mass = 0;              ///< 1/kg; 0: no force moves it
  Mat3 inverse_inertia = Mat3::Zero();  ///< world axes
  Vec3 centre = Vec3::Zero();
  Vec3 velocity = Vec3::Zero(), spin = Vec3::Zero();
};

/// One degree of freedom that a joint removes: a speed of the first body relative to the second.
struct Row {
  FreeBody *first, *second;
  Vec3 linear, first_angular, second_angular;
  double inverse_effective_mass = 0;

  double speed() const {
    return linear.dot(first->velocity - second->velocity) + first_angular.dot(first->spin) -
           second_angular.dot(second->spin);
  }
  void apply(double impulse) const {
    first->velocity += first->inverse_mass * impulse * linear;
    second->velocity -= second->inverse_mass * impulse * linear;
    first->spin += first->inverse_inertia * (impulse * first_angular);
    second->spin -= second->inverse_inertia * (impulse * second_angular);
  }
};

class Joints {
 public:
  explicit Joints(const RobotModel& model) : bodies_(model.bodies.size()) {
    multibody::RobotState start;
    start.joints.resize(model.bodies.size());
    for (std::size_t i = 0; i < model.bodies.size(); ++i) start.joints[i].position = model.initial_positions[i];
    std::vector<multibody::BodyState> states(model.bodies.size());
    forward_kinematics(model, start, states);
    for (std::size_t i = 0; i < bodies_.size(); ++i) place(bodies_[i], model, i, states[i].pose);
    for (std::size_t i = 1; i < bodies_.size(); ++i) add_joint(model.bodies[i], i, states[i].pose);
  }

  /// Sum of the energies of all speeds that joints forbid, each taken alone.
  double energy() const {
    double sum = 0;
    for (const Row& r : rows_) sum += r.speed() * r.speed() / r.inverse_effective_mass;
    return sum;
  }
  void iterate() {
    for (const Row& r : rows_) r.apply(-over_relaxation * r.speed() / r.inverse_effective_mass);
  }

 private:
  static void place(FreeBody& b, const RobotModel& model, std::size_t number, const Pose& pose) {
    const Inertia& inertia = model.bodies[number].inertia;
    b.centre = pose * inertia.com;
    if (number == 0 && model.fixed_base) return;
    const Mat3 axes = pose.orientation.toRotationMatrix();
    b.inverse_mass = 1 / inertia.mass;
    b.inverse_inertia = axes * inertia.tensor().inverse() * axes.transpose();
    // Different directions and speeds, so that no mode is left out.
    const auto n = double(number + 1);
    b.velocity = Vec3(std::fmod(1.1 * n, 2.0) - 1, std::fmod(0.7 * n, 2.0) - 1, std::fmod(1.7 * n, 2.0) - 1);
  }

  void add(std::size_t first, std::size_t second, const Vec3& linear, const Vec3& first_angular,
           const Vec3& second_angular) {
    Row r{&bodies_[first], &bodies_[second], linear, first_angular, second_angular};
    for (const auto& [body, angular] : {std::pair{r.first, &first_angular}, std::pair{r.second, &second_angular}})
      r.inverse_effective_mass +=
          body->inverse_mass * linear.squaredNorm() + angular->dot(body->inverse_inertia * *angular);
    if (r.inverse_effective_mass > 0) rows_.push_back(r);
  }

  void add_joint(const multibody::RigidBody& body, std::size_t number, const Pose& pose) {
    const auto parent = std::size_t(body.parent);
    const Vec3 axis = pose.orientation * body.axis, across = axis.unitOrthogonal();
    const Mat3 frame = (Mat3() << axis, across, axis.cross(across)).finished();
    const bool turns = body.joint == JointKind::revolute;
    const Vec3 at = turns ? pose.position : bodies_[number].centre;
    for (int k = turns ? 0 : 1; k < 3; ++k) {
      const Vec3 e = frame.col(k);
      add(number, parent, e, (at - bodies_[number].centre).cross(e), (at - bodies_[parent].centre).cross(e));
    }
    for (int k = turns ? 1 : 0; k < 3; ++k) add(number, parent, Vec3::Zero(), frame.col(k), frame.col(k));
  }

  std::vector<FreeBody> bodies_;
  std::vector<Row> rows_;
};

}  // namespace

double unsolved_part(const RobotModel& model, int iterations) {
  Joints joints(model);
  const double before = joints.energy();
  if (!(before > 0)) return 0;
  for (int i = 0; i < iterations; ++i) joints.iterate();
  const double part = std::sqrt(joints.energy() / before);
  return std::isfinite(part) ? part : std::numeric_limits<double>::infinity();
}

}  // namespace muro::ode
