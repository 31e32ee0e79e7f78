// SPDX-License-Identifier: MIT
// Pictures through a lens, and with a rolling shutter, compared with their equations.
#include <gtest/gtest.h>

#include <cmath>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;

constexpr std::uint32_t width = 200, height = 150;

struct Studio : test::Scene {
  const RobotView* carrier;
  ObjectId camera;
  const double focal = 160;  ///< px

  Studio() {
    carrier = &add("carrier", test::tree_of([](RobotBuilder& b) { b.base("body"); }), {{0, 0, 1}, Quat::Identity()});
    camera = add_sensor_object(*carrier, "camera", carrier->base());
  }
  ObjectId put(const std::string& name, const Shape& shape, const Pose& at) {
    return world().add_scenery(name, at, std::span<const Shape>(&shape, 1));
  }
  void set_up(const Parameters& more) {
    Parameters parameters{{"width", std::int64_t(width)},
                          {"height", std::int64_t(height)},
                          {"intrinsics", std::vector<double>{focal, focal, 100, 75}},
                          {"labels", true},
                          {"depth", true},
                          {"shadows", false},
                          {"device", "software"}};
    for (const auto& [name, value] : more) parameters[name] = value;
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("camera.opengl", 10, {{carrier, camera}}, parameters);
    build();
  }
  ObjectId label(std::uint32_t column, std::uint32_t row) {
    return world().values(camera, keys::camera_labels)[row * width + column];
  }
  /// Returns the mean column and row of the red pixels within `reach` pixels of a place.
  Eigen::Vector2d middle_of_red(const Eigen::Vector2d& near, double reach) {
    const auto image = world().values(camera, keys::camera_image);
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    double weight = 0;
    for (std::uint32_t row = 0; row < height; ++row)
      for (std::uint32_t column = 0; column < width; ++column) {
        const Eigen::Vector2d at(column + 0.5, row + 0.5);
        const std::uint8_t* p = &image[3 * (row * width + column)];
        const double red = std::pow(p[0] / 255.0, 2.2);  // light
        if ((at - near).cwiseAbs().maxCoeff() > reach) continue;
        sum += red * at;
        weight += red;
      }
    return sum / weight;
  }
};

TEST(ACameraWithALens, SeesAGridOfPointsWhereBrownsEquationsPutThem) {
  const std::vector<double> k = {-0.25, 0.08, 0.004, -0.003, -0.01};
  Studio s;
  std::vector<Eigen::Vector2d> grid;
  Shape square = Shape::box({1e-4, 0.16, 0.16});
  square.color = {1, 0, 0, 1};
  Shape wall = Shape::box({0.01, 40, 40});
  wall.color = {0, 0, 1, 1};
  s.put("wall", wall, {{3.02, 0, 1}, Quat::Identity()});
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j) {
      const double x = 0.24 * i, y = 0.18 * j;  // right and down, at distance 1
      s.put("square" + std::to_string(grid.size()), square, {{3, -3 * x, 1 - 3 * y}, Quat::Identity()});
      grid.push_back({x, y});
    }
  s.set_up({{"distortion", k}});
  s.run_for(0.005);
  for (const Eigen::Vector2d& p : grid) {
    const double r2 = p.squaredNorm(), radial = 1 + k[0] * r2 + k[1] * r2 * r2 + k[4] * r2 * r2 * r2;
    const double x = p.x() * radial + 2 * k[2] * p.x() * p.y() + k[3] * (r2 + 2 * p.x() * p.x());
    const double y = p.y() * radial + k[2] * (r2 + 2 * p.y() * p.y()) + 2 * k[3] * p.x() * p.y();
    const Eigen::Vector2d expected(100 + s.focal * x, 75 + s.focal * y);
    EXPECT_NEAR((s.middle_of_red(expected, 9) - expected).norm(), 0, 0.2) << p.transpose();
  }
}

TEST(ACameraWithALens, ReadsTheDepthOfAPlaneAcrossItAllOver) {
  Studio s;
  s.put("wall", Shape::box({0.2, 20, 20}), {{2.1, 0, 1}, Quat::Identity()});
  s.set_up({{"distortion", std::vector<double>{-0.25, 0.08, 0, 0, 0}}});
  s.run_for(0.005);
  for (const float d : s.world().values(s.camera, keys::camera_depth)) EXPECT_NEAR(double(d), 2, 1e-4);
}

TEST(ARollingShutter, SlantsAPostThatTheCameraTurnsPast) {
  const double turn = 2, time = 0.05;
  Studio s;
  const ObjectId post = s.put("post", Shape::box({0.1, 0.1, 10}), {{4, 0, 1}, Quat::Identity()});
  s.set_up({{"rolling_shutter", time}, {"shutter_slices", std::int64_t(50)}});
  s.world().value(s.carrier->base(), keys::command_twist) = {{0, 0, 0}, {0, 0, turn}};
  s.run_for(0.105);  // pictures at 0 and 0.1 s
  const double yaw = 2 * std::atan2(s.world().value(s.carrier->base(), keys::pose).orientation.z(),
                                    s.world().value(s.carrier->base(), keys::pose).orientation.w());
  ASSERT_NEAR(yaw, turn * 0.1, 0.021);
  for (const std::uint32_t row : {5u, 75u, 145u}) {
    double sum = 0;
    int count = 0;
    for (std::uint32_t column = 0; column < width; ++column)
      if (s.label(column, row) == post) sum += column + 0.5, ++count;
    ASSERT_GT(count, 0) << row;
    const double at = turn * 0.1 - turn * time * (1 - (row + 0.5) / height);  // direction of the camera at that time
    EXPECT_NEAR(sum / count, 100 + s.focal * std::tan(at), 1.2) << "row " << row;
  }
}

TEST(ARollingShutter, ChangesNothingWhileTheCameraStands) {
  std::vector<std::uint8_t> pictures[2];
  for (const double time : {0.0, 0.05}) {
    Studio s;
    s.put("box", Shape::box({1, 1, 1}), {{4, 0.5, 1}, from_rpy(0.2, 0.3, 0.4)});
    s.add_ground();
    s.set_up({{"rolling_shutter", time}});
    s.run_for(0.005);
    const auto image = s.world().values(s.camera, keys::camera_image);
    pictures[time > 0].assign(image.begin(), image.end());
  }
  int differ = 0;
  for (std::size_t i = 0; i < pictures[0].size(); ++i) differ += std::abs(pictures[0][i] - pictures[1][i]) > 4;
  EXPECT_LT(differ, int(pictures[0].size()) / 500) << "slices meet";
}

TEST(ACameraWithNoise, HasOtherNoiseInEachImageButTheSameInTwoRuns) {
  const auto run = [](double seconds) {
    Studio s;
    s.put("wall", Shape::box({0.2, 20, 20}), {{2.1, 0, 1}, Quat::Identity()});
    s.set_up({{"noise", 0.02}});
    s.run_for(seconds);
    const auto image = s.world().values(s.camera, keys::camera_image);
    return std::vector<std::uint8_t>(image.begin(), image.end());
  };
  EXPECT_EQ(run(0.005), run(0.005));
  EXPECT_NE(run(0.005), run(0.105));
}

TEST(ACameraWithALens, TellsWhatIsWrong) {
  Studio s;
  std::string said;
  try {
    s.set_up({{"width", std::int64_t(8000)},
              {"height", std::int64_t(10)},
              {"intrinsics", std::vector<double>{1600, 1600, 4000, 5}},
              {"distortion", std::vector<double>{-0.02, 0, 0, 0, 0}}});
  } catch (const SetupError& e) {
    said = e.what();
  }
  EXPECT_NE(said.find("at most 8192 either way"), std::string::npos) << said;
}

}  // namespace
}  // namespace muro
