// SPDX-License-Identifier: MIT
#include "rule.hpp"

#include <gtest/gtest.h>

#include "muro/algorithm.hpp"

namespace muro::level {
namespace {

const std::vector<std::string> names = {"near", "far"};

TEST(Rule, IsReadInEachOfItsForms) {
  const auto is = [](std::string_view text, std::uint32_t level, Rule::When when, double number,
                     std::string_view what) {
    const Rule r = parse_rule(text, names);
    EXPECT_EQ(r.level, level) << text;
    EXPECT_EQ(r.when, when) << text;
    EXPECT_EQ(r.number, number) << text;
    EXPECT_EQ(r.what, what) << text;
  };
  is("near at 2.5", 0, Rule::When::at, 2.5, "");
  is("near when nearer than 2 to ball", 0, Rule::When::nearer, 2, "ball");
  is("near when nearer than 2 to any", 0, Rule::When::nearer, 2, "");
  is("far when farther than 3 from ball", 1, Rule::When::farther, 3, "ball");
  is("far  when farther than 3 from all", 1, Rule::When::farther, 3, "");
  is("near when inside yard", 0, Rule::When::inside, 0, "yard");
  is("far when outside yard", 1, Rule::When::outside, 0, "yard");
  is("near when in contact", 0, Rule::When::in_contact, 0, "");
  is("far when out of contact for 1.5", 1, Rule::When::out_of_contact, 1.5, "");
  is("far when slower than 1", 1, Rule::When::slower, 1, "");
  is("near when faster than 2", 0, Rule::When::faster, 2, "");
}

std::string refusal(std::string_view text) {
  try {
    parse_rule(text, names);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST(Rule, ThatIsNotUnderstoodIsRefusedWithAllForms) {
  for (const char* text : {"", "near", "near now", "near at", "near at noon", "near at -1", "near at inf",
                           "near when nearer than 2", "near when nearer than 2 from ball", "near at 2 3",
                           "far when out of contact", "near when inside", "near when inside the yard"}) {
    const std::string message = refusal(text);
    EXPECT_NE(message.find("a rule is one of: `NAME at SECONDS`"), std::string::npos) << text << ": " << message;
  }
}

TEST(Rule, OfAMotionThatTheRobotDoesNotHaveNamesThoseItHas) {
  EXPECT_EQ(refusal("neer at 2"),
            "the rule `neer at 2` begins with `neer`, but the robot has no motion of this name (did you mean `near`?); "
            "it has: `near`, `far`");
}

}  // namespace
}  // namespace muro::level
