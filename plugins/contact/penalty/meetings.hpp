// SPDX-License-Identifier: MIT
// Robots that touch something that moves: each other, or robots that no force moves.
#pragma once

#include <optional>
#include <vector>

#include "bodies.hpp"

namespace muro::penalty {

class Meetings {
 public:
  explicit Meetings(const Bodies& bodies) : bodies_(bodies), places_(bodies.robots.size()) {}
  /// Serves the robots (of Bodies::robots) whose flag is set; whoever touches one of them and is moved by forces has
  /// its flag set too.
  void push(const Moment& moment, const std::vector<std::uint8_t>& flags);

 private:
  using V3 = lane::V3<double>;
  using Mobility = law::Mobility<double>;
  using Patch = law::Patch<double>;
  using Resistance = law::Resistance<double>;
  using NormalLaw = law::NormalLaw<double>;
  using FrictionLaw = law::FrictionLaw<double>;

  static constexpr std::uint32_t not_ours = 0xffffffffu;

  /// A robot in the present step.
  struct Place {
    Mobility mobility;
    Resistance resistance;  ///< of all its contacts, in units of omega^2
    double load = 0;        ///< its stiffest motion, in units of omega^2
  };
  /// A patch between a robot and something else.
  struct Touch {
    Patch patch;
    std::uint32_t self;   ///< in Bodies::robots
    std::int32_t other;   ///< the same, or nobody
    std::uint32_t whole;  ///< of the other
    law::Share<double> share;
    double restitution = -1;  ///< that `normal` is for
    std::optional<NormalLaw> normal;
    std::optional<FrictionLaw> friction;
  };

  void place(std::uint32_t robot);
  bool owns(std::uint32_t self, std::int32_t other) const;
  void gather(std::uint32_t self);
  void share(Touch& t);
  std::size_t push_robot(std::uint32_t self, std::size_t next);
  void set_laws(Touch& t, double restitution) const;
  Vec3 force_on_self(const Touch& touch, const Contact& contact, Vec3& stretch) const;
  void push_back(const Robot& robot, const Touch& touch, const Vec3& force, const Vec3& point,
                 const Grip* before) const;
  Vec3 centre_velocity(std::uint32_t robot) const;

  const Bodies& bodies_;
  Moment moment_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> robots_;  ///< that meet
  std::vector<Touch> touches_;
  std::vector<std::uint32_t> touch_of_;  ///< one a contact, in the order of robots and lists
  std::vector<Grip> old_grips_;
};

}  // namespace muro::penalty
