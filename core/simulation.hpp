// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/algorithm_setup.hpp"
#include "core/error.hpp"
#include "core/external/placing.hpp"
#include "core/registry.hpp"
#include "core/schedule/scheduler.hpp"
#include "core/used_library.hpp"
#include "core/world.hpp"
#include "core/world_model.hpp"

namespace muro {

class AlgorithmLog;
class Extensions;
class InputLog;
class Instance;
class Levels;
class OutputRegistry;
class ReportedNumbers;
struct LevelsOfRobot;

/// The complete state of a simulation at one time; it does not change when the simulation goes on.
struct Snapshot {
  PropertyStore::Image properties;
  Scheduler::State schedule;
};

/// A world, algorithms from plugins that are connected to it, and the scheduler that runs them.
///
///     Registry registry(Registry::search_path());
///     Simulation simulation(registry);
///     RobotTree tree = simulation.read_model("rover.urdf");
///     const RobotView& rover = simulation.world().add_robot("rover", tree, start);
///     simulation.use("motion.point", 100, {{&rover, rover.base()}});
///     simulation.build();
///     simulation.run_for(10);
class Simulation {
 public:
  explicit Simulation(Registry& registry, std::uint64_t seed = 1);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  // --- set-up
  World& world() { return world_; }
  const World& world() const { return world_; }
  Registry& registry() { return registry_; }
  /// Sets folders of packages by name, for models that are read from now on: package://NAME/... is searched only there.
  void set_packages(std::map<std::string, std::string> packages);
  /// Reads a model with the reader for its type. Problems of severity error cause a SetupError; the tree keeps the
  /// others.
  RobotTree read_model(const std::string& path);
  /// Reads a file that describes a world, in the same way. Errors in one of its models are kept in the model's tree.
  WorldModel read_world(const std::string& path);
  /// Adds a use of an algorithm; connects nothing yet. Returns its index in `instances()`.
  std::size_t add(AlgorithmSetup setup);
  /// Short form of `add`: `rate` in Hz, 0 for on demand; no items for the whole scene.
  std::size_t use(const std::string& id, double rate, std::vector<Item> items = {},
                  std::map<std::string, ParameterInput> parameters = {});
  /// Adds an object "robot/name" for a sensor on `link` of the robot: it shares pose and twist of the link.
  ObjectId add_sensor_object(const RobotView& robot, std::string_view name, ObjectId link);
  /// Runs algorithms (given by index of `add`) in this order, as one item, at the rate of the first.
  void add_sequence(std::vector<std::size_t> algorithms) { sequences_.push_back(std::move(algorithms)); }
  /// Lets one of several motions at a time move the robot. These are the motions whose items for it have the levels 0,
  /// 1, ...; `names` names them, and `first` is the level at the start. See keys::motion_level_target.
  void set_levels(const RobotView& robot, std::vector<std::string> names, std::uint32_t first);
  /// Receives the log lines of algorithms; default: warnings and errors go to standard error.
  void set_log(std::function<void(LogLevel, std::string_view)> log);
  /// Sets the number of threads for calls that may overlap; 1 unless set. Never changes a result. When the machine
  /// cannot start so many threads, a warning says so, and there are fewer. [between runs]
  void set_threads(unsigned threads);
  /// Makes runs check that algorithms access only what they have declared; see AccessCheck. [between runs]
  void verify_access();
  /// Throws SetupError unless the factor is 0 (as fast as possible) or from 1e-6 to 1e6. [between runs]
  void set_pacing(Pacing pacing);
  /// The output files. Algorithms add theirs when they connect; the program that runs the simulation adds its output
  /// and input files before `build`, which checks them all. [setup]
  OutputRegistry& outputs();
  /// Lets recorders and views be connected and checked, but not started: nothing is written, and the simulation cannot
  /// run. For its inspection. [before build]
  void keep_outputs_closed() { outputs_closed_ = true; }
  /// Opens nothing outside: no stream, no port. A recording may replace them. [before build]
  void keep_inputs_closed() { inputs_closed_ = true; }
  /// Connects everything, checks it and starts it. Throws SetupError with every problem found.
  void build();

  // --- running, all of it after `build`; an earlier call, or a time that is not possible, throws SetupError
  /// Runs for `seconds`: 0 or more, so that the end is at most 4.6e9 s after the start.
  void run_for(double seconds);
  /// Runs up to but not including `time` (ns, 0 to 4.6e18). `stop` is called every few instants; true ends the run.
  void run_until(std::int64_t time, const std::function<bool()>& stop = {});
  /// Lets runs call `sample` at each multiple of `period` (ns) of simulated time, and before and after poses jump. An
  /// empty `sample` ends this. [between runs]
  void set_sampling(std::int64_t period, std::function<void()> sample);
  std::int64_t now() const { return scheduler_.now(); }  ///< ns
  /// Ends the run soon; then it cannot be continued. [on the thread that runs]
  void stop();
  /// Whether stop() was called, or an algorithm has ended the run.
  bool stopped() const;
  /// Informs algorithms that the run is over for now: recorders write their files.
  void finish();

  /// Updates the poses of all bodies to `now`, for readers between runs. Has no influence on the run.
  void refresh();

  // --- state
  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);
  /// Returns to the state right after `build`, with the same bits.
  void reset();
  std::uint64_t state_hash() const { return world_.hash(); }

  // --- from outside
  /// Puts a robot, or an object that moves, at a pose with a velocity; works with every motion. Throws SetupError with
  /// the reason when it cannot be there: it does not move, the pose is out of range, or, unless the placement is
  /// forced, it would overlap something. [between runs]
  void place(const Placement& placement);
  /// Sets the check for overlaps; without it, everything may be put anywhere. [setup]
  void set_overlap_check(OverlapCheck check) { overlap_check_ = std::move(check); }
  /// Informs algorithms that keep parts of the state that it was changed from outside. [between runs]
  void tell_of_change();
  /// Number of jumps of poses: by placing, a reset or a restored snapshot.
  std::uint64_t jumps() const { return jumps_; }
  const InputLog& inputs() const;
  const ReportedNumbers& reported_numbers() const;

  // --- its parts
  const std::vector<std::unique_ptr<Instance>>& instances() const { return instances_; }
  Scheduler& scheduler() { return scheduler_; }
  const Scheduler& scheduler() const { return scheduler_; }
  /// Libraries of the plugins that were requested, then libraries that algorithms have loaded themselves.
  std::vector<UsedLibrary> libraries() const;
  /// Returns the task of an instance.
  TaskId task_of(std::size_t instance) const { return tasks_[instance]; }

 private:
  void require_built(const char* call) const;
  void make_instances();
  void mark_inactive_motions();
  void adopt_rates_of_sequences();
  void partition_memory();
  std::vector<std::size_t> in_order_of(int (*order)(const Description&)) const;
  void schedule();
  void connect_all();
  void connect_or_leave_out(Instance& instance, void (Instance::*how)());
  void check_outputs();
  void start_all();
  void begin_epoch();
  std::vector<RobotId> robot_of_slot() const;

  Registry& registry_;
  std::map<std::string, std::string> packages_;  ///< folders by name
  std::vector<PackageFolder> package_folders_;   ///< views of them
  World world_;
  Scheduler scheduler_;
  std::unique_ptr<Extensions> extensions_;
  std::unique_ptr<AlgorithmLog> log_;
  std::vector<AlgorithmSetup> setups_;
  std::vector<std::size_t> instance_of_setup_;
  std::vector<std::vector<std::size_t>> sequences_;
  std::vector<std::unique_ptr<Instance>> instances_;
  std::vector<LevelsOfRobot> levels_of_robots_;
  std::unique_ptr<Levels> levels_;
  std::vector<TaskId> tasks_;
  Snapshot initial_;
  std::int64_t sampling_period_ = 0;  ///< ns; 0: no sampling
  std::function<void()> sample_;
  OverlapCheck overlap_check_;
  std::uint64_t jumps_ = 0;
  bool built_ = false;
  bool was_ended_ = false;  ///< the last run was ended before its time
  bool outputs_closed_ = false, inputs_closed_ = false;
};

}  // namespace muro
