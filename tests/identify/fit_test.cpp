// SPDX-License-Identifier: MIT
// The search, with records of known motors.
#include <gtest/gtest.h>

#include "host/tools/identify/identification.hpp"
#include "tests/identify/simulated_record.hpp"

namespace muro::host {
namespace {

constexpr double xl330_gain = 0.0028773775;

MotorEstimate xl330_m1() {
  MotorEstimate e;
  e.motor = {.kt = 0.387,
             .resistance = 4.017,
             .armature = 0.00181,
             .gain = xl330_gain,
             .friction = {.coulomb = 0.0128, .viscous = 0.0037}};
  e.offset = 0.02;
  return e;
}

void expect_near_relative(double found, double expected, double part, const char* name) {
  EXPECT_NEAR(found, expected, part * std::abs(expected)) << name;
}

void expect_motor(const MotorEstimate& found, const MotorEstimate& e, double part) {
  expect_near_relative(found.motor.kt, e.motor.kt, part, "kt");
  expect_near_relative(found.motor.resistance, e.motor.resistance, part, "resistance");
  expect_near_relative(found.motor.armature, e.motor.armature, part, "armature");
  expect_near_relative(found.motor.friction.coulomb, e.motor.friction.coulomb, part, "friction");
  expect_near_relative(found.motor.friction.viscous, e.motor.friction.viscous, part, "viscous_friction");
}

class MotorFit : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_fit()) GTEST_SKIP() << "built without NLopt";
  }
};

FitSettings quick(FrictionKind kind) {
  FitSettings s;
  s.friction = kind;
  s.gain = xl330_gain;
  s.threads = 2;
  s.starts = 2;
  return s;
}

TEST_F(MotorFit, FindsAMotorFromItsOwnNoisyRecord) {
  const test::SimulatedBench bench{.motor = xl330_m1()};
  const FitResult r = fit_motor(bench.records(200, 800), quick(FrictionKind::m1));
  expect_motor(r.estimate, bench.motor, 0.02);
  EXPECT_NEAR(r.estimate.offset, 0.02, 1e-3);
  EXPECT_LT(r.mean_error, 1.1e-3) << "the noise is 1e-3 rad, 0.8e-3 its mean size";
  EXPECT_TRUE(r.warnings.empty()) << r.warnings.front();
}

TEST_F(MotorFit, FindsALargeMotorAndTheGainOfItsFirmware) {
  // MX-64 with 1 kg at 0.15 m and 15 V, sampled at 100 Hz
  MotorEstimate mx64;
  mx64.motor = {.kt = 1.622,
                .resistance = 3.949,
                .armature = 0.01195,
                .gain = 0.158,
                .duty_limit = 0.9625,
                .friction = {.coulomb = 0.0904, .viscous = 0.0117}};
  test::SimulatedBench bench{.motor = mx64, .load = {.mass = 1, .length = 0.15}, .supply_voltage = 15};
  bench.period = 0.01;
  FitSettings s = quick(FrictionKind::m1);
  s.fit_gain = true, s.gain = 0, s.duty_limit = 0.9625;
  const FitResult r = fit_motor(bench.records(4, 32), s);
  expect_motor(r.estimate, mx64, 0.05);
  expect_near_relative(r.estimate.motor.gain, 0.158, 0.03, "gain");
}

TEST_F(MotorFit, PredictsWithM4WithinTheNoise) {
  MotorEstimate e = xl330_m1();
  e.motor.friction = {.coulomb = 0.0088,
                      .viscous = 0.001,
                      .stribeck = 0.01,
                      .stribeck_velocity = 1.5,
                      .stribeck_exponent = 1.2,
                      .load = 0.068,
                      .load_stribeck = 0.074};
  test::SimulatedBench bench{.motor = e};
  bench.duration = 4, bench.period = 0.01;
  FitSettings s = quick(FrictionKind::m4);
  s.global_evaluations = 1500, s.local_evaluations = 800;
  const FitResult r = fit_motor(bench.records(200, 800), s);
  EXPECT_LT(r.mean_error, 2e-3);
}

TEST_F(MotorFit, OfAPartOfTheRecordsFindsTheirMotor) {
  // all records together include one of a weaker motor; the part does not
  test::SimulatedBench bench{.motor = xl330_m1()}, weak = bench;
  weak.motor.motor.resistance *= 1.5, weak.motor.offset = -0.05;
  bench.duration = weak.duration = 3;
  std::vector<MotorRecord> records = bench.records(200, 800);
  records[1] = weak.records(200, 800)[1];
  FitSettings s = quick(FrictionKind::m1);
  const FitResult whole = fit_motor(records, s);
  EXPECT_GT(whole.mean_error, 5e-3);
  s.threads = 1;
  const FitResult part = refit_motor({records[0], records[2], records[3]}, s, whole);
  expect_motor(part.estimate, bench.motor, 0.03);
  EXPECT_NEAR(part.estimate.offset, 0.02, 2e-3);
  EXPECT_LT(part.mean_error, 1.1e-3) << "the noise is 1e-3 rad, 0.8e-3 its mean size";
  EXPECT_LT(part.evaluations, whole.evaluations / 4);
}

TEST_F(MotorFit, IsTheSameForAnyNumberOfThreads) {
  test::SimulatedBench bench{.motor = xl330_m1()};
  bench.duration = 2;
  FitSettings s = quick(FrictionKind::m1);
  s.global_evaluations = 300, s.local_evaluations = 100, s.starts = 3;
  const auto fit = [&](unsigned threads, std::uint64_t seed) {
    s.threads = threads, s.seed = seed;
    const FitResult r = fit_motor(bench.records(200, 800), s);
    return std::vector<double>{r.estimate.motor.kt, r.estimate.motor.resistance, r.estimate.motor.friction.coulomb};
  };
  EXPECT_EQ(fit(1, 1), fit(3, 1));
  EXPECT_NE(fit(1, 1), fit(1, 2));
}

TEST_F(MotorFit, SaysWhatRecordsDoNotTell) {
  // One slow motion: both kt and viscous friction brake, and nothing separates their effects.
  test::SimulatedBench bench{.motor = xl330_m1()};
  bench.duration = 3;
  const MotorRecord slow = bench.record(800, [](double t) { return 0.3 * std::sin(t); });
  FitSettings s = quick(FrictionKind::m1);
  s.global_evaluations = 1000, s.local_evaluations = 300;
  EXPECT_FALSE(fit_motor({slow}, s).warnings.empty());
}

/// Two records of the motor, cold and warm; its resistance grows by 1 % a degree from 30 on.
std::vector<MotorRecord> cold_and_warm() {
  std::vector<MotorRecord> all;
  for (const double temperature : {28.0, 38.0}) {
    test::SimulatedBench bench{.motor = xl330_m1()};
    bench.duration = 2;
    bench.motor.motor.resistance *= 1 + 0.01 * (temperature - 30);
    MotorRecord r = bench.record(400, [](double t) { return 1.5 * std::sin(2 * t * t); });
    r.has_temperature = true;
    for (RecordSample& s : r.samples) s.temperature = temperature;
    all.push_back(std::move(r));
  }
  return all;
}

TEST(OpenSimulation, AWarmMotorHasMoreResistance) {
  MotorEstimate e = xl330_m1();
  e.temperature_coefficient = 0.01, e.reference_temperature = 30;
  for (const MotorRecord& r : cold_and_warm()) EXPECT_LT(error_of(prepare(r, 0.002), e).mean, 2e-3);
}

TEST_F(MotorFit, FindsHowItsResistanceGrowsWithTemperature) {
  FitSettings s = quick(FrictionKind::m1);
  s.fit_temperature = true;
  s.global_evaluations = 1500, s.local_evaluations = 600;
  const FitResult r = fit_motor(cold_and_warm(), s);
  expect_near_relative(r.estimate.temperature_coefficient, 0.01, 0.1, "temperature_coefficient");
  EXPECT_EQ(r.estimate.reference_temperature, 33);
}

TEST(OpenSimulation, BeginsAnewBehindAGap) {
  const test::SimulatedBench bench{.motor = xl330_m1(), .sigma = 0};
  MotorRecord r = bench.record(800, [](double t) { return std::sin(2 * t); });
  std::erase_if(r.samples, [](const RecordSample& s) { return s.time > 1 && s.time < 2; });
  const PreparedRecord p = prepare(r, 0.002);
  EXPECT_EQ(p.segments.size(), 2u);
  EXPECT_EQ(p.gap_count, 1u);
  EXPECT_LT(error_of(p, bench.motor).largest, 0.02);
}

TEST(OpenSimulation, MeetsARecordThatItHasMadeItself) {
  const test::SimulatedBench bench{.motor = xl330_m1(), .sigma = 0};
  for (const MotorRecord& r : bench.records(100, 800)) EXPECT_LT(error_of(prepare(r, 0.002), bench.motor).mean, 2e-3);
}

TEST(OpenSimulation, EachRecordHasTheFirmwareThatItSays) {
  test::SimulatedBench bench{.motor = xl330_m1(), .sigma = 0};
  const MotorEstimate common = bench.motor;
  bench.motor.motor.gain *= 2;
  bench.motor.motor.duty_limit = 0.5;
  MotorRecord r = bench.record(400, [](double t) { return std::sin(3 * t); });
  const double wrong = error_of(prepare(r, 0.002), common).mean;
  r.duty_gain = bench.motor.motor.gain, r.duty_limit = 0.5;
  EXPECT_LT(error_of(prepare(r, 0.002), common).mean, 2e-3);
  EXPECT_GT(wrong, 0.02);
}

TEST(OpenSimulation, ADelayShiftsTheCommands) {
  MotorRecord r;
  for (int i = 0; i < 40; ++i) r.samples.push_back({.time = 0.01 * i, .goal = double(i), .supply_voltage = 5});
  const PreparedRecord p = prepare(r, 0.01, 0.02);
  EXPECT_NEAR(p.segments.front().intervals[10].goal, 8, 1e-9);
  EXPECT_EQ(prepare(r, 0.01).segments.front().intervals[10].goal, 10);
  EXPECT_NEAR(prepare(r, 0.01, 0.0125).segments.front().intervals[10].goal, 0.25 * 8 + 0.75 * 9, 1e-9)
      << "the mean of what comes in it";
}

}  // namespace
}  // namespace muro::host
