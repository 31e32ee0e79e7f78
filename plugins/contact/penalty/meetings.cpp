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
  flags_ = &flags;
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
  const Robot& robot = bodies_.robots[self];
  Record& me = record(self);
  me.first_unit = robot.first_unit;
  me.mobilities.clear();
  me.springs.assign(robot.units, {});
  for (std::uint32_t u = robot.first_unit; u < robot.first_unit + robot.units; ++u) {
    const Unit& unit = bodies_.units[u];
    const Vec3& p = unit.pose->position;
    const Quat& q = unit.pose->orientation;
    me.mobilities.push_back(
        law::mobility_of<double>(bodies_.masses[unit.mass], {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}}));
  }
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
    std::int32_t other_robot = bodies_.moved(other);
    if (!bodies_.answers(bodies_.robots[self], other_robot)) {
      me.touch_of.push_back(not_ours);
      continue;
    }
    // Who lists nothing is served by nobody: a shadow's partner, and who was handed over after contacts were found.
    const bool serves = other_robot != nobody && (*flags_)[std::size_t(other_robot)] != 0;
    if (bodies_.robots[self].shadow || !serves) other_robot = nobody;
    if (!owns(self, other_robot)) {
      me.touch_of.push_back(not_ours);
      const auto owner = std::uint32_t(other_robot);
      if (std::find(me.owners.begin(), me.owners.end(), owner) == me.owners.end()) me.owners.push_back(owner);
      continue;
    }
    const V3 normal = plain(contact.normal);
    const std::uint32_t unit = bodies_[contact.self].unit;
    auto touch = std::find_if(me.touches.begin(), me.touches.end(), [&](const Touch& t) {
      return t.unit == unit && t.whole == other.whole && (other_robot == nobody || t.other_unit == other.unit) &&
             dot(t.patch.normal, normal) > same_direction;
    });
    if (touch == me.touches.end()) {
      const Patch patch(normal, me.mobilities[unit - me.first_unit].centre);
      me.touches.push_back(
          {.patch = patch, .unit = unit, .other = other_robot, .other_unit = other.unit, .whole = other.whole});
      touch = me.touches.end() - 1;
    }
    touch->patch.add(plain(contact.point));
    me.touch_of.push_back(std::uint32_t(touch - me.touches.begin()));
  }
  std::sort(me.owners.begin(), me.owners.end(),
            [this](std::uint32_t a, std::uint32_t b) { return owns(a, std::int32_t(b)); });
}

/// The effective mass of a patch, shared among its points. Places are known.
law::Share<double> Meetings::share_of(const Mobility& self, const Touch& t) const {
  const law::Yield<double> middle = t.patch.at_middle(self);
  if (t.other == nobody) return {middle, t.patch.count};
  const Mobility& other = mobility(t.other, t.other_unit);
  return {middle + t.patch.seen_from(other.centre).at_middle(other), t.patch.count};
}

/// Adds up the springs of all patches of a robot, its own and those that others work out. Those of several units hold
/// it no stiffer than the sum of what each does.
void Meetings::find_load(std::uint32_t self) {
  Record& me = record(self);
  for (Touch& t : me.touches) {
    const std::uint32_t unit = t.unit - me.first_unit;
    t.share = share_of(me.mobilities[unit], t);
    me.springs[unit] += t.patch.resistance(t.share.along, t.share.across);
  }
  for (const std::uint32_t owner : me.owners)
    for (const Touch& t : record(owner).touches)
      if (t.other == std::int32_t(self)) {
        const law::Share<double> share = share_of(mobility(std::int32_t(owner), t.unit), t);
        const std::uint32_t unit = t.other_unit - me.first_unit;
        me.springs[unit] += t.patch.seen_from(me.mobilities[unit].centre).resistance(share.along, share.across);
      }
  me.load = me.springs[0].greatest(me.mobilities[0]);
  for (std::size_t u = 1; u < me.springs.size(); ++u) me.load += me.springs[u].greatest(me.mobilities[u]);
}

/// Forces in the contacts that a robot works out.
void Meetings::push(std::uint32_t self) {
  Record& me = record(self);
  const Robot& robot = bodies_.robots[self];
  const auto old = *robot.grips;
  me.old_grips.assign(old.begin(), old.end());
  robot.grips.clear();
  bodies_.leave(self);
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
    const Vec3 force = force_on_self(robot, touch, contact, grip.stretch);
    robot.grips.push_back(grip);
    const Unit& unit = bodies_.units[touch.unit];
    unit.wrench->add_force(force, contact.point - unit.pose->position);
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
Vec3 Meetings::force_on_self(const Robot& self, const Touch& touch, const Contact& contact, Vec3& stretch) const {
  const Vec3& n = contact.normal;
  const Vec3 of_self = velocity(bodies_[contact.self], contact.point);
  const Vec3 of_other = velocity(bodies_[contact.other], contact.point);
  const Vec3 motion = of_self - of_other;
  const double approach = -motion.dot(n);
  const Vec3 slip = motion + approach * n;
  // Poses that are ahead of their twists are seen as they were.
  double depth = contact.depth;
  const double lag = *self.lag, other_lag = touch.other == nobody ? 0 : *bodies_.robots[std::size_t(touch.other)].lag;
  if (lag != 0 || other_lag != 0) depth += moment_.stiffness.h * n.dot(lag * of_self - other_lag * of_other);
  const double normal = touch.share.along * touch.normal->force(depth, approach);
  stretch += slip * moment_.elapsed;
  stretch -= n * n.dot(stretch);
  V3 spring = plain(stretch);
  const V3 across = touch.friction->force(spring, plain(slip), contact.friction * normal * touch.share.inverse_across);
  stretch = vector_of(spring);
  return normal * n + touch.share.across * vector_of(across);
}

Vec3 Meetings::centre_velocity(std::int32_t robot, std::uint32_t unit) const {
  const Unit& u = bodies_.units[unit];
  return u.twist->at(vector_of(mobility(robot, unit).centre) - u.pose->position);
}

/// The force of a contact on the other robot. Levers are those that both have when the force acts, in the middle of the
/// step where poses and twists are of one instant and at its begin where twists lag by half a step: so the pair keeps
/// its angular momentum.
void Meetings::react(std::uint32_t self, Touch& touch, const Vec3& force, const Vec3& point, const Grip* before) const {
  const Unit& own = bodies_.units[touch.unit];
  const Unit& other = bodies_.units[touch.other_unit];
  touch.reaction.add_force(-force, point - other.pose->position);
  const Vec3 v = centre_velocity(std::int32_t(self), touch.unit), u = centre_velocity(touch.other, touch.other_unit);
  Vec3 wander = 0.5 * (v + u);  // velocity of the point, which belongs to no body
  if (before && moment_.elapsed > 0) {
    const Vec3 seen = (point - before->point) / moment_.elapsed;
    if ((seen - wander).norm() <= (v - u).norm()) wander = seen;  // else it is another point
  }
  const double half = 0.5 * moment_.stiffness.h;
  const double lag = *bodies_.robots[self].lag, other_lag = *bodies_.robots[std::size_t(touch.other)].lag;
  own.wrench->torque += (half * (wander - (1 - 2 * lag) * v)).cross(force);
  touch.reaction.torque -= (half * (wander - (1 - 2 * other_lag) * u)).cross(force);
}

void Meetings::add_reactions(std::uint32_t self) {
  for (const std::uint32_t owner : record(self).owners)
    for (const Touch& t : record(owner).touches)
      if (t.other == std::int32_t(self)) *bodies_.units[t.other_unit].wrench += t.reaction;
}

}  // namespace muro::penalty
