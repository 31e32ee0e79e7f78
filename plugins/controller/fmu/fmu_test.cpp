// SPDX-License-Identifier: MIT
// controller.fmu in real simulations: time, values, state.
#include <cmath>
#include <cstring>
#include <limits>

#include "fmu_testing.hpp"

namespace muro::fmu {
namespace {

constexpr Key<double> decay{"test.decay", "1", "what `decay` says"};
constexpr Key<double> euler{"test.euler", "1", "what `euler` says"};
constexpr Key<double> step_end{"test.step_end", "s", "what `step_end` says"};
constexpr Key<std::int32_t> count{"test.count", "1", "what `count` says"};
constexpr Key<double> choice_out{"test.choice_out", "1", "what `choice_out` says"};
constexpr Key<std::uint8_t> has_resource{"test.has_resource", "1", "what `has_resource` says"};

const Texts clocks{"decay=test.decay", "euler=test.euler", "step_end=test.step_end", "count=test.count"};

struct Way {
  int version;
  bool is_isolated;

  friend void PrintTo(const Way& way, std::ostream* out) {
    *out << "FMI " << way.version << (way.is_isolated ? " in a process of its own" : "");
  }
};

class Fmu : public ::testing::TestWithParam<Way> {
 protected:
  struct Bench : fmu::Bench {
    explicit Bench(int robots = 1) : fmu::Bench(robots) { is_isolated = GetParam().is_isolated; }
  };
  int version() const { return GetParam().version; }
  const std::string& able() const { return version() == 2 ? able_2 : able_3; }
  std::string fmu(const std::string& flags) const {
    const std::string path = scratch_.path("x.fmu");
    write_fmu(path, version(), flags);
    return path;
  }
  test::ScratchFolder scratch_;
};

TEST_P(Fmu, IsAtTheTimeOfTheSimulationWithItsClosedForms) {
  Bench bench;
  const double& d = bench.sink(decay);
  const double& e = bench.sink(euler);
  const double& t = bench.sink(step_end);
  const std::int32_t& n = bench.sink(count);
  bench.control(fmu(able()), version(), clocks, {"k=0.7"});
  bench.build();
  bench.run_for(0.05);
  EXPECT_EQ(d, 1) << "at the start";
  EXPECT_EQ(n, 0);
  bench.run_for(2);
  EXPECT_EQ(n, 20);
  EXPECT_EQ(t, 2);
  EXPECT_NEAR(d, std::exp(-0.7 * 2), 1e-14);
  EXPECT_NEAR(e, std::pow(1 - 0.7 / 100, 200), 1e-14);
}

TEST_P(Fmu, NeverDriftsWherePeriodsAreNoWholeNanoseconds) {
  Bench bench;
  const double& d = bench.sink(decay);
  const double& t = bench.sink(step_end);
  bench.sink(euler), bench.sink(count);
  bench.control(fmu(""), version(), clocks, {"k=0.001"}, 30);
  bench.build();
  bench.run_for(100.01);  // the FMU fails when its own time differs from the time of the call
  EXPECT_DOUBLE_EQ(t, 100);
  EXPECT_NEAR(d, std::exp(-0.1), 1e-12);
}

TEST_P(Fmu, DrivesARobotAsASampledControllerDoes) {
  Bench bench;
  bench.control(fmu(able()), version(),
                Settings{{"inputs", Texts{"u=body:pose[x]"}}, {"outputs", Texts{"speed=command.twist[vx]"}}},
                {"gain=2", "goal=3"});
  bench.build();
  bench.run_for(1);
  EXPECT_NEAR(bench.pose(*bench.a).position.x(), 3 * (1 - std::pow(1 - 0.1 * 2, 10)), 1e-9);
  bench.run_for(9);
  EXPECT_NEAR(bench.pose(*bench.a).position.x(), 3, 1e-8);
}

TEST_P(Fmu, ControlsEachRobotByAnInstanceOfItsOwn) {
  Bench bench(2);
  bench.control(fmu(able()), version(),
                Settings{{"inputs", Texts{"u=pose[0]"}}, {"outputs", Texts{"speed=body:command.twist[0]"}}});
  bench.build();
  bench.run_for(1);
  const double rest = std::pow(1 - 0.1 * 2, 10);
  EXPECT_NEAR(bench.pose(*bench.a).position.x(), 1 - rest, 1e-9);
  EXPECT_NEAR(bench.pose(*bench.b).position.x(), 1 + 3 * rest, 1e-9);
}

TEST_P(Fmu, OfTheWorldSeesAndControlsAnyRobot) {
  Bench bench(2);
  bench.is_of_world = true;
  bench.control(fmu(able()), version(),
                Settings{{"inputs", Texts{"u=b/body:pose[x]"}}, {"outputs", Texts{"speed=a/body:command.twist[vx]"}}},
                {"goal=4.5"});
  bench.build();
  bench.run_for(1);
  EXPECT_NEAR(bench.pose(*bench.a).position.x(), 2 * (4.5 - 4), 1e-9) << "b stands still at 4 m";
}

/// A fixed target with a velocity: the drive comes to rest beyond it, at the velocity times damping / stiffness.
TEST_P(Fmu, CommandsPositionAndVelocityOfAJoint) {
  Bench bench;
  bench.is_of_world = true;
  const RobotView& arm = bench.add("arm", test::tree_of([](RobotBuilder& t) {
                                     t.base("foot");
                                     t.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
                                     t.revolute("joint", Vec3::UnitZ(), {});
                                     t.body("forearm");
                                     t.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
                                   }));
  bench.use("motion.simplified", 1000, {{&arm, arm.base()}},
            {{"base", "fixed"}, {"joints", "position"}, {"natural_frequency", 50.0}});
  bench.control(fmu(able()), version(),
                Texts{"decay=arm/joint:joint.position.target", "turn=arm/joint:joint.velocity.target"},
                {"k=0", "angle=-10"});
  bench.build();
  bench.run_for(2);
  EXPECT_NEAR(bench.world().value("arm/joint", keys::joint_position), 1 + 2.0 / 50 * 10 * M_PI / 180, 1e-6);
}

TEST_P(Fmu, GivesTheSameBitsOnAnyNumberOfThreads) {
  const std::string path = fmu(able());
  const auto hash = [&](unsigned threads) {
    Bench bench(6);
    bench.control(path, version(),
                  Settings{{"inputs", Texts{"u=pose[0]"}}, {"outputs", Texts{"speed=body:command.twist[0]"}}});
    bench.build();
    bench.set_threads(threads);
    bench.run_for(2);
    return bench.state_hash();
  };
  EXPECT_EQ(hash(4), hash(1));
}

TEST_P(Fmu, ConvertsUnits) {
  static constexpr Key<double> angle{"test.angle", "rad", ""}, turn{"test.turn", "rad/s", ""};
  Bench bench;
  double& in = bench.source(angle, 0.5);
  const double& out = bench.sink(turn);
  bench.control(fmu(able()), version(),
                Settings{{"inputs", Texts{"angle=test.angle"}}, {"outputs", Texts{"turn=test.turn"}}});
  bench.build();
  bench.run_for(0.3);
  EXPECT_DOUBLE_EQ(out, -0.5);
  in = -1;
  bench.run_for(0.3);
  EXPECT_DOUBLE_EQ(out, 1);
}

TEST_P(Fmu, PassesWholeNumbersBooleansAndEnumerations) {
  static constexpr Key<std::int32_t> whole{"test.int", "1", ""}, whole_out{"test.int_out", "1", ""};
  static constexpr Key<std::uint8_t> flag{"test.flag", "1", ""}, flag_out{"test.flag_out", "1", ""};
  static constexpr Key<double> choice{"test.choice", "1", ""};
  Bench bench;
  bench.source(whole, std::numeric_limits<std::int32_t>::min());
  std::uint8_t& in = bench.source(flag, std::uint8_t(7));
  bench.source(choice, 2.0);
  const auto& whole_is = bench.sink(whole_out);
  const auto& flag_is = bench.sink(flag_out);
  const auto& choice_is = bench.sink(choice_out);
  bench.control(
      fmu(able()), version(),
      Settings{{"inputs", Texts{"int_in=test.int", "bool_in=test.flag", "choice_in=test.choice"}},
               {"outputs", Texts{"int_out=test.int_out", "bool_out=test.flag_out", "choice_out=test.choice_out"}}});
  bench.build();
  bench.run_for(0.3);
  EXPECT_EQ(whole_is, std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(flag_is, 0) << "it says the opposite";
  EXPECT_EQ(choice_is, 2);
  in = 0;
  bench.run_for(0.2);
  EXPECT_EQ(flag_is, 1);
}

TEST_P(Fmu, TakesStartValuesOfAllTypesExactly) {
  static constexpr Key<std::uint64_t> u64_out{"test.u64_out", "1", ""};
  static constexpr Key<std::int64_t> i64_out{"test.i64_out", "1", ""};
  const std::string path = fmu(able());
  Bench bench;
  const double& choice_is = bench.sink(choice_out);
  const std::uint64_t& u64_is = bench.sink(u64_out);
  const std::int64_t& i64_is = bench.sink(i64_out);
  Texts outputs{"choice_out=test.choice_out"};
  if (version() == 3) outputs.insert(outputs.end(), {"u64_out=test.u64_out", "i64_out=test.i64_out"});
  Texts values{"choice_in=b"};
  if (version() == 3) values.insert(values.end(), {"u64_in=18446744073709551615", "i64_in=-9007199254740993"});
  bench.control(path, version(), outputs, values);
  bench.build();
  bench.run_for(0.1);
  EXPECT_EQ(choice_is, 2) << "an item by its name";
  if (version() == 3) {
    EXPECT_EQ(u64_is, std::numeric_limits<std::uint64_t>::max());
    EXPECT_EQ(i64_is, -9007199254740993) << "-(2^53 + 1)";
  }
  Bench wrong;
  wrong.control(path, version(), Texts{}, {"choice_in=c"});
  EXPECT_SAYS(refusal(wrong),
              "value `c` of `choice_in` is no number; write it like 0.05 or 5e-2; items of its type "
              "are `a`, `b`");
}

TEST_P(Fmu, TakesANumberForItselfWhereItemsAreCalledByDigits) {
  const std::string path = scratch_.path("digits.fmu");
  std::string text = description(version(), able());
  const std::string items = R"(<Item name="a" value="1"/><Item name="b" value="2"/>)";
  ASSERT_NE(text.find(items), text.npos);
  text.replace(text.find(items), items.size(),
               R"(<Item name="2" value="1"/><Item name="1" value="2"/><Item name="1 2" value="3"/>)"
               R"(<Item name="0.5" value="4"/><Item name="7" value="5"/>)");
  write_archive(path, {{"modelDescription.xml", text},
                       {"binaries/" + platform_of[version()] + "/model.so",
                        test::text_of(parts + "model" + std::to_string(version()) + ".so")}});
  for (const auto& [said, number] :
       {std::pair<std::string, double>{"1", 1}, {"2", 2}, {"2.0", 2}, {" 2", 2}, {"7", 7}, {"1 2", 3}, {"0.5", 4}}) {
    Bench bench;
    const double& choice_is = bench.sink(choice_out);
    bench.control(path, version(), Texts{"choice_out=test.choice_out"}, {"choice_in=" + said});
    bench.build();
    bench.run_for(0.1);
    EXPECT_EQ(choice_is, number) << said;
  }
}

TEST_P(Fmu, FindsItsResources) {
  Bench bench;
  const std::uint8_t& found = bench.sink(has_resource);
  bench.control(parts + "with_resource_" + std::to_string(version()) + ".fmu", version(),
                Texts{"has_resource=test.has_resource"});
  bench.build();
  bench.run_for(0.3);
  EXPECT_EQ(found, 1);
}

TEST_P(Fmu, BeginsAnewAfterAResetToTheBit) {
  for (const std::string& flags : {able(), std::string()}) {
    Bench bench;
    bench.sink(decay), bench.sink(euler), bench.sink(step_end), bench.sink(count);
    Texts outputs = clocks;
    outputs.emplace_back("speed=command.twist[vx]");
    bench.control(fmu(flags), version(), Settings{{"inputs", Texts{"u=pose[x]"}}, {"outputs", outputs}}, {"k=0.3"});
    bench.build();
    bench.run_for(1.2);
    const std::uint64_t end = bench.state_hash();
    bench.reset();
    bench.run_for(0.5);
    EXPECT_NE(bench.state_hash(), end);
    bench.run_for(0.7);
    EXPECT_EQ(bench.state_hash(), end);
  }
}

TEST_P(Fmu, GoesOnFromASnapshotToTheSameBits) {
  Bench bench;
  const double& d = bench.sink(decay);
  bench.sink(euler), bench.sink(step_end), bench.sink(count);
  Texts outputs = clocks;
  outputs.emplace_back("speed=command.twist[vx]");
  bench.control(fmu(able()), version(), Settings{{"inputs", Texts{"u=pose[x]"}}, {"outputs", outputs}});
  bench.build();
  const Snapshot start = bench.snapshot();
  bench.run_for(0.75);
  const Snapshot middle = bench.snapshot();
  bench.run_for(0.8);
  const std::uint64_t end = bench.state_hash();
  bench.restore(middle);
  EXPECT_NEAR(d, std::exp(-0.7), 1e-14);
  bench.run_for(0.8);
  EXPECT_EQ(bench.state_hash(), end);
  bench.restore(start);
  bench.run_for(1.55);
  EXPECT_EQ(bench.state_hash(), end);
  EXPECT_EQ(bench.said, "");
}

TEST_P(Fmu, ThatCannotBeSerializedRefusesSnapshotsAndSaysSoBefore) {
  const std::string flag = version() == 2 ? "canSerializeFMUstate" : "canSerializeFMUState";
  Bench bench;
  bench.control(fmu(version() == 2 ? R"(canGetAndSetFMUstate="true")" : R"(canGetAndSetFMUState="true")"), version(),
                Texts{"speed=command.twist[vx]"});
  bench.build();
  EXPECT_SAYS(bench.said, "x.fmu lacks the flag " + flag + ": the run can be reset, but not restored to a snapshot");
  const Snapshot start = bench.snapshot();
  bench.run_for(0.5);
  const Snapshot middle = bench.snapshot();
  bench.run_for(0.5);
  EXPECT_SAYS(test::complaint_of([&] { bench.restore(middle); }),
              "robot `a`: x.fmu: it lacks the flag " + flag + ", so its state at that time is lost");
  bench.restore(start);
  bench.run_for(0.5);
}

TEST_P(Fmu, WithoutSnapshotsHasItsStateForItself) {
  const auto hash_after = [&](bool snapshots) {
    Bench bench;
    bench.control(fmu(able()), version(),
                  Settings{{"outputs", Texts{"speed=command.twist[vx]"}}, {"snapshots", snapshots}});
    bench.build();
    bench.run_for(0.5);
    const Snapshot middle = bench.snapshot();
    EXPECT_SAYS(test::complaint_of([&] { bench.restore(middle); }),
                snapshots ? "no complaint"
                          : "robot `a`: x.fmu: it is not saved (`snapshots` is false), so its state at that time is");
    EXPECT_SAYS(bench.said + "saved",
                snapshots ? "saved" : "x.fmu is not saved (`snapshots` is false): the run can be reset, but not");
    bench.reset();
    bench.run_for(0.5);
    return bench.state_hash();
  };
  EXPECT_NE(hash_after(true), hash_after(false)) << "the state of the FMU counts, or not";
  EXPECT_EQ(hash_after(false), hash_after(false));
}

TEST_P(Fmu, RunsAtMultiplesOfItsFixedInternalStepSizeOnly) {
  if (version() == 2) return;  // the flag is new in FMI 3
  for (const auto& [rate, is_legal] :
       {std::pair{10.0, true}, {20.0, true}, {25.0, false}, {40.0, false}, {4.0, true}}) {
    Bench bench;
    bench.control(fmu(R"(fixedInternalStepSize="0.05")"), 3, Texts{"speed=command.twist[vx]"}, {}, rate);
    if (is_legal) {
      bench.build();
      EXPECT_NO_THROW(bench.run_for(1)) << rate;
      continue;
    }
    EXPECT_SAYS(
        test::complaint_of([&] { bench.build(); }),
        "robot `a`: x.fmu: its fixedInternalStepSize is 0.05 s, and the period must be a multiple of it; it is " +
            std::string(rate == 25 ? "0.04" : "0.025") +
            " s. Set `rate` to 1 / (n * 0.05 s) with a whole n, such as 20, 10, 4, 2 Hz");
  }
}

INSTANTIATE_TEST_SUITE_P(OfFmi, Fmu, ::testing::Values(Way{2, false}, Way{3, false}, Way{2, true}, Way{3, true}),
                         [](const auto& test) {
                           return std::to_string(test.param.version) +
                                  (test.param.is_isolated ? "InAProcessOfItsOwn" : "");
                         });

/// Passes `value` from a property to a variable of the FMU and on to another property, which must be `expected`; not a
/// number: it does not fit.
template <class T>
void converts(const std::string& type, T value, T expected) {
  static constexpr Key<T> in{"test.in", "1", ""}, out{"test.out", "1", ""};
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), 3, able_3);
  Bench bench;
  bench.source(in, value);
  const T& result = bench.sink(out);
  bench.control(scratch.path("x.fmu"), 3,
                Settings{{"inputs", Texts{type + "_in=test.in"}}, {"outputs", Texts{type + "_out=test.out"}}});
  bench.build();
  if (std::isnan(double(expected))) {
    EXPECT_SAYS(failure(bench, 0.2), "variable `" + type + "_in` does not take ");
  } else {
    bench.run_for(0.2);
    EXPECT_EQ(result, expected) << type;
  }
}

template <class T>
void passes(const std::string& type, T value) {
  converts(type, value, value);
}

TEST(FmuOfFmi3, PassesEveryTypeOfNumber) {
  passes<float>("f32", 0.1f);
  passes<std::int64_t>("i64", std::numeric_limits<std::int64_t>::min());
  passes<std::int64_t>("i64", std::numeric_limits<std::int64_t>::max());
  passes<std::uint64_t>("u64", std::numeric_limits<std::uint64_t>::max());
  passes<std::int32_t>("i32", std::numeric_limits<std::int32_t>::min());
  passes<std::uint32_t>("u32", std::numeric_limits<std::uint32_t>::max());
  passes<std::int32_t>("i16", -32768);
  passes<std::int32_t>("u16", 65535);
  passes<std::int32_t>("i8", -128);
  passes<std::uint8_t>("u8", 255);
}

TEST(FmuOfFmi3, RoundsNumbersAndRefusesThoseThatDoNotFit) {
  const double nothing = std::nan("");
  converts<double>("u8", 254.6, 255);
  converts<double>("u8", -0.4, 0);
  converts<double>("u8", 255.6, nothing);
  converts<double>("i8", -129, nothing);
  converts<double>("i64", 9223372036854775808.0, nothing);
  converts<double>("u64", 18446744073709549568.0, 18446744073709549568.0);
  converts<double>("i32", std::numeric_limits<double>::infinity(), nothing);
  converts<double>("f32", 0.5, 0.5);
  converts<double>("f32", 1e39, nothing);
  converts<float>("u16", 65535.0f, 65535.0f);
}

TEST(FmuOfFmi3, TakesArraysFromSeveralProperties) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), 3, able_3);
  static constexpr Key<Vec3> in{"test.in", "1", ""};
  static constexpr Key<double> one{"test.one", "1", ""};
  static constexpr Key<Twist> out{"test.out", "1", ""};
  Bench bench;
  bench.source(in, Vec3(1, 2, 3));
  bench.source(one, 9.0);
  const Twist& result = bench.sink(out);
  bench.control(
      scratch.path("x.fmu"), 3,
      Settings{{"inputs", Texts{"vector_in=test.in[1..2],test.one"}}, {"outputs", Texts{"vector_out=test.out[3..5]"}}});
  bench.build();
  bench.run_for(0.2);
  EXPECT_EQ(result.linear, Vec3(0, 0, 0));
  EXPECT_EQ(result.angular, Vec3(-2, -3, -9));
}

TEST(FmuOfFmi3, TakesBytesAsBinaryData) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), 3, able_3);
  static constexpr Key<std::uint8_t> in{"test.in", "1", ""}, out{"test.out", "1", ""};
  Bench bench;
  PropertyStore& store = bench.world().store();
  const auto array = [&](const KeyInfo& key, Usage usage) {
    return static_cast<ArrayHeader*>(
        store.bind(store.add_accessor("the test"), bench.a->base(), key, usage, Multiplicity::array, 6, nullptr));
  };
  const ArrayHeader* from = array(in, usage::variable);
  const ArrayHeader* to = array(out, usage::input);
  bench.control(scratch.path("x.fmu"), 3,
                Settings{{"inputs", Texts{"bytes_in=test.in"}}, {"outputs", Texts{"bytes_out=test.out"}}});
  bench.build();
  std::memcpy(from->data, "abcdef", 6);
  bench.run_for(0.2);
  EXPECT_EQ(std::string(static_cast<const char*>(to->data), 6), "fedcba");
}

}  // namespace
}  // namespace muro::fmu
