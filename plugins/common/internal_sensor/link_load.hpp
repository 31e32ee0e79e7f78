// SPDX-License-Identifier: MIT
// What acts on a link from outside, whoever finds it: an engine, the contact algorithm, others.
#pragma once

#include <optional>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro::internal_sensor {

/// Which of what acts on a link counts.
enum class Load : std::uint8_t {
  contacts,  ///< what contacts do
  all,       ///< and what else is added to `wrench.external`, such as thrust
};

/// Of one link. Contacts in the world of an engine are those of its last step, others those of the instant.
class LinkLoad {
 public:
  LinkLoad() = default;
  /// [setup]
  LinkLoad(Connector& c, const RobotView& robot, std::uint32_t link, Load which) {
    object_ = robot.links[link].object;
    const ObjectId base = robot.base();
    if (c.is_used(object_, keys::contact_wrench, usage::derived)) engine_ = c.read(object_, keys::contact_wrench);
    const bool is_pushed = c.is_used(object_, keys::external_wrench, usage::read_sum);
    if (is_pushed && which == Load::all)
      external_ = c.read_sum(object_, keys::external_wrench);
    else if (c.is_used(base, keys::contact_wrenches_of_law, usage::derived))
      law_ = c.read_list(base, keys::contact_wrenches_of_law);
  }

  /// Whether anything can be felt: at a motion that no force moves nothing can.
  bool feels_forces() const { return engine_ || external_ || law_; }

  /// On the link, at its origin, world axes. `origin`: where that is in the world, m. [step]
  Wrench wrench(const Vec3& origin) const {
    Wrench sum;
    if (engine_) sum += *engine_;
    if (external_) sum += external_->value();
    if (!law_) return sum;
    for (const ContactWrench& contact : *law_) {
      const double sign = contact.body == object_ ? 1 : contact.other == object_ ? -1 : 0;
      if (sign == 0 || !std::isfinite(contact.wrench.force.sum() + contact.wrench.torque.sum())) continue;
      sum.add_force(sign * contact.wrench.force, contact.point - origin);
      sum.torque += sign * contact.wrench.torque;
    }
    return sum;
  }

 private:
  ObjectId object_ = no_object;
  In<Wrench> engine_;
  std::optional<SumIn<Wrench>> external_;
  ListIn<ContactWrench> law_;
};

}  // namespace muro::internal_sensor
