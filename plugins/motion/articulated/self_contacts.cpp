// SPDX-License-Identifier: MIT
#include "self_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "muro/base/random.hpp"
#include "plugins/common/contact_geometry/kept_contact.hpp"

namespace muro::articulated {

namespace {

constexpr std::size_t some_contacts = 64;
constexpr double most_phase = 0.6;

/// Returns the divisor of the stiffness. The springs of `pairs` pairs of bodies, one along and one across the normal of
/// each, move nothing faster than the root of 2 pairs omega^2. Semi-implicit Euler with the spring of the end of the
/// step is stable as long as pairs (6 phase^2 + 8 phase) / softening < 4. Here it is 3.2, so that one pair alone does
/// not overshoot.
double softening_of(double phase, int pairs) { return std::max(1.0, 1.25 * pairs * (1.5 * phase + 2) * phase); }

}  // namespace

SelfContacts::SelfContacts(Connector& c, const RobotView& view, const multibody::RobotModel& model)
    : is_wanted_(c.variable(view.base(), keys::self_collision, std::uint32_t{1})),
      list_(c.read_list(view.base(), keys::contacts)),
      kept_(c.variable_list(view.base(), kept_self_contacts)),
      poses_(model.bodies.size()),
      mobility_(model) {
  for (std::uint32_t i = 0; i < model.loaded_links.size(); ++i) {
    const multibody::LoadedLink& link = model.loaded_links[i];
    if (!link.has_shapes) continue;
    link_places_.push_back(
        {link.object, fnv1a(c.object_name(link.object)), i, link.placement.body, In<Pose>(), In<Twist>()});
  }
  std::sort(link_places_.begin(), link_places_.end(),
            [](const LinkPlace& a, const LinkPlace& b) { return index_of(a.object) < index_of(b.object); });
}

void SelfContacts::connect_by_name(Connector& c, const RobotView& view, const multibody::RobotModel& model) {
  if (!is_wanted_) return;
  for (LinkPlace& link : link_places_) {
    link.pose = c.read(link.object, keys::pose);
    link.twist = c.read(link.object, keys::twist);
  }
  for (const multibody::RigidBody& body : model.bodies)
    body_poses_.push_back(c.read(view.links[body.link].object, keys::pose));
}

void SelfContacts::start() {
  if (!is_wanted_) return;
  contacts_.reserve(some_contacts), places_.reserve(some_contacts), before_.reserve(some_contacts);
  if (!(*kept_).empty()) return;
  for (std::size_t i = 0; i < some_contacts; ++i) kept_.push_back({});
  kept_.clear();
}

void SelfContacts::take_over() const {
  if (!is_wanted_) return;
  *is_wanted_ = 1;
  kept_.clear();
}

const SelfContacts::LinkPlace* SelfContacts::place_of(ObjectId object) const {
  const auto found =
      std::lower_bound(link_places_.begin(), link_places_.end(), object,
                       [](const LinkPlace& a, ObjectId id) { return index_of(a.object) < index_of(id); });
  return found != link_places_.end() && found->object == object ? &*found : nullptr;
}

void SelfContacts::find() {
  const auto list = *list_;
  contacts_.clear();
  places_.clear();
  for (std::uint32_t i = 0; i < list.size(); ++i) {
    const LinkPlace* const other = place_of(list[i].other);
    const LinkPlace* const own = other ? place_of(list[i].self) : nullptr;
    if (!own) continue;
    contacts_.push_back(
        {.link = own->loaded_link, .other_link = other->loaded_link, .body = own->body, .other_body = other->body});
    places_.push_back(i);
  }
}

/// Gives the points of two bodies shares of one spring. Returns the number of pairs of bodies that touch.
int SelfContacts::count_shares() {
  int pairs = 0;
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const auto is_same = [&](const SelfContact& c) {
      return c.body == contacts_[i].body && c.other_body == contacts_[i].other_body;
    };
    pairs += std::find_if(contacts_.begin(), contacts_.end(), is_same) - contacts_.begin() == std::ptrdiff_t(i);
    contacts_[i].share = 1 / double(std::count_if(contacts_.begin(), contacts_.end(), is_same));
  }
  return pairs;
}

void SelfContacts::keep_what_lasts() {
  before_.assign((*kept_).begin(), (*kept_).end());
  kept_.clear();
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    const Contact& c = contact(i);
    KeptSelfContact kept;
    kept.pair = contact_geometry::pair_of(place_of(c.self)->name, place_of(c.other)->name, c.self_shape, c.other_shape);
    const KeptSelfContact* const known =
        contact_geometry::previous(std::span<const KeptSelfContact>(before_), i, kept.pair, c.point);
    kept.excess = -1;  // it is not known
    if (known) kept = *known;
    kept.point = c.point;
    kept_.push_back(kept);
  }
}

void SelfContacts::update(const Law& law, double dt) {
  if (!is_wanted_) return;
  if ((*list_).empty() && contacts_.empty() && (*kept_).empty()) return;
  find();
  keep_what_lasts();
  if (contacts_.empty()) return;
  for (std::size_t i = 0; i < poses_.size(); ++i) poses_[i] = *body_poses_[i];
  mobility_.set_poses(poses_);
  const int pairs = count_shares();
  for (std::size_t i = 0; i < contacts_.size(); ++i) push(i, law, dt, pairs);
}

/// Finds the force of a contact: a critically damped spring and damper along the normal that only push; across it a
/// spring with a slider beside a damper. Springs and dampers are those of the end of the step if velocities do not
/// change.
void SelfContacts::push(std::size_t i, const Law& law, double dt, int pairs) {
  SelfContact& to = contacts_[i];
  KeptSelfContact& kept = (*kept_)[i];
  const Contact& c = contact(i);
  const LinkPlace &own = *place_of(c.self), &other = *place_of(c.other);
  const Vec3 velocity = own.twist->at(c.point - own.pose->position) - other.twist->at(c.point - other.pose->position);
  const Mat3 mobility = mobility_.between(to.body, to.other_body, c.point);
  const double along = c.normal.dot(mobility * c.normal), across = mobility.trace() - along;
  constexpr double least_part = 1e-9;  // part of a mobility: less is rounding, since no joint lets the links give way
  if (!(along > least_part * mobility.trace())) {
    to.force = kept.displacement = Vec3::Zero();
    return;
  }
  const double speed = velocity.dot(c.normal);
  const double phase = std::min(dt * std::sqrt(law.stiffness * along), most_phase);  // rad: phase gained in a step
  const double omega = phase / dt, damping_per_spring = 2 / omega + dt;
  const double softening = softening_of(phase, pairs);
  const auto spring_of = [&](double inverse_mass) {
    return inverse_mass > 0 ? omega * omega * to.share / (inverse_mass * softening) : 0.0;
  };
  // along
  constexpr double least_excess = 5e-3;  // m
  const bool is_new = kept.excess < 0;
  if (is_new) kept.excess = c.depth > std::max(least_excess, 2 * dt * std::abs(speed)) ? c.depth : 0;
  kept.excess = std::clamp(kept.excess - dt * law.correcting_speed, 0.0, c.depth);
  const double load = std::max(0.0, spring_of(along) * (c.depth - kept.excess - damping_per_spring * speed));
  // across
  const double spring = spring_of(across), most = c.surface.friction * load;
  const Vec3 slip = velocity - speed * c.normal;
  Vec3& x = kept.displacement;
  x += dt * own.twist->angular.cross(x);
  x -= x.dot(c.normal) * c.normal;
  Vec3 drag = -spring * (x + damping_per_spring * slip);
  x += dt * slip;
  const double size = drag.norm();
  if (size > most) {
    drag *= most / size;
    x = spring > 0 ? Vec3(drag / -spring) : Vec3(Vec3::Zero());
  }
  to.force = load * c.normal + drag;
}

void SelfContacts::add_to(std::span<double> wrenches) const {
  const auto add = [&](std::uint32_t body, const Vec3& force, const Vec3& point) {
    double* const to = wrenches.data() + 6 * std::size_t(body);
    const Vec3 torque = (point - poses_[body].position).cross(force);
    for (int n = 0; n < 3; ++n) to[n] += force[n], to[3 + n] += torque[n];
  };
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    add(contacts_[i].body, contacts_[i].force, contact(i).point);
    add(contacts_[i].other_body, -contacts_[i].force, contact(i).point);
  }
}

}  // namespace muro::articulated
