// SPDX-License-Identifier: MIT
#include "core/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/access_check.hpp"
#include "core/algorithm_log.hpp"
#include "core/c_locale.hpp"
#include "core/collected_problems.hpp"
#include "core/extensions.hpp"
#include "core/instance.hpp"
#include "core/levels.hpp"
#include "core/output_registry.hpp"
#include "core/read_model.hpp"
#include "core/simulated_time.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

Simulation::Simulation(Registry& registry, std::uint64_t seed)
    : registry_(registry),
      extensions_(std::make_unique<Extensions>(world_, scheduler_)),
      log_(std::make_unique<AlgorithmLog>(*extensions_)),
      levels_(std::make_unique<Levels>()) {
  scheduler_.set_seed(seed);
  extensions_->lockstep().say = [this](const std::string& note) { log_->log(LogLevel::info, note); };
}

Simulation::~Simulation() = default;

void Simulation::set_log(std::function<void(LogLevel, std::string_view)> log) { log_->sink = std::move(log); }

void Simulation::set_packages(std::map<std::string, std::string> packages) {
  packages_ = std::move(packages);
  package_folders_.clear();
  for (const auto& [name, folder] : packages_) package_folders_.push_back({name, folder});
}

RobotTree Simulation::read_model(const std::string& path) {
  outputs().add_input(path, "a model");
  return muro::read_model(registry_, path, package_folders_);
}

WorldModel Simulation::read_world(const std::string& path) {
  outputs().add_input(path, "the world file");
  return muro::read_world(registry_, path, package_folders_);
}

std::size_t Simulation::add(AlgorithmSetup setup) {
  if (setup.name.empty()) setup.name = setup.use + " #" + std::to_string(setups_.size());
  check_time(setup.phase, fmt::format("{}: the phase", setup.name));
  setups_.push_back(std::move(setup));
  return setups_.size() - 1;
}

std::size_t Simulation::use(const std::string& id, double rate, std::vector<Item> items,
                            std::map<std::string, ParameterInput> parameters) {
  AlgorithmSetup s;
  s.use = id;
  s.subsystem = id;
  s.rate = Rate(rate);
  s.items = std::move(items);
  s.parameters = std::move(parameters);
  return add(std::move(s));
}

ObjectId Simulation::add_sensor_object(const RobotView& robot, std::string_view name, ObjectId link) {
  const ObjectId sensor = world_.add_object(std::string(robot.name) + "/" + std::string(name), robot.id);
  world_.share(sensor, keys::pose, link, keys::pose);
  world_.share(sensor, keys::twist, link, keys::twist);
  world_.set(sensor, keys::sensor_link, link);
  return sensor;
}

void Simulation::set_levels(const RobotView& robot, std::vector<std::string> names, std::uint32_t first) {
  if (first >= names.size())
    throw SetupError(
        fmt::format("`{}` has {} motions, so it cannot start with number {}", robot.name, names.size(), first));
  levels_of_robots_.push_back({&robot, std::move(names), first});
}

std::vector<std::size_t> Simulation::in_order_of(int (*order)(const Description&)) const {
  std::vector<std::size_t> all(instances_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  std::stable_sort(all.begin(), all.end(), [&](std::size_t a, std::size_t b) {
    return order(instances_[a]->description()) < order(instances_[b]->description());
  });
  return all;
}

OutputRegistry& Simulation::outputs() { return extensions_->outputs(); }

void Simulation::verify_access() {
  std::vector<Instance*> instances;
  for (const auto& i : instances_) instances.push_back(i.get());
  scheduler_.executor().set_observer(std::make_unique<AccessCheck>(world_.store(), instances, robot_of_slot()));
}

void Simulation::require_built(const char* call) const {
  if (!built_) throw SetupError(fmt::format("{} is called before build(), which connects what is to run", call));
}

void Simulation::set_threads(unsigned threads) {
  const std::string reason = scheduler_.set_threads(threads);
  if (!reason.empty())
    log_->log(LogLevel::warning,
              fmt::format("only {} of {} threads can be started ({}); the run goes on with these, and "
                          "its results are the same",
                          scheduler_.executor().threads(), threads, reason));
}

void Simulation::set_pacing(Pacing pacing) {
  if (pacing.factor != 0 && !(pacing.factor >= 1e-6 && pacing.factor <= 1e6))
    throw SetupError(
        fmt::format("a run at {} times real time is not possible; allowed are 1e-6 to 1e6, or 0 for as fast as it goes",
                    pacing.factor));
  scheduler_.set_pacing(pacing);
  extensions_->requests().start_with_speed(pacing.factor);
}

void Simulation::run_for(double seconds) { run_until(now() + nanoseconds_of(seconds, "the duration of a run")); }

void Simulation::run_until(std::int64_t time, const std::function<bool()>& stop) {
  require_built("run_until()");
  const CLocale locale;
  check_time(time, "the end of a run");
  if (outputs_closed_) throw SetupError("a simulation that keeps its outputs closed cannot run");
  Inspector& inspector = extensions_->inspector();
  RunRequests& requests = extensions_->requests();
  if (inspector.stopped()) return;
  inspector.set_stop(stop);
  const auto is_stopping = [&] { return inspector.is_stopping(); };
  const auto sample = [&](bool is_due) {
    if (is_due && sample_) sample_();
  };
  while (!is_stopping()) {
    const std::int64_t next_sample =
        sample_ ? now() - now() % sampling_period_ + sampling_period_ : std::numeric_limits<std::int64_t>::max();
    scheduler_.run_until(std::min({time, requests.next_time(now()), next_sample}),
                         [&] { return is_stopping() || requests.is_waiting(); });
    sample(now() >= next_sample || requests.is_due(now()));
    const std::uint64_t jumps_before = jumps_;
    if (!is_stopping()) requests.carry_out(*this, is_stopping);
    sample(jumps_ != jumps_before);
    if (now() >= time) break;
  }
  was_ended_ = is_stopping();
  inspector.set_stop({});
}

void Simulation::set_sampling(std::int64_t period, std::function<void()> sample) {
  sampling_period_ = period;
  sample_ = std::move(sample);
}

void Simulation::stop() { extensions_->inspector().stop(); }

bool Simulation::stopped() const { return extensions_->inspector().stopped(); }

std::vector<UsedLibrary> Simulation::libraries() const {
  std::vector<UsedLibrary> all = registry_.loaded();
  all.insert(all.end(), extensions_->libraries().begin(), extensions_->libraries().end());
  return all;
}

void Simulation::refresh() {
  require_built("refresh()");
  const CLocale locale;
  std::vector<TaskId> kinematics;
  for (std::size_t i = 0; i < instances_.size(); ++i)
    if (instances_[i]->description().kind == Kind::kinematics) kinematics.push_back(tasks_[i]);
  scheduler_.run_extra(kinematics);
}

void Simulation::finish() {
  require_built("finish()");
  const CLocale locale;
  if (was_ended_) extensions_->requests().record_stop();
  CollectedProblems problems;  // one that fails does not keep others from writing their files
  for (const std::size_t i : in_order_of(order_of)) problems.run([&] { instances_[i]->finish(); });
  problems.check();
}

Snapshot Simulation::snapshot() const {
  require_built("snapshot()");
  return {world_.store().save(), scheduler_.state()};
}

void Simulation::restore(const Snapshot& snapshot) {
  require_built("restore()");
  const CLocale locale;
  world_.store().load(snapshot.properties);
  scheduler_.set_state(snapshot.schedule);
  begin_epoch();
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->restored();
}

void Simulation::reset() {
  require_built("reset()");
  const CLocale locale;
  world_.store().load(initial_.properties);
  scheduler_.set_state(initial_.schedule);
  begin_epoch();
  for (const std::size_t i : in_order_of(order_of)) instances_[i]->start();
}

void Simulation::begin_epoch() {
  ++jumps_;
  extensions_->inputs().begin_epoch();
}

void Simulation::place(const Placement& placement) {
  require_built("place()");
  if (const std::string problem = problem_of(world_, placement); !problem.empty()) throw SetupError(problem);
  if (const std::string other = overlap_check_ && !placement.is_forced ? overlap_check_(placement) : ""; !other.empty())
    throw SetupError(fmt::format("{} would overlap {} there; put it elsewhere, or force it",
                                 in_backquotes(world_.object_name(placement.object)), other));
  write_placement(world_, placement);
  ++jumps_;
  tell_of_change();
}

/// Algorithms that simulate bodies keep neighbours, transforms and the like.
void Simulation::tell_of_change() {
  const CLocale locale;
  for (const std::size_t i : in_order_of(order_of)) {
    const Kind kind = instances_[i]->description().kind;
    constexpr Kind told[] = {Kind::kinematics, Kind::scene, Kind::collision, Kind::contact, Kind::motion};
    if (std::find(std::begin(told), std::end(told), kind) != std::end(told)) instances_[i]->restored();
  }
}

const InputLog& Simulation::inputs() const { return extensions_->inputs(); }
const ReportedNumbers& Simulation::reported_numbers() const { return extensions_->reported_numbers(); }

}  // namespace muro
