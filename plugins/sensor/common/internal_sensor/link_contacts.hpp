// SPDX-License-Identifier: MIT
// The contact wrenches of a link, one for each contact, from all sources.
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"

namespace muro::internal_sensor {

/// Whether forces move the robot, in at least one of its motions. [setup, from the connect of a sensor on]
bool is_moved_by_forces(const Connector& c, const RobotView& robot);

/// Conditions under which the contacts of a link are read.
enum class When : std::uint8_t {
  always,
  kinematic,  ///< only while no force moves the robot
};

/// Contacts of one link. An engine lists the contact wrenches of the last step of the robots that it moves. So the
/// contacts of a robot that no force moves are found in the lists of other robots.
class LinkContacts {
 public:
  LinkContacts() = default;
  /// [setup]
  LinkContacts(Connector& c, const RobotView& robot, std::uint32_t link, When when = When::always);

  /// Whether the link can have contacts with forces: forces move its robot or another robot.
  bool any() const { return law_ || motion_ || !others_.empty(); }
  /// Whether the lists of other robots are read as well.
  bool reads_other_robots() const { return !others_.empty(); }
  /// Whether a motion by forces moves the robot. [step]
  bool is_dynamic() const { return muro::is_moved_by_forces(*world_); }

  /// Calls f(contact, sign) for each contact of the contact algorithm. `sign`: 1 if the link feels the wrench of
  /// `contact`, -1 if it feels the opposite. [step]
  template <class F>
  void each_of_law(const F& f) const {
    each(law_, f);
  }
  /// Calls f for each contact of the engine that moves the robot (`by_own`), or of the engines of other robots.
  template <class F>
  void each_of_engines(bool by_own, const F& f) const {
    if (by_own) return each(motion_, f);
    for (const ListIn<ContactWrench>& list : others_) each(list, f);
  }

 private:
  template <class F>
  void each(const ListIn<ContactWrench>& list, const F& f) const {
    if (!list) return;
    for (const ContactWrench& contact : *list)
      if (contact.body == link_)
        f(contact, 1.0);
      else if (contact.other == link_)
        f(contact, -1.0);
  }

  ObjectId link_ = no_object;
  In<std::uint64_t> world_;  ///< see keys::contact_world
  ListIn<ContactWrench> law_, motion_;
  std::vector<ListIn<ContactWrench>> others_;  ///< lists of engines, if it is possible that no force moves the robot
};

}  // namespace muro::internal_sensor
