// SPDX-License-Identifier: MIT
// Pictures on surfaces, and the materials of mesh files, seen by a camera.
#include <gtest/gtest.h>
#include <png.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

/// Writes a picture of four quarters, rows from the top: red, green; blue, white.
std::string quarters(const test::ScratchFolder& folder) {
  constexpr std::uint32_t side = 16;
  std::vector<std::uint8_t> rgb;
  for (std::uint32_t row = 0; row < side; ++row)
    for (std::uint32_t column = 0; column < side; ++column) {
      const bool right = column >= side / 2, low = row >= side / 2;
      const std::uint8_t white = right && low ? 255 : 0;
      rgb.push_back(!right && !low ? 255 : white);
      rgb.push_back(right && !low ? 255 : white);
      rgb.push_back(!right && low ? 255 : white);
    }
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = side;
  image.format = PNG_FORMAT_RGB;
  const std::string path = folder.path("quarters.png");
  png_image_write_to_file(&image, path.c_str(), 0, rgb.data(), 0, nullptr);
  return path;
}

/// A camera at (0, 0, 1), and the colours that it sees in the middles of the four quarters of an object straight ahead.
struct Studio : test::Scene {
  ObjectId camera;
  std::string warnings;

  Studio() {
    const RobotView& carrier =
        add("carrier", test::tree_of([](RobotBuilder& b) { b.base("body"); }), {{0, 0, 1}, Quat::Identity()});
    camera = add_sensor_object(carrier, "camera", carrier.base());
  }
  void look_at(const Shape& shape, const Pose& at) {
    world().add_scenery("thing", at, {}, std::span<const Shape>(&shape, 1));
    set_log([this](LogLevel level, std::string_view text) {
      if (level == LogLevel::warning) warnings += text;
    });
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("camera.opengl", 10, {{world().robots()[0], camera}},
        {{"width", std::int64_t(100)},
         {"height", std::int64_t(100)},
         {"intrinsics", std::vector<double>{100, 100, 50, 50}},
         {"device", std::string("software")}});
    build();
    run_for(0.005);
  }
  /// Returns the colour of a pixel: "red", "green", "blue" or "white".
  std::string color(std::uint32_t column, std::uint32_t row) {
    const std::uint8_t* p = &world().values(camera, keys::camera_image)[3 * (row * 100 + column)];
    const int most = std::max({p[0], p[1], p[2]}), least = std::min({p[0], p[1], p[2]});
    if (most - least < 40) return "white";
    return p[0] == most ? "red" : p[1] == most ? "green" : "blue";
  }
  void expect_quarters() {
    EXPECT_EQ(color(35, 35), "red");
    EXPECT_EQ(color(65, 35), "green");
    EXPECT_EQ(color(35, 65), "blue");
    EXPECT_EQ(color(65, 65), "white");
  }
};

TEST(APictureOnABox, StandsUprightOnEachOfItsSides) {
  const test::ScratchFolder folder;
  for (const double yaw : {0.0, M_PI / 2, M_PI, -M_PI / 2}) {
    Studio s;
    Shape box = Shape::box({2, 2, 2});
    box.texture = s.world().intern(quarters(folder));
    box.color = {1, 1, 1, 1};
    box.material_source = MaterialSource::model;
    s.look_at(box, {{3, 0, 1}, from_rpy(0, 0, yaw)});
    s.expect_quarters();
  }
}

TEST(APictureOnABox, IsLeftOutWithAWarningWhereItCannotBeRead) {
  const test::ScratchFolder folder;
  Studio s;
  Shape box = Shape::box({2, 2, 2});
  box.texture = s.world().intern(folder.file("broken.png", "no picture"));
  s.look_at(box, {{3, 0, 1}, Quat::Identity()});
  EXPECT_NE(s.warnings.find("broken.png cannot be read"), std::string::npos) << s.warnings;
  EXPECT_NE(s.warnings.find("what it covers is plain"), std::string::npos);
}

TEST(APictureOnABox, IsLeftOutWhereItClaimsMorePixelsThanThereCanBe) {
  using namespace std::string_literals;
  const test::ScratchFolder folder;
  Studio s;
  Shape box = Shape::box({2, 2, 2});
  // the head of a PNG file: 20000 x 16 pixels of four bytes
  box.texture = s.world().intern(
      folder.file("huge.png", "\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\x4e\x20\0\0\0\x10\x08\x06\0\0\0\0\0\0\0"s));
  s.look_at(box, {{3, 0, 1}, Quat::Identity()});
  EXPECT_NE(s.warnings.find("huge.png has 20000 x 16 pixels, and may have 16384 in each direction; make it smaller; "
                            "what it covers is plain"),
            std::string::npos)
      << s.warnings;
}

TEST(AMesh, ThatCannotBeReadIsNotDrawnWithOneWarning) {
  const test::ScratchFolder folder;
  Studio s;
  const std::string path = folder.file("broken.obj", "no mesh");
  for (const double scale : {1.0, 2.0}) {
    const Shape mesh{.kind = ShapeKind::mesh, .mesh = s.world().intern(path), .size = Vec3::Constant(scale)};
    s.world().add_scenery("scale " + std::to_string(int(scale)), {}, {}, std::span<const Shape>(&mesh, 1));
  }
  s.look_at(Shape::box({2, 2, 2}), {{3, 0, 1}, Quat::Identity()});
  EXPECT_NE(s.warnings.find("`scale 1`: mesh " + path + " cannot be read"), std::string::npos) << s.warnings;
  EXPECT_TRUE(s.warnings.ends_with("; it is not drawn")) << s.warnings;
  EXPECT_EQ(s.warnings.find("scale 2"), std::string::npos) << s.warnings;
}

TEST(AMesh, ThatIsDrawnForItCollidesAndCannotBeReadIsAnError) {
  const test::ScratchFolder folder;
  Studio s;
  const std::string path = folder.file("broken.obj", "no mesh");
  const Shape mesh{.kind = ShapeKind::mesh, .mesh = s.world().intern(path), .size = Vec3::Ones()};
  s.world().add_scenery("rock", {}, std::span<const Shape>(&mesh, 1));
  try {
    s.look_at(Shape::box({2, 2, 2}), {{3, 0, 1}, Quat::Identity()});
    ADD_FAILURE();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("`rock`: mesh " + path + " cannot be read"), std::string::npos) << e.what();
  }
}

/// A square of 2 m at x = 0 that faces -x, in OBJ with its material, or in glTF.
struct Square {
  test::ScratchFolder folder;

  std::string obj(const std::string& material) const {
    folder.file("square.mtl", "newmtl paint\n" + material);
    return folder.file("square.obj",
                       "mtllib square.mtl\nusemtl paint\nv 0 1 -1\nv 0 -1 -1\nv 0 -1 1\nv 0 1 1\n"
                       "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn -1 0 0\nf 1/1/1 4/4/1 3/3/1\nf 1/1/1 3/3/1 2/2/1\n");
  }
};

Shape mesh_of(Studio& s, const std::string& path) {
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.size = Vec3::Ones();
  mesh.mesh = s.world().intern(path);
  return mesh;
}

TEST(AMesh, HasThePictureOfItsMaterial) {
  const Square square;
  quarters(square.folder);
  Studio s;
  s.look_at(mesh_of(s, square.obj("Kd 1 1 1\nmap_Kd quarters.png\n")), {{2, 0, 1}, Quat::Identity()});
  EXPECT_EQ(s.warnings, "");
  s.expect_quarters();
}

TEST(AMesh, HasTheColourOfItsMaterialUnlessTheModelSaysAnother) {
  const Square square;
  for (const bool model : {false, true}) {
    Studio s;
    Shape mesh = mesh_of(s, square.obj("Kd 0 0 1\n"));
    if (model) {
      mesh.color = {1, 0, 0, 1};
      mesh.material_source = MaterialSource::model;
    }
    s.look_at(mesh, {{2, 0, 1}, Quat::Identity()});
    EXPECT_EQ(s.color(50, 50), model ? "red" : "blue");
  }
}

TEST(AMesh, WhosePictureIsMissingHasItsColourAndIsTold) {
  const Square square;
  Studio s;
  s.look_at(mesh_of(s, square.obj("Kd 0 0 1\nmap_Kd gone.png\n")), {{2, 0, 1}, Quat::Identity()});
  EXPECT_NE(s.warnings.find("its picture `gone.png` is not there"), std::string::npos) << s.warnings;
  EXPECT_EQ(s.color(50, 50), "blue");
}

TEST(AMesh, HasThePictureThatTheModelGivesIt) {
  const Square square;
  Studio s;
  Shape mesh = mesh_of(s, square.obj("Kd 0 0 1\n"));
  mesh.texture = s.world().intern(quarters(square.folder));
  mesh.color = {1, 1, 1, 1};
  mesh.material_source = MaterialSource::model;
  s.look_at(mesh, {{2, 0, 1}, Quat::Identity()});
  s.expect_quarters();
}

}  // namespace
}  // namespace muro
