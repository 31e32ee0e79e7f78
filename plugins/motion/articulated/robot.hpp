// SPDX-License-Identifier: MIT
// A robot of motion.articulated: the properties that hold its state, and the wrenches on it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "model.hpp"
#include "plugins/common/contact_geometry/impact_input.hpp"
#include "plugins/motion/common/motion/contact_role.hpp"
#include "plugins/motion/common/position_drive/drive_losses.hpp"
#include "plugins/motion/common/position_drive/position_target.hpp"
#include "robot_contacts.hpp"
#include "self_contacts.hpp"

namespace muro::articulated {

class Robot {
 public:
  /// Connects the robot. `level`: the motion.level at which this motion moves it. [setup]
  Robot(Connector& c, const RobotView& view, const Parameters& p, std::uint32_t level);
  /// Finds which properties are commanded and read. [setup]
  void connect_by_name(Connector& c, const RobotView& view, const Parameters& p);
  /// Begins or continues the run; all handles may be read. [setup]
  void start();
  /// Continues after another motion has moved the robot.
  void take_over();

  const multibody::RobotModel& model() const { return rigid_; }
  /// Returns the model for kernels; it is complete after connect_by_name(). [setup]
  const Model& kernel_model() const { return model_; }
  const RobotState& state() const { return state_; }
  const Pose& pose() const { return *pose_; }
  const Twist& twist() const { return *twist_; }
  /// Calls `visit` for the sum of external wrenches on each link.
  template <class Visit>
  void each_external(Visit visit) const {
    for (const LoadedLink& link : links_) visit(link.external);
  }
  /// Velocities of joints, one per link (rad/s or m/s); null where there is none. [setup]
  const std::vector<const double*>& velocities() const { return velocities_; }
  /// Masses of its bodies.
  const std::vector<Mass>& masses() const { return masses_; }
  std::size_t contact_count() const { return contacts_.contacts().size(); }

  /// Finds contacts. [step, before any robot moves]
  void look_up_contacts(const TouchedBodies& bodies) { contacts_.look_up(bodies); }
  /// Updates the state for a step of `dt` (s).
  void prepare(double dt);
  /// Brings the robot onto its corrected path, if impacts with other robots in the last step should have acted at their
  /// instant. [after it has moved]
  void take_impacts(const Step& step);
  /// Writes the results of contacts.
  void export_contacts();
  /// Returns the reason why the state is no longer finite.
  std::string failure() const;

 private:
  struct JointHandles {
    ObjectId object = no_object;
    std::string name;
    In<double> target;
    PositionTarget position_target;
    DriveLosses losses;
  };
  /// Target of a drive, with the data that a step needs of it side by side.
  struct InterpolatedTarget {
    PositionTarget target;
    const double* position = nullptr;  ///< rad or m: position of the joint
    JointLimits limits;
    double* to = nullptr;  ///< place in targets_
  };
  /// The base, or a link with shapes.
  struct LoadedLink {
    SumIn<Wrench> external;
    Out<Wrench> contact;  ///< there is none without shapes
    Out<Wrench> applied;  ///< used if somebody reads it
    In<Pose> pose, pose_of_body;
    bool is_body = false;  ///< its frame is that of its body
  };

  void connect_joints(Connector& c, const RobotView& view, const Parameters& p);
  void connect_links(Connector& c);
  void connect_drives(Connector& c, const RobotView& view, const Parameters& p);
  void connect_memory(Connector& c, const RobotView& view, bool keeps_accelerations);
  void connect_self_contacts(Connector& c, const RobotView& view, const Parameters& p);
  void set_offsets();
  bool interpolates() const;
  void advance_targets(double dt);
  void sum_wrenches();
  void add_self_contacts(double dt);
  void fetch_contacts() const;
  void find_touching_links();
  void clear_contact_wrenches(std::size_t first);
  void export_self_contacts();
  Wrench wrench_of_contact(std::size_t i) const {
    const double* const n = contact_wrenches_.data() + 6 * i;
    return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}};
  }
  Wrench sum_of_contacts(std::size_t begin, std::size_t end, const Vec3& origin) const;
  const Vec3& origin_of(std::uint32_t link) const { return link == 0 ? start_ : links_[link].pose->position; }

  std::uint32_t level_;
  multibody::RobotModel rigid_;
  Model model_;
  std::vector<Mass> masses_;
  RobotState state_;
  Out<Pose> pose_;
  Out<Twist> twist_;
  ContactRole contact_role_;
  In<double> carried_mass_;
  std::vector<JointHandles> joints_;                                       ///< one per body
  std::vector<const double*> velocities_;                                  ///< one per link
  std::vector<Out<double>> positions_out_, velocities_out_, efforts_out_;  ///< one per body
  std::vector<double> targets_;  ///< targets of drives that interpolate: positions, then velocities
  std::vector<InterpolatedTarget> interpolated_;
  std::vector<LoadedLink> links_;  ///< same order as rigid_.loaded_links
  bool has_contact_law_ = false;   ///< a contact algorithm adds to wrenches
  bool tells_contacts_ = false, tells_applied_ = false;
  bool only_contacts_push_ = false;            ///< only the contact algorithm adds to wrenches
  std::vector<std::uint32_t> touching_links_;  ///< indices of links_ that contacts push now or in the last step
  std::vector<double*> touching_wrenches_;     ///< wrenches of those that contacts with others push in this step
  bool links_are_clear_ = false;
  ListOut<ContactWrench> told_;
  Vec3 start_ = Vec3::Zero();  ///< m: position of the base at the begin of the step
  RobotContacts contacts_;
  SelfContacts self_contacts_;
  SelfContacts::Law self_contact_law_;
  contact_geometry::ImpactInput impacts_;  ///< for a robot that is one free body
  std::vector<double> wrenches_;           ///< wrenches on bodies
  std::span<double> accelerations_;        ///< see RobotState
  std::vector<double> contact_wrenches_;   ///< wrenches of contacts
};

}  // namespace muro::articulated
