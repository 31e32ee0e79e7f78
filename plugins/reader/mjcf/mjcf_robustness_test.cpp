// SPDX-License-Identifier: MIT
// Damaged files, read through the plugin and the parser process. Each is read, or refused with one message.
#include <random>

#include "core/simulation.hpp"
#include "reading_testing.hpp"
#include "tests/support/scene.hpp"

namespace muro::mjcf {
namespace {

const std::string walker = R"(<mujoco model="r">
<compiler angle="degree"/><option timestep="0.002" gravity="0 0 -9.81"/><size njmax="100" nconmax="50"/>
<default><joint damping="1"/><geom friction="0.8"/><default class="leg"><geom rgba="1 0 0 1"/></default></default>
<asset><mesh name="tet" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/><texture name="t" type="2d" builtin="flat" width="4" height="4"/><material name="m" texture="t"/></asset>
<worldbody><geom name="floor" type="plane" size="1 1 1" material="m"/>
<body name="torso" pos="0 0 1"><freejoint/><geom type="box" size="0.2 0.1 0.1"/><site name="imu"/>
 <body name="thigh" pos="0.1 0 0" childclass="leg"><joint name="hip" axis="0 1 0" range="-30 30" limited="true"/>
  <geom type="capsule" fromto="0 0 0 0 0 -0.4" size="0.05"/>
  <body name="shin" pos="0 0 -0.4"><joint name="knee" type="slide" axis="0 0 1" pos="0 0 0.1"/><geom type="mesh" mesh="tet"/></body></body></body>
</worldbody>
<tendon><fixed name="f"><joint joint="hip" coef="1"/></fixed></tendon>
<actuator><motor joint="hip" gear="10"/><position joint="knee" kp="5"/></actuator>
<sensor><gyro name="g" site="imu"/></sensor>
<keyframe><key qpos="0 0 1 1 0 0 0 0 0"/></keyframe>
</mujoco>)";

std::string damaged(std::mt19937& random) {
  std::string text = walker;
  for (std::size_t damages = 1 + random() % 3; damages > 0; --damages) {
    const std::size_t at = random() % text.size();
    const auto attribute = [&](const std::string& value) {
      const std::size_t open = text.find('"', at), close = text.find('"', open + 1);
      if (open != text.npos && close != text.npos) text.replace(open + 1, close - open - 1, value);
    };
    constexpr const char* values[] = {"",     "-1",  "0",   "1e308",     "nan",    "inf",   "2000000000", "-2147483648",
                                      "hip",  "t",   "leg", "torso",     "0 0 0",  "true",  "ball",       "mesh",
                                      "%n%s", "1 2", "1,5", "ellipsoid", "hfield", "plane", "/dev/null",  "euler"};
    switch (random() % 5) {
      case 0:
        text[at] = char(text[at] ^ (1 << random() % 8));
        break;
      case 1: {
        const std::size_t open = text.find('<', at), close = text.find('>', at + 1);
        if (open < close && close != text.npos) text.erase(open, close + 1 - open);
        break;
      }
      case 2: {
        const std::size_t open = text.find('<', at), close = text.find("/>", open);
        if (close != text.npos) text.insert(open, text.substr(open, close + 2 - open));
        break;
      }
      case 3:
        if (random() % 5 == 0) text.resize(at);
        break;
      default:
        attribute(values[random() % std::size(values)]);
    }
    if (text.empty()) text = " ";
  }
  return text;
}

void check_damaged_files(int variants) {
  std::mt19937 random(20261123);
  const test::ScratchFolder folder;
  int refused = 0, read = 0;
  for (int variant = 0; variant < variants; ++variant) {
    const std::string text = damaged(random), path = folder.file("robot.xml", text);
    Simulation simulation(test::plugins());
    for (const bool as_world : {false, true}) try {
        if (as_world)
          simulation.read_world(path);
        else
          simulation.read_model(path);
        ++read;
      } catch (const std::exception& e) {
        ++refused;
        EXPECT_NE(std::string(e.what()).find("robot.xml"), std::string::npos) << e.what() << "\n" << text;
      }
  }
  EXPECT_GT(refused, variants / 10);
  EXPECT_GT(read, variants / 10);
}

TEST(MjcfRobustness, DamagedFilesAreReadOrRefused) { check_damaged_files(100); }
TEST(SlowMjcfRobustness, ManyDamagedFilesAreReadOrRefused) { check_damaged_files(5000); }

TEST(MjcfRobustness, AChainOfManyBodiesIsReadInOrder) {
  // the deepest nesting of XML that is allowed here
  std::string open, close;
  for (int i = 0; i < 90; ++i) {
    open += concat("<body name='b", i, "' pos='0 0 0.1'>", i > 0 ? "<joint axis='0 1 0'/>" : "<freejoint/>",
                   "<geom size='0.05'/>");
    close += "</body>";
  }
  const Robot chain = robot_of(mujoco(open + close));
  ASSERT_EQ(chain.tree.links().size(), 90u) << joined(chain.problems);
  EXPECT_TRUE(near(chain.pose("b89"), {{0, 0, 8.9}, Quat::Identity()}));
}

TEST(MjcfRobustness, DeeplyNestedElementsAreAnErrorNotAnOverflow) {
  std::string text = "<mujoco><worldbody>";
  for (int i = 0; i < 200000; ++i) text += "<body>";
  const Robot deep = robot_of(text);
  ASSERT_EQ(deep.problems.size(), 1u);
  EXPECT_NE(deep.problems[0].find("elements are nested more than 100 deep"), std::string::npos);
}

}  // namespace
}  // namespace muro::mjcf
