// SPDX-License-Identifier: MIT
#include "host/tools/compare/factor.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string urban_scenario = MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml";

Factor vary(const std::string& text) { return read_factor(text, read_scenario(urban_scenario, {}), test::plugins()); }

std::string refusal(const std::string& text) {
  try {
    vary(text);
  } catch (const SetupError& e) {
    return e.what();
  }
  return "none";
}

TEST(Factor, ShortNamesAreOfTheFamilyThatIsVaried) {
  const Factor v = vary("rovers.motion=point,motion.simplified");
  EXPECT_EQ(v.path, "robots.rovers.motion");
  EXPECT_EQ(v.kind, "motion");
  ASSERT_EQ(v.choices.size(), 2u);
  EXPECT_EQ(v.choices[0].use, "motion.point");
  EXPECT_EQ(v.choices[1].label, "simplified");
  EXPECT_EQ(vary("rovers.laser=raycast,off").choices[1].use, "off");
}

TEST(Factor, AlgorithmsOfTheSceneVaryToo) {
  const Factor v = vary("collision=native");
  EXPECT_EQ(v.path, "algorithms.collision");
  EXPECT_EQ(v.choices[0].use, "collision.native");
  EXPECT_EQ(v.robots, "");
}

TEST(Factor, SomeRobotsOfATemplateCanVary) {
  const Factor v = vary("rovers[5-9].motion=point");
  EXPECT_EQ(v.path, "robots.rovers[5-9].motion");
  EXPECT_EQ(v.first, 5);
  EXPECT_EQ(v.last, 9);
  EXPECT_EQ(refusal("rovers[5-99].motion=point"),
            "--vary rovers[5-99].motion=point: `[5-99]` must be a robot or a range of them within [0-19]");
}

TEST(Factor, SeveralMakeAProduct) {
  const std::vector<Factor> both = {vary("rovers.motion=point,simplified"), vary("rovers.laser=raycast,off")};
  const auto all = all_variations(both);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all[1].label, "point + off");
  EXPECT_EQ(all[1].overrides,
            (std::vector<std::string>{"robots.rovers.motion.use=motion.point", "robots.rovers.laser=off"}));
  EXPECT_EQ(all[2].label, "simplified + raycast");
}

TEST(Factor, MistakesNameWhatThereIs) {
  EXPECT_EQ(refusal("rovers.motion=point,simplifed")
                .rfind("--vary rovers.motion=point,simplifed: no plugin offers "
                       "`motion.simplifed` (did you mean `motion.simplified`?)",
                       0),
            0u);
  EXPECT_EQ(
      refusal("rover.motion=point"),
      "--vary rover.motion=point: the scenario has no robots `rover` (did you mean `rovers`?); there are: rovers");
  EXPECT_EQ(refusal("rovers.moton=point"),
            "--vary rovers.moton=point: robots `rovers` have no `moton` (did you mean `motion`?); they have: motion, "
            "drive, laser, control");
  EXPECT_EQ(refusal("rovers.motion=laser.raycast"),
            "--vary rovers.motion=laser.raycast: `laser.raycast` is of kind sensor, but `rovers.motion` is a motion");
  EXPECT_EQ(refusal("rovers.motion"),
            "--vary rovers.motion: write SUBSYSTEM=NAME,NAME,..., such as rovers.motion=point,simplified");
  EXPECT_EQ(refusal("rovers.motion=point,point"), "--vary rovers.motion=point,point: `point` is named twice");
  EXPECT_EQ(refusal("rovers.motion=point,,ode"), "--vary rovers.motion=point,,ode: a name is missing between commas");
}

}  // namespace
}  // namespace muro::host
