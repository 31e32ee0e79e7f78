// SPDX-License-Identifier: MIT
// The twelve recordings of an XL-330 (Rhoban/bam), where they lie beside the repository.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/identify/identification.hpp"

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

TEST_F(SlowRealRecords, TheirDutiesTellTheGainOfTheFirmware) {
  EXPECT_NEAR(recorded_gain(records), 0.0028773775, 0.01 * 0.0028773775);
}

}  // namespace
}  // namespace muro::host
