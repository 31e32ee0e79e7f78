// SPDX-License-Identifier: MIT
#include "position_drive.hpp"

#include <charconv>
#include <cmath>

#include "plugins/common/text/quote.hpp"

namespace muro {

namespace {

/// A gain from "joint=value", or from "value" for all joints.
struct GivenGain {
  std::string_view joints = "*";
  double value = 0;
};

GivenGain given_gain(std::string_view parameter, std::string_view text) {
  const std::size_t sign = text.rfind('=');
  GivenGain gain;
  if (sign != text.npos) gain.joints = text.substr(0, sign);
  const std::string_view number = sign == text.npos ? text : text.substr(sign + 1);
  const auto [end, code] = std::from_chars(number.data(), number.data() + number.size(), gain.value);
  if (code != std::errc() || end != number.data() + number.size() || !(gain.value >= 0) || gain.value > 1e15)
    throw Error(quote(parameter) + ": " + quote(text) +
                " is no gain; write a number from 0 to 1e15, or a map of joints to such numbers: `{shoulder: 400, "
                "\"finger_*\": 20}`");
  return gain;
}

void set_gains(const Connector& connector, const RobotView& robot, std::span<const DriveMode> modes,
               const Parameters& p, const Parameter& parameter, std::optional<double> PositionDrive::*member,
               std::vector<PositionDrive>& drives) {
  for (const std::string_view text : p.texts(parameter.name)) {
    const GivenGain gain = given_gain(parameter.name, text);
    std::vector<std::string> known;
    bool found = false;
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const Link& link = robot.links[i];
      if (link.joint == JointKind::fixed || link.mimic >= 0 || modes[i] != DriveMode::position) continue;
      known.emplace_back(connector.object_name(link.joint_object).substr(robot.name.size() + 1));
      if (!detail::names_joint(gain.joints, known.back())) continue;
      drives[i].*member = gain.value;
      found = true;
    }
    if (found || gain.joints == "*") continue;
    std::string all;
    for (const std::string& k : known) all += " " + quote(k);
    throw Error(quote(parameter.name) + " names " + quote(gain.joints) + ", but " + quote(robot.name) +
                " has no such joint in mode `position`" + did_you_mean(gain.joints, known) +
                "; joints in that mode are:" + (all.empty() ? " none" : all));
  }
}

}  // namespace

PdGains PositionDrive::gains(double inertia) const {
  const double k = stiffness.value_or(natural_frequency * natural_frequency * inertia);
  return {k, damping.value_or(2 * std::sqrt(k * inertia))};
}

ImplicitDrive implicit_drive(const PdGains& gains, double error, double target_velocity, double dt) {
  ImplicitDrive drive;
  drive.damping = gains.damping + dt * gains.stiffness;
  if (drive.damping > 0) drive.velocity = (gains.stiffness * error + gains.damping * target_velocity) / drive.damping;
  return drive;
}

std::vector<PositionDrive> position_drives_of(const Connector& connector, const RobotView& robot,
                                              std::span<const DriveMode> modes, const Parameters& p) {
  std::vector<PositionDrive> drives(robot.links.size());
  for (PositionDrive& d : drives) {
    d.natural_frequency = p.real(natural_frequency.name);
    d.interpolation = p.real(interpolate.name);
  }
  set_gains(connector, robot, modes, p, drive_stiffness, &PositionDrive::stiffness, drives);
  set_gains(connector, robot, modes, p, drive_damping, &PositionDrive::damping, drives);
  return drives;
}

}  // namespace muro
