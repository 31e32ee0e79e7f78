// SPDX-License-Identifier: MIT
#include "meetings.hpp"

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

void Meetings::push(const Moment& moment, const std::vector<std::uint8_t>& flags) {
  robots_.clear();
  const std::uint8_t *const begin = flags.data(), *const end = begin + flags.size();
  for (auto at = begin; at != end; ++at) {
    at = static_cast<const std::uint8_t*>(std::memchr(at, 1, std::size_t(end - at)));
    if (!at) break;
    robots_.push_back(std::uint32_t(at - begin));
  }
  if (robots_.empty()) return;
  moment_ = moment;
  touches_.clear();
  touch_of_.clear();
  for (const std::uint32_t r : robots_) place(r);
  for (const std::uint32_t r : robots_) gather(r);
  for (Touch& t : touches_) share(t);
  for (const std::uint32_t r : robots_) places_[r].load = places_[r].resistance.greatest(places_[r].mobility);
  std::size_t next = 0;
  for (const std::uint32_t r : robots_) next = push_robot(r, next);
}

void Meetings::place(std::uint32_t robot) {
  const Robot& r = bodies_.robots[robot];
  *r.wrench = Wrench{};
  const Vec3& p = r.base->position;
  const Quat& q = r.base->orientation;
  places_[robot].mobility =
      law::mobility_of<double>(bodies_.masses[r.mass], {{p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}});
  places_[robot].resistance = Resistance{};
}

/// Whether robot `self` works out the contact: both robots of a pair list it.
bool Meetings::owns(std::uint32_t self, std::int32_t other) const {
  if (other == nobody) return true;
  const std::uint64_t mine = bodies_.robots[self].rank, theirs = bodies_.robots[std::size_t(other)].rank;
  return mine != theirs ? mine < theirs : self < std::uint32_t(other);
}

/// Sorts the contacts of a robot into patches.
void Meetings::gather(std::uint32_t self) {
  const std::size_t first = touches_.size();
  for (const Contact& contact : *bodies_.robots[self].contacts) {
    const Body& other = bodies_[contact.other];
    if (!owns(self, other.robot)) {
      touch_of_.push_back(not_ours);
      continue;
    }
    const V3 normal = plain(contact.normal);
    std::size_t t = touches_.size();
    while (t > first &&
           !(touches_[t - 1].whole == other.whole && dot(touches_[t - 1].patch.normal, normal) > same_direction))
      --t;
    if (t == first) {
      t = touches_.size() + 1;
      touches_.push_back(
          {Patch(normal, places_[self].mobility.centre), self, other.robot, other.whole, {}, -1, {}, {}});
    }
    touches_[t - 1].patch.add(plain(contact.point));
    touch_of_.push_back(std::uint32_t(t - 1));
  }
}

/// Shares the effective mass of a patch among its points, and adds their springs to those of its robots.
void Meetings::share(Touch& t) {
  Place& a = places_[t.self];
  law::Yield<double> middle = t.patch.at_middle(a.mobility);
  if (t.other == nobody) {
    t.share = {middle, t.patch.count};
  } else {
    Place& b = places_[std::size_t(t.other)];
    const Patch theirs = t.patch.seen_from(b.mobility.centre);
    t.share = {middle + theirs.at_middle(b.mobility), t.patch.count};
    b.resistance += theirs.resistance(t.share.along, t.share.across);
  }
  a.resistance += t.patch.resistance(t.share.along, t.share.across);
}

/// Works out the contacts of a robot; theirs begin at `next` in touch_of_. Returns where the next robot's begin.
std::size_t Meetings::push_robot(std::uint32_t self, std::size_t next) {
  const Robot& robot = bodies_.robots[self];
  const auto old = *robot.grips;
  old_grips_.assign(old.begin(), old.end());
  robot.grips.clear();
  Wrench total;
  std::size_t ours = 0;
  for (const Contact& contact : *robot.contacts) {
    const std::uint32_t place_of_touch = touch_of_[next++];
    if (place_of_touch == not_ours) continue;
    Touch& touch = touches_[place_of_touch];
    if (contact.restitution != touch.restitution) set_laws(touch, contact.restitution);
    const std::uint64_t pair = bodies_.pair_of(contact);
    const Grip* const before = previous(old_grips_, ours++, pair, contact.point);
    Grip grip{pair, contact.point, before ? before->stretch : Vec3::Zero()};
    const Vec3 force = force_on_self(touch, contact, grip.stretch);
    robot.grips.push_back(grip);
    total.add_force(force, contact.point - robot.base->position);
    if (touch.other != nobody) push_back(robot, touch, force, contact.point, before);
  }
  *robot.wrench += total;
  return next;
}

/// A patch rarely has more than one restitution.
void Meetings::set_laws(Touch& t, double restitution) const {
  const double load = places_[t.self].load + (t.other == nobody ? 0 : places_[std::size_t(t.other)].load);
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
  return r.twist->at(vector_of(places_[robot].mobility.centre) - r.base->position);
}

/// The force of a contact on the other robot. The levers are those of the middle of the step, to which both centres
/// and the point move on: so the pair keeps its angular momentum.
void Meetings::push_back(const Robot& robot, const Touch& touch, const Vec3& force, const Vec3& point,
                         const Grip* before) const {
  const Robot& other = bodies_.robots[std::size_t(touch.other)];
  other.wrench->add_force(-force, point - other.base->position);
  const Vec3 v = centre_velocity(touch.self), u = centre_velocity(std::uint32_t(touch.other));
  Vec3 wander = 0.5 * (v + u);  // velocity of the point, which belongs to no body
  if (before && moment_.elapsed > 0) {
    const Vec3 seen = (point - before->point) / moment_.elapsed;
    if ((seen - wander).norm() <= (v - u).norm()) wander = seen;  // else it is another point
  }
  const double half = 0.5 * moment_.stiffness.h;
  robot.wrench->torque += (half * (wander - v)).cross(force);
  other.wrench->torque -= (half * (wander - u)).cross(force);
}

}  // namespace muro::penalty
