// SPDX-License-Identifier: MIT
// The descriptions of models.txt in every motion by forces: they stand, fall freely, or are refused in one clear
// sentence. No robot is thrown or sinks into the ground.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/mesh_corners.hpp"
#include "muro/base/bounds.hpp"
#include "muro/vocabulary.hpp"
#include "tests/models/model_table.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

constexpr double g = 9.81;        // m/s^2
constexpr double duration = 1;    // s
constexpr double deepest = 0.01;  // m
constexpr double drift = 0.5;     // m/s, beyond free fall: of links that swing

struct ModelAtMotion {
  std::string file, motion;
  friend std::ostream& operator<<(std::ostream& out, const ModelAtMotion& m) {
    return out << m.file << " " << m.motion;
  }
};

std::vector<ModelAtMotion> models_at_motions() {
  std::vector<ModelAtMotion> all;
  for (const test::ModelCase& c : test::model_cases())
    for (const char* motion :
         {"motion.simplified", "motion.articulated", "motion.ode", "motion.bullet", "motion.mujoco"})
      if (!c.is_refused && !c.is_world()) all.push_back({c.file, motion});
  return all;
}

/// Returns the height of the lowest point above the plane z = 0, m.
double lowest_point(const World& world, const RobotView& robot, MeshCorners& meshes) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Link& link : robot.links) {
    if (!world.has(link.object, keys::collision_shapes.name)) continue;
    for (const Shape& s : world.values(link.object, keys::collision_shapes)) {
      const Pose at = world.value(link.object, keys::pose) * s.origin;
      const std::string mesh = s.kind == ShapeKind::mesh ? std::string(world.text(s.mesh)) : "";
      if (s.kind != ShapeKind::plane) lowest = std::min(lowest, meshes.bounds_of(s, mesh, at).low.z());
    }
  }
  return lowest;
}

class ModelsAtMotions : public testing::TestWithParam<ModelAtMotion> {
 protected:
  BuiltScenario built() const {
    const test::ScratchFolder folder;
    const std::string robot = "{model: \"" + test::models_folder() + "/" + GetParam().file +
                              "\", motion: {use: " + GetParam().motion + ", rate: 1000}}";
    return build(
        read_scenario(folder.file("s.yaml", "world: {objects: {ground: {shape: plane}}}\nrobots: {r: " + robot + "}\n"),
                      {}),
        test::plugins());
  }
};

TEST_P(ModelsAtMotions, StandOrFallOrAreRefusedInOneSentence) {
  BuiltScenario b;
  try {
    b = built();
  } catch (const SetupError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("mass"), text.npos) << text;
    EXPECT_EQ(text.find('\n'), text.npos) << text;
    return;
  }
  const World& world = b.simulation->world();
  const RobotView& robot = *world.robots()[0];
  MeshCorners meshes(*b.simulation);
  const bool touches = lowest_point(world, robot, meshes) < 1e9;
  for (int tenth = 1; tenth <= 10; ++tenth) {
    b.simulation->run_for(0.1 * duration);
    b.simulation->refresh();
    for (const Link& link : robot.links) {
      const Pose pose = world.value(link.object, keys::pose);
      const Twist twist = world.value(link.object, keys::twist);
      ASSERT_TRUE(pose.position.allFinite() && pose.orientation.coeffs().allFinite());
      EXPECT_LT(twist.linear.norm(), g * 0.1 * tenth * duration + drift) << world.object_name(link.object);
    }
    if (touches) {
      EXPECT_GT(lowest_point(world, robot, meshes), -deepest) << "after " << 0.1 * tenth << " s";
    }
  }
}

std::string name_with_motion(const testing::TestParamInfo<ModelAtMotion>& info) {
  std::string name = info.param.file + "_at_" + info.param.motion.substr(info.param.motion.find('.') + 1);
  for (char& character : name)
    if (!std::isalnum(static_cast<unsigned char>(character))) character = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, ModelsAtMotions, testing::ValuesIn(models_at_motions()), name_with_motion);

}  // namespace
}  // namespace muro::host
