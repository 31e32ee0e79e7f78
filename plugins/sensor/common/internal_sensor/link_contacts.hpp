// SPDX-License-Identifier: MIT
// What contacts do to a link, one by one, whoever finds them.
#pragma once

#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"

namespace muro::internal_sensor {

/// Whether forces move the robot, at some of its motions at least. [setup, from the connect of a sensor on]
bool is_moved_by_forces(const Connector& c, const RobotView& robot);

/// When what contacts do to a link is asked for.
enum class When : std::uint8_t {
  always,
  kinematic,  ///< only while no force moves the robot
};

/// Of one link. An engine lists what its contacts have done in the last step with the robots that it moves, so what
/// they do to a robot that no force moves is looked for there.
class LinkContacts {
 public:
  LinkContacts() = default;
  /// [setup]
  LinkContacts(Connector& c, const RobotView& robot, std::uint32_t link, When when = When::always);

  /// Whether anything that forces move could push the link, itself or another.
  bool any() const { return law_ || motion_ || !others_.empty(); }
  /// Whether the lists of other robots are read, too.
  bool reads_other_robots() const { return !others_.empty(); }
  /// Whether a motion by forces moves the robot. [step]
  bool is_dynamic() const { return muro::is_moved_by_forces(*world_); }

  /// Calls f(contact, sign) for each; `sign` is 1 where `contact` is as the link feels it, -1 where it feels the
  /// opposite. [step]
  template <class F>
  void each_of_law(const F& f) const {
    each(law_, f);
  }
  /// `by_own`: of the engine that moves the robot; else of those of others, which matter where no force moves it.
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
  std::vector<ListIn<ContactWrench>> others_;  ///< of engines, where it may be that no force moves the robot
};

}  // namespace muro::internal_sensor
