// SPDX-License-Identifier: MIT
// Contact forces by penalty: springs and dampers where bodies overlap. Scene-wide.
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "muro/base/number_text.hpp"
#include "muro/plugin.hpp"
#include "muro/vocabulary/contact.hpp"
#include "pair_contacts.hpp"
#include "scenery_contacts.hpp"

namespace {

using namespace muro;
using namespace muro::penalty;

constexpr Parameter parameters[] = {
    real("frequency", "Hz", 50, "stiffness: that of a body bobbing on a contact; at most 0.095 of the rate")
        .between(1, 1e5),
    real("correcting_speed", "m/s", 1, "bodies that are put into each other are parted no faster").between(0, 1e9),
};
constexpr PropertyUse reads[] = {
    {"contacts", "of every robot that forces move"},
    {"pose", "of every body with a collision shape"},
    {"twist", "of every body with a collision shape"},
    {"inertial", "of every body of robots that forces move"},
    {"gravity", "on the world object; 0 0 -9.81 when absent"},
    {"contact.impact.step", "of every robot whose motion takes impacts at their instant"},
};
constexpr PropertyUse writes[] = {
    {"wrench.external", "of every robot that forces move"},
    {"contact.friction_anchors", "friction anchors, of every robot that forces move"},
    {"contact.friction_anchor_details", "of each of them, where one rolls or stands in what it was put into"},
    {keys::carried_mass.name, "of every robot whose motion resolves contacts, too"},
    {"contact.solved", "contacts that were solved together with others, of the same"},
    {"contact.turning_springs", "springs against rolling and spinning, of the same, where shapes resist these"},
    {keys::contact_wrenches_of_law.name,
     "of every robot with a part in a contact: what each does, where somebody reads it"},
    {"contact.time", "of the last run, on the world object"},
    {"contact.impact", "of every robot whose motion takes impacts at their instant"},
    {"contact.impact.time", "of the same robots, when they were in an impact last"},
};
constexpr Description description{
    .id = "contact.penalty",
    .kind = Kind::contact,
    .version = "1.1.0",
    .summary = "Spring-damper contact with restitution and Coulomb friction, stiffness from effective masses",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | allocation_free | restorable,
};

class Penalty final : public Algorithm {
 public:
  void connect(Connector& c) override {
    omega_ = 2 * M_PI * c.parameters().real("frequency");
    correcting_speed_ = c.parameters().real("correcting_speed");
    gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    host_ = &c.host();
    bodies_.connect(c);
    last_run_ = c.variable(world_object, last_run, std::int64_t{-1});
    scenery_contacts_ = std::make_unique<SceneryContacts>(bodies_);
    pair_contacts_ = std::make_unique<PairContacts>(bodies_, c.host());
  }
  void connect_by_name(Connector& c) override { bodies_.connect_by_name(c); }
  void start() override {
    scenery_contacts_->start();
    pair_contacts_->start();
  }
  void restored() override { start(); }

  /// Robots that touch only scenery, which are nearly all, come first, block by block. Then come those that touch
  /// something that moves: in one task if they are few, otherwise block by block.
  std::span<const Phase> phases() const override { return phases_; }

  void step(const Step& step, Range range) override {
    // Contacts are as stiff as wanted, if the step is short enough.
    StepContext context{{std::min(omega_, max_phase_step / step.dt), step.dt},
                        omega_,
                        *last_run_ < 0 ? 0 : 1e-9 * double(step.time - *last_run_),
                        step.time,
                        gravity_};
    constexpr double slowest_impact = 0.02;  // m/s
    context.impact_speed = std::max(slowest_impact, gravity_.norm() / context.stiffness.omega);
    context.correcting_speed = correcting_speed_;
    switch (step.phase) {
      case with_scenery:
        return scenery_contacts_->apply_forces(context, range);
      case pair_begin:
        return begin_pairs(context);
      case pair_contacts:
        return each_pair_robot(&PairContacts::find_contacts, range);
      case pair_loads:
        return each_pair_robot(&PairContacts::find_loads, range);
      case pair_groups:
        return pair_contacts_->prepare_groups();
      case pair_forces:
        return each_pair_robot(&PairContacts::find_forces, range);
      case pair_application:
        return each_pair_robot(&PairContacts::apply, range);
      case pair_reactions:
        return each_pair_robot(&PairContacts::add_reactions, range);
      case kinematic_lists:
        return pair_contacts_->list_kinematic_robots();
    }
  }

 private:
  /// Phases of a step. `pair_begin` decides whether few or many robots touch something that moves, and serves few; the
  /// phases behind it serve many.
  enum PhaseName : std::uint32_t {
    with_scenery,
    pair_begin,
    pair_contacts,
    pair_loads,
    pair_groups,
    pair_forces,
    pair_application,
    pair_reactions,
    kinematic_lists,
    phase_count
  };

  void begin_pairs(const StepContext& context) {
    *last_run_ = context.time;
    if (context.stiffness.omega < omega_) report(context.stiffness);
    if (bodies_.tells_kinematic_robots) bodies_.clear_kinematic_lists();
    constexpr std::size_t few = 12;  // take less time than distributing them to threads
    const std::size_t count = pair_contacts_->begin(context, scenery_contacts_->remaining());
    many_pairs_ = count > few ? 1 : 0;
    lists_kinematic_robots_ = many_pairs_ != 0 && bodies_.tells_kinematic_robots ? 1 : 0;
    if (!many_pairs_) pair_contacts_->run();
  }
  void each_pair_robot(void (PairContacts::*pass)(std::uint32_t), Range block) {
    for (std::uint32_t number = block.begin; number < block.end; ++number) {
      const std::int32_t robot = bodies_.robot_of[number];
      if (robot != not_dynamic && scenery_contacts_->remaining()[std::size_t(robot)])
        (*pair_contacts_.*pass)(std::uint32_t(robot));
    }
  }
  void report(const Stiffness& s) {
    if (std::exchange(reported_, true)) return;
    host_->log(LogLevel::info, "contact.penalty: at a step of " + number_text(s.h) + " s, contacts have " +
                                   number_text(s.omega / (2 * M_PI)) + " Hz instead of " +
                                   number_text(omega_ / (2 * M_PI)) +
                                   "; a higher rate of motion makes them as stiff as asked");
  }

  double omega_ = 0, correcting_speed_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  Host* host_ = nullptr;
  bool reported_ = false;
  Bodies bodies_;
  std::unique_ptr<SceneryContacts> scenery_contacts_;
  std::unique_ptr<PairContacts> pair_contacts_;
  Out<std::int64_t> last_run_;
  std::uint8_t many_pairs_ = 0, lists_kinematic_robots_ = 0;
  const Phase for_many_{.index_space = Phase::IndexSpace::robots, .enabled = &many_pairs_};
  const Phase phases_[phase_count] = {{Phase::IndexSpace::robots, Phase::Scope::own_robot},  // with_scenery
                                      {},                                                    // pair_begin
                                      for_many_,                                             // pair_contacts
                                      for_many_,                                             // pair_loads
                                      {.enabled = &many_pairs_},                             // pair_groups
                                      for_many_,                                             // pair_forces
                                      for_many_,                                             // pair_application
                                      for_many_,                                             // pair_reactions
                                      {.enabled = &lists_kinematic_robots_}};                // kinematic_lists
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Penalty>(description)};

}  // namespace

MURO_PLUGIN(.name = "contact_penalty", .version = description.version, .licence = "MIT",
            .summary = "Contact forces by penalty", .algorithms = algorithms)
