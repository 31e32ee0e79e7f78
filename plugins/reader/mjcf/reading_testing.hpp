// SPDX-License-Identifier: MIT
// For tests: robots and worlds from texts, and the problems reported for them.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <map>

#include "core/world_model.hpp"
#include "library.hpp"
#include "muro/toolkit/link_pose.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/model_file/message.hpp"
#include "read.hpp"
#include "tests/support/files.hpp"

namespace muro::mjcf {

using model_file::concat;

using Lines = std::vector<std::string>;

inline Lines lines_of(const std::vector<RobotTree::Problem>& problems) {
  Lines lines;
  for (const auto& p : problems) {
    constexpr const char* names[] = {"note", "warning", "error", "lost collision"};
    lines.push_back(concat(names[std::size_t(p.severity)], " ", p.line, ": ", p.text));
  }
  return lines;
}

inline bool has_line(const Lines& lines, std::string_view part) {
  for (const std::string& l : lines)
    if (l.find(part) != l.npos) return true;
  return false;
}

inline std::string joined(const Lines& lines) {
  std::string all;
  for (const std::string& l : lines) all += l + "\n";
  return all;
}

/// A robot as it was read.
struct Robot {
  RobotTree tree;
  Lines problems;

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
  std::string name(std::int32_t part) const { return tree.components().at(std::size_t(part)).name; }
  const RobotTree::FlatLink* joint(const std::string& name_of_joint) const {
    for (const auto& f : tree.links())
      if (f.joint >= 0 && name(f.joint) == name_of_joint) return &f;
    return nullptr;
  }
  Lines links() const {
    Lines names;
    for (const auto& f : tree.links()) names.push_back(name(f.body));
    return names;
  }
  Lines joints() const {
    Lines names;
    for (const auto& f : tree.links())
      if (f.joint >= 0) names.push_back(name(f.joint));
    return names;
  }
  /// Returns the pose of a link in the base's frame. `positions`: of joints by name; all others are at 0.
  Pose pose(const std::string& link, const std::map<std::string, double>& positions = {}) const {
    std::vector<Pose> poses;
    for (const auto& f : tree.links()) {
      const auto q = f.joint < 0 ? positions.end() : positions.find(name(f.joint));
      const Pose in_parent = pose_in_parent(f.link, q == positions.end() ? 0 : q->second);
      poses.push_back(f.link.parent < 0 ? Pose{} : poses[std::size_t(f.link.parent)] * in_parent);
      if (name(f.body) == link) return poses.back();
    }
    return {Vec3::Constant(NAN), Quat::Identity()};
  }
};

inline Robot robot_of(const std::string& text, const std::string& path = "/nowhere/robot.xml") {
  Robot robot;
  read_text(text, path, robot.tree);
  robot.problems = lines_of(robot.tree.problems());
  if (robot.tree.usable()) robot.tree.close();
  return robot;
}

/// Returns a file with the world `bodies`, followed by the elements `more`.
inline std::string mujoco(const std::string& bodies, const std::string& more = "") {
  return "<mujoco>\n<worldbody>\n" + bodies + "\n</worldbody>\n" + more + "\n</mujoco>\n";
}

inline ::testing::AssertionResult near(const Pose& a, const Pose& b, double tolerance = 1e-12) {
  const bool same = (a.position - b.position).norm() <= tolerance &&
                    std::abs(std::abs(a.orientation.dot(b.orientation)) - 1) <= tolerance;
  if (same) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << a.position.transpose() << " / " << a.orientation.coeffs().transpose()
                                       << " is not near " << b.position.transpose() << " / "
                                       << b.orientation.coeffs().transpose();
}

}  // namespace muro::mjcf
