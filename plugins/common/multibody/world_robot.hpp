// SPDX-License-Identifier: MIT
#pragma once

#include "last_state.hpp"
#include "muro/algorithm.hpp"
#include "world.hpp"

namespace muro::multibody {

/// A robot of a world: its model and state, and the properties that the state is imported from and exported to.
class WorldRobot {
 public:
  /// What all robots of a world have in common.
  struct WorldTraits {
    std::string_view motion;          ///< id of the algorithm
    std::uint64_t contact_world = 0;  ///< see keys::contact_world
    double twist_lag = 0;             ///< see keys::twist_lag
  };

  WorldRobot(RobotModel model, std::uint32_t level);

  /// `engine_memory`: how many numbers the engine keeps of the robot. [setup]
  void connect(Connector& c, const RobotView& view, const WorldTraits& traits, std::size_t engine_memory);

  const RobotModel& model() const { return model_; }
  RobotState& state() { return state_; }
  bool is_dynamic() const { return state_.motion_type == MotionType::dynamic; }

  /// The world moves the robot from now on.
  void take_over(const WorldTraits& traits);
  /// Properties to state.
  void import();
  /// Sets what drives are to do in a step of the engine. `position_gain`: 1/s.
  void set_drive_targets(double position_gain);
  /// State to properties. Throws Error when it is not finite.
  void export_state();

 private:
  struct Joint {
    Out<double> position, velocity, effort;
    In<double> target;
  };
  /// Of a loaded link.
  struct LinkWrenches {
    SumIn<Wrench> external;
    Out<Wrench> contact;  ///< by contacts in the own world; none without shapes
  };

  void connect_joints(Connector& c, const RobotView& view);
  void connect_links(Connector& c, const RobotView& view);
  void connect_memory(Connector& c, const RobotView& view, std::string_view motion, std::size_t engine_memory);
  void import_wrenches();
  void export_contacts();
  void clear_outputs() const;

  RobotModel model_;
  RobotState state_;
  std::uint32_t level_;  ///< the motion.level at which this world moves the robot
  In<std::uint32_t> active_level_;
  Out<std::uint64_t> contact_world_;
  Out<double> twist_lag_;
  Out<Pose> pose_;
  Out<Twist> twist_;
  std::vector<Joint> joints_;           ///< one per body
  std::vector<LinkWrenches> wrenches_;  ///< one per loaded link
  LastState last_;
  std::vector<BodyState> body_states_;  ///< scratch
};

}  // namespace muro::multibody
