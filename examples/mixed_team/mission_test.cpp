// SPDX-License-Identifier: MIT
// The team at work, compared with the true places of crates and robots.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "examples/common/repeat_testing.hpp"
#include "mixed_team_testing.hpp"

namespace muro::mixed_team_test {
namespace {

const std::vector<std::string> flyer_alone = {"robots.rover=off",    "robots.cart=off",  "robots.walker=off",
                                              "robots.mates=off",    "robots.pacer=off", "algorithms.referee=off",
                                              "algorithms.score=off"};

TEST(Mission, TheFlyerFindsCratesToADecimetre) {
  Mission m(flyer_alone);
  m.run(14);
  const auto targets = m.targets();
  ASSERT_GE(targets.size(), 1u) << "the first lane has crates";
  for (const auto& t : targets) {
    EXPECT_LT(m.off(t.at), 0.12);
    EXPECT_FALSE(t.confirmed) << "nobody has been there";
  }
  EXPECT_NEAR(m.pose("flyer").position.z(), 4, 0.2);
}

TEST(Mission, WithoutACameraNothingIsFound) {
  std::vector<std::string> blind = flyer_alone;
  blind.emplace_back("robots.flyer.camera=off");
  Mission m(blind);
  m.run(12);
  EXPECT_TRUE(m.targets().empty());
}

TEST(Mission, EachKindOfRobotConfirmsTheCrateBeforeIt) {
  Mission m(crates_ahead());
  const auto contacts = example_test::contacts_of(m.world(), *m.world().find_robot("walker"));
  double lowest = 1, bears = 0;
  int steps = 0;
  for (double t = 0; t < 8; t += 0.05) {
    m.run(0.05);
    lowest = t > 1 ? std::min(lowest, m.pose("walker").position.z()) : lowest;
    for (const auto& contact : contacts) {
      const double force = contact.wrench->force.z();
      if (t > 1 && contact.is_foot()) bears += force;
      EXPECT_TRUE(contact.is_foot() || force == 0) << contact.link << " touches something";
    }
    steps += t > 1;
  }
  EXPECT_GT(lowest, 0.3) << "it stands on its legs";
  EXPECT_NEAR(bears / steps, 12 * 9.81, 12) << "and its feet bear its weight";
  for (const auto& kind : kinds)
    for (const std::string& robot : kind) {
      EXPECT_EQ(m.confirmed_by(robot), 1) << robot;
      EXPECT_LT(m.off(m.pose(robot).position.head<2>()), 0.8) << robot;
    }
  EXPECT_EQ(m.score("confirmed"), 6);
  EXPECT_EQ(m.score("wrong"), 0);
}

TEST(Mission, TheRefereeDoesNotBelieveWhoWasNotThere) {
  auto from_afar = crates_ahead({"robots.cart=off", "robots.walker=off", "robots.mates=off", "robots.pacer=off"});
  from_afar.emplace_back("robots.rover.seek.tunables=[stop=4]");
  Mission m(from_afar);
  m.run(6);
  const auto targets = m.targets();
  EXPECT_GT(std::count_if(targets.begin(), targets.end(), [](const auto& t) { return t.confirmed; }), 0);
  EXPECT_EQ(m.score("found"), 6);
  EXPECT_EQ(m.score("confirmed"), 0);
}

TEST(Mission, GoesOnFromASnapshotToTheSameBits) {
  Mission m(crates_ahead());
  example_test::expect_same_bits_from_snapshot(m.simulation(), 2.52, 1);
}

TEST(SlowMission, AllCratesAreFoundAndConfirmed) {
  for (const char* seed : {"seed=1", "seed=40"}) {
    Mission m({seed});
    std::map<std::string, double> confirmed;
    for (int k = 0; k < 1200 && m.score("confirmed") < 10; ++k) {
      m.run(0.1);
      for (const auto& kind : kinds)
        for (const std::string& robot : kind) {
          if (m.confirmed_by(robot) == confirmed[robot]) continue;
          confirmed[robot] = m.confirmed_by(robot);
          EXPECT_LT(m.off(m.pose(robot).position.head<2>()), 0.9) << robot << " said so from afar";
        }
      EXPECT_GT(m.pose("walker").position.z(), k > 10 ? 0.29 : 0.2) << "after " << 0.1 * k << " s";
    }
    const auto targets = m.targets();
    ASSERT_EQ(targets.size(), 10u) << seed;
    for (const auto& t : targets) {
      EXPECT_TRUE(t.confirmed) << seed;
      EXPECT_LT(m.off(t.at), 0.2) << seed;
    }
    const auto had_part = std::count_if(kinds.begin(), kinds.end(), [&](const std::vector<std::string>& kind) {
      return std::any_of(kind.begin(), kind.end(), [&](const std::string& r) { return confirmed[r] > 0; });
    });
    EXPECT_GE(had_part, 3) << seed;
  }
}

TEST(SlowMission, ThreadsDoNotMatter) {
  EXPECT_EQ(example_test::hash_on(1, scenario, {}, 25), example_test::hash_on(3, scenario, {}, 25));
}

TEST(SlowMission, TheWalkerDoesItsPartInEachEngine) {
  for (const char* motion : {"motion.mujoco", "motion.bullet", "motion.ode"}) {
    Mission m(crates_ahead({std::string("robots.walker.motion.use=") + motion}));
    m.run(8);
    EXPECT_EQ(m.confirmed_by("walker"), 1) << motion;
    EXPECT_GT(m.pose("walker").position.z(), 0.3) << motion;
    EXPECT_LT(m.off(m.pose("walker").position.head<2>()), 0.8) << motion;
  }
}

}  // namespace
}  // namespace muro::mixed_team_test
