// SPDX-License-Identifier: MIT
// Chooses which of its motions moves a robot, also by the speed of the run on this machine.
#include <chrono>

#include "muro/plugin.hpp"
#include "plugins/level/common/level_rules/rules_algorithm.hpp"

namespace {

using namespace muro;

constexpr Description description{
    .id = "level.budget",
    .kind = Kind::level,
    .version = "1.0.0",
    .summary = "Hands a robot over between its motions as level.rules does, and by the speed of the run",
    .parameters = level::parameters,
    .reads = level::reads,
    .writes = level::writes,
    .capabilities = allocation_free,  // neither deterministic nor restorable: it depends on the machine's clock
};

class LevelBudget final : public level::RulesAlgorithm {
 public:
  LevelBudget() : RulesAlgorithm(true) {}

  void connect(Connector& c) override {
    RulesAlgorithm::connect(c);
    c.host().log(LogLevel::warning,
                 "level.budget is not deterministic: it reads the machine's clock, so that no run is repeated exactly");
  }

  void start() override {
    begin_ = {};
    run_speed_.reset();
  }

  void step(const Step& step, Range range) override {
    measure(step.time);
    choose(step, range, run_speed_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Measures the speed of the run, over a quarter of a second of the machine's clock each time.
  void measure(std::int64_t time) {
    const Clock::time_point now = Clock::now();
    const double wall = std::chrono::duration<double>(now - begin_).count();
    if (begin_ != Clock::time_point{} && wall < 0.25) return;
    if (begin_ != Clock::time_point{}) run_speed_ = 1e-9 * double(time - begin_time_) / wall;
    begin_ = now;
    begin_time_ = time;
  }

  Clock::time_point begin_{};        ///< begin of the measurement
  std::int64_t begin_time_ = 0;      ///< ns, simulated time at the begin
  std::optional<double> run_speed_;  ///< in units of real time
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<LevelBudget>(description)};

}  // namespace

MURO_PLUGIN(.name = "level_budget", .version = description.version, .licence = "MIT",
            .summary = "Motions of robots by the speed of the run", .algorithms = algorithms)
