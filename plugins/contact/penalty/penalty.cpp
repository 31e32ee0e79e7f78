// SPDX-License-Identifier: MIT
// Contact forces by penalty: springs and dampers where bodies overlap. Scene-wide.
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "meetings.hpp"
#include "muro/plugin.hpp"
#include "standings.hpp"

namespace {

using namespace muro;
using namespace muro::penalty;

constexpr Parameter parameters[] = {
    real("frequency", "Hz", 50, "stiffness: that of a body bobbing on a contact; at most 0.095 of the rate")
        .between(1, 1e5),
};
constexpr PropertyUse reads[] = {
    {"contacts", "of every robot that forces move"},
    {"pose", "of every body with a collision shape"},
    {"twist", "of every body with a collision shape"},
    {"inertial", "of every body of robots that forces move"},
};
constexpr PropertyUse writes[] = {
    {"wrench.external", "of every robot that forces move"},
    {"contact.grips", "friction springs, of every robot that forces move"},
    {"contact.time", "of the last run, on the world object"},
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
    host_ = &c.host();
    bodies_.connect(c);
    last_run_ = c.variable(world_object, last_run, std::int64_t{-1});
    standings_ = std::make_unique<Standings>(bodies_);
    meetings_ = std::make_unique<Meetings>(bodies_);
  }
  void start() override { standings_->start(); }
  void restored() override { start(); }

  /// First, block by block, the robots that touch only scenery, which are nearly all. Then those that meet something
  /// that moves: a few at once, many block by block.
  std::span<const Phase> phases() const override { return phases_; }

  void step(const Step& step, Range range) override {
    // As stiff as wanted, as far as the step resolves it.
    const Moment moment{{std::min(omega_, finest_step / step.dt), step.dt},
                        *last_run_ < 0 ? 0 : 1e-9 * double(step.time - *last_run_)};
    if (step.phase == 0) return standings_->push(moment, range);
    if (step.phase > 1) return meet(int(step.phase) - 2, range);
    *last_run_ = step.time;
    if (moment.stiffness.omega < omega_) warn(moment.stiffness);
    constexpr std::size_t few = 12;  // take less time than threads need to share them
    const std::size_t meet = meetings_->begin(moment, standings_->left());
    many_meet_ = meet > few ? 1 : 0;
    for (int pass = 0; pass < Meetings::passes && !many_meet_; ++pass) meetings_->pass(pass);
  }

 private:
  void meet(int pass, Range block) {
    for (std::uint32_t number = block.begin; number < block.end; ++number) {
      const std::int32_t robot = bodies_.robot_of[number];
      if (robot != nobody && standings_->left()[std::size_t(robot)]) meetings_->pass(pass, std::uint32_t(robot));
    }
  }
  void warn(const Stiffness& s) {
    if (std::exchange(told_, true)) return;
    host_->log(LogLevel::info, "contact.penalty: at a step of " + std::to_string(s.h) + " s, contacts have " +
                                   std::to_string(s.omega / (2 * M_PI)) + " Hz instead of " +
                                   std::to_string(omega_ / (2 * M_PI)) +
                                   "; a higher rate of motion makes them as stiff as asked");
  }

  double omega_ = 0;
  Host* host_ = nullptr;
  bool told_ = false;
  Bodies bodies_;
  std::unique_ptr<Standings> standings_;
  std::unique_ptr<Meetings> meetings_;
  Out<std::int64_t> last_run_;
  std::uint8_t many_meet_ = 0;
  const Phase for_many_{.index_space = Phase::IndexSpace::robots, .enabled = &many_meet_};
  static_assert(Meetings::passes == 4);
  const Phase phases_[6] = {
      {Phase::IndexSpace::robots, Phase::Scope::own_robot}, {}, for_many_, for_many_, for_many_, for_many_};
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Penalty>(description)};

}  // namespace

MURO_PLUGIN(.name = "contact_penalty", .version = "1.0.0", .licence = "MIT", .summary = "Contact forces by penalty",
            .algorithms = algorithms)
