// SPDX-License-Identifier: MIT
// For tests: a RobotBuilder that records the calls.
#pragma once

#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "document.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"
#include "read.hpp"

namespace muro::urdf {

/// Two links that have a mass.
inline constexpr char body_a[] =
    "<link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
    "izz='1'/></inertial></link>";
inline constexpr char link_b[] =
    "<link name='b'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
    "izz='1'/></inertial></link>";

class RecordingBuilder final : public RobotBuilder {
 public:
  std::vector<std::string> calls;     ///< "translation 0.1 0 0", "revolute hinge about 0 1 0"
  std::vector<std::string> problems;  ///< "error 3:5 text"
  std::vector<Quat> rotations;
  std::map<std::string, JointLimits> limits;
  std::map<std::string, Inertia> inertials;
  std::map<std::string, std::vector<Shape>> collisions, visuals;
  std::map<std::string, std::vector<std::string>> materials;  ///< materials of visuals, by body
  std::vector<std::string> texts{""};
  std::vector<std::string> subsystems;         ///< "laser: {use: laser.embree, ...}"
  std::vector<std::int32_t> subsystem_places;  ///< line, column

  void base(std::string_view name) noexcept override { part("base", name, ""); }
  void fork() noexcept override { calls.emplace_back("fork"); }
  void end() noexcept override { calls.emplace_back("end"); }
  void translation(const Vec3& v) noexcept override { calls.push_back("translation " + text(v)); }
  void rotation(const Quat& q) noexcept override {
    calls.emplace_back("rotation");
    rotations.push_back(q);
  }
  void revolute(std::string_view name, const Vec3& axis, const JointLimits& l) noexcept override {
    part("revolute", name, " about " + text(axis));
    limits[last_] = l;
  }
  void prismatic(std::string_view name, const Vec3& axis, const JointLimits& l) noexcept override {
    part("prismatic", name, " along " + text(axis));
    limits[last_] = l;
  }
  void mimic(std::string_view leader, double multiplier, double offset) noexcept override {
    calls.push_back(concat("mimic ", leader, " * ", multiplier, " + ", offset));
  }
  void body(std::string_view name) noexcept override { part("body", name, ""); }
  TextId intern(std::string_view t) noexcept override {
    texts.emplace_back(t);
    return TextId(texts.size() - 1);
  }
  void report(Severity severity, std::string_view t, int line, int column) noexcept override {
    constexpr const char* names[] = {"note", "warning", "error", "lost collision"};
    problems.push_back(concat(names[std::size_t(severity)], " ", line, ":", column, " ", t));
  }

 private:
  static std::string text(const Vec3& v) { return concat(v.x(), " ", v.y(), " ", v.z()); }
  void part(const char* kind, std::string_view name, const std::string& more) {
    last_ = name;
    calls.push_back(concat(kind, " ", name, more));
  }
  void set_raw(const KeyInfo& key, const void* data, std::uint32_t count) noexcept override {
    if (key.name == keys::inertial.name) {
      inertials[last_] = *static_cast<const Inertia*>(data);
    } else if (key.name == keys::visual_materials.name) {
      for (std::uint32_t i = 0; i < count; ++i)
        materials[last_].push_back(texts[std::size_t(static_cast<const TextId*>(data)[i])]);
    } else if (key.name == keys::model_subsystems.name) {
      for (std::uint32_t i = 0; i < count; ++i)
        subsystems.push_back(texts[std::size_t(static_cast<const TextId*>(data)[i])]);
    } else if (key.name == keys::model_subsystem_places.name) {
      subsystem_places.assign(static_cast<const std::int32_t*>(data), static_cast<const std::int32_t*>(data) + count);
    } else if (key.type->name == ValueTraits<double>::name) {
      calls.push_back(concat("set ", key.name, " ", *static_cast<const double*>(data)));
    } else if (key.name == keys::joint_drive.name) {
      calls.push_back(concat("set ", key.name, " ", *static_cast<const std::uint32_t*>(data)));
    } else {
      const auto* first = static_cast<const Shape*>(data);
      (key.name == keys::collision_shapes.name ? collisions : visuals)[last_].assign(first, first + count);
    }
  }

  std::string last_;
};

inline RecordingBuilder recorded(const std::string& urdf, const std::string& folder = "/nowhere") {
  RecordingBuilder builder;
  read_text(urdf, folder, builder);
  return builder;
}

}  // namespace muro::urdf
