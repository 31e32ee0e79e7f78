// SPDX-License-Identifier: MIT
#pragma once

#include "joint_drive_target.hpp"
#include "last_state.hpp"
#include "muro/algorithm.hpp"
#include "plugins/motion/common/motion/contact_role.hpp"
#include "plugins/motion/common/position_drive/drive_losses.hpp"
#include "plugins/motion/common/position_drive/moved_inertias.hpp"
#include "plugins/motion/common/watch/watch.hpp"
#include "world.hpp"

namespace muro::multibody {

/// A robot of a world: its model, its state, and the properties from which the state is imported and to which it is
/// exported.
class WorldRobot {
 public:
  /// Values that all robots of a world have in common.
  struct WorldTraits {
    std::string_view motion;          ///< id of the algorithm
    std::uint64_t contact_world = 0;  ///< see keys::contact_world
    double twist_lag = 0;             ///< see keys::twist_lag
    bool couples_mimics = true;       ///< constraints of the engine couple mimic joints to their leaders
    std::string_view advice;          ///< advice for a user when forces grow
  };

  WorldRobot(RobotModel model, std::uint32_t level);

  /// Connects the robot to its properties. `engine_memory`: number of values that the engine keeps for the robot.
  /// [setup]
  void connect(Connector& c, const RobotView& view, const Parameters& p, const WorldTraits& traits,
               std::size_t engine_memory);
  /// Finds the mode of joints in mode auto, whether velocities of joints in mode position are commanded, friction and
  /// armature of drives, and which contact results are read. [setup]
  void connect_by_name(Connector& c, const RobotView& view, const Parameters& p);
  /// Sets whether the contact algorithm adds to the external wrenches of the robot. [setup]
  void set_has_contact_law(bool has) { has_contact_law_ = has; }

  const RobotModel& model() const { return model_; }
  RobotState& state() { return state_; }
  const RobotState& state() const { return state_; }
  bool is_dynamic() const { return state_.motion_type == MotionType::dynamic; }

  /// Restarts the watch: the run begins or continues from the robot's state at the next import. [setup]
  void begin_watch();
  /// Lets the world move the robot from now on.
  void take_over();
  /// Copies properties to the state. Throws Error when they are not valid for a body.
  void import();
  /// Sets the tasks of drives in a step of the engine of `dt` (s). `gain_of_mimics`: 1/s. Throws Error for targets that
  /// are not finite.
  void set_drive_targets(const WorldTraits& traits, double dt, double gain_of_mimics);
  /// Adds the contact results after one of `count` steps of the engine within this step of the motion.
  void add_contacts(int count);
  /// Copies the state to properties. Throws Error when it exceeds the limits of the watch.
  void export_state();

  /// Returns the ratio of its motion to the limits of the watch: above 1 beyond them, infinite when the motion is not
  /// finite.
  double wildness() const;
  /// Returns a message on a failure of the engine: the name of the robot, its last motion, and advice.
  std::string failure_text(const std::string& failure) const;

 private:
  struct Joint {
    Out<double> position, velocity, effort;
    In<double> target;
    DriveLosses losses;
    PositionDrive position_drive;
    PositionTarget position_target;
    ObjectId object = no_object;
    double reach_square = 0;  ///< m^2, see watch::Reach; 1 for a joint that shifts
  };
  /// Wrenches on a loaded link.
  struct LinkWrenches {
    SumIn<Wrench> external;
    Out<Wrench> contact;  ///< by contacts in this world; none without shapes
    Out<Wrench> applied;  ///< when something reads it
    Wrench used;          ///< `external` of this step
    Wrench mean_contact;  ///< mean over the engine's steps so far, see RobotState::contact; when `applied` is read
  };

  void connect_joints(Connector& c, const RobotView& view, const Parameters& p, const watch::Reach& reach);
  void connect_drives(Connector& c, const RobotView& view, const Parameters& p);
  void connect_links(Connector& c, const RobotView& view);
  void connect_memory(Connector& c, const RobotView& view, std::string_view motion, std::size_t engine_memory);
  void import_wrenches();
  void export_contacts();
  Wrench at_link(std::size_t number, const Wrench& at_body, bool& has_body_states);
  void clear_outputs() const;
  bool follows_positions(std::size_t body) const;
  void check_input() const;
  bool is_within_limits() const;
  std::string broken_limit() const;
  std::string likely_cause() const;

  RobotModel model_;
  RobotState state_;
  watch::Watch watch_;
  bool watch_begins_ = true;      ///< the watch begins with the present step
  bool has_contact_law_ = false;  ///< the contact algorithm adds to external wrenches
  std::string_view advice_;
  std::uint32_t level_;  ///< the motion.level at which this world moves the robot
  In<std::uint32_t> active_level_;
  ContactRole contact_role_;
  Out<Pose> pose_;
  Out<Twist> twist_;
  std::vector<Joint> joints_;                                    ///< one per body
  MovedInertias moved_inertias_;                                 ///< when some joint follows positions
  bool has_position_drives_ = false, has_speed_limits_ = false;  ///< speed limits: of joints in mode effort
  std::vector<double> positions_;                                ///< joint positions, one per body
  ListOut<ContactWrench> contacts_;
  std::vector<LinkWrenches> wrenches_;                 ///< one per loaded link
  bool tells_applied_ = false;                         ///< `applied` of some of them is read
  std::vector<std::string> joint_names_, link_names_;  ///< same order; for messages
  LastState last_;
  std::vector<BodyState> body_states_;  ///< scratch
};

}  // namespace muro::multibody
