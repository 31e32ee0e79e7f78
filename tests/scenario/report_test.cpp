// SPDX-License-Identifier: MIT
#include "host/outputs/report.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "host/outputs/json_text.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro::host {
namespace {

TEST(Report, ANameThatIsNoUtf8DoesNotLoseIt) {
  RunResult result;
  result.scenario = "caf\xe9";
  test::Scene scene;
  scene.build();
  const std::string text = json_text(report(result, scene, Odometer(scene)));
  EXPECT_EQ(nlohmann::json::parse(text).at("scenario"), "caf\xef\xbf\xbd");
}

TEST(Report, APoseThatIsNotFiniteIsAnError) {
  test::Scene scene;
  const RobotView& ball = scene.add("ball", test::single_body(Shape::sphere(0.5), {.mass = 1}));
  scene.use("motion.point", 10, {{&ball, ball.base()}});
  scene.build();
  const Odometer odometer(scene);
  odometer.check();
  scene.pose(ball).position.x() = std::nan("");
  try {
    odometer.check();
    FAIL();
  } catch (const StepError& e) {
    EXPECT_EQ(std::string(e.what()).rfind("the pose of robot `ball` is not finite any more at t = 0 s", 0), 0u)
        << e.what();
  }
}

TEST(Report, NamesAlgorithmsThatAreNotDeterministic) {
  test::Scene scene;
  const RobotView& ball = scene.add("ball", test::single_body(Shape::sphere(0.5), {.mass = 1}));
  const ObjectId laser = scene.add_sensor_object(ball, "laser", ball.base());
  scene.use("motion.point", 10, {{&ball, ball.base()}});
  scene.use("scene.bvh", 0);
  scene.use("laser.auto", 10, {{&ball, laser}});  // it measures the machine to choose a method
  scene.build();
  EXPECT_EQ(nondeterministic_algorithms(scene), std::vector<std::string>{"laser.auto"});
  const auto written = report({}, scene, Odometer(scene));
  EXPECT_EQ(written.at("nondeterministic_algorithms"), (nlohmann::ordered_json{"laser.auto"}));
  for (const auto& algorithm : written.at("algorithms"))
    EXPECT_EQ(algorithm.at("deterministic").get<bool>(), algorithm.at("plugin") != "laser.auto");
}

TEST(Report, TellsPropertiesAtTheEndWholeNumbersWithoutAPoint) {
  test::Scene scene;
  const RobotView& ball = scene.add("ball", test::single_body(Shape::sphere(0.5), {.mass = 1}));
  scene.use("motion.point", 10, {{&ball, ball.base()}});
  scene.use("recorder.report", 1, {}, {{"properties", std::vector<std::string>{"ball/body:pose"}}});
  scene.build();
  scene.pose(ball).position = Vec3(0.5, 3, 0);
  scene.finish();
  const auto pose = report({}, scene, Odometer(scene)).at("properties").at(0);
  EXPECT_EQ(pose.at("name"), "ball/body:pose");
  EXPECT_EQ(pose.at(".x").dump(), "0.5");
  EXPECT_EQ(pose.at(".y").dump(), "3");
}

}  // namespace
}  // namespace muro::host
