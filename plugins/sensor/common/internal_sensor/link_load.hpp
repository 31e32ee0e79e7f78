// SPDX-License-Identifier: MIT
// The external wrench on a link from all sources: an engine, the contact algorithm, others.
#pragma once

#include <cmath>

#include "link_contacts.hpp"

namespace muro::internal_sensor {

/// Selects the wrenches on a link that count.
enum class Load : std::uint8_t {
  contacts,  ///< contact wrenches of the last step in which contacts were searched
  all,       ///< all wrenches of the last step, also thrust: those that belong to its accelerations
};

/// Load of one link. If no force has moved the robot, only contacts with robots that forces move are known.
class LinkLoad {
 public:
  LinkLoad() = default;
  /// [setup]
  LinkLoad(Connector& c, const RobotView& robot, std::uint32_t link, Load which)
      : contacts_(c, robot, link, which == Load::all ? When::kinematic : When::always) {
    const ObjectId object = robot.links[link].object;
    const bool touches = !c.constant_array(object, keys::collision_shapes).empty();
    if (which == Load::contacts) {
      if (c.is_used(object, keys::contact_wrench, usage::derived)) engine_ = c.read(object, keys::contact_wrench);
    } else if (is_moved_by_forces(c, robot) && (touches || c.is_used(object, keys::external_wrench, usage::read_sum))) {
      applied_ = c.read(object, keys::applied_wrench);
    }
  }

  /// Whether contacts are known with their forces, from engines or from the contact algorithm.
  bool knows_contacts() const { return engine_ || contacts_.any(); }
  /// Whether the lists of other robots are read as well.
  bool reads_other_robots() const { return contacts_.reads_other_robots(); }

  /// Returns the wrench on the link, at its origin, world axes. `origin`: of the link in the world, m. [step]
  Wrench wrench(const Vec3& origin) const {
    Wrench sum;
    const auto add = [&](const ContactWrench& contact, double sign) {
      if (!std::isfinite(contact.wrench.force.sum() + contact.wrench.torque.sum())) return;
      sum.add_force(sign * contact.wrench.force, contact.point - origin);
      sum.torque += sign * contact.wrench.torque;
    };
    if (is_applied_known()) return *applied_;
    contacts_.each_of_law(add);
    if (contacts_.is_dynamic() && !applied_) {
      if (engine_) sum += *engine_;
    } else {
      contacts_.each_of_engines(false, add);
    }
    return sum;
  }

 private:
  /// Whether the last step was one of a motion by forces. Before the first step the applied wrench is zero.
  bool is_applied_known() const {
    if (!applied_ || !std::isfinite(applied_->force.sum() + applied_->torque.sum())) return false;
    return contacts_.is_dynamic() || !applied_->force.isZero(0) || !applied_->torque.isZero(0);
  }

  LinkContacts contacts_;
  In<Wrench> engine_, applied_;
};

}  // namespace muro::internal_sensor
