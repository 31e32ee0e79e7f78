// SPDX-License-Identifier: MIT
// Every motion against every case that applies to it.
#include <gtest/gtest.h>

#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {
namespace {

using Tried = std::tuple<std::string, std::size_t>;

class EveryMotion : public ::testing::TestWithParam<Tried> {};

TEST_P(EveryMotion, IsAsItShouldBe) {
  const auto& [motion, number] = GetParam();
  const Case c = all_cases()[number];
  const Features has = description_of(motion).features;
  std::string missing;
  for (const FeatureInfo& f : feature_infos)
    if ((c.needs & f.bit) != 0 && (has & f.bit) == 0) missing += " " + std::string(f.name);
  if (!missing.empty()) GTEST_SKIP() << motion << " does not offer:" << missing;
  if ((c.excludes & has) != 0) GTEST_SKIP() << "not for motions by forces";
  Outcome seen;
  try {
    seen = c.run(motion);
  } catch (const SetupError& refusal) {  // a kinematic motion serves robots of its kind alone
    if ((has & feature_forces) != 0) throw;
    GTEST_SKIP() << refusal.what();
  }
  const Bound bound = bound_of(motion, c);
  EXPECT_LE(seen.error, bound.error) << motion << ": " << c.name << ": " << seen.seen << " (" << c.unit << ")";
  RecordProperty("seen", seen.seen);
}

std::vector<Tried> everything() {
  std::vector<Tried> all;
  for (const std::string& motion : motions())
    for (std::size_t i = 0; i < all_cases().size(); ++i) all.emplace_back(motion, i);
  return all;
}

/// "motion_ode_a_block_slides_down_30_deg".
std::string name_of(const ::testing::TestParamInfo<Tried>& test) {
  std::string name = std::get<0>(test.param) + "_" + std::string(all_cases()[std::get<1>(test.param)].name);
  std::string clean;
  for (const char c : name) {
    const bool fine = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (fine || (!clean.empty() && clean.back() != '_')) clean += fine ? c : '_';
  }
  return clean;
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryMotion, ::testing::ValuesIn(everything()), name_of);

}  // namespace
}  // namespace muro::conformance
