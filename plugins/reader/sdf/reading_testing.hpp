// SPDX-License-Identifier: MIT
// For tests: robots and worlds from texts, and the problems reported for them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "core/world_model.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"
#include "read.hpp"
#include "source_file.hpp"
#include "tests/support/files.hpp"

namespace muro::sdf {

using Lines = std::vector<std::string>;

inline Lines lines_of(const std::vector<RobotTree::Problem>& problems) {
  Lines lines;
  for (const auto& p : problems) {
    constexpr const char* names[] = {"note", "warning", "error", "lost collision"};
    lines.push_back(concat(names[std::size_t(p.severity)], " ", p.line, ":", p.column, " ", p.text));
  }
  return lines;
}

/// Returns the lines that are not notes.
inline Lines without_notes(const Lines& lines) {
  Lines kept;
  for (const std::string& l : lines)
    if (!l.starts_with("note")) kept.push_back(l);
  return kept;
}

/// A robot as it was read.
struct Robot {
  RobotTree tree;
  Lines problems;

  /// Returns the value of a constant of a part; nothing if the part does not have it.
  template <class T>
  std::vector<T> constants(const std::string& part, const Key<T>& key) const {
    std::vector<T> values;
    for (const auto& p : tree.components())
      for (const auto& c : p.constants)
        if (p.name == part && c.key.name == key.name) {
          values.resize(c.count == single_value ? 1 : c.count);
          std::memcpy(static_cast<void*>(values.data()), c.data.data(), c.data.size());
        }
    return values;
  }
  const RobotTree::FlatLink* frame(const std::string& body) const {
    for (const auto& f : tree.links())
      if (name(f.body) == body) return &f;
    return nullptr;
  }
  const RobotTree::FlatLink* joint(const std::string& name_of_joint) const {
    for (const auto& f : tree.links())
      if (f.joint >= 0 && name(f.joint) == name_of_joint) return &f;
    return nullptr;
  }
  std::string name(std::int32_t part) const { return tree.components().at(std::size_t(part)).name; }

  /// Returns the pose of a body in the base's frame. `positions`: of joints by name; all others are at 0.
  Pose pose(const std::string& body, const std::map<std::string, double>& positions = {}) const {
    std::vector<Pose> poses;
    for (const auto& f : tree.links()) {
      const auto q = f.joint < 0 ? positions.end() : positions.find(name(f.joint));
      const Pose in_parent = pose_in_parent(f.link, q == positions.end() ? 0 : q->second);
      poses.push_back(f.link.parent < 0 ? Pose{} : poses[std::size_t(f.link.parent)] * in_parent);
      if (name(f.body) == body) return poses.back();
    }
    return {Vec3::Constant(NAN), Quat::Identity()};
  }
  /// Returns the kind and name of each node: "base a", "fork", "revolute axis_joint", ...
  Lines blocks() const {
    constexpr const char* kinds[] = {"base", "fork", "translation", "rotation", "revolute", "prismatic", "body"};
    Lines lines;
    for (const auto& n : tree.nodes()) lines.push_back(kinds[int(n.kind)] + (n.name.empty() ? "" : " " + n.name));
    return lines;
  }
};

inline Robot robot_of(const std::string& sdf, const std::string& folder = "/nowhere") {
  Robot robot;
  read_text(sdf, folder, robot.tree);
  robot.problems = lines_of(robot.tree.problems());
  if (robot.tree.usable()) robot.tree.close();
  return robot;
}

/// Returns a file with a model `m` in line 2; `inside` begins at line 3, column 1.
inline std::string model(const std::string& inside, const std::string& version = "1.9") {
  return "<sdf version='" + version + "'>\n<model name='m'>\n" + inside + "\n</model></sdf>";
}

inline std::string inertial(double mass = 1) {
  return concat("<inertial><mass>", mass,
                "</mass><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>1</iyy><iyz>0</iyz>",
                "<izz>1</izz></inertia></inertial>");
}
/// Returns a link of 1 kg.
inline std::string link(const std::string& name, const std::string& inside = "") {
  return "<link name='" + name + "'>" + inside + inertial() + "</link>";
}
inline std::string joint(const std::string& name, const std::string& type, const std::string& parent,
                         const std::string& child, const std::string& inside = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent>" + parent + "</parent><child>" + child + "</child>" +
         inside + "</joint>";
}
inline std::string axis(const std::string& xyz, const std::string& more = "", const std::string& name = "axis") {
  return "<" + name + "><xyz>" + xyz + "</xyz>" + more + "</" + name + ">";
}

inline ::testing::AssertionResult near(const Pose& a, const Pose& b, double tolerance = 1e-12) {
  const bool same = (a.position - b.position).norm() <= tolerance &&
                    std::abs(std::abs(a.orientation.dot(b.orientation)) - 1) <= tolerance;
  if (same) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a.position.transpose() << " / " << a.orientation.coeffs().transpose()
                                       << " is not near " << b.position.transpose() << " / "
                                       << b.orientation.coeffs().transpose();
}

}  // namespace muro::sdf
