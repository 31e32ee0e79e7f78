// SPDX-License-Identifier: MIT
#pragma once

#include "muro/algorithm.hpp"
#include "muro/vocabulary/contact.hpp"

namespace muro {

/// The role of a robot in contacts while one motion moves it: keys::contact_world and keys::twist_lag of its base.
class ContactRole {
 public:
  ContactRole() = default;
  /// `world`, `lag`: values of the two properties. [setup]
  ContactRole(Connector& c, ObjectId base, std::uint64_t world, double lag = 0)
      : world_(c.variable(base, keys::contact_world, world)),
        lag_(c.variable(base, keys::twist_lag, lag)),
        own_world_(world),
        own_lag_(lag) {}

  explicit operator bool() const { return bool(world_); }
  /// Writes the values of this motion, which moves the robot from now on. [between steps]
  void take_over() const {
    *world_ = own_world_;
    *lag_ = own_lag_;
  }
  /// Returns the world at present: that of the motion that moves the robot. [step]
  std::uint64_t present_world() const { return *world_; }

 private:
  Out<std::uint64_t> world_;
  Out<double> lag_;
  std::uint64_t own_world_ = 0;
  double own_lag_ = 0;
};

}  // namespace muro
