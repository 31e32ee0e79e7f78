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

/// The whole state of a simulation at one time, independent of the simulation's later life.
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
  /// Folders of packages by name, for models that are read from now on: package://NAME/... is looked for there alone.
  void set_packages(std::map<std::string, std::string> packages);
  /// Reads a model with the reader for its type. Problems of severity error make a SetupError; the
  /// others are kept in the tree.
  RobotTree read_model(const std::string& path);
  /// The same for a file that describes a world. Errors in one of its models are left in the model's tree.
  WorldModel read_world(const std::string& path);
  /// Uses an algorithm; connects nothing yet. Returns its number in `instances()`.
  std::size_t add(AlgorithmSetup setup);
  /// Short form of `add`: `rate` in Hz, 0 for on demand; no items for the whole scene.
  std::size_t use(const std::string& id, double rate, std::vector<Item> items = {},
                  std::map<std::string, ParameterInput> parameters = {});
  /// An object "robot/name" for a sensor that rides on `link` of the robot: it shares the link's pose and twist.
  ObjectId add_sensor_object(const RobotView& robot, std::string_view name, ObjectId link);
  /// Algorithms (by number of `add`) that run in this order, as one item, at the rate of the first.
  void add_sequence(std::vector<std::size_t> algorithms) { sequences_.push_back(std::move(algorithms)); }
  /// The robot is moved by one of several motions at a time: those used for it whose items have the levels 0, 1, ...,
  /// named here; `first` is the level at the start. See keys::motion_level_target.
  void set_levels(const RobotView& robot, std::vector<std::string> names, std::uint32_t first);
  /// Where log lines of algorithms go; default: warnings and errors to standard error.
  void set_log(std::function<void(LogLevel, std::string_view)> log);
  /// On how many threads calls are made that may overlap; 1, unless set. Never changes a result. When the machine
  /// starts no more threads, a warning says so, and there are fewer. [between runs]
  void set_threads(unsigned threads);
  /// Makes runs prove that algorithms touch only what they have declared; see AccessCheck. [between runs]
  void verify_access();
  /// Throws SetupError unless the factor is 0 (as fast as it goes) or from 1e-6 to 1e6. [between runs]
  void set_pacing(Pacing pacing);
  /// What is written: algorithms add their files when they connect; who runs the simulation adds its own, and what it
  /// reads, before `build`, which checks them all. [setup]
  OutputRegistry& outputs();
  /// Recorders and views are to be connected and checked, but not started: nothing is written, and the simulation
  /// cannot run. For a look at it. [before build]
  void keep_outputs_closed() { outputs_closed_ = true; }
  /// Nothing outside is opened: no stream, no port. A recording may stand in for it. [before build]
  void keep_inputs_closed() { inputs_closed_ = true; }
  /// Connects everything, checks it, starts it. Throws SetupError with every problem found.
  void build();

  // --- running, all of it after `build`; before, and for times that cannot be, there is a SetupError
  /// `seconds`: 0 or more, so that the end is at most 4.6e9 s after the start.
  void run_for(double seconds);
  /// Up to but not including `time` (ns, from 0 to 4.6e18). `stop` is asked every few instants; true ends the run.
  void run_until(std::int64_t time, const std::function<bool()>& stop = {});
  /// Runs call `sample` at each multiple of `period` (ns) of simulated time, and before and after poses jump. None: no
  /// more. [between runs]
  void set_sampling(std::int64_t period, std::function<void()> sample);
  std::int64_t now() const { return scheduler_.now(); }  ///< ns
  /// Ends the run soon; nothing runs any more then. [on the thread that runs]
  void stop();
  /// Whether somebody, such as an algorithm, has called for that.
  bool stopped() const;
  /// Tells algorithms that the run is over for now: recorders write their files.
  void finish();

  /// Brings the poses of all bodies up to `now`, for whoever reads them between runs. Without influence on the run.
  void refresh();

  // --- state
  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);
  /// As right after `build`, to the bit.
  void reset();
  std::uint64_t state_hash() const { return world_.hash(); }

  // --- from outside
  /// Puts a robot, or an object that moves, at a pose with a velocity, for whatever motion. Throws SetupError that says
  /// why it cannot be there: it does not move, the pose is out of range, or, unless it is forced, it would overlap
  /// something. [between runs]
  void place(const Placement& placement);
  /// How overlaps are found; without it, everything may be put anywhere. [setup]
  void set_overlap_check(OverlapCheck check) { overlap_check_ = std::move(check); }
  /// State has been written from outside: tells those that keep something of it. [between runs]
  void tell_of_change();
  /// How often poses have jumped: by placing, a reset or a restored snapshot.
  std::uint64_t jumps() const { return jumps_; }
  const InputLog& inputs() const;
  const ReportedNumbers& reported_numbers() const;

  // --- what it consists of
  const std::vector<std::unique_ptr<Instance>>& instances() const { return instances_; }
  Scheduler& scheduler() { return scheduler_; }
  const Scheduler& scheduler() const { return scheduler_; }
  /// Those of the plugins that were asked for, then those that algorithms have loaded themselves.
  std::vector<UsedLibrary> libraries() const;
  /// The task of an instance.
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
  std::int64_t sampling_period_ = 0;  ///< ns; 0: nobody samples
  std::function<void()> sample_;
  OverlapCheck overlap_check_;
  std::uint64_t jumps_ = 0;
  bool built_ = false;
  bool was_ended_ = false;  ///< the last run, before its time
  bool outputs_closed_ = false, inputs_closed_ = false;
};

}  // namespace muro
