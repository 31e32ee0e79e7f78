// SPDX-License-Identifier: MIT
#include "meetings.hpp"

#include <algorithm>
#include <cstring>

namespace muro::penalty {
namespace {

lane::V3<double> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 vector_of(const lane::V3<double>& v) { return {v.x, v.y, v.z}; }

/// Velocity of a point of a body, m/s.
Vec3 velocity(const Body& body, const Vec3& point) {
  return body.twist ? body.twist->at(point - body.pose->position) : Vec3::Zero();
}

}  // namespace

std::size_t Meetings::begin(const Moment& moment, const std::vector<std::uint8_t>& flags) {
  moment_ = moment;
  robots_.clear();
  const std::uint8_t *const begin = flags.data(), *const end = begin + flags.size();
  for (auto at = begin; at != end; ++at) {
    at = static_cast<const std::uint8_t*>(std::memchr(at, 1, std::size_t(end - at)));
    if (!at) break;
    const auto robot = std::uint32_t(at - begin);
    record_of_[robot] = std::uint32_t(robots_.size());
    robots_.push_back(robot);
  }
  if (records_.size() < robots_.size()) add_records();
  return robots_.size();
}

/// With room for what most robots need.
void Meetings::add_records() {
  const std::size_t known = records_.size();
  records_.resize(2 * robots_.size());
  for (auto r = records_.begin() + std::ptrdiff_t(known); r != records_.end(); ++r) {
    r->touches.reserve(8);
    r->touch_of.reserve(32);
    r->owners.reserve(8);
    r->old_grips.reserve(32);
  }
}

void Meetings::pass(int which, std::uint32_t robot) {
  switch (which) {
    case 0:
      place(robot);
      return gather(robot);
    case 1:
      return find_load(robot);
    case 2:
      return push(robot);
    case 3:
      return add_reactions(robot);
  }
}

void Meetings::place(std::uint32_t self) {
  const Robot& r = bodies_.robots[self];
  const Vec3& p = r.base->position;
  const Quat& q = r.base->orientation;
  record(self).mobility =
      law::mobility_of<double>(bodies_.masses[r.mass], {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}});
}

/// Whether robot `self` works out the contact: both robots of a pair list it.
bool Meetings::owns(std::uint32_t self, std::int32_t other) const {
  if (other == nobody) return true;
  const std::uint64_t mine = bodies_.robots[self].rank, theirs = bodies_.robots[std::size_t(other)].rank;
  return mine != theirs ? mine < theirs : self < std::uint32_t(other);
}

/// Sorts the contacts of a robot into patches.
void Meetings::gather(std::uint32_t self) {
  Record& me = record(self);
  me.touches.clear();
  me.touch_of.clear();
  me.owners.clear();
  for (const Contact& contact : *bodies_.robots[self].contacts) {
    const Body& other = bodies_[contact.other];
    if (!owns(self, other.robot)) {
      me.touch_of.push_back(not_ours);
      const auto owner = std::uint32_t(other.robot);
      if (std::find(me.owners.begin(), me.owners.end(), owner) == me.owners.end()) me.owners.push_back(owner);
      continue;
    }
    const V3 normal = plain(contact.normal);
    auto touch = std::find_if(me.touches.begin(), me.touches.end(), [&](const Touch& t) {
      return t.whole == other.whole && dot(t.patch.normal, normal) > same_direction;
    });
    if (touch == me.touches.end()) {
      const Patch patch(normal, me.mobility.centre);
      me.touches.push_back({.patch = patch, .other = other.robot, .whole = other.whole});
      touch = me.touches.end() - 1;
    }
    touch->patch.add(plain(contact.point));
    me.touch_of.push_back(std::uint32_t(touch - me.touches.begin()));
  }
  std::sort(me.owners.begin(), me.owners.end(),
            [this](std::uint32_t a, std::uint32_t b) { return owns(a, std::int32_t(b)); });
}

/// The effective mass of a patch, shared among its points. Places are known.
law::Share<double> Meetings::share_of(const Record& self, const Touch& t) const {
  const law::Yield<double> middle = t.patch.at_middle(self.mobility);
  if (t.other == nobody) return {middle, t.patch.count};
  const Mobility& other = record(std::uint32_t(t.other)).mobility;
  return {middle + t.patch.seen_from(other.centre).at_middle(other), t.patch.count};
}

/// Adds up the springs of all patches of a robot, its own and those that others work out.
void Meetings::find_load(std::uint32_t self) {
  Record& me = record(self);
  law::Resistance<double> all;
  for (Touch& t : me.touches) {
    t.share = share_of(me, t);
    all += t.patch.resistance(t.share.along, t.share.across);
  }
  for (const std::uint32_t owner : me.owners)
    for (const Touch& t : record(owner).touches)
      if (t.other == std::int32_t(self)) {
        const law::Share<double> share = share_of(record(owner), t);
        all += t.patch.seen_from(me.mobility.centre).resistance(share.along, share.across);
      }
  me.load = all.greatest(me.mobility);
}

/// Forces in the contacts that a robot works out.
void Meetings::push(std::uint32_t self) {
  Record& me = record(self);
  const Robot& robot = bodies_.robots[self];
  const auto old = *robot.grips;
  me.old_grips.assign(old.begin(), old.end());
  robot.grips.clear();
  *robot.wrench = Wrench{};
  std::size_t ours = 0;
  const std::uint32_t* touch_of = me.touch_of.data();
  for (const Contact& contact : *robot.contacts) {
    const std::uint32_t place_of_touch = *touch_of++;
    if (place_of_touch == not_ours) continue;
    Touch& touch = me.touches[place_of_touch];
    if (contact.restitution != touch.restitution) set_laws(me, touch, contact.restitution);
    const std::uint64_t pair = bodies_.pair_of(contact);
    const Grip* const before = previous(me.old_grips, ours++, pair, contact.point);
    Grip grip{pair, contact.point, before ? before->stretch : Vec3::Zero()};
    const Vec3 force = force_on_self(touch, contact, grip.stretch);
    robot.grips.push_back(grip);
    robot.wrench->add_force(force, contact.point - robot.base->position);
    if (touch.other != nobody) react(self, touch, force, contact.point, before);
  }
}

/// A patch rarely has more than one restitution.
void Meetings::set_laws(const Record& self, Touch& t, double restitution) const {
  const double load = self.load + (t.other == nobody ? 0 : record(std::uint32_t(t.other)).load);
  t.restitution = restitution;
  t.normal.emplace(moment_.stiffness, bodies_.materials[bodies_.material_of(restitution)].damping_ratio, load);
  t.friction.emplace(moment_.stiffness, load);
}

/// `stretch`: of the friction spring, brought up to date.
Vec3 Meetings::force_on_self(const Touch& touch, const Contact& contact, Vec3& stretch) const {
  const Vec3& n = contact.normal;
  const Vec3 motion = velocity(bodies_[contact.self], contact.point) - velocity(bodies_[contact.other], contact.point);
  const double approach = -motion.dot(n);
  const Vec3 slip = motion + approach * n;
  const double normal = touch.share.along * touch.normal->force(contact.depth, approach);
  stretch += slip * moment_.elapsed;
  stretch -= n * n.dot(stretch);
  V3 spring = plain(stretch);
  const V3 across = touch.friction->force(spring, plain(slip), contact.friction * normal * touch.share.inverse_across);
  stretch = vector_of(spring);
  return normal * n + touch.share.across * vector_of(across);
}

Vec3 Meetings::centre_velocity(std::uint32_t robot) const {
  const Robot& r = bodies_.robots[robot];
  return r.twist->at(vector_of(record(robot).mobility.centre) - r.base->position);
}

/// The force of a contact on the other robot. The levers are those of the middle of the step, to which both centres
/// and the point move on: so the pair keeps its angular momentum.
void Meetings::react(std::uint32_t self, Touch& touch, const Vec3& force, const Vec3& point, const Grip* before) const {
  const Robot& other = bodies_.robots[std::size_t(touch.other)];
  touch.reaction.add_force(-force, point - other.base->position);
  const Vec3 v = centre_velocity(self), u = centre_velocity(std::uint32_t(touch.other));
  Vec3 wander = 0.5 * (v + u);  // velocity of the point, which belongs to no body
  if (before && moment_.elapsed > 0) {
    const Vec3 seen = (point - before->point) / moment_.elapsed;
    if ((seen - wander).norm() <= (v - u).norm()) wander = seen;  // else it is another point
  }
  const double half = 0.5 * moment_.stiffness.h;
  bodies_.robots[self].wrench->torque += (half * (wander - v)).cross(force);
  touch.reaction.torque -= (half * (wander - u)).cross(force);
}

void Meetings::add_reactions(std::uint32_t self) {
  for (const std::uint32_t owner : record(self).owners)
    for (const Touch& t : record(owner).touches)
      if (t.other == std::int32_t(self)) *bodies_.robots[self].wrench += t.reaction;
}

}  // namespace muro::penalty
