// SPDX-License-Identifier: MIT
#include "drives.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace muro::mjcf {

namespace {

/// Returns the mode of an actuator, found from its gain and bias (MuJoCo documentation, actuator shortcuts).
std::optional<DriveMode> mode_of(const mjModel& m, int actuator) {
  const mjtNum* const gain = m.actuator_gainprm + mjNGAIN * actuator;
  const mjtNum* const bias = m.actuator_biasprm + mjNBIAS * actuator;
  if (m.actuator_dyntype[actuator] != mjDYN_NONE || m.actuator_gaintype[actuator] != mjGAIN_FIXED || gain[0] == 0)
    return std::nullopt;
  if (m.actuator_biastype[actuator] == mjBIAS_NONE) return DriveMode::effort;
  if (m.actuator_biastype[actuator] != mjBIAS_AFFINE || bias[0] != 0) return std::nullopt;
  if (bias[1] == -gain[0] && gain[0] > 0) return DriveMode::position;
  if (bias[1] == 0 && bias[2] == -gain[0]) return DriveMode::velocity;
  return std::nullopt;
}

double largest(const mjtNum* range) { return std::max(std::abs(range[0]), std::abs(range[1])); }

/// Returns the maximum effort of an actuator on its joint (N m or N).
double effort_of(const mjModel& m, int actuator, DriveMode mode) {
  double effort = std::numeric_limits<double>::infinity();
  const double gear = std::abs(m.actuator_gear[6 * actuator]);
  if (m.actuator_forcelimited[actuator]) effort = gear * largest(m.actuator_forcerange + 2 * actuator);
  if (mode == DriveMode::effort && m.actuator_ctrllimited[actuator])
    effort = std::min(
        effort, gear * std::abs(m.actuator_gainprm[mjNGAIN * actuator]) * largest(m.actuator_ctrlrange + 2 * actuator));
  return effort;
}

}  // namespace

Drives drives_of(const mjModel& m) {
  Drives out;
  out.of_joint.resize(std::size_t(m.njnt));
  for (int a = 0; a < m.nu; ++a) {
    const int joint = m.actuator_trnid[2 * a];
    const std::optional<DriveMode> mode = mode_of(m, a);
    std::string why;
    if (m.actuator_trntype[a] != mjTRN_JOINT && m.actuator_trntype[a] != mjTRN_JOINTINPARENT)
      why = "acts on no joint";
    else if (m.jnt_type[joint] != mjJNT_HINGE && m.jnt_type[joint] != mjJNT_SLIDE)
      why = "acts on a joint that is neither a hinge nor a slide";
    else if (!mode || m.actuator_gear[6 * a] == 0)
      why = "is neither a motor nor a position or velocity servo";
    else if (out.of_joint[std::size_t(joint)].actuator >= 0)
      why = "is the second of its joint";
    if (!why.empty()) {
      out.left_out.emplace_back(a, why);
      continue;
    }
    Drive& drive = out.of_joint[std::size_t(joint)];
    drive = {*mode, effort_of(m, a, *mode), a};
    const double gear = m.actuator_gear[6 * a];
    if (*mode == DriveMode::position) {
      drive.stiffness = gear * gear * m.actuator_gainprm[mjNGAIN * a];
      drive.damping = std::max(0.0, -gear * gear * m.actuator_biasprm[mjNBIAS * a + 2]);
    }
    out.any = true;
  }
  return out;
}

}  // namespace muro::mjcf
