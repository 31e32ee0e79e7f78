// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstring>
#include <vector>

#include "grip.hpp"
#include "muro/scene.hpp"
#include "standing.hpp"

namespace muro::penalty {

static_assert(sizeof(Contact) == contact_stride * sizeof(double) && offsetof(Contact, point) == 8 &&
              offsetof(Contact, normal) == 32 && offsetof(Contact, depth) == 56 && offsetof(Contact, friction) == 64 &&
              offsetof(Contact, self_shape) == 80 && sizeof(Grip) == grip_stride * sizeof(double) &&
              offsetof(Grip, point) == 8 && offsetof(Grip, stretch) == 32);

/// What a robot stood on in the step before. It saves looking at the same contacts again; whether the kernels serve a
/// robot follows from its contacts and grips alone.
class Standing {
 public:
  StandingRobot view;

  /// Whether the robot has just these contacts, and a grip for each in their order.
  bool matches(std::span<const Contact> contacts, std::span<const Grip> springs) const {
    if (contacts.size() != count_ || springs.size() != count_) return false;
    bool same = true;
    for (std::uint32_t i = 0; i < count_; ++i)
      same = same && std::memcmp(&contacts[i].self, &bodies_[i], 8) == 0 &&
             std::memcmp(&contacts[i].self_shape, &shapes_[i], 8) == 0 && springs[i].pair == pairs_[i];
    return same;
  }
  void clear() { count_ = 0; }
  /// Takes a contact over; they come in order. False: there is no room.
  bool add(const Contact& c, std::uint64_t pair, const double* pose, const double* twist) {
    if (count_ == most_contacts) return false;
    const bool new_group = count_ == 0 || pair != pairs_[count_ - 1];
    if (new_group) {
      view.body_pose[groups_of(count_)] = pose;
      view.body_twist[groups_of(count_)] = twist;
    }
    std::memcpy(&bodies_[count_], &c.self, 8);
    std::memcpy(&shapes_[count_], &c.self_shape, 8);
    pairs_[count_] = pair;
    groups_ = groups_of(count_) + (new_group ? 1 : 0);
    ends_[groups_ - 1] = ++count_;
    return true;
  }
  /// Equal for robots that one lane can serve.
  std::uint64_t signature(std::uint32_t material) const {
    std::uint64_t bits = count_ | std::uint64_t(material) << 32;
    for (std::uint32_t g = 0; g < groups_; ++g) bits |= std::uint64_t(1) << (ends_[g] + 8);
    return bits;
  }
  void describe(StandingWork& work) const {
    work.contacts = int(count_);
    work.groups = int(groups_);
    std::copy_n(ends_, groups_, work.ends);
  }
  bool simple = false;     ///< served by the kernels, as long as it matches and its normals make one patch
  std::uint64_t kind = 0;  ///< its signature
  double restitution = 0;

 private:
  std::uint32_t groups_of(std::uint32_t count) const { return count == 0 ? 0 : groups_; }

  std::uint32_t count_ = 0, groups_ = 0;
  std::uint64_t bodies_[most_contacts] = {}, shapes_[most_contacts] = {}, pairs_[most_contacts] = {};
  std::uint32_t ends_[most_contacts] = {};
};

}  // namespace muro::penalty
