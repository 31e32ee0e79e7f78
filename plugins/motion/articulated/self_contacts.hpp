// SPDX-License-Identifier: MIT
// Contacts among the links of a robot.
#pragma once

#include <span>
#include <vector>

#include "muro/algorithm.hpp"
#include "point_mobility.hpp"

namespace muro::articulated {

/// State that a contact of two links keeps from step to step.
struct KeptSelfContact {
  std::uint64_t pair = 0;            ///< see contact_geometry/kept_contact.hpp
  Vec3 point = Vec3::Zero();         ///< m, world
  Vec3 displacement = Vec3::Zero();  ///< m, world: stretch of the friction spring
  double excess = 0;                 ///< m: overlap that no motion has caused; the spring does not see it
};

/// Response of a contact of two links in a step.
struct SelfContact {
  std::uint32_t link = 0, other_link = 0;  ///< indices in RobotModel::loaded_links
  std::uint32_t body = 0, other_body = 0;
  double share = 1;           ///< part of the stiffness of two bodies: 1 / the number of points in which they touch
  Vec3 force = Vec3::Zero();  ///< N, world, at the contact's point, on the first link; the second has the opposite
};

/// Springs and dampers between links that overlap. Their equal and opposite forces act at one point.
class SelfContacts {
 public:
  SelfContacts() = default;
  /// Connects the contacts. [setup]
  SelfContacts(Connector& c, const RobotView& view, const multibody::RobotModel& model);
  /// Connects poses and twists. [setup]
  void connect_by_name(Connector& c, const RobotView& view, const multibody::RobotModel& model);
  /// Takes the memory that steps need. [setup]
  void start();
  /// Continues after another motion has moved the robot.
  void take_over() const;

  /// Law of all contacts of a robot.
  struct Law {
    double stiffness = 0;         ///< N/m
    double correcting_speed = 0;  ///< m/s
  };
  /// Finds the contacts and their forces in a step of `dt` (s). [step]
  void update(const Law& law, double dt);
  /// Adds the contact forces to the wrenches on bodies: force and torque at the origin of each, world axes.
  void add_to(std::span<double> wrenches) const;

  const std::vector<SelfContact>& contacts() const { return contacts_; }
  /// Returns contact `i` as it is in the list.
  const Contact& contact(std::size_t i) const { return (*list_)[places_[i]]; }

 private:
  struct LinkPlace {
    ObjectId object = no_object;
    std::uint64_t name = 0;         ///< hash
    std::uint32_t loaded_link = 0;  ///< index in RobotModel
    std::uint32_t body = 0;
    In<Pose> pose;
    In<Twist> twist;
  };
  const LinkPlace* place_of(ObjectId object) const;
  void find();
  int count_shares();
  void keep_what_lasts();
  void push(std::size_t i, const Law& law, double dt, int pairs);

  Out<std::uint32_t> is_wanted_;  ///< see keys::self_collision; not connected: links do not touch each other
  ListIn<Contact> list_;
  ListOut<KeptSelfContact> kept_;
  std::vector<LinkPlace> link_places_;  ///< sorted by object
  std::vector<In<Pose>> body_poses_;
  std::vector<Pose> poses_;
  PointMobility mobility_;
  std::vector<SelfContact> contacts_;
  std::vector<std::uint32_t> places_;  ///< place of each contact in the list
  std::vector<KeptSelfContact> before_;
};

}  // namespace muro::articulated

namespace muro {
MURO_OPAQUE_TYPE(articulated::KeptSelfContact, "muro.motion.articulated.KeptSelfContact", opaque);
}  // namespace muro

namespace muro::articulated {
inline constexpr Key<KeptSelfContact> kept_self_contacts{"contact.self.kept", "m",
                                                         "list on the base of a robot: springs among its links"};
}  // namespace muro::articulated
