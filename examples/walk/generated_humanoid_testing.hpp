// SPDX-License-Identifier: MIT
// Test humanoids that differ from the one of examples/models in lengths, masses and servos, and in the zeros and
// directions of their joints; and the scenario in which they walk.
#pragma once

#include <array>
#include <string>

#include "tests/support/files.hpp"

namespace muro::walk_test {

/// Numbers of a humanoid: m, kg, N m/rad, N m s/rad. The axes of a leg that cross do so in hip and ankle.
struct Numbers {
  double hip_y, hip_z;         ///< place of the left hip, in the frame of the trunk
  double thigh, shin, ankle;   ///< lengths; ankle: height above the sole
  double sole_x, sole_y;       ///< centre of the left sole, from the ankle
  std::array<double, 2> foot;  ///< length and width
  double trunk, hip, thigh_mass, shin_mass, ankle_mass, foot_mass, arm_mass;
  double trunk_com;      ///< centre of mass of trunk and head, above the trunk's origin
  double shoulder, arm;  ///< height of the shoulders, length of an arm that hangs down
  double stiffness, damping;
  double knee_zero;  ///< bend of the knee where its joint is at 0
  bool mirrored;     ///< pitch joints of the right leg turn the other way

  double leg() const { return 2 * hip + thigh_mass + shin_mass + ankle_mass + foot_mass; }
  double mass() const { return trunk + 2 * (leg() + arm_mass); }
};

/// Lengths and masses of ROBOTIS OP2 (ROBOTIS-OP2-Common), whose right leg turns the other way.
inline Numbers op2() {
  return {.hip_y = 0.037,
          .hip_z = -0.1222,
          .thigh = 0.093,
          .shin = 0.093,
          .ankle = 0.0335,
          .sole_x = 0.005,
          .sole_y = 0.008,
          .foot = {0.104, 0.066},
          .trunk = 1.157,
          .hip = 0.06,
          .thigh_mass = 0.22,
          .shin_mass = 0.119,
          .ankle_mass = 0.19,
          .foot_mass = 0.079,
          .arm_mass = 0.253,
          .trunk_com = 0.01,
          .shoulder = 0,
          .arm = 0.2,
          .stiffness = 24.9,
          .damping = 0.68,
          .knee_zero = 0,
          .mirrored = true};
}

/// A heavier robot of the class of Sigmaban (placo-examples: height of the mass 0.32 m, feet 0.122 m apart, soles of
/// 0.158 x 0.092 m), whose knees are bent where their joints are at 0.
inline Numbers sigmaban() {
  return {.hip_y = 0.05,
          .hip_z = -0.03,
          .thigh = 0.143,
          .shin = 0.148,
          .ankle = 0.052,
          .sole_x = 0.012,
          .sole_y = 0.011,
          .foot = {0.158, 0.092},
          .trunk = 3.2,
          .hip = 0.16,
          .thigh_mass = 0.4,
          .shin_mass = 0.25,
          .ankle_mass = 0.3,
          .foot_mass = 0.2,
          .arm_mass = 0.45,
          .trunk_com = 0.11,
          .shoulder = 0.15,
          .arm = 0.3,
          .stiffness = 80,
          .damping = 2.2,
          .knee_zero = 0.4,
          .mirrored = false};
}

namespace detail {

inline std::string text(std::initializer_list<double> values) {
  std::string all;
  for (const double v : values) all += (all.empty() ? "" : " ") + std::to_string(v);
  return all;
}

/// Returns a link that is a homogeneous box with its centre at `at`. `touches`: it collides with other bodies.
inline std::string link(const std::string& name, double mass, std::array<double, 3> size, std::array<double, 3> at,
                        bool touches) {
  const auto [x, y, z] = size;
  const std::string origin = "<origin xyz=\"" + text({at[0], at[1], at[2]}) + "\"/>";
  const std::string box = origin + "<geometry><box size=\"" + text({x, y, z}) + "\"/></geometry>";
  return "<link name=\"" + name + "\"><inertial>" + origin + "<mass value=\"" + std::to_string(mass) +
         "\"/><inertia ixx=\"" + std::to_string(mass * (y * y + z * z) / 12) + "\" iyy=\"" +
         std::to_string(mass * (x * x + z * z) / 12) + "\" izz=\"" + std::to_string(mass * (x * x + y * y) / 12) +
         "\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial><visual>" + box + "</visual>" +
         (touches ? "<collision>" + box + "</collision>" : "") + "</link>\n";
}

inline std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                         std::array<double, 3> at, double pitch, const std::string& axis) {
  return "<joint name=\"" + name + "\" type=\"revolute\"><parent link=\"" + parent + "\"/><child link=\"" + child +
         "\"/><origin xyz=\"" + text({at[0], at[1], at[2]}) + "\" rpy=\"0 " + std::to_string(pitch) +
         " 0\"/><axis xyz=\"" + axis + "\"/><limit lower=\"-3\" upper=\"3\" effort=\"20\" velocity=\"8\"/>" +
         "<dynamics damping=\"0.005\" friction=\"0.05\" armature=\"0.008\"/></joint>\n";
}

}  // namespace detail

inline std::string urdf(const Numbers& n) {
  std::string all = "<robot name=\"generated\">\n" +
                    detail::link("base_link", n.trunk, {0.1, 1.6 * n.hip_y, 0.12}, {0, 0, n.trunk_com}, true);
  for (const std::string s : {"l", "r"}) {
    const double side = s == "l" ? 1 : -1;
    const std::string pitch = n.mirrored && s == "r" ? "0 -1 0" : "0 1 0";
    all += detail::link(s + "1", n.hip, {0.03, 0.03, 0.03}, {0, 0, 0.02}, false) +
           detail::link(s + "2", n.hip, {0.05, 0.03, 0.03}, {0, 0, 0}, false) +
           detail::link(s + "3", n.thigh_mass, {0.04, 0.04, 0.7 * n.thigh}, {0, 0, -0.5 * n.thigh}, true) +
           detail::link(s + "4", n.shin_mass, {0.04, 0.04, 0.6 * n.shin}, {0, 0, -0.5 * n.shin}, true) +
           detail::link(s + "5", n.ankle_mass, {0.05, 0.03, 0.03}, {0, 0, 0}, false) +
           detail::link(s + "_foot", n.foot_mass, {n.foot[0], n.foot[1], 0.01},
                        {n.sole_x, side * n.sole_y, 0.005 - n.ankle}, true) +
           detail::link(s + "_arm", n.arm_mass, {0.04, 0.04, n.arm}, {0, 0, -0.5 * n.arm}, false);
    all +=
        detail::joint(s + "1_yaw", "base_link", s + "1", {0, side * n.hip_y, n.hip_z}, 0, "0 0 1") +
        detail::joint(s + "2_roll", s + "1", s + "2", {0, 0, 0}, 0, "1 0 0") +
        detail::joint(s + "3_pitch", s + "2", s + "3", {0, 0, 0}, 0, pitch) +
        detail::joint(s + "4_knee", s + "3", s + "4", {0, 0, -n.thigh}, n.knee_zero, pitch) +
        detail::joint(s + "5_pitch", s + "4", s + "5", {0, 0, -n.shin}, 0, pitch) +
        detail::joint(s + "6_roll", s + "5", s + "_foot", {0, 0, 0}, 0, "1 0 0") +
        detail::joint(s + "_shoulder", "base_link", s + "_arm", {0, side * (n.hip_y + 0.05), n.shoulder}, 0, "0 1 0");
  }
  return all + "</robot>\n";
}

/// Writes the scenario of a robot, with its model and its numbers, and returns its path.
inline std::string scenario_of(const test::ScratchFolder& folder, const Numbers& n, const std::string& motion,
                               const std::string& tunables) {
  const double bend = 0.9, leg = 0.96 * (n.thigh + n.shin);  // m, from hip to ankle
  const double height = leg * 0.95 + n.ankle - n.hip_z;
  const auto set = [](const char* name, double value) {
    return std::string(name) + "=" + std::to_string(value) + ", ";
  };
  // distance of the mass of a leg below the hip
  const double below = (n.thigh_mass * 0.5 * n.thigh + n.shin_mass * (n.thigh + 0.5 * n.shin) +
                        (n.ankle_mass + n.foot_mass) * (n.thigh + n.shin)) /
                       n.leg();
  const double upper_z =
      (n.trunk * n.trunk_com + 2 * n.arm_mass * (n.shoulder - 0.5 * n.arm)) / (n.trunk + 2 * n.arm_mass);
  const std::string r = n.mirrored ? "-" : "", knee = std::to_string(bend - n.knee_zero);
  std::string joints, targets;
  for (const std::string s : {"l", "r"})
    for (const char* name : {"1_yaw", "2_roll", "3_pitch", "4_knee", "5_pitch", "6_roll"})
      joints += (joints.empty() ? "" : ",") + s + name + ":joint.position";
  for (std::size_t i = 0; i <= joints.size(); ++i)
    targets += i == joints.size() || joints[i] == ',' ? ".target" + std::string(i == joints.size() ? "" : ",")
                                                      : std::string(1, joints[i]);
  const std::string zero = std::to_string(-n.knee_zero);
  const std::string text =
      "world: {objects: {ground: {shape: plane, friction: 0.9}}}\nrobots:\n  walker:\n    model: " +
      folder.file("generated.urdf", urdf(n)) + "\n    joints: {l3_pitch: -0.45, l4_knee: " + knee +
      ", l5_pitch: -0.45, r3_pitch: " + (n.mirrored ? "0.45" : "-0.45") +
      ", r4_knee: " + (n.mirrored ? "-" + knee : knee) + ", r5_pitch: " + (n.mirrored ? "0.45" : "-0.45") +
      "}\n    motion: {use: " + motion + ", rate: 1000, joints: position, stiffness: " + std::to_string(n.stiffness) +
      ", damping: " + std::to_string(n.damping) + ", interpolate: 0.008}\n" +
      "    imu: {use: sensor.imu, on: base_link, rate: 125}\n    imu_error: {use: sensor.error, on: imu, part: "
      "mti1}\n" +
      "    walk:\n      use: controller.library\n      library: walk\n      rate: 125\n      inputs: "
      "[\"joint.position=" +
      joints + "\"]\n      outputs: [\"joint.position.target=" + targets +
      "\"]\n      arguments: [\"directions=" + (n.mirrored ? "++++++++---+" : "++++++++++++") + "\", \"zeros=0,0,0," +
      zero + ",0,0,0,0,0," + zero + ",0,0\"]\n      tunables: [" + set("hip_y", n.hip_y) + set("hip_z", n.hip_z) +
      set("hip_pitch_x", 0) + set("thigh", n.thigh) + set("shin", n.shin) + set("sole_x", n.sole_x) +
      set("sole_y", n.sole_y) + set("sole_z", n.ankle) + set("mass", n.mass()) + set("leg_mass", n.leg() / n.mass()) +
      set("leg_com", below / (n.thigh + n.shin + n.ankle)) + set("upper_com_x", 0) + set("upper_com_z", upper_z) +
      set("stiffness", n.stiffness) + set("foot_distance", 2 * (n.hip_y + n.sole_y)) + set("trunk_height", height) +
      tunables + "]\n";
  return folder.file("generated.yaml", text);
}

}  // namespace muro::walk_test
