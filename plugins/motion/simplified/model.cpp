// SPDX-License-Identifier: MIT
#include "model.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <string>

#include "muro/base/number_text.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::simplified {

namespace {

void check_mass(const RobotView& robot, const Inertia& total) {
  const std::string name = quote(robot.name);
  if (!(total.mass > 0))
    throw Error(name +
                " has no mass; give its bodies mass and inertia (`inertial`), fix its base (`base: fixed`), where its "
                "joints need no forces, or move it with motion.point");
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(total.tensor());
  if (!(principal.eigenvalues().minCoeff() > 1e-12 * principal.eigenvalues().maxCoeff()))
    throw Error(name + ": the inertia of all its bodies together has the principal moments " +
                number_text(principal.eigenvalues()[0]) + ", " + number_text(principal.eigenvalues()[1]) + ", " +
                number_text(principal.eigenvalues()[2]) +
                " kg m^2; all must be positive: give its bodies an inertia (`inertial`) that fits their mass");
}

}  // namespace

RigidMass rigid_mass(const RobotView& robot, const Inertia& total) {
  check_mass(robot, total);
  RigidMass mass;
  mass.inverse_mass = 1 / total.mass;
  std::copy_n(total.com.data(), 3, mass.com);
  const Mat3 inertia = total.tensor(), inverse = inertia.inverse();
  std::copy_n(inertia.data(), 9, mass.inertia);
  std::copy_n(inverse.data(), 9, mass.inverse);
  return mass;
}

std::vector<RobotState> Model::add_groups(const RobotView& robot, const std::vector<JointProperties>& properties,
                                          double acceleration, const RobotState& base) {
  std::vector<RobotState> states;
  for (const Mode mode : {Mode::velocity, Mode::position, Mode::acceleration}) {
    RobotState of_group = states.empty() ? base : RobotState{};
    std::vector<Joint> joints = kernel_joints(robot, properties, mode, acceleration, of_group);
    if (joints.empty()) continue;
    groups.push_back({mode, std::move(joints)});
    states.push_back(of_group);
  }
  if (states.empty()) states.push_back(base);
  return states;
}

std::uint32_t number_of(Model model, std::vector<Model>& known) {
  const auto same = std::find(known.rbegin(), known.rend(), model);  // mostly the last one
  if (same != known.rend()) return std::uint32_t(known.rend() - same) - 1;
  known.push_back(std::move(model));
  return std::uint32_t(known.size() - 1);
}

}  // namespace muro::simplified
