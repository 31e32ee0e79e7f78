// SPDX-License-Identifier: MIT
// Every sensor of a robot's own state in every motion that supports it.
#include <gtest/gtest.h>

#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {
namespace {

using Combination = std::tuple<std::string, std::size_t>;

class EverySensor : public ::testing::TestWithParam<Combination> {};

TEST_P(EverySensor, ReadsWhatIsKnown) {
  const auto& [motion, number] = GetParam();
  const Case c = all_cases()[number];
  if (how(motion, c) == How::refused) {
    try {
      c.run(motion);
      ADD_FAILURE() << motion << " was connected: " << c.name;
    } catch (const SetupError& error) {
      EXPECT_NE(std::string(error.what()).find("no force moves `r`"), std::string::npos) << error.what();
    }
    return;
  }
  const Outcome seen = c.run(motion);
  const Bound bound = bound_of(motion, c);
  EXPECT_LE(seen.error, bound.error) << motion << ": " << c.name << ": " << seen.seen << " (" << c.unit << ")";
  RecordProperty("seen", seen.seen);
}

std::vector<Combination> combinations() {
  const std::vector<Case> cases = all_cases();
  std::vector<Combination> all;
  for (const std::string& motion : motions())
    for (std::size_t i = 0; i < cases.size(); ++i)
      if (how(motion, cases[i]) != How::left_out) all.emplace_back(motion, i);
  return all;
}

std::string name_of_case(const ::testing::TestParamInfo<Combination>& test) {
  const std::string name = std::get<0>(test.param) + "_" + std::string(all_cases()[std::get<1>(test.param)].name);
  std::string clean;
  for (const char c : name) {
    const bool fine = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fine || (!clean.empty() && clean.back() != '_')) clean += fine ? c : '_';
  }
  return clean;
}

INSTANTIATE_TEST_SUITE_P(Conformance, EverySensor, ::testing::ValuesIn(combinations()), name_of_case);

}  // namespace
}  // namespace muro::sensor_conformance
