// SPDX-License-Identifier: MIT
#include "host/scenario/overlaps.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Returns the notes of a built scenario, without the path of its file.
std::vector<std::string> notes_of(const std::string& text) {
  const test::ScratchFolder folder;
  folder.file("arm.urdf", R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.4 0.4 0.4"/></geometry></collision></link>
  <link name="hand"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="swing" type="revolute"><parent link="base"/><child link="hand"/><axis xyz="0 1 0"/>
    <origin xyz="0 0 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <link name="tip"><inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><geometry><sphere radius="0.1"/></geometry></collision></link>
  <joint name="wrist" type="fixed"><parent link="hand"/><child link="tip"/><origin xyz="0 0 2"/></joint>
</robot>)");
  const std::string file = folder.file("s.yaml", text);
  std::vector<std::string> notes = build(read_scenario(file, {}), test::plugins()).notes;
  for (std::string& note : notes)
    if (note.starts_with(file + ":")) note.erase(0, file.size() + 1);
  return notes;
}

using Notes = std::vector<std::string>;

TEST(Overlaps, AreToldWithBothBodiesAndTheirDepth) {
  // two balls: 0.3 + 0.3 - 0.5; a ball and the wall: 0.3 - (1.05 - 0.4 / 2 - 0.6)
  EXPECT_EQ(
      notes_of(R"(
world:
  objects:
    ground: {shape: plane}
    wall: {shape: {box: [0.4, 4, 4]}, at: {x: 1.05}}
robots:
  ball:
    shape: {sphere: 0.3}
    mass: 1
    place: {list: [{x: 0.6, z: 1}, {x: 0.1, z: 1}, {x: -3}]}
    motion: {use: motion.simplified, rate: 100}
)"),
      (Notes{
          "10:12: note: `ball_0/body` and `ball_1/body` overlap by 0.1 m at the start; contacts push them apart, so "
          "move one of them",
          "10:12: note: `ball_0/body` and `wall` overlap by 0.05 m at the start; contacts push them apart, so move one "
          "of them"}));
}

TEST(Overlaps, OfLinksAreThoseWithTheJointsWhereTheyStart) {
  const auto arm = [](double angle) {
    return notes_of(R"(
world: {objects: {post: {shape: {sphere: 0.1}, at: {x: 2, z: 5}}}}
robots:
  arm: {model: arm.urdf, at: {z: 5}, joints: {swing: )" +
                    std::to_string(angle) +
                    R"(}, motion: {use: motion.simplified, rate: 100}}
)");
  };
  EXPECT_EQ(arm(0), Notes{});
  EXPECT_EQ(arm(M_PI / 2 - 0.06).size(), 1u) << "0.12 m apart, which is less than both radii";
  EXPECT_NE(arm(M_PI / 2 - 0.06)[0].find("`arm/tip` and `post` overlap by 0.08 m"), std::string::npos);
}

TEST(Overlaps, OfManyTheDeepestAreTold) {
  const Notes notes = notes_of(R"(
robots:
  ball:
    shape: {sphere: 0.3}
    mass: 1
    place: {list: [{}, {x: 0.59}, {x: 1.17}, {x: 1.74}, {x: 2.3}, {x: 2.85}, {x: 3.39}, {x: 3.92}]}
    motion: {use: motion.simplified, rate: 100}
)");
  ASSERT_EQ(notes.size(), 6u);
  EXPECT_NE(notes[0].find("`ball_6/body` and `ball_7/body` overlap by 0.07 m"), std::string::npos) << notes[0];
  EXPECT_EQ(notes[5], "note: 2 more pairs start in overlap");
}

TEST(Overlaps, ThatNoContactPartsAreNotTold) {
  const auto notes_where_contacts = [](const char* are) {
    return notes_of(fmt::format(R"(
robots:
  ball:
    shape: {{sphere: 0.3}}
    mass: 1
    place: {{list: [{{z: 1}}, {{x: 0.1, z: 1}}]}}
    motion: {{use: motion.point, rate: 100, on_contact: {}}}
)",
                                are));
  };
  EXPECT_EQ(notes_where_contacts("ignore"), Notes{});
  EXPECT_EQ(notes_where_contacts("stop").size(), 1u);
}

}  // namespace
}  // namespace muro::host
