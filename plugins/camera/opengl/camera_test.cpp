// SPDX-License-Identifier: MIT
// Pictures of a few bodies at known places, compared with the equations of the pinhole camera.
#include <gtest/gtest.h>

#include <cmath>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;

constexpr std::uint32_t width = 160, height = 120;

Shape painted(Shape shape, double red, double green, double blue) {
  shape.color = {red, green, blue, 1};
  return shape;
}

/// A camera on a robot without shapes, and objects around it.
struct Studio : test::Scene {
  ObjectId camera;
  double focal = 0.5 * width / std::tan(0.5);  ///< px

  explicit Studio(const Pose& at) {
    const RobotView& carrier = add("carrier", test::tree_of([](RobotBuilder& b) { b.base("body"); }), at);
    camera = add_sensor_object(carrier, "camera", carrier.base());
  }
  void put(const char* name, const Shape& shape, const Pose& at) {
    world().add_scenery(name, at, std::span<const Shape>(&shape, 1));
  }
  void shoot(const Parameters& more = {}) {
    Parameters parameters{{"width", std::int64_t(width)},
                          {"height", std::int64_t(height)},
                          {"horizontal_fov", 1.0},
                          {"depth", true},
                          {"labels", true},
                          {"device", "software"}};
    for (const auto& [name, value] : more) parameters[name] = value;
    if (parameters.count("intrinsics")) parameters.erase("horizontal_fov");
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("camera.opengl", 10, {{world().robots()[0], camera}}, parameters);
    build();
    run_for(0.15);
  }
  float depth(std::uint32_t column, std::uint32_t row) {
    return world().values(camera, keys::camera_depth)[row * width + column];
  }
  ObjectId label(std::uint32_t column, std::uint32_t row) {
    return world().values(camera, keys::camera_labels)[row * width + column];
  }
  /// Returns red, green, blue, 0..255.
  Vec3 color(std::uint32_t column, std::uint32_t row) {
    const std::uint8_t* p = &world().values(camera, keys::camera_image)[3 * (row * width + column)];
    return {double(p[0]), double(p[1]), double(p[2])};
  }
  /// Returns the mean column and row of the pixels with this label, in pixels from the corner, and their number.
  std::pair<Eigen::Vector2d, int> middle(ObjectId object) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    int count = 0;
    for (std::uint32_t row = 0; row < height; ++row)
      for (std::uint32_t column = 0; column < width; ++column)
        if (label(column, row) == object) sum += Eigen::Vector2d(column + 0.5, row + 0.5), ++count;
    return {sum / std::max(count, 1), count};
  }
};

TEST(ACamera, SeesAPlaneAtItsDistanceInEveryPixel) {
  const double pitch = 0.4, up = 1.5;
  Studio s({{3, -2, up}, from_rpy(0, pitch, 0.7)});
  s.add_ground();
  s.shoot();
  for (std::uint32_t row = 0; row < height; ++row)
    for (std::uint32_t column = 0; column < width; ++column) {
      const double below = (row + 0.5 - 0.5 * height) / s.focal;  // down, per metre forward
      const double falls = std::sin(pitch) + below * std::cos(pitch);
      if (falls > 0.02) {
        EXPECT_NEAR(s.depth(column, row), up / falls, 2e-5 * up / falls) << column << ", " << row;
      } else if (falls < 0) {
        EXPECT_TRUE(std::isinf(s.depth(column, row)));
        EXPECT_EQ(s.label(column, row), no_object);
      }
    }
}

/// A ball with the angular radius a at an angle t from the axis is seen as an ellipse. Its half axes are f sin a cos a
/// / q along the radius of the picture and f sin a / sqrt q across, its middle is at f sin t cos t / q, with q = cos^2
/// t - sin^2 a.
TEST(ACamera, SeesABallAsTheEllipseThatThePinholeMakesOfIt) {
  const double radius = 0.25;
  for (const Vec3& at : {Vec3(2, 0, 0), Vec3(2, 0.5, 0.3), Vec3(1.7, -0.5, -0.3), Vec3(4, 1.2, -1)}) {
    const Pose stand{{0, 0, 5}, from_rpy(0, 0, 0.5)};
    Studio s(stand);
    s.put("ball", Shape::sphere(radius), {stand * at, Quat::Identity()});
    s.shoot();
    const auto [middle, count] = s.middle(s.world().object("ball"));
    const double f = s.focal, a = std::asin(radius / at.norm()), t = std::acos(at.x() / at.norm());
    const double q = std::cos(t) * std::cos(t) - std::sin(a) * std::sin(a);
    const double out = t > 0 ? f * std::sin(t) * std::cos(t) / q : 0;
    const Eigen::Vector2d way =
        t > 0 ? Eigen::Vector2d(Eigen::Vector2d(-at.y(), -at.z()).normalized()) : Eigen::Vector2d(0, 0);
    EXPECT_NEAR(middle.x(), 0.5 * width + out * way.x(), 0.1) << at.transpose();
    EXPECT_NEAR(middle.y(), 0.5 * height + out * way.y(), 0.1) << at.transpose();
    const double area = M_PI * f * f * std::sin(a) * std::sin(a) * std::cos(a) / std::pow(q, 1.5);
    EXPECT_NEAR(count, area, 0.02 * area) << at.transpose();
  }
}

TEST(ACamera, SeesWhatIsInFront) {
  Studio s({{0, 0, 1}, Quat::Identity()});
  s.put("near", Shape::box({0.2, 1, 1}), {{2.1, 0.5, 1}, Quat::Identity()});
  s.put("far", Shape::box({0.2, 4, 4}), {{5.1, 0, 1}, Quat::Identity()});
  s.put("behind", Shape::box({1, 1, 1}), {{-2, 0, 1}, Quat::Identity()});
  s.shoot();
  EXPECT_EQ(s.label(width / 2 - 5, height / 2), s.world().object("near"));
  EXPECT_NEAR(s.depth(width / 2 - 5, height / 2), 2, 1e-5);
  EXPECT_EQ(s.label(width / 2 + 5, height / 2), s.world().object("far"));
  EXPECT_NEAR(s.depth(width / 2 + 5, height / 2), 5, 1e-5);
  EXPECT_EQ(s.middle(s.world().object("behind")).second, 0);
}

TEST(ACamera, TakesIntrinsicsAsTheyAre) {
  const Vec3 at(2, 0.3, 0.2);
  Studio s({{0, 0, 1}, Quat::Identity()});
  s.put("ball", Shape::sphere(0.05), {Vec3(0, 0, 1) + at, Quat::Identity()});
  s.shoot({{"intrinsics", std::vector<double>{150, 120, 60, 70}}});
  const auto [middle, count] = s.middle(s.world().object("ball"));
  EXPECT_NEAR(middle.x(), 60 - 150 * at.y() / at.x(), 0.1);
  EXPECT_NEAR(middle.y(), 70 - 120 * at.z() / at.x(), 0.1);
  EXPECT_GT(count, 30);
}

TEST(ACamera, SeesEveryKindOfShapeAtItsDistance) {
  const std::pair<Shape, double> shapes[] = {{Shape::box({1, 1, 1}), 2.5},
                                             {Shape::sphere(0.5), 2.5},
                                             {Shape::cylinder(0.5, 1), 2.5},
                                             {Shape::capsule(0.5, 1), 2.5},
                                             {Shape::plane(), 3}};
  for (const auto& [shape, distance] : shapes) {
    Studio s({{0, 0, 1}, Quat::Identity()});
    const bool plane = shape.kind == ShapeKind::plane;
    s.put("thing", shape, {{3, 0, 1}, plane ? from_rpy(0, -M_PI / 2, 0) : from_rpy(0, 0, M_PI)});
    s.shoot();
    EXPECT_NEAR(s.depth(width / 2, height / 2), distance, 2e-3) << int(shape.kind);
    EXPECT_EQ(s.label(width / 2, height / 2), s.world().object("thing"));
  }
}

TEST(ACamera, SeesColoursTheSkyAndShadows) {
  Studio s({{0, 0, 3}, from_rpy(0, 0.45, 0)});
  s.add_ground();
  s.put("red", painted(Shape::box({1, 1, 1}), 0.9, 0.1, 0.1), {{5, 0, 0.5}, Quat::Identity()});
  s.put("roof", Shape::box({3, 3, 0.2}), {{6.5, 6, 4}, Quat::Identity()});
  s.shoot();
  const auto [red, pixels] = s.middle(s.world().object("red"));
  ASSERT_GT(pixels, 50);
  const Vec3 paint = s.color(std::uint32_t(red.x()), std::uint32_t(red.y()));
  EXPECT_GT(paint.x(), 2 * paint.y());
  const Vec3 sky = s.color(2, 0);
  EXPECT_GT(sky.z(), sky.x()) << "blue";
}

TEST(ACamera, SeesGroundDarkerInShadow) {
  const auto ground_below_roof = [](bool shadows) {
    Studio s({{-4, 0, 2}, from_rpy(0, 0.45, 0)});
    s.add_ground();
    s.put("roof", Shape::box({6, 12, 0.1}), {{0, 0, 2.5}, Quat::Identity()});
    s.shoot({{"shadows", shadows}});
    return s.color(width / 2, height / 2).sum();
  };
  EXPECT_LT(ground_below_roof(true), 0.75 * ground_below_roof(false));
}

TEST(ACamera, TakesTheSamePictureTwice) {
  const auto picture = [] {
    Studio s({{0, 0, 1}, from_rpy(0, 0.2, 0.3)});
    s.add_ground();
    s.put("box", Shape::box({1, 1, 1}), {{4, 1, 0.5}, from_rpy(0, 0, 0.3)});
    s.shoot();
    return s.state_hash();
  };
  EXPECT_EQ(picture(), picture());
}

TEST(ACamera, TellsWhatIsWrong) {
  const auto complaint = [](const Parameters& more) -> std::string {
    Studio s({});
    try {
      s.shoot(more);
    } catch (const SetupError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(complaint({{"near", 2.0}, {"far", 1.0}}).find("near (2 m) must be less than far"), std::string::npos);
  EXPECT_NE(complaint({{"intrinsics", std::vector<double>{1, 2, 3}}}).find("four numbers"), std::string::npos);
}

}  // namespace
}  // namespace muro
