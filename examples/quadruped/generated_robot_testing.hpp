// SPDX-License-Identifier: MIT
// Test quadrupeds that differ from those of examples/models in lengths, masses, limits, and in the zeros and directions
// of their joints; and the scenario in which they trot.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "tests/support/files.hpp"

namespace muro::quadruped_test {

/// Numbers of a quadruped: m, kg, N m, rad.
struct Numbers {
  double hip_front, hip_rear, hip_side, hip_up, abduction, thigh, shank, foot_radius;
  double trunk, hip_mass, thigh_mass, shank_mass, foot_mass;
  std::array<double, 3> trunk_size;
  std::array<double, 3> effort;
  double speed, armature, friction;
  double bend_front, bend_rear;
  bool mirrored;               ///< joints of the right side turn the other way
  double hip_zero, knee_zero;  ///< angles of hip and knee where their joints are at 0

  double mass() const { return trunk + 4 * (hip_mass + thigh_mass + shank_mass + foot_mass); }
};

/// Returns a robot like Mini Cheetah (mit-biomimetics/Cheetah-Software: lengths, masses, efforts), joints mirrored.
inline Numbers mini_cheetah() {
  return {.hip_front = 0.19,
          .hip_rear = -0.19,
          .hip_side = 0.049,
          .hip_up = 0,
          .abduction = 0.062,
          .thigh = 0.209,
          .shank = 0.195,
          .foot_radius = 0.0175,
          .trunk = 3.3,
          .hip_mass = 0.54,
          .thigh_mass = 0.634,
          .shank_mass = 0.05,
          .foot_mass = 0.014,
          .trunk_size = {0.36, 0.1, 0.1},
          .effort = {18, 18, 28},
          .speed = 30,
          .armature = 0.00227,
          .friction = 0.2,
          .bend_front = -1,
          .bend_rear = -1,
          .mirrored = true,
          .hip_zero = 0,
          .knee_zero = -1.2};
}

/// Returns a robot of 30 kg with long legs, knees that point to each other, and hips above the middle of the trunk.
inline Numbers large() {
  return {.hip_front = 0.28,
          .hip_rear = -0.28,
          .hip_side = 0.12,
          .hip_up = 0.03,
          .abduction = 0.1,
          .thigh = 0.3,
          .shank = 0.32,
          .foot_radius = 0.03,
          .trunk = 16,
          .hip_mass = 1.2,
          .thigh_mass = 1.6,
          .shank_mass = 0.5,
          .foot_mass = 0.1,
          .trunk_size = {0.56, 0.26, 0.2},
          .effort = {60, 60, 70},
          .speed = 12,
          .armature = 0.01,
          .friction = 0.5,
          .bend_front = -1,
          .bend_rear = 1,
          .mirrored = false,
          .hip_zero = 0.5,
          .knee_zero = 0};
}

/// Returns a robot of 2 kg on legs of 16 cm.
inline Numbers small() {
  return {.hip_front = 0.1,
          .hip_rear = -0.1,
          .hip_side = 0.04,
          .hip_up = 0,
          .abduction = 0.03,
          .thigh = 0.08,
          .shank = 0.08,
          .foot_radius = 0.01,
          .trunk = 1.2,
          .hip_mass = 0.08,
          .thigh_mass = 0.09,
          .shank_mass = 0.025,
          .foot_mass = 0.005,
          .trunk_size = {0.2, 0.08, 0.05},
          .effort = {2, 2, 2},
          .speed = 15,
          .armature = 0,
          .friction = 0.01,
          .bend_front = -1,
          .bend_rear = -1,
          .mirrored = true,
          .hip_zero = -0.3,
          .knee_zero = 0.2};
}

inline std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

class GeneratedRobot {
 public:
  explicit GeneratedRobot(const Numbers& n) : n_(n) {}

  /// Legs in the order of the file.
  static constexpr std::array<const char*, 4> legs{"RR", "RL", "FR", "FL"};

  std::string urdf() const {
    std::string text = "<robot name='generated'><link name='base_link'>" +
                       body(n_.trunk, "", box(n_.trunk_size[0], n_.trunk_size[1], n_.trunk_size[2]), n_.trunk_size) +
                       "</link>";
    for (const std::string leg : legs) text += leg_of(leg);
    return text + "</robot>";
  }
  /// Signs of the joints, or their angles at 0, in the order of the file.
  std::string signs() const {
    return all([&](const std::string& leg, int) { return sign(leg); });
  }
  std::string offsets() const {
    return all([&](const std::string& leg, int j) { return zero(leg, j); });
  }
  double position(const std::string& leg, int j, double angle) const { return sign(leg) * (angle - zero(leg, j)); }
  double bend(const std::string& leg) const { return leg[0] == 'F' ? n_.bend_front : n_.bend_rear; }

  /// Returns the scenario. `tunables`: beside those of the model; `world`: further lines of the world.
  std::string scenario(const std::string& motion, const std::string& tunables, const std::string& world = "") const {
    std::string joints, feet, contacts;
    for (const std::string leg : legs) {
      joints += leg + "_hip_pitch: " + number(position(leg, 1, -0.9 * bend(leg))) + ", " + leg +
                "_knee: " + number(position(leg, 2, 1.8 * bend(leg))) + ", ";
      feet += "    " + leg + ": {use: sensor.foot, on: " + leg + "_foot, rate: 500, threshold: 3}\n";
      contacts += (contacts.empty() ? "" : ",") + leg + ":foot.contact";
    }
    joints.resize(joints.size() - 2);
    return "seed: 1\nworld:\n  objects:\n    ground: {shape: plane, friction: 0.8}\n" + world +
           "robots:\n  walker:\n    model: generated.urdf\n    joints: {" + joints + "}\n    motion: {use: motion." +
           motion + ", rate: 1000, joints: effort}\n    imu: {use: sensor.imu, on: base_link, rate: 500}\n" + feet +
           "    trot:\n      use: controller.library\n      library: trot\n      rate: 500\n      arguments: " +
           "[\"legs=RR RL FR FL\", \"signs=" + signs() + "\", \"offsets=" + offsets() + "\"]\n      tunables: {" +
           model_tunables() + (tunables.empty() ? "" : ", ") + tunables +
           "}\n      inputs: [\"joint.position=*:joint.position\", \"joint.velocity=*:joint.velocity\", "
           "\"foot.contact=" +
           contacts + "\"]\n      outputs: [\"joint.effort.target=*:joint.effort.target\"]\n";
  }
  /// Writes model and scenario; returns the path of the scenario.
  std::string write(const test::ScratchFolder& folder, const std::string& motion, const std::string& tunables,
                    const std::string& world = "") const {
    folder.file("generated.urdf", urdf());
    return folder.file("generated.yaml", scenario(motion, tunables, world));
  }

 private:
  double sign(const std::string& leg) const { return n_.mirrored && leg[1] == 'R' ? -1 : 1; }
  double zero(const std::string&, int j) const { return j == 1 ? n_.hip_zero : j == 2 ? n_.knee_zero : 0; }

  std::string model_tunables() const {
    const std::pair<const char*, double> all[] = {{"hip_front", n_.hip_front},
                                                  {"hip_rear", n_.hip_rear},
                                                  {"hip_side", n_.hip_side},
                                                  {"hip_up", n_.hip_up},
                                                  {"abduction", n_.abduction},
                                                  {"thigh", n_.thigh},
                                                  {"shank", n_.shank},
                                                  {"foot_radius", n_.foot_radius},
                                                  {"bend_front", n_.bend_front},
                                                  {"bend_rear", n_.bend_rear},
                                                  {"mass", n_.mass()},
                                                  {"thigh_mass", n_.thigh_mass},
                                                  {"shank_mass", n_.shank_mass},
                                                  {"foot_mass", n_.foot_mass},
                                                  {"armature", n_.armature},
                                                  {"effort_abduction", n_.effort[0]},
                                                  {"effort_hip", n_.effort[1]},
                                                  {"effort_knee", n_.effort[2]},
                                                  {"speed", n_.speed}};
    std::string text;
    for (const auto& [name, value] : all) text += (text.empty() ? "" : ", ") + std::string(name) + ": " + number(value);
    return text;
  }
  template <class Value>
  static std::string all(Value value) {
    std::string text;
    for (const std::string leg : legs)
      for (int j = 0; j < 3; ++j) text += (text.empty() ? "" : " ") + number(value(leg, j));
    return text;
  }
  static std::string box(double x, double y, double z) {
    return "<box size='" + number(x) + " " + number(y) + " " + number(z) + "'/>";
  }
  static std::string body(double mass, const std::string& origin, const std::string& shape,
                          const std::array<double, 3>& size) {
    const double x = size[0] * size[0], y = size[1] * size[1], z = size[2] * size[2], m = mass / 12;
    return "<inertial>" + origin + "<mass value='" + number(mass) + "'/><inertia ixx='" + number(m * (y + z)) +
           "' iyy='" + number(m * (x + z)) + "' izz='" + number(m * (x + y)) +
           "' ixy='0' ixz='0' iyz='0'/></inertial>" +
           (shape.empty() ? "" : "<collision>" + origin + "<geometry>" + shape + "</geometry></collision>");
  }
  std::string joint(const std::string& leg, int j, const std::string& parent, const std::string& child,
                    const std::string& xyz) const {
    static const char* const names[] = {"_hip_roll", "_hip_pitch", "_knee"};
    const std::string direction = sign(leg) < 0 ? "-1" : "1";
    return "<joint name='" + leg + names[j] + "' type='revolute'><parent link='" + parent + "'/><child link='" + child +
           "'/><origin xyz='" + xyz + "' rpy='0 " + number(zero(leg, j)) + " 0'/><axis xyz='" +
           (j == 0 ? direction + " 0 0" : "0 " + direction + " 0") + "'/><limit lower='-4' upper='4' effort='" +
           number(n_.effort[std::size_t(j)]) + "' velocity='" + number(n_.speed) +
           "'/><dynamics damping='0.01' friction='" + number(n_.friction) + "' armature='" + number(n_.armature) +
           "'/></joint>";
  }
  std::string leg_of(const std::string& leg) const {
    const double side = leg[1] == 'L' ? 1 : -1;
    const auto below = [](double length) { return "<origin xyz='0 0 " + number(-0.5 * length) + "'/>"; };
    std::string text = "<link name='" + leg + "_hip'>" + body(n_.hip_mass, "", "", {0.08, 0.08, 0.08}) + "</link>";
    text += joint(leg, 0, "base_link", leg + "_hip",
                  number(leg[0] == 'F' ? n_.hip_front : n_.hip_rear) + " " + number(side * n_.hip_side) + " " +
                      number(n_.hip_up));
    text += "<link name='" + leg + "_thigh'>" +
            body(n_.thigh_mass, below(n_.thigh), box(0.03, 0.03, 0.9 * n_.thigh), {0.04, 0.04, n_.thigh}) + "</link>";
    text += joint(leg, 1, leg + "_hip", leg + "_thigh", "0 " + number(side * n_.abduction) + " 0");
    text += "<link name='" + leg + "_shank'>" +
            body(n_.shank_mass, below(n_.shank), box(0.02, 0.02, 0.9 * n_.shank), {0.02, 0.02, n_.shank}) + "</link>";
    text += joint(leg, 2, leg + "_thigh", leg + "_shank", "0 0 " + number(-n_.thigh));
    text += "<link name='" + leg + "_foot'>" +
            body(n_.foot_mass, "", "<sphere radius='" + number(n_.foot_radius) + "'/>",
                 {n_.foot_radius, n_.foot_radius, n_.foot_radius}) +
            "</link><joint name='" + leg + "_ankle' type='fixed'><parent link='" + leg + "_shank'/><child link='" +
            leg + "_foot'/><origin xyz='0 0 " + number(-n_.shank) + "'/></joint>";
    return text;
  }

  Numbers n_;
};

}  // namespace muro::quadruped_test
