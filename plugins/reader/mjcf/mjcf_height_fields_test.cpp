// SPDX-License-Identifier: MIT
// Height fields.
#include "plugins/common/heightmap/heightmap_values.hpp"
#include "plugins/common/image_file/png.hpp"
#include "reading_testing.hpp"

namespace muro::mjcf {
namespace {

using test::ScratchFolder;

/// Returns a height field in MuJoCo's binary format.
std::string binary(std::int32_t rows, std::int32_t columns, const std::vector<float>& values) {
  std::string bytes(8 + 4 * values.size(), '\0');
  std::memcpy(bytes.data(), &rows, 4);
  std::memcpy(bytes.data() + 4, &columns, 4);
  std::memcpy(bytes.data() + 8, values.data(), 4 * values.size());
  return bytes;
}

/// Returns a file with a geom `hills` of this height field in line 4, and a ball that can move.
std::string hills_yard(const std::string& field) {
  return "<mujoco><compiler meshdir='land'/>\n<asset>" + field +
         "</asset><worldbody>\n<body name='ball' pos='0 0 5'><freejoint/><geom size='0.1'/></body>\n<geom "
         "name='hills' type='hfield' hfield='h' pos='1 2 3' euler='0 0 90'/></worldbody></mujoco>";
}

struct HillyWorld {
  WorldModel model;
  Lines problems;
  HillyWorld(const std::string& text, const ScratchFolder& folder) {
    read_world_text(text, folder.path("yard.xml"), model);
    model.close();
    problems = lines_of(model.problems());
  }
  const WorldModel::Scenery& hills() const { return model.scenery().at(0); }
};

/// Returns the largest distance (m) of a node of the shape from MuJoCo's node, in the frame of the geom.
double distance_from_mujoco(const Shape& shape, const std::string& path, const std::string& text,
                            const ScratchFolder& folder) {
  const Compiled compiled = compile(text, folder.path("yard.xml"));
  const mjModel& m = *compiled.model;
  const heightmap::HeightmapFile file = heightmap::read_values(path);
  const Heightmap map = file.heightmap(shape.size);
  EXPECT_EQ(int(map.rows), m.hfield_nrow[0]);
  EXPECT_EQ(int(map.columns), m.hfield_ncol[0]);
  double largest = 0;
  for (int row = 0; row < m.hfield_nrow[0]; ++row)
    for (int column = 0; column < m.hfield_ncol[0]; ++column) {
      // MuJoCo's documentation of hfield: x from -radius_x to radius_x over columns, y over rows, z the elevation
      const Vec3 node(m.hfield_size[0] * (2.0 * column / (m.hfield_ncol[0] - 1) - 1),
                      m.hfield_size[1] * (2.0 * row / (m.hfield_nrow[0] - 1) - 1),
                      m.hfield_size[2] * double(m.hfield_data[row * m.hfield_ncol[0] + column]));
      const Vec3 ours = shape.origin * map.node(std::uint32_t(column), std::uint32_t(row));
      largest = std::max(largest, (ours - node).norm());
    }
  return largest;
}

TEST(MjcfHeightField, OfFloatsIsTheSurfaceThatMuJoCoCompiles) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("land"));
  const std::string path = folder.file("land/hills.bin", binary(2, 3, {-1, 2, 3, 4, 5, 9}));
  const std::string text = hills_yard("<hfield name='h' file='hills.bin' size='2 1 0.5 0.1'/>");
  const HillyWorld world(text, folder);
  EXPECT_EQ(world.problems, Lines{});
  ASSERT_EQ(world.hills().collisions.size(), 1u);
  const Shape& shape = world.hills().collisions[0];
  EXPECT_EQ(shape.kind, ShapeKind::heightmap);
  EXPECT_EQ(world.model.texts()[shape.mesh], path);
  EXPECT_TRUE(shape.size.isApprox(Vec3(4, 2, 0.05), 1e-12)) << shape.size.transpose();
  EXPECT_TRUE(near(world.hills().pose, {{1, 2, 3}, Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitZ()))}));
  EXPECT_LT(distance_from_mujoco(shape, path, text, folder), 1e-6);
}

TEST(MjcfHeightField, OfAPictureIsTheSurfaceThatMuJoCoCompiles) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("land"));
  const std::uint8_t pixels[] = {40, 40, 40, 200, 200, 200, 90, 90, 90, 41, 41, 41};
  const std::string path = folder.path("land/hills.png");
  image_file::write_png(path, image_file::Format::rgb8, 2, 2, pixels);
  const std::string text = hills_yard("<hfield name='h' file='hills.png' size='2 1 0.5 0.1'/>");
  const HillyWorld world(text, folder);
  EXPECT_EQ(world.problems, Lines{});
  EXPECT_LT(distance_from_mujoco(world.hills().collisions.at(0), path, text, folder), 1e-6);
}

TEST(MjcfHeightField, OfSixteenBitsTellsHowFarMuJoCoIsFromIt) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("land"));
  const std::uint16_t pixels[] = {0, 58979, 511, 20000};
  const std::string path = folder.path("land/hills.png");
  image_file::write_png(path, image_file::Format::grey16, 2, 2, pixels);
  const std::string text = hills_yard("<hfield name='h' file='hills.png' size='2 1 255 0.1'/>");
  const HillyWorld world(text, folder);
  // 511 is 0.0087 of the highest value; MuJoCo reads 1 / 230
  EXPECT_TRUE(has_line(world.problems, "note 4: the heights of geom `hills` differ by up to 1.1 m"))
      << joined(world.problems);
  const double distance = distance_from_mujoco(world.hills().collisions.at(0), path, text, folder);
  EXPECT_NEAR(distance, 255 * (511 / 58979.0 - 1 / 230.0), 1e-3);
}

TEST(MjcfHeightField, ThatIsFlatIsABoxAsDeepAsItsBase) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("land"));
  folder.file("land/flat.bin", binary(2, 2, {3, 3, 3, 3}));
  for (const char* field : {"<hfield name='h' nrow='5' ncol='4' size='2 1 0.5 0.1'/>",
                            "<hfield name='h' file='flat.bin' size='2 1 0.5 0.1'/>"}) {
    const HillyWorld world(hills_yard(field), folder);
    EXPECT_EQ(world.problems, Lines{});
    const Shape& shape = world.hills().collisions.at(0);
    EXPECT_EQ(shape.kind, ShapeKind::box);
    EXPECT_EQ(shape.size, Vec3(4, 2, 0.1));
    EXPECT_TRUE(near(shape.origin, {{0, 0, -0.05}, Quat::Identity()}));
  }
}

TEST(MjcfHeightField, WrittenInTheFileIsLeftOutByNameAndTheRestIsRead) {
  const ScratchFolder folder;
  const HillyWorld world(hills_yard("<hfield name='h' nrow='2' ncol='2' elevation='0 1 2 3' size='2 1 0.5 0.1'/>"),
                         folder);
  EXPECT_TRUE(
      has_line(world.problems,
               "lost collision 4: geom `hills` is left out: height field `h` is written in the MJCF itself; save its "
               "values as a grey picture (PNG) and name it as `file`"))
      << joined(world.problems);
  EXPECT_TRUE(world.model.scenery().empty());
  EXPECT_EQ(world.model.models().size(), 1u);
}

TEST(MjcfHeightField, WhoseColoursMuJoCoReadsOtherwiseIsLeftOutByName) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder.path("land"));
  const std::uint8_t pixels[] = {0, 255, 0, 255, 0, 0, 0, 0, 255, 255, 255, 255};
  image_file::write_png(folder.path("land/hills.png"), image_file::Format::rgb8, 2, 2, pixels);
  const HillyWorld world(hills_yard("<hfield name='h' file='hills.png' size='2 1 0.5 0.1'/>"), folder);
  EXPECT_TRUE(has_line(world.problems, "lost collision 4: geom `hills` is left out: MuJoCo reads other heights from `" +
                                           folder.path("land/hills.png") +
                                           "` than muro; save it as a grey picture (PNG) of 8 bits"))
      << joined(world.problems);
}

}  // namespace
}  // namespace muro::mjcf
