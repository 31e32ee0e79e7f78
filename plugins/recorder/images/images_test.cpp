// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/picture.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t width = 40, height = 30;

/// A camera 2 m in front of a wall.
struct Scene : test::Scene {
  ObjectId camera;
  Scene() {
    const RobotView& carrier = add("carrier", test::tree_of([](RobotBuilder& b) { b.base("body"); }));
    camera = add_sensor_object(carrier, "camera", carrier.base());
    const Shape wall = Shape::box({0.2, 50, 50});
    world().add_scenery("wall", {{2.1, 0, 0}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("camera.opengl", 10, {{&carrier, camera}},
        {{"width", std::int64_t(width)}, {"height", std::int64_t(height)}, {"depth", true}, {"device", "software"}});
  }
  void record(std::map<std::string, ParameterInput> parameters) {
    use("recorder.images", 5, {}, std::move(parameters));
    build();
  }
};

TEST(Images, AreThePixelsThatTheCameraSaw) {
  const test::ScratchFolder folder;
  Scene s;
  s.record({{"folder", folder.path("pictures")}});
  s.run_for(0.5);
  std::set<std::string> names;
  for (const auto& f : fs::directory_iterator(folder.path("pictures"))) names.insert(f.path().filename());
  EXPECT_EQ(names,
            (std::set<std::string>{"carrier_camera_00000.000000.png", "carrier_camera_00000.200000.png",
                                   "carrier_camera_00000.400000.png", "carrier_camera_depth_00000.000000.png",
                                   "carrier_camera_depth_00000.200000.png", "carrier_camera_depth_00000.400000.png"}));
  const auto rgb = test::Picture<>(folder.path("pictures/carrier_camera_00000.400000.png")).values;
  const auto seen = s.world().values(s.camera, keys::camera_image);
  ASSERT_EQ(rgb.size(), seen.size());
  EXPECT_TRUE(std::equal(rgb.begin(), rgb.end(), seen.begin()));
}

TEST(Images, OfDepthAreMillimetres) {
  const test::ScratchFolder folder;
  Scene s;
  s.record({{"folder", folder.path("pictures")}, {"cameras", std::vector<std::string>{"carrier/camera"}}});
  s.run_for(0.1);
  const auto grey = test::Picture<std::uint16_t>(folder.path("pictures/carrier_camera_depth_00000.000000.png")).values;
  ASSERT_EQ(grey.size(), std::size_t(width) * height);
  for (const std::uint16_t value : grey) EXPECT_EQ(value, 2000);
}

TEST(Images, RawAreTheBytesOfTheProperties) {
  const test::ScratchFolder folder;
  Scene s;
  s.record({{"folder", folder.path("pictures")}, {"format", std::string("raw")}});
  s.run_for(0.1);
  const std::string image = test::text_of(folder.path("pictures/carrier_camera_00000.000000.rgb8"));
  const auto seen = s.world().values(s.camera, keys::camera_image);
  ASSERT_EQ(image.size(), seen.size());
  EXPECT_EQ(image.compare(0, image.size(), reinterpret_cast<const char*>(seen.data()), seen.size()), 0);
  EXPECT_EQ(test::text_of(folder.path("pictures/carrier_camera_depth_00000.000000.f32")).size(),
            sizeof(float) * width * height);
}

TEST(Images, OfACameraThatIsNotThereAreAnError) {
  Scene s;
  try {
    s.record({{"folder", "nowhere"}, {"cameras", std::vector<std::string>{"carrier/camer"}}});
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("no camera `carrier/camer`"), std::string::npos) << e.what();
  }
}

TEST(Images, OfCamerasWhoseFilesWouldBeOneAreAnError) {
  const test::ScratchFolder folder;
  Scene s;
  const RobotView& other = s.add("carrier_camera", test::tree_of([](RobotBuilder& b) { b.base("body"); }));
  // the depths of carrier/camera, and the colours of carrier_camera/depth
  const ObjectId camera = s.add_sensor_object(other, "depth", other.base());
  s.use("motion.point", 50, {{&other, other.base()}});
  s.use("camera.opengl", 10, {{&other, camera}}, {{"device", "software"}});
  const std::string told = test::complaint_of([&] { s.record({{"folder", folder.path("pictures")}}); });
  EXPECT_SAYS(told, " write to one file, " + folder.path("pictures/carrier_camera_depth_#.png"));
  EXPECT_FALSE(fs::exists(folder.path("pictures")));
}

}  // namespace
}  // namespace muro
