// SPDX-License-Identifier: MIT
#include "robot_contacts.hpp"

#include <algorithm>
#include <cstddef>

#include "muro/base/random.hpp"
#include "muro/simd/numbers.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/contact_geometry/kept_contact.hpp"

namespace muro::articulated {

// the layout that kernels read
static_assert(offsetof(Contact, normal) == offsetof(Contact, point) + 3 * sizeof(double) &&
              offsetof(Contact, depth) == offsetof(Contact, point) + 6 * sizeof(double) &&
              offsetof(Contact, surface.friction) == offsetof(Contact, point) + 7 * sizeof(double) &&
              offsetof(Surface, restitution) == sizeof(double) &&
              offsetof(Surface, rolling_resistance) == 2 * sizeof(double) &&
              offsetof(Surface, spinning_resistance) == 3 * sizeof(double) &&
              offsetof(KeptContact, way) == offsetof(KeptContact, point) + 3 * sizeof(double) &&
              offsetof(KeptContact, displacement) == offsetof(KeptContact, point) + 6 * sizeof(double) &&
              offsetof(KeptContact, load) == offsetof(KeptContact, point) + 9 * sizeof(double) &&
              offsetof(KeptContact, mean_load) == offsetof(KeptContact, point) + 10 * sizeof(double) &&
              offsetof(KeptContact, turn) == offsetof(KeptContact, point) + 11 * sizeof(double));

void TouchedBodies::connect(Connector& c) {
  all_.resize(c.object_count());
  for (std::uint32_t i = 0; i < all_.size(); ++i) {
    all_[i].name = fnv1a(c.object_name(ObjectId{i}));
    for (const Shape& shape : c.constant_array(ObjectId{i}, keys::collision_shapes))
      all_[i].shapes.push_back(contact_geometry::extent_of(shape));
  }
  for (const RobotView* robot : c.robots()) {
    const In<std::uint64_t> world = c.input(robot->base(), keys::contact_world, kinematic_world);
    for (const Link& link : robot->links)
      if (!c.constant_array(link.object, keys::collision_shapes).empty()) all_[index_of(link.object)].world = world;
  }
}

void TouchedBodies::connect_by_name(Connector& c) {
  for (const RobotView* robot : c.robots())
    for (const Link& link : robot->links) {
      Touched& body = all_[index_of(link.object)];
      if (!body.world) continue;
      body.pose = c.read(link.object, keys::pose);
      body.twist = c.read(link.object, keys::twist);
    }
}

RobotContacts::RobotContacts(Connector& c, const RobotView& view, const multibody::RobotModel& model) {
  const auto has_shapes = [](const multibody::LoadedLink& link) { return link.has_shapes; };
  if (std::none_of(model.loaded_links.begin(), model.loaded_links.end(), has_shapes)) return;
  list_ = c.read_list(view.base(), keys::contacts);
  kept_ = c.variable_list(view.base(), kept_contacts);
  for (std::uint32_t i = 0; i < model.loaded_links.size(); ++i) {
    const multibody::LoadedLink& link = model.loaded_links[i];
    link_places_.push_back({link.object, i, int(link.placement.body), link.placement.pose.orientation});
  }
  std::sort(link_places_.begin(), link_places_.end(),
            [](const LinkPlace& a, const LinkPlace& b) { return index_of(a.object) < index_of(b.object); });
}

void RobotContacts::start() {
  revision_ = no_revision;
  if (!list_) return;
  constexpr std::size_t of_a_link = 8;
  const std::size_t most = of_a_link * link_places_.size();
  of_links_.reserve(link_places_.size());
  contacts_.reserve(most), extents_.reserve(most), places_.reserve(most), others_.reserve(most), before_.reserve(most);
  if (!(*kept_).empty()) return;
  for (std::size_t i = 0; i < most; ++i) kept_.push_back({});
  kept_.clear();
}

const RobotContacts::LinkPlace* RobotContacts::place_of(ObjectId object) const {
  const auto found =
      std::lower_bound(link_places_.begin(), link_places_.end(), object,
                       [](const LinkPlace& a, ObjectId id) { return index_of(a.object) < index_of(id); });
  return found != link_places_.end() && found->object == object ? &*found : nullptr;
}

void RobotContacts::look_up(const TouchedBodies& bodies) {
  if (!list_) return;
  if ((*list_).empty() && contacts_.empty() && (*kept_).empty()) {
    touches_robots_ = false;
    return;
  }
  const bool is_same_list = revision_ == list_.revision() && length_ == (*list_).size();
  if (touches_robots_ || !is_same_list || (*kept_).size() != contacts_.size()) {
    find(bodies);
    keep_what_lasts(bodies);
    revision_ = list_.revision(), length_ = (*list_).size();
  }
  if (touches_robots_) look_at_others(bodies);
}

void RobotContacts::find(const TouchedBodies& bodies) {
  const auto list = *list_;
  contacts_.clear(), extents_.clear(), places_.clear();
  touches_robots_ = false;
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    const Contact& c = list[i];
    const TouchedBodies::Touched& other = bodies[c.other];
    if (other.pose && place_of(c.other)) continue;  // a contact of two links: see self_contacts.hpp
    touches_robots_ = touches_robots_ || other.pose;
    if (other.world && is_moved_by_forces(*other.world)) continue;
    const LinkPlace* const link = place_of(c.self);
    if (!link) continue;
    KernelContact& contact = contacts_.emplace_back();
    contact.place = c.point.data();
    contact.body = link->body;
    const Vec3 rim = link->orientation * bodies[c.self].shapes[c.self_shape].rim;
    std::copy_n(rim.data(), 3, extents_.emplace_back().rim);
    contact.set(KernelContact::has_rim, !rim.isZero(0));
    contact.set(KernelContact::resists_turning, c.surface.rolling_resistance > 0 || c.surface.spinning_resistance > 0);
    contact.set(KernelContact::is_of_disc,
                contact_geometry::is_of_disc(bodies[c.self].shapes[c.self_shape], other.shapes[c.other_shape]));
    places_.push_back({i, link->loaded_link});
  }
  sort_by_body();
  find_bodies();
  find_links();
  find_joins();
}

/// Sorts contacts by body, and within a body by link. The list is in the order of links. That is the order of bodies
/// except for links behind fixed joints.
void RobotContacts::sort_by_body() {
  const auto is_before = [this](std::size_t a, std::size_t b) {
    return contacts_[a].body != contacts_[b].body ? contacts_[a].body < contacts_[b].body
                                                  : places_[a].link < places_[b].link;
  };
  for (std::size_t i = 1; i < contacts_.size(); ++i)
    for (std::size_t k = i; k > 0 && is_before(k, k - 1); --k) {
      std::swap(contacts_[k], contacts_[k - 1]);
      std::swap(extents_[k], extents_[k - 1]);
      std::swap(places_[k], places_[k - 1]);
    }
}

void RobotContacts::find_bodies() {
  constexpr std::size_t most = 8;
  constexpr int bits = 8;
  bodies_ = 0;
  if (contacts_.size() > most) return;
  for (const KernelContact& c : contacts_) {
    if (c.body + 1 >= 1 << bits) {
      bodies_ = 0;
      return;
    }
    bodies_ = bodies_ << bits | std::uint64_t(c.body + 1);
  }
}

void RobotContacts::find_links() {
  of_links_.clear();
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    if (of_links_.empty() || of_links_.back().link != places_[i].link) of_links_.push_back({places_[i].link, i});
    of_links_.back().end = i + 1;
  }
}

/// Keeps the state of contacts that last. In a list of the same pairs, each contact continues the one at its place in
/// the step before, so that a restored state continues as the original. In another list, the nearest one counts.
void RobotContacts::keep_what_lasts(const TouchedBodies& bodies) {
  const auto list = *list_;
  const auto pair_at = [&](std::size_t i) {
    const Contact& c = list[places_[i].in_list];
    return contact_geometry::pair_of(bodies[c.self].name, bodies[c.other].name, c.self_shape, c.other_shape);
  };
  before_.assign((*kept_).begin(), (*kept_).end());
  bool is_same = before_.size() == contacts_.size();
  for (std::size_t i = 0; is_same && i < contacts_.size(); ++i) is_same = before_[i].pair == pair_at(i);
  if (!is_same) {
    kept_.clear();
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      KeptContact kept;
      kept.pair = pair_at(i);
      const KeptContact* const known = contact_geometry::previous(std::span<const KeptContact>(before_), i, kept.pair,
                                                                  list[places_[i].in_list].point);
      if (known) kept = *known;
      kept_.push_back(kept);
    }
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    contacts_[i].kept = (*kept_)[i].point.data(), contacts_[i].extent = &extents_[i];
}

/// Finds contacts of the same two shapes. Two may be the ends of a line, more the corners of a face: kernels find that
/// out.
void RobotContacts::find_joins() {
  constexpr int bits = 8;
  for (std::size_t i = 1; i < contacts_.size(); ++i) {
    const Contact &before = contact(i - 1), &c = contact(i);
    contacts_[i].set(KernelContact::joins, c.self == before.self && c.other == before.other &&
                                               c.self_shape == before.self_shape &&
                                               c.other_shape == before.other_shape);
  }
  faces_ = 0;
  const auto joins = [this](std::size_t, std::size_t i) { return contacts_[i].traits & KernelContact::joins; };
  contact_geometry::each_patch(contacts_.size(), joins, [this](std::size_t begin, std::size_t end) {
    const std::size_t points = end > begin + 2 ? end - begin : 0;
    contacts_[begin].face = std::int16_t(points);
    faces_ |= std::uint64_t(std::min<std::size_t>(points, 0xff)) << begin % bits * bits;
    if (end != begin + 2) return;
    for (std::size_t i = begin; i < end; ++i) {
      contacts_[i].partner = contacts_[begin + end - 1 - i].place;
      contacts_[i].set(KernelContact::may_be_line, true);
      contacts_[i].set(KernelContact::is_second, i > begin);
    }
  });
}

void RobotContacts::look_at_others(const TouchedBodies& bodies) {
  others_.resize(contacts_.size());
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = (*list_)[places_[i].in_list];
    const TouchedBodies::Touched& other = bodies[c.other];
    contacts_[i].other = nullptr;
    contacts_[i].set(KernelContact::is_moved, bool(other.pose));
    if (!other.pose) continue;
    others_[i] = {other.twist->at(c.point - other.pose->position), other.twist->angular};
    contacts_[i].other = lane::numbers(&others_[i]);
  }
}

}  // namespace muro::articulated
