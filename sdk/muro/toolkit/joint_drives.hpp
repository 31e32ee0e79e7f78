// SPDX-License-Identifier: MIT
// Drives of the joints of a robot: the parameters that all motions with driven joints share.
#pragma once

#include <string>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// The target that a joint follows. The limits of the model hold in each mode.
enum class DriveMode : std::uint8_t {
  velocity,      ///< joint.velocity.target
  position,      ///< joint.position.target
  acceleration,  ///< joint.acceleration.target
  effort,        ///< joint.effort.target acts on the joint
  passive,       ///< no target: the joint moves freely, with its damping and friction
};

/// Parameters of a motion with driven joints, in addition to `joints`, the mode of all joints that none of them names.
/// A name is that of a joint, or the beginning of one followed by `*`.
inline constexpr Parameter velocity_joints = texts("velocity_joints", "joints that follow velocity targets");
inline constexpr Parameter position_joints = texts("position_joints", "joints that follow position targets");
inline constexpr Parameter effort_joints = texts("effort_joints", "joints that efforts drive");
inline constexpr Parameter passive_joints = texts("passive_joints", "joints that nothing drives");

/// Returns the mode for a value of the parameter `joints`. For `auto`, which leaves the mode open, it is the first one.
inline DriveMode drive_mode_of(std::string_view word) {
  if (word == "auto") return DriveMode::velocity;
  constexpr std::pair<std::string_view, DriveMode> words[] = {{"velocity", DriveMode::velocity},
                                                              {"position", DriveMode::position},
                                                              {"acceleration", DriveMode::acceleration},
                                                              {"effort", DriveMode::effort},
                                                              {"passive", DriveMode::passive}};
  for (const auto& [known, mode] : words)
    if (known == word) return mode;
  throw std::logic_error("no drive mode is named `" + std::string(word) + "`");
}

namespace detail {

/// Whether `pattern` is `name`, or a beginning of it followed by `*`.
inline bool names_joint(std::string_view pattern, std::string_view name) {
  if (pattern.empty() || pattern.back() != '*') return pattern == name;
  return name.substr(0, pattern.size() - 1) == pattern.substr(0, pattern.size() - 1);
}

}  // namespace detail

/// Returns the mode of every link's joint, from `joints` and the four lists of names; modes of fixed and mimic joints
/// do not count. `is_open`: for each link, whether no list names its joint and `joints` is `auto`. Throws Error for a
/// name that no joint has and for a joint with two modes. [setup]
inline std::vector<DriveMode> drive_modes_of(const Connector& connector, const RobotView& robot, const Parameters& p,
                                             std::vector<bool>* is_open = nullptr) {
  std::vector<DriveMode> modes(robot.links.size(), drive_mode_of(p.text("joints")));
  std::vector<std::string_view> chosen_by(modes.size());
  const auto name_of_joint = [&](const Link& f) {
    return connector.object_name(f.joint_object).substr(robot.name.size() + 1);
  };
  constexpr std::pair<const Parameter*, DriveMode> lists[] = {{&velocity_joints, DriveMode::velocity},
                                                              {&position_joints, DriveMode::position},
                                                              {&effort_joints, DriveMode::effort},
                                                              {&passive_joints, DriveMode::passive}};
  for (const auto& [list, mode] : lists)
    for (const std::string_view pattern : p.texts(list->name)) {
      bool found = false;
      std::vector<std::string> known;
      for (std::size_t i = 0; i < modes.size(); ++i) {
        const Link& f = robot.links[i];
        if (f.joint == JointKind::fixed) continue;
        known.emplace_back(name_of_joint(f));
        if (!detail::names_joint(pattern, known.back())) continue;
        found = true;
        if (!chosen_by[i].empty() && chosen_by[i] != list->name)
          throw Error("joint `" + known.back() + "` is named by `" + std::string(chosen_by[i]) + "` and by `" +
                      std::string(list->name) + "`; a joint has one mode");
        chosen_by[i] = list->name;
        modes[i] = mode;
      }
      if (found) continue;
      std::string all;
      for (const std::string& k : known) all += " `" + k + "`";
      throw Error("`" + std::string(list->name) + "` names `" + std::string(pattern) + "`, but `" +
                  std::string(robot.name) + "` has no such joint" + did_you_mean(pattern, known) +
                  "; its joints are:" + (all.empty() ? " none" : all));
    }
  if (is_open) {
    is_open->assign(modes.size(), false);
    if (p.text("joints") == "auto")
      for (std::size_t i = 0; i < modes.size(); ++i)
        (*is_open)[i] = robot.links[i].joint != JointKind::fixed && robot.links[i].mimic < 0 && chosen_by[i].empty();
  }
  return modes;
}

}  // namespace muro
