// SPDX-License-Identifier: MIT
// The twelve records of an XL-330 (Rhoban/bam), if they are next to the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/tools/identify/identification.hpp"

namespace muro::host {
namespace {

std::vector<MotorRecord> real_records() {
  const std::filesystem::path folder = std::filesystem::path(MURO_TEST_SOURCE_DIR) / "../shared/data/xl330";
  std::vector<std::string> files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  std::vector<MotorRecord> records;
  for (const std::string& f : files) records.push_back(read_motor_record(f, {}));
  return records;
}

class SlowRealRecords : public testing::Test {
 protected:
  void SetUp() override {
    records = real_records();
    if (!can_fit()) GTEST_SKIP() << "built without NLopt";
    if (records.empty()) GTEST_SKIP() << "there are no recordings in ../shared/data/xl330";
  }
  FitSettings settings(FrictionKind kind) const {
    FitSettings s;
    s.friction = kind;
    s.gain = 0.0028773775;
    s.threads = 2;
    return s;
  }
  std::vector<MotorRecord> records;
};

TEST_F(SlowRealRecords, M1PredictsThemWithin60Milliradians) {
  EXPECT_LT(fit_motor(records, settings(FrictionKind::m1)).mean_error, 0.060);
}

TEST_F(SlowRealRecords, M4PredictsThemWithin36Milliradians) {
  EXPECT_LT(fit_motor(records, settings(FrictionKind::m4)).mean_error, 0.036);
}

TEST_F(SlowRealRecords, TheirTemperaturesTellMoreThanAnyFriction) {
  // P 800 was recorded at 33 to 39 degrees Celsius, the others at 28 to 30
  FitSettings s = settings(FrictionKind::m4);
  s.fit_temperature = true;
  EXPECT_LT(fit_motor(records, s).mean_error, 0.024);
}

TEST_F(SlowRealRecords, AWarmMotorIsForeseenByItsTemperature) {
  std::vector<MotorRecord> cold, warm;
  for (const MotorRecord& r : records) (r.p_gain == 800 ? warm : cold).push_back(r);
  FitSettings s = settings(FrictionKind::m1);
  s.fit_temperature = true;
  const FitResult fit = fit_motor(cold, s);
  double error = 0;
  for (const MotorRecord& r : warm) error += error_of(prepare(r, 0.002), fit.estimate).mean / double(warm.size());
  EXPECT_LT(error, 1.7 * fit.mean_error) << "2.1 without";
}

TEST_F(SlowRealRecords, TheirDutiesTellTheGainOfTheFirmware) {
  EXPECT_NEAR(recorded_gain(records), 0.0028773775, 0.01 * 0.0028773775);
}

}  // namespace
}  // namespace muro::host
