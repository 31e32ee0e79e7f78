// SPDX-License-Identifier: MIT
// The access check finds algorithms that access what they have not declared, and reports what each does.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/simulation.hpp"

namespace muro {
namespace {

/// Runs 20 robots under the access check and returns its message.
std::string verdict(const std::string& motion) {
  Registry registry({BAD_PLUGIN_DIR "/secretive"});
  Simulation s(registry);
  RobotTree tree;
  tree.base("body");
  tree.close();
  std::vector<Item> items;
  for (int i = 0; i < 20; ++i) {
    const RobotView& robot = s.world().add_robot("r" + std::to_string(i), tree);
    items.push_back({&robot, robot.base()});
  }
  s.use(motion, 100, items);
  s.build();
  s.verify_access();
  try {
    s.run_for(0.05);
  } catch (const StepError& e) {
    return e.what();
  }
  return "";
}

TEST(Secretive, AnHonestAlgorithmPasses) { EXPECT_EQ(verdict("motion.honest"), ""); }

TEST(Secretive, ReadingARobotOfAnotherBlockIsFound) {
  const std::string text = verdict("motion.reads_another");
  EXPECT_NE(text.find("motion.reads_another #0 (motion.reads_another), one of `r8` to `r19`, failed"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("it wrote `r8/body:pose` differently in phase 0, for items 8 to 19, with Scope::own_robot"),
            std::string::npos)
      << text;
}

TEST(Secretive, WritingARobotOfAnotherBlockIsFound) {
  const std::string text = verdict("motion.writes_another");
  EXPECT_NE(text.find("it wrote `r0/body:pose`, which it has no right to in phase 0, for items 8 to 19"),
            std::string::npos)
      << text;
}

TEST(Secretive, StateOutsideOfPropertiesIsFound) {
  const std::string text = verdict("motion.keeps_state");
  EXPECT_NE(text.find("`r0/body:pose` differently"), std::string::npos) << text;
  EXPECT_NE(text.find("keeps state outside of properties"), std::string::npos) << text;
}

}  // namespace
}  // namespace muro
