// SPDX-License-Identifier: MIT
// Heightmaps.
#include "plugins/common/heightmap/heightmap_values.hpp"
#include "plugins/common/image_file/png.hpp"
#include "reading_testing.hpp"

namespace muro::sdf {
namespace {

using test::ScratchFolder;

/// A picture of 3 x 2 pixels with a brightest pixel of half white, and its folder.
struct Hills {
  ScratchFolder folder;
  std::string path = folder.path("hills.png");
  Hills() {
    const std::uint16_t pixels[] = {0, 16384, 32768, 8192, 32768, 4096};
    image_file::write_png(path, image_file::Format::grey16, 3, 2, pixels);
  }
};

struct HillyWorld {
  WorldModel model;
  Lines problems;
};

/// Returns a world with a ball and a model `land` in line 2; `inside` is in its link, in line 3.
HillyWorld hilly_world(const std::string& inside, const std::string& folder) {
  HillyWorld out;
  read_world_text("<sdf version='1.9'><world name='w'>\n<model name='land'><static>1</static><link name='l'>\n" +
                      inside + "\n</link></model><model name='ball'>" + link("b") + "</model></world></sdf>",
                  folder, out.model);
  out.model.close();
  out.problems = lines_of(out.model.problems());
  return out;
}

std::string hills_collision(const std::string& inside) {
  return "<collision name='c'><geometry><heightmap>" + inside + "</heightmap></geometry></collision>";
}

TEST(SdfHeightmap, OfAStaticModelIsAsHighAsGazeboMakesIt) {
  const Hills hills;
  const HillyWorld world =
      hilly_world(hills_collision("<uri>hills.png</uri><size>20 10 4</size><pos>1 2 0.5</pos>"), hills.folder.path(""));
  EXPECT_EQ(world.problems, Lines{});
  ASSERT_EQ(world.model.scenery().size(), 1u);
  const Shape shape = world.model.scenery()[0].collisions.at(0);
  EXPECT_EQ(shape.kind, ShapeKind::heightmap);
  EXPECT_EQ(world.model.texts()[shape.mesh], hills.path);
  EXPECT_EQ(shape.origin.position, Vec3(1, 2, 0.5));
  // Gazebo: black is 0, the brightest pixel has the height of the file, the upper row is at +y
  const heightmap::HeightmapFile file = heightmap::read_values(hills.path);
  const Heightmap map = file.heightmap(shape.size);
  const double expected[2][3] = {{1, 4, 0.5}, {0, 2, 4}};
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t column = 0; column < 3; ++column)
      EXPECT_TRUE(map.node(column, row).isApprox(Vec3(10.0 * column - 10, 10.0 * row - 5, expected[row][column]), 1e-6))
          << map.node(column, row).transpose();
}

TEST(SdfHeightmap, IsOneMetreInEachDirectionWhereTheFileSaysNoSize) {
  const Hills hills;
  const HillyWorld world = hilly_world(hills_collision("<uri>file://hills.png</uri>"), hills.folder.path(""));
  EXPECT_EQ(world.problems, Lines{});
  const Shape shape = world.model.scenery().at(0).collisions.at(0);
  EXPECT_NEAR(shape.size.z(), 65535 / 32768.0, 1e-6);
  EXPECT_EQ(shape.size.head<2>(), Eigen::Vector2d(1, 1));
}

TEST(SdfHeightmap, ThatIsSeenHasItsFirstTextureAndTheRestIsNamed) {
  const Hills hills;
  hills.folder.file("grass.png", "");
  const std::string texture = "<texture><size>2</size><diffuse>grass.png</diffuse><normal>n.png</normal></texture>";
  const HillyWorld world =
      hilly_world("<visual name='v'><geometry><heightmap><uri>hills.png</uri><sampling>2</sampling>" + texture +
                      "\n<texture><diffuse>rock.png</diffuse></texture>\n<blend/>" + "</heightmap></geometry></visual>",
                  hills.folder.path(""));
  const std::string only = "note 4:1 a heightmap has one texture, and 1 other is left out";
  EXPECT_NE(std::find(world.problems.begin(), world.problems.end(), only), world.problems.end())
      << testing::PrintToString(world.problems);
  EXPECT_EQ(without_notes(world.problems), Lines{});
  for (const char* part : {"<blend> in <heightmap> is left out", "<sampling> in <heightmap> is left out",
                           "<normal> in <texture> is left out"})
    EXPECT_NE(testing::PrintToString(world.problems).find(part), std::string::npos) << part;
  const Shape shape = world.model.scenery().at(0).visuals.at(0);
  EXPECT_EQ(shape.kind, ShapeKind::heightmap);
  EXPECT_EQ(world.model.texts()[shape.texture], hills.folder.path("grass.png"));
  EXPECT_EQ(shape.material_source, MaterialSource::model);
  EXPECT_EQ(shape.color, Eigen::Vector4d(1, 1, 1, 1));
}

TEST(SdfHeightmap, ThatIsNotThereIsNamedWithItsLineAndTheRestLoads) {
  const Hills hills;
  const HillyWorld world =
      hilly_world(hills_collision("\n<uri>gone.png</uri>") + "<collision name='d'><geometry><box><size>1 1 " +
                      "1</size></box></geometry></collision>",
                  hills.folder.path(""));
  EXPECT_EQ(world.problems,
            Lines{"lost collision 4:1 heightmap `gone.png` is not found and left out, so that nothing touches "
                  "it; looked for " +
                  hills.folder.path("gone.png") + "; correct its path"});
  ASSERT_EQ(world.model.scenery().size(), 1u);
  EXPECT_EQ(world.model.scenery()[0].collisions.size(), 1u);
  EXPECT_EQ(world.model.models().size(), 1u);
}

TEST(SdfHeightmap, ThatCannotBeReadIsNamedWithItsLineAndTheRestLoads) {
  const Hills hills;
  hills.folder.file("torn.png", "no picture");
  hills.folder.file("land.tif", "II*");
  for (const std::string name : {"torn.png", "land.tif"}) {
    const HillyWorld world = hilly_world(hills_collision("\n<uri>" + name + "</uri>"), hills.folder.path(""));
    ASSERT_EQ(world.problems.size(), 1u) << testing::PrintToString(world.problems);
    EXPECT_TRUE(world.problems[0].starts_with("lost collision 4:1 heightmap " + hills.folder.path(name) + " has "))
        << world.problems[0];
    EXPECT_NE(world.problems[0].find("neither a picture"), std::string::npos) << world.problems[0];
    EXPECT_TRUE(world.model.scenery().empty());
    EXPECT_EQ(world.model.models().size(), 1u);
  }
}

TEST(SdfHeightmap, WithoutASizeAboveZeroOrAFileIsLeftOut) {
  const Hills hills;
  const std::string left_out = "lost collision 3:31 <collision name=`c`> is left out, as its <heightmap> has ";
  EXPECT_EQ(hilly_world(hills_collision("<uri>hills.png</uri><size>5 5 -1</size>"), hills.folder.path("")).problems,
            Lines{left_out + "a <size> that is not above 0"});
  EXPECT_EQ(hilly_world(hills_collision("<size>5 5 1</size>"), hills.folder.path("")).problems,
            Lines{left_out + "no <uri>"});
}

}  // namespace
}  // namespace muro::sdf
