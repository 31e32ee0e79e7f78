// SPDX-License-Identifier: MIT
// Contacts between moving bodies: of robots that touch each other, or robots that no force moves.
#pragma once

#include <algorithm>
#include <atomic>
#include <optional>
#include <vector>

#include "contact_solver.hpp"
#include "impact.hpp"
#include "pair_kernel.hpp"

namespace muro::penalty {

/// Each robot is processed in five passes, in this order: find_contacts, find_loads, find_forces, apply,
/// apply_reactions; prepare_groups comes before find_forces. A pass reads the results of earlier passes for other
/// robots, and writes only the data of its robot (one robot of a group: those of all robots of the group), so threads
/// may share the robots.
class PairContacts {
 public:
  PairContacts(const Bodies& bodies, Host& host)
      : bodies_(bodies),
        host_(host),
        kernels_(pair_kernels_for(lane::best_isa())),
        record_of_(bodies.robots.size()),
        known_(bodies.robots.size()) {}
  /// Forgets what is known of earlier steps; call it before the first step and when the state was changed from outside.
  void start() {
    for (KnownContacts& known : known_) known.count = 0;
    number_in_group_.resize(bodies_.dynamic_bodies.size());
  }

  /// Starts a step with the robots (of Bodies::robots) with a set flag. A robot that touches one of them and that
  /// forces move has its flag set too. Returns the number of robots.
  std::size_t begin(const StepContext& context, const std::vector<std::uint8_t>& flags);

  /// Finds the contacts that the robot computes, and their patches. `robot`: one of those that begin() took.
  void find_contacts(std::uint32_t robot) {
    set_up(robot);
    find_patches(robot);
  }
  /// Finds its stiffest motion, and the impacts that it is in.
  void find_loads(std::uint32_t robot) {
    find_load(robot);
    count_impacts(robot);
  }
  /// Finds groups of robots that carry each other, and resolves the impacts of bodies that are in several, one after
  /// the other in the order of their times. Once for all robots.
  void prepare_groups() {
    find_groups();
    resolve_in_turns();
  }
  /// Finds the forces of its contacts, or of all contacts of its group.
  void find_forces(std::uint32_t robot);
  /// Applies them and the impulses of impacts to the robot.
  void apply(std::uint32_t robot) {
    apply_forces(robot);
    apply_impacts(robot);
    keep_told(robot);
  }
  /// Adds the reactions of contacts that other robots compute.
  void add_reactions(std::uint32_t robot);
  /// Lists what contacts do to robots that no force moves, where something reads it. Once, after all passes.
  void list_kinematic_robots() const;
  /// Runs all passes for all robots.
  void run() {
    const auto each = [&](void (PairContacts::*pass)(std::uint32_t)) {
      for (const std::uint32_t robot : robots_) (this->*pass)(robot);
    };
    each(&PairContacts::find_contacts);
    each(&PairContacts::find_loads);
    prepare_groups();
    each(&PairContacts::find_forces);
    each(&PairContacts::apply);
    each(&PairContacts::add_reactions);
    if (bodies_.tells_kinematic_robots) list_kinematic_robots();
  }

 private:
  using V3 = lane::V3<double>;
  using Mobility = law::Mobility<double>;
  using Patch = law::Patch<double>;

  static constexpr std::uint32_t not_computed = 0xffffffffu, in_impact = 0xfffffffeu, had_impact = 0xfffffffdu,
                                 no_group = 0xffffffffu;

  /// A contact patch in an impact.
  struct ImpactPatch {
    Vec3 normal;
    std::int32_t other;             ///< in Bodies::robots, or not_dynamic
    std::uint32_t model;            ///< of the other
    bool is_resolved = false;       ///< its points have their impulses
    Wrench reaction{};              ///< on the other's base
    ImpactCorrection correction{};  ///< of the other's path
  };
  /// A contact in an impact.
  struct ImpactContact {
    std::uint32_t patch = 0;  ///< index in Record::impact_patches
    ImpactPoint point;
  };

  /// A contact patch between a dynamic body of a robot and something else.
  struct ContactPatch {
    Patch patch;                   ///< seen from the centre of the body
    std::uint32_t body;            ///< body of the robot, index in Bodies::dynamic_bodies
    std::int32_t other;            ///< in Bodies::robots, or not_dynamic
    std::uint32_t other_body = 0;  ///< index in Bodies::dynamic_bodies, if it is a robot
    std::uint32_t model;           ///< of the other
    law::EffectiveMass<double> effective_mass{};
    double load = 0;  ///< of both bodies; after the effective mass, as PairPoint::patch expects it
    bool has_load = false;
    Vec3 velocity = Vec3::Zero(), other_velocity = Vec3::Zero();  ///< m/s, of the centres of two robots
    Wrench reaction{};                                            ///< on the other's body
  };
  /// Adjacent contacts with one body.
  struct Run {
    ObjectId other;
    std::uint32_t end;                       ///< place after the last one, in the list
    bool is_computed = false;                ///< this robot computes them
    std::int32_t other_robot = not_dynamic;  ///< index in Bodies::robots, if forces on it count
  };
  /// A contact that a robot computes.
  struct Computed {
    std::uint64_t pair;
    std::uint32_t place;                    ///< place in the list
    std::uint32_t body, other_body, model;  ///< as in ContactPatch
    std::int32_t other_robot;               ///< in Bodies::robots, or not_dynamic
    double zeta;                            ///< damping ratio of the normal
    bool is_of_disc;                        ///< see Bodies::is_of_disc
    std::uint32_t patch = 0;                ///< index in Record::patches, or one of the constants above
    bool lasts = false;                     ///< it existed in the step before
    SolvedContact solved{};                 ///< in a group: as kept from the last step; once solved, as to be kept
    bool is_exact = false;                  ///< in a group: all that acts on its bodies is known
    double yield = 0;  ///< s/kg: in a group, speed per force by which its friction gives way to spin
    /// m, see find_lever_shifts
    Vec3 lever_shift = Vec3::Zero(), other_lever_shift = Vec3::Zero();
    Vec3 way = Vec3::Zero();  ///< m, world: way of its point in the last step, if it moves over a single body
  };
  /// Data about the contacts of a robot. They are valid as long as the list has the same contacts.
  struct KnownContacts {
    std::uint64_t revision = 0;  ///< revision of the list
    std::size_t count = 0;       ///< 0: nothing is known
    bool resist_turning = false;
    std::vector<Run> runs;
    std::vector<Computed> computed;
    std::vector<PairPoint> points;  ///< in the order of `computed`
  };
  /// A robot in the present step.
  struct Record {
    std::uint32_t first_body = 0;
    std::vector<Mobility> mobilities;                   ///< of its bodies
    std::vector<law::SpringStiffness<double>> springs;  ///< springs that hold its bodies
    std::vector<ContactPatch> patches;                  ///< of the contacts that it computes
    std::vector<std::uint32_t> owners;                  ///< robots that compute its other contacts, by order key
    std::vector<TurningSpring> old_turning_springs;
    std::vector<ImpactPatch> impact_patches;     ///< of the impacts that it computes
    std::vector<ImpactContact> impact_contacts;  ///< of these patches
    std::vector<ImpactPoint> points;             ///< scratch
    Push pushed;                                 ///< sum of the earlier impacts of this step
    std::vector<ContactWrench> told;             ///< contacts of its list in which it pushes others, if reported
    std::size_t impacts = 0;                     ///< patches that contain it, its own and those of others
    double load = 0;                             ///< its stiffest motion, in units of omega^2
    std::vector<std::uint32_t> touched;          ///< numbers of its bodies with contacts that are solved in a group
    double shared = 1;                           ///< of these, see ApparentMasses::shared_by
    std::uint32_t group = no_group;              ///< index in groups_; no_group: its contacts are resolved one by one

    std::vector<V3> bounced;  ///< N s, N m s about the origin: by contacts that bounce, for each body; empty: none

    void add_impulse(std::uint32_t body, const Vec3& impulse, const Vec3& point) {
      if (bounced.empty()) bounced.assign(2 * mobilities.size(), V3{0, 0, 0});
      const Vec3 turn = point.cross(impulse);
      bounced[2 * (body - first_body)] += V3{impulse.x(), impulse.y(), impulse.z()};
      bounced[2 * (body - first_body) + 1] += V3{turn.x(), turn.y(), turn.z()};
    }
    void add_touched(std::uint32_t body) {
      if (std::find(touched.begin(), touched.end(), body - first_body) == touched.end())
        touched.push_back(body - first_body);
    }
  };

  void add_records();
  void set_up(std::uint32_t self);
  void find_patches(std::uint32_t self);
  bool computes_contacts_with(std::uint32_t self, ObjectId body, std::int32_t& other_robot);
  std::uint32_t add_to_patch(Record& me, const Computed& computed, const Contact& contact) const;
  bool add_impact(std::uint32_t self, const Contact& contact, std::int32_t other_robot, std::size_t place);
  void find_groups();
  bool carries(std::uint32_t self, const ContactPatch& patch) const;
  std::uint32_t root_of(std::uint32_t record);
  void solve_group(std::uint32_t number);
  void find_touched(std::uint32_t robot);
  void add_bodies(std::uint32_t robot, ContactSolver& solver);
  void recall(std::uint32_t robot, std::size_t place, Computed& c, double approach, const Contact& contact,
              double mean_over) const;
  void add_supports(std::uint32_t robot, double mass, ContactSolver& solver) const;
  bool has_joints(std::int64_t robot) const;
  double apparent_mass_across(std::uint32_t self, const Computed& c) const;
  double parted_depth(double depth) const;
  void add_contacts(std::uint32_t robot, double mass, ContactSolver& solver);
  void take_forces(std::uint32_t robot, std::span<const SolverContact>& found);
  double mean_over_of(std::uint32_t robot) const;
  void tell_depth(std::uint32_t robot, const Contact& contact, const PairPoint& point, const Computed& c);
  static bool is_solved(const Computed& c) {
    return c.patch != in_impact && c.patch != had_impact && !(c.solved.rebounds > 0);
  }
  void recall_contacts(std::uint32_t robot);
  void resolve_in_turns();
  void count_impacts(std::uint32_t self);
  void resolve_in_turn(std::uint32_t self, std::uint32_t number);
  void apply_impacts(std::uint32_t self);
  void add_impact_reactions(std::uint32_t self);
  FreeBody free_body(std::uint32_t robot) const { return {bodies_, bodies_.base_of(bodies_.robots[robot])}; }
  void find_load(std::uint32_t self);
  void apply_forces(std::uint32_t self);
  void keep_told(std::uint32_t self);

  bool computes(std::uint32_t self, std::int32_t other) const;
  const Mobility& mobility(std::int32_t robot, std::uint32_t body) const {
    const Record& r = record(std::uint32_t(robot));
    return r.mobilities[body - r.first_body];
  }
  law::EffectiveMass<double> effective_mass_of(const Mobility& self, const ContactPatch& p) const;
  void set_load(std::uint32_t self, ContactPatch& patch) const;
  void find_runs(std::uint32_t self);
  void find_computed(std::uint32_t self);
  void update_computed(std::uint32_t self);
  static void find_cells(KnownContacts& known);
  void find_springs(std::uint32_t self);
  Vec3 resist_turning(std::uint32_t self, ContactPatch& patch, const Contact& contact, const TurningSpring& spring,
                      double normal_force);
  void find_lever_shifts(std::uint32_t self, const ContactPatch& patch, const Vec3& at, const FrictionAnchor* before,
                         const AnchorDetail& detail, Computed& c) const;
  void find_shared_lever_shifts(std::uint32_t self, const ContactPatch& patch, const Vec3& at,
                                const FrictionAnchor* before, Computed& c) const;
  void find_own_lever_shift(std::uint32_t self, const ContactPatch& patch, const Vec3& at, const FrictionAnchor* before,
                            const AnchorDetail& detail, Computed& c) const;
  void apply_to_pair(const Computed& c, ContactPatch& patch, const Vec3& force, const Vec3& moment,
                     const Vec3& point) const;
  Vec3 centre_velocity(std::int32_t robot, std::uint32_t body) const;
  Record& record(std::uint32_t robot) { return records_[record_of_[robot]]; }
  const Record& record(std::uint32_t robot) const { return records_[record_of_[robot]]; }

  /// An impact patch of a body that is in several. They are sorted by time.
  struct Turn {
    double since;                 ///< s
    std::uint64_t key;            ///< order key of the robot
    std::uint32_t robot, number;  ///< index in Bodies::robots; index in its impact_patches
  };

  /// Robots that carry each other. Their contacts are solved together.
  struct Group {
    std::vector<std::uint32_t> robots;  ///< indices in Bodies::robots, by order key
    ContactSolver solver;
  };

  const Bodies& bodies_;
  Host& host_;
  const PairKernels& kernels_;
  StepContext context_;
  const std::vector<std::uint8_t>* flags_ = nullptr;  ///< flags of this step, see begin()
  std::vector<std::uint32_t> robots_;                 ///< robots of this step
  std::vector<std::uint32_t> record_of_;              ///< by robot: index in records_, for robots of this step
  std::vector<Turn> turns_;                           ///< scratch
  std::vector<KnownContacts> known_;                  ///< in the order of Bodies::robots
  std::vector<Record> records_;                       ///< at least one for each robot of this step
  std::vector<std::uint32_t> roots_;                  ///< scratch, by record: another record of its group
  std::vector<std::uint8_t> carrying_;                ///< scratch, by record: its group is solved
  std::vector<Group> groups_;                         ///< the first group_count_ are of this step
  std::size_t group_count_ = 0;
  std::atomic<bool> depth_is_told_ = false;
  std::vector<std::uint32_t> number_in_group_;  ///< of bodies, in the order of Bodies::dynamic_bodies
};

}  // namespace muro::penalty
