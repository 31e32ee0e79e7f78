// SPDX-License-Identifier: MIT
// The wrench that acts on each link of a robot in a step, for algorithms that read it (keys::applied_wrench).
#pragma once

#include <optional>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro::simplified {

/// Forces on links act on the robot as a whole: the base has the sum of all. The part of each link follows from the
/// contacts of the contact algorithm, or from the link's own `wrench.external` when the motion reads it.
class AppliedWrenches {
 public:
  /// Finds the links. `external`: the sum that the motion reads at the base; null: no wrench acts. [setup]
  void connect_by_name(Connector& c, const RobotView& robot, const SumIn<Wrench>* external) {
    if (!external) return;
    bool is_read = false, has_sum_of_all = false;
    for (const Link& link : robot.links) is_read = is_read || c.is_used(link.object, keys::applied_wrench, usage::read);
    if (!is_read) return;
    for (std::size_t i = 0; i < robot.links.size(); ++i) {
      const ObjectId object = robot.links[i].object;
      OfLink& link = links_.emplace_back();
      link.object = object;
      link.pose = c.read(object, keys::pose);
      link.has_own = i == 0 || c.is_used(object, keys::external_wrench, usage::read_sum);
      if (link.has_own) link.external = c.read_sum(object, keys::external_wrench);
      has_sum_of_all = has_sum_of_all || !link.has_own;
      if (c.is_used(object, keys::applied_wrench, usage::read)) link.applied = c.derived(object, keys::applied_wrench);
    }
    if (has_sum_of_all && c.is_used(robot.base(), keys::contact_wrenches_of_law, usage::derived))
      contacts_ = c.read_list(robot.base(), keys::contact_wrenches_of_law);
  }

  /// Whether nothing reads these wrenches.
  bool empty() const { return links_.empty(); }

  /// Stores the wrenches that act in this step. Call it before the robot moves. [step]
  void keep() {
    for (OfLink& link : links_) link.sum = link.has_own ? link.external->value() : Wrench{};
    if (contacts_ && !links_.empty())
      for (const ContactWrench& contact : *contacts_) move_from_base(contact);
    for (const OfLink& link : links_)
      if (link.applied) *link.applied = link.sum;
  }

 private:
  struct OfLink {
    ObjectId object = no_object;
    In<Pose> pose;
    bool has_own = false;  ///< `external` acts on this link; at the base, also on links without their own
    std::optional<SumIn<Wrench>> external;
    Out<Wrench> applied;
    Wrench sum;  ///< at its origin, world axes
  };

  OfLink* link_of(ObjectId object) {
    for (OfLink& link : links_)
      if (link.object == object) return &link;
    return nullptr;
  }

  /// Moves a contact wrench from the base to the touching link, when the base has the sum for that link.
  void move_from_base(const ContactWrench& contact) {
    OfLink* const link = link_of(contact.body);
    if (!link || link->has_own) return;
    OfLink& base = links_.front();
    link->sum.add_force(contact.wrench.force, contact.point - link->pose->position);
    link->sum.torque += contact.wrench.torque;
    base.sum.add_force(-contact.wrench.force, contact.point - base.pose->position);
    base.sum.torque -= contact.wrench.torque;
  }

  std::vector<OfLink> links_;       ///< links of the robot; empty when nothing reads the wrench of any link
  ListIn<ContactWrench> contacts_;  ///< when the base has the sum for other links
};

}  // namespace muro::simplified
