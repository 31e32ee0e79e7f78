// SPDX-License-Identifier: MIT
// Robots that touch something that moves: each other, or robots that no force moves.
#pragma once

#include <optional>
#include <vector>

#include "bodies.hpp"

namespace muro::penalty {

/// Each robot is served in four passes, which read what the passes before found of other robots. A pass writes only
/// what belongs to its robot, so robots may be divided among threads.
class Meetings {
 public:
  explicit Meetings(const Bodies& bodies) : bodies_(bodies), record_of_(bodies.robots.size()) {}

  /// Takes the robots (of Bodies::robots) whose flag is set; whoever touches one of them and is moved by forces has its
  /// flag set too. Returns how many they are.
  std::size_t begin(const Moment& moment, const std::vector<std::uint8_t>& flags);

  static constexpr int passes = 4;
  /// `which`: 0 to 3, one behind the other. `robot`: one of those that begin() took.
  void pass(int which, std::uint32_t robot);
  /// The same for all of them.
  void pass(int which) {
    for (const std::uint32_t r : robots_) pass(which, r);
  }

 private:
  using V3 = lane::V3<double>;
  using Mobility = law::Mobility<double>;
  using Patch = law::Patch<double>;

  static constexpr std::uint32_t not_ours = 0xffffffffu;

  /// A patch between a unit of a robot and something else.
  struct Touch {
    Patch patch;                   ///< from the centre of the unit
    std::uint32_t unit;            ///< of the robot, in Bodies::units
    std::int32_t other;            ///< in Bodies::robots, or nobody
    std::uint32_t other_unit = 0;  ///< in Bodies::units, of somebody
    std::uint32_t whole;           ///< of the other
    law::Share<double> share{};
    double restitution = -1;  ///< that `normal` is for
    std::optional<law::NormalLaw<double>> normal{};
    std::optional<law::FrictionLaw<double>> friction{};
    Wrench reaction{};  ///< on the other's unit
  };
  /// A robot in the present step.
  struct Record {
    std::uint32_t first_unit = 0;
    std::vector<Mobility> mobilities;              ///< of its units
    std::vector<law::Resistance<double>> springs;  ///< that hold them
    std::vector<Touch> touches;                    ///< of the contacts that it works out
    std::vector<std::uint32_t> touch_of;           ///< of each contact: in `touches`, or not_ours
    std::vector<std::uint32_t> owners;             ///< robots that work out its other contacts, by rank
    std::vector<Grip> old_grips;
    double load = 0;  ///< its stiffest motion, in units of omega^2
  };

  void add_records();
  void place(std::uint32_t self);
  void gather(std::uint32_t self);
  void find_load(std::uint32_t self);
  void push(std::uint32_t self);
  void add_reactions(std::uint32_t self);

  bool owns(std::uint32_t self, std::int32_t other) const;
  const Mobility& mobility(std::int32_t robot, std::uint32_t unit) const {
    const Record& r = record(std::uint32_t(robot));
    return r.mobilities[unit - r.first_unit];
  }
  law::Share<double> share_of(const Mobility& self, const Touch& t) const;
  void set_laws(const Record& self, Touch& t, double restitution) const;
  Vec3 force_on_self(const Robot& self, const Touch& touch, const Contact& contact, Vec3& stretch) const;
  void react(std::uint32_t self, Touch& touch, const Vec3& force, const Vec3& point, const Grip* before) const;
  Vec3 centre_velocity(std::int32_t robot, std::uint32_t unit) const;
  Record& record(std::uint32_t robot) { return records_[record_of_[robot]]; }
  const Record& record(std::uint32_t robot) const { return records_[record_of_[robot]]; }

  const Bodies& bodies_;
  Moment moment_;
  const std::vector<std::uint8_t>* flags_ = nullptr;  ///< of this step, see begin()
  std::vector<std::uint32_t> robots_;                 ///< that meet
  std::vector<std::uint32_t> record_of_;              ///< by robot: in records_, of those that meet
  std::vector<Record> records_;                       ///< at least as many as meet
};

}  // namespace muro::penalty
