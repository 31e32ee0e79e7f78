// SPDX-License-Identifier: MIT
#include "core/schedule/scheduler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <utility>

#include "core/error.hpp"

namespace muro {
namespace {

/// Writes its name and the time of each run into a log.
class Recorder final : public abi::AlgorithmInstance {
 public:
  Recorder(std::string name, std::vector<std::string>& log) : name_(std::move(name)), log_(log) {}
  bool connect(Connector&, abi::ErrorText&) noexcept override { return true; }
  bool connect_by_name(Connector&, abi::ErrorText&) noexcept override { return true; }
  bool start(abi::ErrorText&) noexcept override { return true; }
  Rows<Phase> phases() const noexcept override { return {}; }
  bool step(const Step& step, Range, abi::ErrorText& error) noexcept override {
    log_.push_back(name_ + "@" + std::to_string(step.time / 1'000'000));
    last = step;
    if (fails) error.set("out of fuel");
    if (step.index % 16 == busy_step) work();
    return !fails;
  }
  bool restored(abi::ErrorText&) noexcept override { return true; }
  bool finish(abi::ErrorText&) noexcept override { return true; }
  void destroy() noexcept override {}
  bool on_handover(std::uint32_t, abi::ErrorText&) noexcept override { return true; }
  void* find_extension(const ExtensionId&) noexcept override { return nullptr; }
  Step last;
  bool fails = false;
  std::uint64_t busy_step = 16;  ///< the step of each 16 in which it works; 16: none

  static void work() {
    for (volatile int i = 0; i < 100'000;) i = i + 1;
  }

 private:
  std::string name_;
  std::vector<std::string>& log_;
};

struct Fixture : ::testing::Test {
  std::vector<std::string> log;
  std::deque<Recorder> recorders;
  Scheduler scheduler;

  TaskId add(const std::string& name, double hertz, Kind kind = Kind::kinematics, std::int64_t phase = 0,
             std::vector<std::uint32_t> reads = {}, std::vector<std::uint32_t> writes = {},
             Task::Rank rank = Task::Rank::first) {
    recorders.emplace_back(name, log);
    Task task;
    task.name = name;
    task.instance = &recorders.back();
    task.items = 1;
    task.rate = Rate(hertz);
    task.phase = phase;
    task.kind = kind;
    task.rank = rank;
    task.reads = std::move(reads);
    task.writes = std::move(writes);
    return scheduler.add(std::move(task));
  }
  using Log = std::vector<std::string>;
};
using SchedulerTest = Fixture;

TEST_F(SchedulerTest, RunsEachTaskAtItsOwnRate) {
  add("a", 10);
  add("b", 5);
  scheduler.run_until(400'000'000);
  EXPECT_EQ(log, (Log{"a@0", "b@0", "a@100", "a@200", "b@200", "a@300"}));
  EXPECT_EQ(scheduler.now(), 400'000'000);
}

TEST_F(SchedulerTest, OrdersAnInstantByKindThenByAdding) {
  add("motion", 10, Kind::motion);
  add("sensor 1", 10, Kind::sensor);
  add("sensor 2", 10, Kind::sensor);
  scheduler.run_until(1);
  EXPECT_EQ(log, (Log{"sensor 1@0", "sensor 2@0", "motion@0"}));
}

TEST_F(SchedulerTest, APhaseShiftsEveryRun) {
  add("a", 10, Kind::kinematics, 30'000'000);
  scheduler.run_until(300'000'000);
  EXPECT_EQ(log, (Log{"a@30", "a@130", "a@230"}));
}

TEST_F(SchedulerTest, OnDemandRunsOnceAnInstantJustBeforeItsFirstReader) {
  add("kinematics", 0, Kind::kinematics, 0, {1}, {2});
  add("index", 0, Kind::scene, 0, {2}, {3});
  add("laser", 5, Kind::sensor, 0, {3}, {4});
  add("second laser", 5, Kind::sensor, 0, {3}, {6});
  add("motion", 10, Kind::motion, 0, {5}, {1});
  scheduler.run_until(250'000'000);
  EXPECT_EQ(log, (Log{"kinematics@0", "index@0", "laser@0", "second laser@0", "motion@0", "motion@100",
                      "kinematics@200", "index@200", "laser@200", "second laser@200", "motion@200"}));
  EXPECT_DOUBLE_EQ(recorders[1].last.dt, 0.2) << "the period of the reader that asks";
}

TEST_F(SchedulerTest, ASequenceKeepsItsOrderAndGivesItsRateToAll) {
  const TaskId contact = add("contact", 0, Kind::contact);
  const TaskId motion = add("motion", 10, Kind::motion);
  const TaskId collision = add("collision", 0, Kind::collision);
  add("laser", 10, Kind::sensor);
  scheduler.add_sequence({contact, motion, collision});
  scheduler.run_until(150'000'000);
  EXPECT_EQ(log, (Log{"laser@0", "contact@0", "motion@0", "collision@0", "laser@100", "contact@100", "motion@100",
                      "collision@100"}));
}

TEST_F(SchedulerTest, ASequenceOfDifferentRatesOrOfNoneIsAnError) {
  const TaskId a = add("a", 10), b = add("b", 20), c = add("c", 0), d = add("d", 0);
  EXPECT_THROW(scheduler.add_sequence({a, b}), SetupError);
  EXPECT_THROW(scheduler.add_sequence({c, d}), SetupError);
}

TEST_F(SchedulerTest, ATaskOnDemandHasTheLongestPeriodOfItsReaders) {
  add("contact", 0, Kind::contact, 0, {}, {1});
  add("fast", 1000, Kind::motion, 0, {1});
  add("slow", 100, Kind::motion, 0, {1});
  scheduler.run_until(5'000'000);
  EXPECT_DOUBLE_EQ(recorders[0].last.dt, 0.01);
}

TEST_F(SchedulerTest, WhoOnlyLooksDoesNotLengthenThePeriodOfATaskOnDemand) {
  add("contact", 0, Kind::contact, 0, {}, {1});
  add("motion", 1000, Kind::motion, 0, {1}, {2});
  add("recorder", 100, Kind::recorder, 0, {1});
  scheduler.run_until(5'000'000);
  EXPECT_DOUBLE_EQ(recorders[0].last.dt, 0.001);
}

TEST_F(SchedulerTest, ASensorDoesNotLengthenThePeriodOfATaskOnDemand) {
  add("contact", 0, Kind::contact, 0, {}, {1});
  add("motion", 1000, Kind::motion, 0, {1}, {2});
  add("sensor", 100, Kind::sensor, 0, {1}, {3});
  add("sensor on demand", 0, Kind::sensor, 0, {1}, {4});
  add("controller", 10, Kind::controller, 0, {4}, {5});
  scheduler.run_until(5'000'000);
  EXPECT_DOUBLE_EQ(recorders[0].last.dt, 0.001);
  EXPECT_DOUBLE_EQ(recorders[3].last.dt, 0.1);
}

/// A motion that reads output of a contact algorithm, which reads output of a collision algorithm.
class StepsOfMotion : public SchedulerTest {
 protected:
  void add_contact_and_motion(double rate) {
    add("collision", 0, Kind::collision, 0, {5}, {1});
    add("contact", 0, Kind::contact, 0, {1}, {2});
    add("motion", rate, Kind::motion, 0, {2}, {5});
  }
};

TEST_F(StepsOfMotion, ContactRunsForMotionsAndNotForThoseWhoLook) {
  add_contact_and_motion(10);
  add("sensor", 20, Kind::sensor, 0, {2}, {3});
  add("control", 20, Kind::controller, 0, {1}, {4});
  scheduler.run_until(150'000'000);
  EXPECT_EQ(log, (Log{"collision@0", "contact@0", "sensor@0", "control@0", "motion@0", "sensor@50", "control@50",
                      "sensor@100", "control@100", "collision@100", "contact@100", "motion@100"}))
      << "before those who read it at the start alone";
}

TEST_F(StepsOfMotion, ContactHasThePeriodOfTheSlowestMotion) {
  add_contact_and_motion(1000);
  add("second motion", 500, Kind::motion, 0, {2}, {6});
  add("control", 10, Kind::controller, 0, {1}, {4});
  add("level", 20, Kind::level, 0, {1, 2}, {7});
  scheduler.run_until(5'000'000);
  EXPECT_DOUBLE_EQ(recorders[0].last.dt, 0.002);
  EXPECT_DOUBLE_EQ(recorders[1].last.dt, 0.002);
}

TEST_F(StepsOfMotion, LevelsChangeBeforeContactAndAfterTheirRules) {
  add("collision", 0, Kind::collision, 0, {6}, {1});
  add("contact", 0, Kind::contact, 0, {1, 6}, {2});
  add("motion", 10, Kind::motion, 0, {2, 6}, {5});
  add("sensor", 20, Kind::sensor, 0, {2, 6}, {3});
  add("rules", 10, Kind::level, 0, {5}, {7});
  add("levels", 0, Kind::level, 0, {7}, {6}, Task::Rank::second);
  scheduler.run_until(150'000'000);
  EXPECT_EQ(log, (Log{"sensor@0", "rules@0", "levels@0", "collision@0", "contact@0", "motion@0", "sensor@50",
                      "sensor@100", "rules@100", "levels@100", "collision@100", "contact@100", "motion@100"}))
      << "at the start, too";
}

TEST_F(StepsOfMotion, WithoutMotionsContactRunsForThoseWhoAsk) {
  add("collision", 0, Kind::collision, 0, {5}, {1});
  add("sensor", 20, Kind::sensor, 0, {1}, {3});
  scheduler.run_until(100'000'000);
  EXPECT_EQ(log, (Log{"collision@0", "sensor@0", "collision@50", "sensor@50"}));
}

TEST_F(StepsOfMotion, BeginWithTheFirstStepOfAMotion) {
  add("collision", 0, Kind::collision, 0, {5}, {1});
  add("contact", 0, Kind::contact, 0, {1}, {2});
  add("motion", 10, Kind::motion, 50'000'000, {2}, {5});
  add("sensor", 20, Kind::sensor, 0, {2}, {3});
  scheduler.run_until(100'000'000);
  EXPECT_EQ(log, (Log{"sensor@0", "collision@50", "contact@50", "sensor@50", "motion@50"}));
}

TEST_F(StepsOfMotion, GoOnFromAStateWithoutABeginning) {
  add_contact_and_motion(10);
  add("sensor", 10, Kind::sensor, 0, {2}, {3});
  scheduler.run_until(100'000'000);
  const Scheduler::State state = scheduler.state();
  log.clear();
  scheduler.set_state(state);
  scheduler.run_until(200'000'000);
  EXPECT_EQ(log, (Log{"sensor@100", "collision@100", "contact@100", "motion@100"}));
}

TEST_F(SchedulerTest, AStopEndsAPacedWaitAndLosesNoInstant) {
  add("a", 1);
  scheduler.set_pacing({0.01});  // one instant in 100 s
  int asked = 0;
  scheduler.run_until(10'000'000'000, [&] { return ++asked >= 3; });
  EXPECT_EQ(log, (Log{"a@0"}));
  scheduler.set_pacing({0});
  scheduler.run_until(2'000'000'000);
  EXPECT_EQ(log, (Log{"a@0", "a@1000"}));
}

TEST_F(SchedulerTest, GoesOnWhereItStopped) {
  add("a", 10);
  scheduler.run_until(100'000'000);
  scheduler.run_until(200'000'000);
  EXPECT_EQ(log, (Log{"a@0", "a@100"}));
  EXPECT_EQ(recorders[0].last.index, 1u);
}

TEST_F(SchedulerTest, AStopTakesEffectBetweenInstantsAndLosesNothing) {
  add("a", 10);
  add("b", 10);
  add("slow", 2);
  scheduler.run_until(10'000'000'000);
  const Log whole = std::exchange(log, {});
  scheduler.set_state({0, {0, 0, 0}});
  int stops = 0;
  while (scheduler.now() < 10'000'000'000) {
    const std::size_t before = log.size();
    scheduler.run_until(10'000'000'000, [&] { return true; });
    stops += scheduler.now() < 10'000'000'000;
    EXPECT_LE(log.size() - before, 20u);
    scheduler.set_state(scheduler.state());
  }
  EXPECT_EQ(log, whole);
  EXPECT_GT(stops, 10);
}

TEST_F(SchedulerTest, AFailureNamesAlgorithmAndTime) {
  add("rover.control", 10);
  scheduler.run_until(200'000'000);
  recorders[0].fails = true;
  try {
    scheduler.run_until(300'000'000);
    FAIL();
  } catch (const StepError& e) {
    EXPECT_STREQ(e.what(), "rover.control failed at t = 0.200000 s: out of fuel");
  }
}

TEST_F(SchedulerTest, PacedRunsTakeTheirTimeAndCountOverruns) {
  add("a", 100);
  scheduler.set_pacing({2});
  const auto before = std::chrono::steady_clock::now();
  scheduler.run_until(200'000'000);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  EXPECT_GE(wall, 0.094) << "19 periods of 10 ms at twice real time";
  EXPECT_EQ(log.size(), 20u);
}

TEST_F(SchedulerTest, AccountsForEveryRun) {
  const TaskId a = add("a", 1000), b = add("b", 50);
  scheduler.run_until(1'000'000'000);
  EXPECT_EQ(scheduler.cost(a).runs, 1000u);
  EXPECT_EQ(scheduler.cost(b).runs, 50u);
  EXPECT_GT(double(scheduler.cost(a).ticks) * scheduler.seconds_per_tick(), 0);
}

// Costs of long runs are sampled. Work in every 16th step must be in as many samples as its share of the steps.
TEST_F(SchedulerTest, CostsOfRareWorkDoNotDependOnItsStep) {
  std::vector<TaskId> tasks;
  for (const std::uint64_t step : {0u, 1u, 8u, 13u}) {
    tasks.push_back(add("works in " + std::to_string(step), 1000));
    recorders.back().busy_step = step;
  }
  scheduler.run_until(64'000'000);
  std::vector<double> before;
  for (const TaskId t : tasks) before.push_back(double(scheduler.cost(t).ticks));
  const int times = 28;
  scheduler.run_until((64 + 16 * times) * 1'000'000LL);
  double quickest = 1;  // s; a disturbed run takes longer
  for (int i = 0; i < times; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    Recorder::work();
    quickest = std::min(quickest, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  for (std::size_t i = 0; i < tasks.size(); ++i)
    EXPECT_GT((double(scheduler.cost(tasks[i]).ticks) - before[i]) * scheduler.seconds_per_tick(),
              0.5 * times * quickest)
        << "task " << i;
}

}  // namespace
}  // namespace muro
