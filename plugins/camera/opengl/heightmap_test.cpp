// SPDX-License-Identifier: MIT
// Ground from heightmap files, seen by a camera.
#include <gtest/gtest.h>

#include <functional>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/image_file/png.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

constexpr int pixels = 100;

/// A camera with a field of view of 90 degrees and no shadows, and the objects in view.
struct Outdoors : test::Scene {
  ObjectId camera;
  test::ScratchFolder folder;
  std::string warnings;

  explicit Outdoors(const Pose& at) {
    const RobotView& carrier = add("carrier", test::tree_of([](RobotBuilder& b) { b.base("body"); }), at);
    camera = add_sensor_object(carrier, "camera", carrier.base());
  }
  /// Returns a heightmap around the origin, with heights of 0 to 1 of size.z.
  Shape heightmap(std::uint32_t nodes, const Vec3& size, const std::function<double(double, double)>& height) {
    std::vector<std::uint16_t> values;
    for (std::uint32_t row = nodes; row-- > 0;)
      for (std::uint32_t column = 0; column < nodes; ++column) {
        const double x = double(column) / (nodes - 1) - 0.5, y = double(row) / (nodes - 1) - 0.5;
        values.push_back(std::uint16_t(std::lround(65535 * height(x * size.x(), y * size.y()) / size.z())));
      }
    const std::string path = folder.path("hills.png");
    image_file::write_png(path, image_file::Format::grey16, nodes, nodes, values.data());
    Shape shape{.kind = ShapeKind::heightmap, .mesh = world().intern(path), .size = size};
    shape.color = {0.6, 0.6, 0.6, 1};
    return shape;
  }
  ObjectId put(const char* name, const Shape& shape, const Pose& at = {}) {
    return world().add_scenery(name, at, {}, std::span<const Shape>(&shape, 1));
  }
  void shoot() {
    set_log([this](LogLevel level, std::string_view text) {
      if (level == LogLevel::warning) warnings += text;
    });
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("camera.opengl", 10, {{world().robots()[0], camera}},
        {{"width", std::int64_t(pixels)},
         {"height", std::int64_t(pixels)},
         {"intrinsics", std::vector<double>{50, 50, 50, 50}},
         {"depth", true},
         {"labels", true},
         {"device", std::string("software")}});
    build();
    run_for(0.005);
  }
  Vec3 color(int column, int row) {
    const std::uint8_t* p = &world().values(camera, keys::camera_image)[std::size_t(3 * (row * pixels + column))];
    return {double(p[0]), double(p[1]), double(p[2])};
  }
  double depth(int column, int row) {
    return double(world().values(camera, keys::camera_depth)[std::size_t(row * pixels + column)]);
  }
  ObjectId label(int column, int row) {
    return world().values(camera, keys::camera_labels)[std::size_t(row * pixels + column)];
  }
};

const Quat looking_down = from_rpy(0, M_PI / 2, 0);  // the upper side of the picture is at +x

TEST(AHeightmapInAPicture, IsAsFarAwayAsItsHeightsSayAlsoWith1025NodesEachWay) {
  for (const std::uint32_t nodes : {65u, 1025u}) {
    Outdoors s({{0, 0, 20}, looking_down});
    const ObjectId hills =
        s.put("hills", s.heightmap(nodes, {64, 64, 16}, [](double x, double y) { return 8 + x / 8 - y / 8; }));
    s.shoot();
    EXPECT_EQ(s.warnings, "");
    for (int row = 5; row < pixels; row += 15)
      for (int column = 5; column < pixels; column += 15) {
        // through the middle of the pixel: -y to the right, +x up
        const double right = (column + 0.5 - 50) / 50, up = (50 - row - 0.5) / 50;
        const double exact = (20 - 8) / (1 + up / 8 + right / 8);
        EXPECT_NEAR(s.depth(column, row), exact, 2e-3) << column << ", " << row;
        EXPECT_EQ(s.label(column, row), hills);
      }
  }
}

TEST(AHeightmapInAPicture, IsLitAsATiltedPlateIs) {
  const Quat tilt = from_rpy(0, std::atan(0.5), 0);  // down towards +x
  const auto shade = [&](bool heightmap) {
    Outdoors s({{0, 0, 20}, looking_down});
    if (heightmap) {
      s.put("ground", s.heightmap(33, {16, 16, 8}, [](double x, double) { return 4 - x / 2; }));
    } else {
      Shape plate = Shape::box({30, 30, 0.1});
      plate.color = {0.6, 0.6, 0.6, 1};
      s.put("ground", plate, {Vec3(0, 0, 4) - tilt * Vec3(0, 0, 0.05), tilt});
    }
    s.shoot();
    return s.color(50, 50);
  };
  const Vec3 ground = shade(true), plate = shade(false);
  EXPECT_LT((ground - plate).cwiseAbs().maxCoeff(), 2.5) << ground.transpose() << " and " << plate.transpose();
}

TEST(AHeightmapInAPicture, IsSmoothOverItsCells) {
  // the cap of a ball with cells of 2 m: colours change little from pixel to pixel, without visible facets
  Outdoors s({{0, 0, 30}, looking_down});
  s.put("cap", s.heightmap(17, {32, 32, 16}, [](double x, double y) { return std::sqrt(625 - x * x - y * y) - 10; }));
  s.shoot();
  double most = 0, across = 0;
  for (int column = 20; column < 80; ++column) {
    most = std::max(most, (s.color(column + 1, 40) - s.color(column, 40)).norm());
    across = std::max(across, (s.color(column, 40) - s.color(20, 40)).norm());
  }
  EXPECT_GT(across, 20);
  EXPECT_LT(most, 0.12 * across);
}

TEST(AHeightmapInAPicture, HasWallsBelowItsRim) {
  Outdoors s({{-20, 0, 3}, Quat::Identity()});
  const ObjectId block = s.put("block", s.heightmap(5, {20, 20, 8}, [](double x, double) { return x < -4 ? 8 : 0; }));
  s.shoot();
  EXPECT_EQ(s.label(50, 50), block);
  EXPECT_NEAR(s.depth(50, 50), 10, 1e-2);
  EXPECT_EQ(s.label(50, 20), no_object) << "above it";
}

TEST(AHeightmapInAPicture, HasATextureOverItOnceWithTheUpperSideAtPlusY) {
  Outdoors s({{0, 0, 12}, from_rpy(0, M_PI / 2, 0) * from_rpy(M_PI / 2, 0, 0)});
  Shape field = s.heightmap(9, {20, 20, 2}, [](double, double) { return 1; });
  // red, green; blue, white
  const std::uint8_t quarters[] = {255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255};
  const std::string path = s.folder.path("quarters.png");
  image_file::write_png(path, image_file::Format::rgb8, 2, 2, quarters);
  field.texture = s.world().intern(path);
  field.color = {1, 1, 1, 1};
  s.put("field", field);
  s.shoot();
  EXPECT_EQ(s.warnings, "");
  const auto strongest = [&](double x, double y) {
    for (int row = 0; row < pixels; ++row)
      for (int column = 0; column < pixels; ++column) {
        // the point of the field that the pixel shows
        const Vec3 ray((column + 0.5 - 50) / 50, (row + 0.5 - 50) / 50, 1);  // right, down, ahead
        const Pose& at = s.world().value(s.world().robots()[0]->base(), keys::pose);
        const Vec3 d = at.orientation * Vec3(ray.z(), -ray.x(), -ray.y());
        const Vec3 point = at.position - d * ((at.position.z() - 1) / d.z());
        if ((point.head<2>() - Eigen::Vector2d(x, y)).norm() > 0.3) continue;
        const Vec3 c = s.color(column, row);
        if (c.maxCoeff() - c.minCoeff() < 40) return std::string("white");
        return std::string(c.x() == c.maxCoeff() ? "red" : c.y() == c.maxCoeff() ? "green" : "blue");
      }
    return std::string("not in the picture");
  };
  EXPECT_EQ(strongest(-5, 5), "red");
  EXPECT_EQ(strongest(5, 5), "green");
  EXPECT_EQ(strongest(-5, -5), "blue");
  EXPECT_EQ(strongest(5, -5), "white");
}

TEST(AHeightmapInAPicture, ThatCannotBeReadIsLeftOutWithAWarning) {
  Outdoors s({{0, 0, 20}, looking_down});
  const std::string path = s.folder.file("broken.png", "no picture");
  s.put("hills", {.kind = ShapeKind::heightmap, .mesh = s.world().intern(path), .size = {10, 10, 1}});
  s.shoot();
  EXPECT_NE(s.warnings.find("`hills`: heightmap " + path), std::string::npos) << s.warnings;
  EXPECT_TRUE(s.warnings.ends_with("; it is not drawn")) << s.warnings;
}

}  // namespace
}  // namespace muro
