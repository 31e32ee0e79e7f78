// SPDX-License-Identifier: MIT
#include "split_step.hpp"

#include <algorithm>

namespace muro::ode {

using multibody::MotionType;

void SplitStep::resize(const std::deque<OdeRobot>& robots) {
  std::size_t count = 0;
  for (const OdeRobot& r : robots) count += r.body_count();
  bodies_.resize(count);
  pushed_.resize(robots.size());
}

void SplitStep::keep_start(const std::deque<OdeRobot>& robots) {
  Body* kept = bodies_.data();
  for (const OdeRobot& r : robots)
    for (std::size_t i = 0; i < r.body_count(); ++i, ++kept) {
      const dBodyID id = r.body_id(i);
      std::copy_n(dBodyGetPosition(id), 3, kept->position);
      std::copy_n(dBodyGetQuaternion(id), 4, kept->orientation);
      std::copy_n(dBodyGetLinearVel(id), 3, kept->velocity);
      std::copy_n(dBodyGetAngularVel(id), 3, kept->spin);
      std::copy_n(dBodyGetForce(id), 3, kept->force);
      std::copy_n(dBodyGetTorque(id), 3, kept->torque);
    }
}

bool SplitStep::find_pushed(const std::deque<OdeRobot>& robots, std::span<const FoundContact> contacts) {
  std::fill(pushed_.begin(), pushed_.end(), char(0));
  const auto is_dynamic = [&](const GeomOwner& owner) {
    return owner.robot >= 0 && robots[std::size_t(owner.robot)].motion_type() == MotionType::dynamic;
  };
  const auto add = [&](const GeomOwner& owner) {
    if (!is_dynamic(owner) || pushed_[std::size_t(owner.robot)]) return false;
    pushed_[std::size_t(owner.robot)] = 1;
    return true;
  };
  bool is_found = false;
  for (const FoundContact& c : contacts)
    if (c.splits && c.force().dot(c.normal()) > 0) {
      is_found = true;
      add(*c.first);
      add(*c.second);
    }
  for (bool grows = is_found; grows;) {
    grows = false;
    for (const FoundContact& c : contacts) {
      if (!is_dynamic(*c.first) || !is_dynamic(*c.second) || !is_pushed(c)) continue;
      const bool has_first = add(*c.first), has_second = add(*c.second);
      grows = grows || has_first || has_second;
    }
  }
  return is_found;
}

void SplitStep::begin_again(const std::deque<OdeRobot>& robots) {
  Body* kept = bodies_.data();
  for (std::size_t k = 0; k < robots.size(); ++k) {
    const OdeRobot& r = robots[k];
    const bool is_left_out = r.motion_type() == MotionType::dynamic && !pushed_[k];
    for (std::size_t i = 0; i < r.body_count(); ++i, ++kept) {
      const dBodyID id = r.body_id(i);
      if (is_left_out) {
        dBodyDisable(id);
        continue;
      }
      const Body start = *kept;
      std::copy_n(dBodyGetPosition(id), 3, kept->position);
      std::copy_n(dBodyGetQuaternion(id), 4, kept->orientation);
      dBodySetPosition(id, start.position[0], start.position[1], start.position[2]);
      dBodySetQuaternion(id, start.orientation);
      dBodySetLinearVel(id, start.velocity[0], start.velocity[1], start.velocity[2]);
      dBodySetAngularVel(id, start.spin[0], start.spin[1], start.spin[2]);
      dBodySetForce(id, start.force[0], start.force[1], start.force[2]);
      dBodySetTorque(id, start.torque[0], start.torque[1], start.torque[2]);
    }
  }
}

void SplitStep::end(const std::deque<OdeRobot>& robots) {
  const Body* kept = bodies_.data();
  for (std::size_t k = 0; k < robots.size(); ++k) {
    const OdeRobot& r = robots[k];
    const bool is_left_out = r.motion_type() == MotionType::dynamic && !pushed_[k];
    for (std::size_t i = 0; i < r.body_count(); ++i, ++kept) {
      const dBodyID id = r.body_id(i);
      if (is_left_out) {
        dBodyEnable(id);
        continue;
      }
      dBodySetPosition(id, kept->position[0], kept->position[1], kept->position[2]);
      dBodySetQuaternion(id, kept->orientation);
    }
  }
}

}  // namespace muro::ode
