// SPDX-License-Identifier: MIT
#include "link_contacts.hpp"

namespace muro::internal_sensor {

bool is_moved_by_forces(const Connector& c, const RobotView& robot) {
  if (c.is_used(robot.base(), keys::contact_wrenches_of_motion, usage::derived)) return true;
  for (const Link& link : robot.links)
    if (c.is_used(link.object, keys::external_wrench, usage::read_sum)) return true;
  return false;
}

LinkContacts::LinkContacts(Connector& c, const RobotView& robot, std::uint32_t link, When when)
    : link_(robot.links[link].object), world_(c.input(robot.base(), keys::contact_world, kinematic_world)) {
  const auto list_of = [&](ObjectId base, const Key<ContactWrench>& key) {
    return c.is_used(base, key, usage::derived) ? c.read_list(base, key) : ListIn<ContactWrench>();
  };
  const bool has_levels = !c.constant_array(robot.base(), keys::motion_level_names).empty();
  const bool is_kinematic = !is_moved_by_forces(c, robot) || has_levels;
  if (when == When::kinematic && !is_kinematic) return;
  law_ = list_of(robot.base(), keys::contact_wrenches_of_law);
  if (when == When::always) motion_ = list_of(robot.base(), keys::contact_wrenches_of_motion);
  if (!is_kinematic) return;
  for (const RobotView* other : c.robots()) {
    if (index_of(other->id) == index_of(robot.id) || c.constant(other->base(), keys::shadow_of)) continue;
    if (const ListIn<ContactWrench> list = list_of(other->base(), keys::contact_wrenches_of_motion))
      others_.push_back(list);
  }
}

}  // namespace muro::internal_sensor
