// SPDX-License-Identifier: MIT
// Runs every case on every motion that it applies to. Combinations that do not apply are not instantiated; the XML
// report of MotionCases.AreLeftOutForAReason has a table of them.
#include <gtest/gtest.h>

#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {
namespace {

/// A motion, and the number of a case.
using Combination = std::tuple<std::string, std::size_t>;

class EveryMotion : public ::testing::TestWithParam<Combination> {};

TEST_P(EveryMotion, IsAsItShouldBe) {
  const auto& [motion, number] = GetParam();
  const Case c = all_cases()[number];
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
      if (why_left_out(motion, cases[i]).empty()) all.emplace_back(motion, i);
  return all;
}

/// Returns a name such as "motion_ode_a_block_slides_down_30_deg".
std::string name_of_case(const ::testing::TestParamInfo<Combination>& test) {
  std::string name = std::get<0>(test.param) + "_" + std::string(all_cases()[std::get<1>(test.param)].name);
  std::string clean;
  for (const char c : name) {
    const bool fine = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fine || (!clean.empty() && clean.back() != '_')) clean += fine ? c : '_';
  }
  return clean;
}

TEST(MotionCases, AreLeftOutForAReason) {
  const std::vector<std::string> all = motions();
  const bool has_multibody = std::any_of(all.begin(), all.end(), [](const std::string& motion) {
    return (description_of(motion).features & feature_link_dynamics) != 0;
  });
  for (const Case& c : all_cases()) {
    std::string left_out;
    std::size_t run = 0;
    for (const std::string& motion : all) {
      const std::string why = why_left_out(motion, c);
      if (why.empty())
        ++run;
      else
        left_out += motion + ": " + why + "; ";
    }
    RecordProperty(std::string(c.name), left_out);
    if (has_multibody || (c.needs & (feature_link_dynamics | feature_convex_meshes | feature_concave_meshes)) == 0) {
      EXPECT_GT(run, 0u) << "no motion is held to: " << c.name;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryMotion, ::testing::ValuesIn(combinations()), name_of_case);

}  // namespace
}  // namespace muro::conformance
