// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "landmark.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "rule.hpp"

namespace muro::level {

// Parameters and properties for the descriptions of algorithms that use rules.
inline constexpr Parameter parameters[] = {
    texts("rules", "which motion moves the robot, and when; the first rule that holds decides; none: only `dwell`"),
    real("dwell", "s", 0.1, "a motion moves the robot for so long at least").between(0, 1e6),
};
inline constexpr PropertyUse reads[] = {
    {"motion.level", "of the robot"},
    {"motion.level.names", "of the robot"},
    {"pose", "of bases of robots, and of scenery, for rules by distance and place"},
    {"contacts", "of the robot, for rules by contact"},
};
inline constexpr PropertyUse writes[] = {{"motion.level.rule", "of the robot"}};

/// Chooses by rules which of its motions moves each robot. If no rule holds, `motion.level.target` decides, which
/// control code writes. After a change by anyone the motion is kept for `dwell`, counted from the run that sees the
/// change.
class RulesAlgorithm : public Algorithm {
 public:
  /// Throws Error if a rule is not understood, or depends on the speed of the run and `run_speed_is_known` is false.
  void connect(Connector& connector) override;

 protected:
  explicit RulesAlgorithm(bool run_speed_is_known) : run_speed_is_known_(run_speed_is_known) {}

  /// `run_speed`: in units of real time; nothing if it is not known yet.
  void choose(const Step& step, Range range, std::optional<double> run_speed = std::nullopt) const;

 private:
  struct Condition {
    Rule rule;
    Landmark landmark;  ///< for rules about distance and place
  };
  struct Robot {
    std::vector<Condition> conditions;
    bool by_contact = false;
    In<Pose> pose;
    In<std::uint32_t> level;
    Out<std::int32_t> choice;  ///< -1: no rule holds, and others may choose
    ListIn<Contact> contacts;
    Out<std::int64_t> switch_time, contact_time;
    Out<std::int32_t> known_level;  ///< in the last run; -1: none yet
    std::vector<RobotId> robot_of;  ///< by object, for rules by contact
    RobotId id = no_robot;
  };

  void connect_robot(Connector& c, const RobotView& view);
  Condition read_condition(Connector& c, const RobotView& view, std::string_view text,
                           std::span<const std::string> levels) const;
  void choose(const Robot& r, const Step& step, std::optional<double> run_speed) const;
  static bool is_in_contact(const Robot& r);
  static bool holds(const Robot& r, const Condition& c, const Step& step, std::optional<double> run_speed);

  bool run_speed_is_known_;
  std::int64_t dwell_ = 0;  ///< ns
  std::vector<Robot> robots_;
};

}  // namespace muro::level
