// SPDX-License-Identifier: MIT
// The contacts that a robot computes, found again only when its list has others than in the step before.
#include <algorithm>

#include "pair_contacts.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"

namespace muro::penalty {

/// Whether robot `self` computes the contact. Both robots of a pair list it, but only one computes it.
bool PairContacts::computes(std::uint32_t self, std::int32_t other) const {
  if (other == not_dynamic) return true;
  const std::uint64_t mine = bodies_.robots[self].order_key, theirs = bodies_.robots[std::size_t(other)].order_key;
  return mine != theirs ? mine < theirs : self < std::uint32_t(other);
}

/// Whether robot `self` computes its contacts with a body. `other_robot`: out, robot of the body, if forces on it
/// count.
bool PairContacts::computes_contacts_with(std::uint32_t self, ObjectId body, std::int32_t& other_robot) {
  other_robot = bodies_.dynamic_robot_of(bodies_[body]);
  if (!contact_algorithm_resolves(*bodies_.robots[self].world, bodies_.world_of(other_robot))) return false;
  // Nothing is computed for robots that list nothing: a shadow's partner, and one handed over after the collision step.
  const bool takes_part = other_robot != not_dynamic && (*flags_)[std::size_t(other_robot)] != 0;
  if (bodies_.robots[self].is_shadow || !takes_part) other_robot = not_dynamic;
  if (computes(self, other_robot)) return true;
  std::vector<std::uint32_t>& owners = record(self).owners;
  const auto owner = std::uint32_t(other_robot);
  if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  return false;
}

/// Finds the runs of the present list.
void PairContacts::find_runs(std::uint32_t self) {
  KnownContacts& known = known_[self];
  const Robot& robot = bodies_.robots[self];
  const auto contacts = *robot.contacts;
  if (known.count == contacts.size() && known.revision == robot.contacts.revision()) return;
  known.count = contacts.size();
  known.revision = robot.contacts.revision();
  known.resist_turning = false;
  known.computed.clear();
  known.points.clear();
  known.runs.clear();
  for (std::uint32_t k = 0; k < contacts.size(); ++k) {
    if (known.runs.empty() || known.runs.back().other != contacts[k].other)
      known.runs.push_back({.other = contacts[k].other, .end = k});
    known.runs.back().end = k + 1;
    const Surface& surface = contacts[k].surface;
    known.resist_turning = known.resist_turning || surface.rolling_resistance > 0 || surface.spinning_resistance > 0;
  }
}

/// Finds the contacts to compute, from the present runs.
void PairContacts::find_computed(std::uint32_t self) {
  static constexpr double at_rest[6] = {};
  KnownContacts& known = known_[self];
  known.computed.clear();
  known.points.clear();
  std::uint32_t k = 0;
  const auto contacts = *bodies_.robots[self].contacts;
  for (const Run& run : known.runs) {
    for (; k < run.end; ++k) {
      if (!run.is_computed) continue;
      const Contact& contact = contacts[k];
      const Body &own = bodies_[contact.self], &other = bodies_[contact.other];
      known.computed.push_back(
          {.pair = bodies_.pair_of(contact),
           .place = k,
           .body = own.dynamic_body,
           .other_body = other.dynamic_body,
           .model = other.model,
           .other_robot = run.other_robot,
           .zeta = bodies_.materials[bodies_.material_of(contact.surface.restitution)].damping_ratio,
           .is_of_disc = bodies_.is_of_disc(contact)});
      PairPoint& p = known.points.emplace_back();
      p.pose = own.twist ? own.pose->position.data() : at_rest;
      p.twist = own.twist ? own.twist->linear.data() : at_rest;
      p.other_pose = other.twist ? other.pose->position.data() : at_rest;
      p.other_twist = other.twist ? other.twist->linear.data() : at_rest;
    }
  }
}

/// Finds which contacts the robot computes in this step, and how they move.
void PairContacts::update_computed(std::uint32_t self) {
  KnownContacts& known = known_[self];
  find_runs(self);
  const double lag = *bodies_.robots[self].lag;
  bool is_same = !known.computed.empty(), has_lag = lag != 0;
  for (Run& run : known.runs) {
    std::int32_t other_robot = not_dynamic;
    const bool is_computed = computes_contacts_with(self, run.other, other_robot);
    is_same = is_same && is_computed == run.is_computed && other_robot == run.other_robot;
    run.is_computed = is_computed;
    run.other_robot = other_robot;
    has_lag = has_lag || (other_robot != not_dynamic && *bodies_.robots[std::size_t(other_robot)].lag != 0);
  }
  if (!is_same) find_computed(self);
  const Contact* const contacts = (*bodies_.robots[self].contacts).data();
  for (std::size_t i = 0; i < known.points.size(); ++i) {
    const Computed& c = known.computed[i];
    PairPoint& p = known.points[i];
    p.contact = contacts[c.place].point.data();
    if (!has_lag) continue;
    p.lag = lag;
    p.other_lag = c.other_robot == not_dynamic ? 0 : *bodies_.robots[std::size_t(c.other_robot)].lag;
  }
  find_cells(known);
  kernels_.move(known.points.data(), int(known.points.size()), context_.stiffness.h, has_lag);
}

/// Finds the cells of lines and faces.
void PairContacts::find_cells(KnownContacts& known) {
  const auto normal = [&](std::size_t i) { return Vec3(Vec3::Map(known.points[i].contact + 3)); };
  const auto belongs = [&](std::size_t first, std::size_t i) {
    return known.computed[i].pair == known.computed[first].pair && normal(first).dot(normal(i)) > same_direction;
  };
  contact_geometry::each_patch(known.computed.size(), belongs, [&](std::size_t begin, std::size_t end) {
    std::fill_n(known.points[begin].turn, 3, 0.0);
    contact_geometry::find_cells(
        end - begin, known.computed[begin].is_of_disc, [&](std::size_t i) { return known.points[begin + i].contact; },
        [&](std::size_t i, const Vec3& cell) {
          Vec3::Map(known.points[begin + i].turn) = normal(begin + i).cross(cell);
        });
  });
}

}  // namespace muro::penalty
