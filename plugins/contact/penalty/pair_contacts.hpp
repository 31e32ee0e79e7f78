// SPDX-License-Identifier: MIT
// Contacts between moving bodies: of robots that touch each other, or robots that no force moves.
#pragma once

#include <optional>
#include <vector>

#include "impact.hpp"

namespace muro::penalty {

/// Each robot is processed in four passes, which read the results of earlier passes for other robots. A pass writes
/// only the data of its robot, so threads may share the robots.
class PairContacts {
 public:
  explicit PairContacts(const Bodies& bodies) : bodies_(bodies), record_of_(bodies.robots.size()) {}

  /// Starts a step with the robots (of Bodies::robots) whose flag is set; who touches one of them and is moved by
  /// forces has its flag set too. Returns their number.
  std::size_t begin(const StepContext& context, const std::vector<std::uint8_t>& flags);

  static constexpr int passes = 4;
  /// `which`: 0 to 3, in this order. `robot`: one of those that begin() took.
  void pass(int which, std::uint32_t robot);
  /// Between passes 1 and 2: the impacts of bodies that are in several, one after the other in the order of their
  /// times.
  void resolve_in_turns();
  /// All passes, for all of them.
  void run() {
    for (int which = 0; which < passes; ++which) {
      if (which == 2) resolve_in_turns();
      for (const std::uint32_t r : robots_) pass(which, r);
    }
  }

 private:
  using V3 = lane::V3<double>;
  using Mobility = law::Mobility<double>;
  using Patch = law::Patch<double>;

  static constexpr std::uint32_t not_computed = 0xffffffffu, in_impact = 0xfffffffeu;

  /// A contact patch in an impact.
  struct ImpactPatch {
    Vec3 normal;
    std::int32_t other;             ///< in Bodies::robots, or no_robot
    std::uint32_t model;            ///< of the other
    bool is_resolved = false;       ///< its points have their impulses
    Wrench reaction{};              ///< on the other's base
    ImpactCorrection correction{};  ///< of the other's path
  };
  /// A contact in an impact.
  struct ImpactContact {
    std::uint32_t patch = 0;  ///< in Record::impact_patches
    ImpactPoint point;
  };

  /// A contact patch between a dynamic body of a robot and something else.
  struct ContactPatch {
    Patch patch;                   ///< from the centre of the body
    std::uint32_t body;            ///< of the robot, in Bodies::dynamic_bodies
    std::int32_t other;            ///< in Bodies::robots, or no_robot
    std::uint32_t other_body = 0;  ///< in Bodies::dynamic_bodies, of a robot
    std::uint32_t model;           ///< of the other
    law::EffectiveMass<double> effective_mass{};
    double restitution = -1;  ///< that `normal` is for
    std::optional<law::NormalLaw<double>> normal{};
    std::optional<law::FrictionLaw<double>> friction{};
    Vec3 velocity = Vec3::Zero(), other_velocity = Vec3::Zero();  ///< m/s, of the centres of two robots
    Wrench reaction{};                                            ///< on the other's body
  };
  /// Velocities (m/s) of both bodies where they touch.
  struct PointMotion {
    Vec3 of_self, of_other;

    Vec3 relative() const { return of_self - of_other; }
  };
  /// A robot in the present step.
  struct Record {
    std::uint32_t first_body = 0;
    std::vector<Mobility> mobilities;                   ///< of its bodies
    std::vector<law::SpringStiffness<double>> springs;  ///< that hold them
    std::vector<ContactPatch> patches;                  ///< of the contacts that it computes
    std::vector<std::uint32_t> patch_of;                ///< of each contact: in `patches`, not_computed or in_impact
    std::vector<std::uint32_t> owners;                  ///< robots that compute its other contacts, by order key
    std::vector<FrictionAnchor> old_anchors;
    std::vector<TurningSpring> old_turning_springs;
    std::vector<ImpactPatch> impact_patches;     ///< of the impacts that it computes
    std::vector<ImpactContact> impact_contacts;  ///< of these patches
    std::vector<ImpactPoint> points;             ///< scratch
    Push pushed;                                 ///< in the impacts of this step that came before
    std::size_t impacts = 0;                     ///< patches in which it is, its own and those of others
    double load = 0;                             ///< its stiffest motion, in units of omega^2
  };

  void add_records();
  void set_up(std::uint32_t self);
  void find_patches(std::uint32_t self);
  bool computes_contacts_with(std::uint32_t self, ObjectId body, std::int32_t& other_robot);
  std::uint32_t add_to_patch(Record& me, const Contact& contact, std::int32_t other_robot) const;
  bool add_impact(std::uint32_t self, const Contact& contact, std::int32_t other_robot, std::size_t place);
  void count_impacts(std::uint32_t self);
  void resolve_in_turn(std::uint32_t self, std::uint32_t number);
  void apply_impacts(std::uint32_t self);
  void add_impact_reactions(std::uint32_t self);
  FreeBody free_body(std::uint32_t robot) const { return {bodies_, bodies_.base_of(bodies_.robots[robot])}; }
  void find_load(std::uint32_t self);
  void apply_forces(std::uint32_t self);
  void add_reactions(std::uint32_t self);

  bool computes(std::uint32_t self, std::int32_t other) const;
  const Mobility& mobility(std::int32_t robot, std::uint32_t body) const {
    const Record& r = record(std::uint32_t(robot));
    return r.mobilities[body - r.first_body];
  }
  law::EffectiveMass<double> effective_mass_of(const Mobility& self, const ContactPatch& p) const;
  void set_up_laws(std::uint32_t self, ContactPatch& p, double restitution) const;
  Vec3 resist_turning(std::uint32_t self, ContactPatch& patch, const Contact& contact, const TurningSpring& spring,
                      double normal_force);
  Vec3 force_on_self(const Robot& self, const ContactPatch& patch, const Contact& contact, const PointMotion& point,
                     FrictionAnchor& anchor) const;
  void apply_reaction(std::uint32_t self, ContactPatch& patch, const Vec3& force, const Vec3& point,
                      const FrictionAnchor* before) const;
  Vec3 centre_velocity(std::int32_t robot, std::uint32_t body) const;
  Record& record(std::uint32_t robot) { return records_[record_of_[robot]]; }
  const Record& record(std::uint32_t robot) const { return records_[record_of_[robot]]; }

  /// An impact patch of a body that is in several, in the order of their times.
  struct Turn {
    double since;                 ///< s
    std::uint64_t key;            ///< order key of the robot
    std::uint32_t robot, number;  ///< in Bodies::robots; in its impact_patches
  };

  const Bodies& bodies_;
  StepContext context_;
  const std::vector<std::uint8_t>* flags_ = nullptr;  ///< of this step, see begin()
  std::vector<std::uint32_t> robots_;                 ///< of this step
  std::vector<std::uint32_t> record_of_;              ///< by robot: in records_, of those of this step
  std::vector<Turn> turns_;                           ///< scratch
  std::vector<Record> records_;                       ///< at least one for each robot of this step
};

}  // namespace muro::penalty
