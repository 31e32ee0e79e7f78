// SPDX-License-Identifier: MIT
// Colours and pictures of materials that the scenario gives instead of the model.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// A body with four visuals: two of one material, one of another, one without a material.
const std::string urdf = R"(<robot name="r">
<material name="team"><color rgba="0 0 1 1"/></material>
<link name="box"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><box size="1 1 1"/></geometry><material name="team"/></visual>
<visual><geometry><box size="2 1 1"/></geometry><material name="team"/></visual>
<visual><geometry><sphere radius="1"/></geometry><material name="plate"><color rgba="1 1 0 0.5"/></material></visual>
<visual><geometry><sphere radius="2"/></geometry></visual>
</link></robot>)";

const std::string sdf = R"(<sdf version="1.9"><model name="r"><link name="box">
<visual name="team"><geometry><box><size>1 1 1</size></box></geometry>
<material><diffuse>0 0 1 1</diffuse></material></visual>
<visual name="plate"><geometry><sphere><radius>1</radius></sphere></geometry></visual>
<inertial><mass>1</mass></inertial></link></model></sdf>)";

const std::string mjcf = R"(<mujoco><asset><material name="team" rgba="0 0 1 1"/></asset><worldbody>
<body name="box"><freejoint/><geom type="box" size="1 1 1" material="team"/><geom type="sphere" size="1"/></body>
</worldbody></mujoco>)";

const Eigen::Vector4d blue(0, 0, 1, 1), red(1, 0, 0, 1), green(0, 1, 0, 0.5);

class MaterialsOfAModel : public testing::Test {
 protected:
  MaterialsOfAModel() {
    folder_.file("r.urdf", urdf);
    folder_.file("r.sdf", sdf);
    folder_.file("r.xml", mjcf);
    folder_.file("7.png", "a picture, which nobody draws here");
  }
  BuiltScenario built(const std::string& keys, const std::string& model = "r.urdf") {
    return build(read_scenario(folder_.file("r.yaml", "robots:\n  r:\n    model: " + model + "\n" + keys + "\n"), {}),
                 test::plugins());
  }
  static std::vector<Shape> shapes(const BuiltScenario& b, const std::string& robot = "r") {
    const World& world = b.simulation->world();
    const std::span<const Shape> all = world.constants(world.object(robot + "/box"), keys::visual_shapes);
    return {all.begin(), all.end()};
  }
  std::string refusal(const std::string& keys) {
    return test::complaint_of<SetupError>([&] { built(keys); });
  }
  test::ScratchFolder folder_;
};

TEST_F(MaterialsOfAModel, AreAsTheModelSaysWhereNothingIsStated) {
  const auto s = shapes(built("    at: {x: 1}"));
  ASSERT_EQ(s.size(), 4u);
  EXPECT_EQ(s[0].color, blue);
  EXPECT_EQ(s[2].color, Eigen::Vector4d(1, 1, 0, 0.5));
}

TEST_F(MaterialsOfAModel, GetTheColourOfTheScenarioWhereverTheyAre) {
  const auto s = shapes(built("    materials: {team: {color: [1, 0, 0]}, plate: {color: [0, 1, 0, 0.5]}}"));
  EXPECT_EQ(s[0].color, red);
  EXPECT_EQ(s[1].color, red);
  EXPECT_EQ(s[2].color, green);
  EXPECT_EQ(s[3].color, Shape{}.color) << "it has no material";
  EXPECT_EQ(s[0].material_source, MaterialSource::model);
}

TEST_F(MaterialsOfAModel, GetAPictureAndKeepTheirColour) {
  const BuiltScenario b = built("    materials: {plate: {texture: 7.png}}");
  const auto s = shapes(b);
  EXPECT_EQ(b.simulation->world().text(s[2].texture), folder_.path("7.png"));
  EXPECT_EQ(s[2].color, Eigen::Vector4d(1, 1, 0, 0.5));
  EXPECT_EQ(s[0].texture, no_text);
}

TEST_F(MaterialsOfAModel, DifferBetweenRobotsOfATemplateByVariants) {
  const BuiltScenario b = built(R"(    count: 4
    place: {list: [{x: 0}, {x: 5}, {x: 10}, {x: 15}]}
    materials: {team: {color: [1, 0, 0]}}
    variants: {"1-2": {materials: {plate: {color: [0, 1, 0, 0.5]}}}, "2": {materials: {team: {color: [0, 0, 1]}}}})");
  const Eigen::Vector4d yellow(1, 1, 0, 0.5);
  const Eigen::Vector4d team[] = {red, red, blue, red}, plate[] = {yellow, green, green, yellow};
  for (int i = 0; i < 4; ++i) {
    SCOPED_TRACE(i);
    const auto s = shapes(b, "r_" + std::to_string(i));
    EXPECT_EQ(s[0].color, team[i]);
    EXPECT_EQ(s[2].color, plate[i]);
  }
}

TEST_F(MaterialsOfAModel, AreNamesOfVisualsInSdf) {
  const auto s = shapes(built("    materials: {team: {color: [1, 0, 0]}, plate: {color: [0, 1, 0, 0.5]}}", "r.sdf"));
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].color, red);
  EXPECT_EQ(s[1].color, green);
}

TEST_F(MaterialsOfAModel, AreThoseOfGeomsInMjcf) {
  const auto s = shapes(built("    materials: {team: {color: [1, 0, 0]}}", "r.xml"));
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].color, red);
  EXPECT_NE(s[1].color, red);
}

TEST_F(MaterialsOfAModel, ThatItDoesNotHaveAreNamedWithThoseThatItHas) {
  EXPECT_SAYS(refusal("    materials: {tam: {color: [1, 0, 0]}}"),
              "r.yaml:4:17: `materials` of robot `r` names `tam`, and its model has no such material (did you mean "
              "`team`?); it has: plate, team");
  EXPECT_SAYS(refusal("    count: 2\n    place: {list: [{x: 0}, {x: 5}]}\n"
                      "    variants: {\"1\": {materials: {plat: {color: [1, 0, 0]}}}}"),
              "names `plat`, and its model has no such material (did you mean `plate`?)");
}

TEST_F(MaterialsOfAModel, AreRefusedWithoutAColourOrAPicture) {
  EXPECT_SAYS(refusal("    materials: {team: {}}"),
              "material `team` of robot `r` needs `color: [r, g, b]` or `texture: FILE`");
  EXPECT_SAYS(refusal("    materials: {team: {color: [2, 0, 0]}}"), "`color` of material `team` of robot `r`");
  EXPECT_SAYS(refusal("    materials: {team: {texture: 8.png}}"), "8.png does not exist");
  EXPECT_SAYS(refusal("    materials: {team: {colour: [1, 0, 0]}}"), "did you mean `color`?");
  EXPECT_SAYS(refusal("    materials: [1, 0, 0]"), "materials");
}

}  // namespace
}  // namespace muro::host
