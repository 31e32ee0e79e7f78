// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "tests/conformance/known_answers/answer.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::known_answers {
namespace {

class KnownAnswer : public testing::TestWithParam<std::size_t> {};

TEST_P(KnownAnswer, IsFound) {
  const Answer a = all_answers()[GetParam()];
  const Found found = a.run();
  EXPECT_LE(found.error, found.tolerance) << a.plugin << ": " << a.name << " (" << a.unit << ")";
}

std::string name_of_answer(const testing::TestParamInfo<std::size_t>& test) {
  std::string clean;
  for (const char c : all_answers()[test.param].name)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      clean += c;
    else if (!clean.empty() && clean.back() != '_')
      clean += '_';
  return clean;
}

INSTANTIATE_TEST_SUITE_P(, KnownAnswer, testing::Range(std::size_t(0), all_answers().size()), name_of_answer);

TEST(KnownAnswers, HoldAgainstEachBugOfAPeer) {
  std::set<std::string_view> names;
  for (const Answer& a : all_answers()) names.insert(a.name);
  for (const sensor_conformance::Case& c : sensor_conformance::all_cases()) names.insert(c.name);
  for (const PeerBug& b : peer_bugs()) EXPECT_TRUE(names.contains(b.answer)) << b.peer << ": " << b.answer;
}

}  // namespace
}  // namespace muro::known_answers
