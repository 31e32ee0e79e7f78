// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "heightmap_file.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/image_file/png.hpp"
#include "tests/support/files.hpp"

namespace {

using namespace muro;
using heightmap::HeightmapFile;
using heightmap::load;

std::string floats(const std::vector<float>& values, const std::vector<std::int32_t>& header = {}) {
  std::string bytes(header.size() * 4 + values.size() * 4, '\0');
  if (!header.empty()) std::memcpy(bytes.data(), header.data(), header.size() * 4);
  std::memcpy(bytes.data() + header.size() * 4, values.data(), values.size() * 4);
  return bytes;
}

std::string failure_of(const std::string& path) {
  try {
    load(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(HeightmapFile, OfAPictureHasItsUpperRowsAtPlusYAndWhiteIsOne) {
  const test::ScratchFolder folder;
  const std::uint16_t pixels[] = {0, 13107, 65535, 6553, 32768, 1};  // 3 x 2
  const std::string path = folder.path("hills.png");
  image_file::write_png(path, image_file::Format::grey16, 3, 2, pixels);
  const HeightmapFile file = load(path);
  EXPECT_EQ(file.columns, 3u);
  EXPECT_EQ(file.rows, 2u);
  const float expected[] = {6553 / 65535.f, 32768 / 65535.f, 1 / 65535.f, 0, 0.2f, 1};
  for (int i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(file.values[std::size_t(i)], expected[i]) << i;
}

TEST(HeightmapFile, OfEightBitsHasWhiteAtOneAndColoursAreMadeGrey) {
  const test::ScratchFolder folder;
  const std::uint8_t pixels[] = {0, 0, 0, 255, 255, 255, 51, 51, 51, 128, 128, 128};
  const std::string path = folder.path("hills.png");
  image_file::write_png(path, image_file::Format::rgb8, 2, 2, pixels);
  const HeightmapFile file = load(path);
  EXPECT_FLOAT_EQ(file.values[0], 0.2f);
  EXPECT_FLOAT_EQ(file.values[1], 128 / 255.f);
  EXPECT_FLOAT_EQ(file.values[2], 0);
  EXPECT_FLOAT_EQ(file.values[3], 1);
}

TEST(HeightmapFile, OfFloatsIsASquareOrSaysItsRowsAndColumnsFirst) {
  const test::ScratchFolder folder;
  const std::vector<float> six{0, 1, 2, 3, -4, 5}, nine{0, 1, 2, 3, -4, 5, 6, 7, 8};
  const HeightmapFile square = load(folder.file("square.r32", floats(nine)));
  EXPECT_EQ(square.columns, 3u);
  EXPECT_TRUE(std::ranges::equal(square.values, nine));
  const HeightmapFile mujoco = load(folder.file("hills.bin", floats(six, {2, 3})));
  EXPECT_EQ(mujoco.rows, 2u);
  EXPECT_EQ(mujoco.columns, 3u);
  EXPECT_TRUE(std::ranges::equal(mujoco.values, six));
}

TEST(HeightmapFile, IsInMemoryOnceUntilItChanges) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("map.r32", floats({0, 1, 2, 3}));
  const HeightmapFile first = load(path), second = load(path);
  EXPECT_EQ(first.values.data(), second.values.data());
  folder.file("map.r32", floats({4, 5, 6, 7, 8, 9, 10, 11, 12}));
  const HeightmapFile changed = load(path);
  EXPECT_EQ(changed.values[0], 4);
  EXPECT_EQ(first.values[3], 3) << "who has the old one keeps it";
}

TEST(HeightmapFile, ThatIsNoneIsRefusedInOneSentence) {
  const test::ScratchFolder folder;
  const auto says = [&](const std::string& path, const std::string& words) {
    const std::string said = failure_of(path);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find(path), std::string::npos) << said;
  };
  says(folder.path("none.png"), "is not there");
  says(folder.path("."), "is not there, or no file");
  says(folder.file("empty.r32", ""), "has 0 bytes and is neither a picture");
  says(folder.file("six.r32", floats({0, 1, 2, 3, 4, 5})), "has 24 bytes and is neither a picture");
  says(folder.file("one.r32", floats({0})), "has 1 x 1 values, and must have 2 or more");
  says(folder.file("row.bin", floats({0, 1, 2}, {1, 3})), "has 3 x 1 values, and must have 2 or more");
  says(folder.file("hills.tif", std::string("II*\0\x08\0\0\0", 8)),
       "is a TIFF file, which muro does not read; make a grey PNG file of 16 bits of it, by `gdal_translate -of PNG");
  says(folder.file("large.png", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n"),
       "is only a pointer to the file, left there by Git LFS; run `git lfs pull`");
  says(folder.file("dem.tif", std::string("MM\0+\0\x08\0\0", 8)), "is a TIFF file");
  says(folder.file("nan.r32", floats({0, 1, NAN, 3})), "not finite or beyond 1e6: number 0 of row 1");
  says(folder.file("cut.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\2\0\0\0\2\x10\0\0\0\0", 29)),
       "cannot be");
}

/// The plane z = 1 + 0.2 x - 0.1 y on any grid.
struct Slope {
  std::vector<float> values;
  Heightmap map;
  Slope(std::uint32_t columns, std::uint32_t rows, const Vec3& size) {
    map = {{}, columns, rows, size};
    values.assign(std::size_t(columns) * rows, 0);
    map.values = values;
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const Vec3 p = map.node(c, r);
        values[r * columns + c] = float((1 + 0.2 * p.x() - 0.1 * p.y()) / size.z());
      }
  }
};

TEST(Heightmap, OfAnInclinedPlaneHasItsHeightAndNormalEverywhere) {
  const Slope slope(7, 4, {3, 9, 2});
  const Vec3 normal = Vec3(-0.2, 0.1, 1).normalized();
  for (double x = -1.5; x <= 1.5; x += 0.1)
    for (double y = -4.5; y <= 4.5; y += 0.17) {
      const auto ground = slope.map.ground_at(x, y);
      ASSERT_TRUE(ground);
      EXPECT_NEAR(ground->height, 1 + 0.2 * x - 0.1 * y, 1e-6);
      EXPECT_LT((ground->normal - normal).norm(), 1e-6);
    }
  EXPECT_FALSE(slope.map.ground_at(1.51, 0));
  EXPECT_FALSE(slope.map.ground_at(0, -4.51));
}

TEST(Heightmap, IsTheSurfaceOfItsTriangles) {
  const std::vector<float> values{0, 1, 0.5f, 2, 0.25f, 3, 1, 1, 0};
  const Heightmap map{values, 3, 3, {2, 4, 0.5}};
  const mesh::Mesh mesh = heightmap::mesh_of(map);
  EXPECT_EQ(mesh.vertices.size(), 9u);
  ASSERT_EQ(mesh.triangles.size(), 8u);
  double area = 0;
  for (const mesh::Triangle& t : mesh.triangles) {
    const Vec3 &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 doubled = (b - a).cross(c - a);
    EXPECT_GT(doubled.z(), 0) << "it looks up";
    area += 0.5 * doubled.z();
    const Vec3 centre = (a + b + c) / 3;
    const auto ground = map.ground_at(centre.x(), centre.y());
    ASSERT_TRUE(ground);
    EXPECT_NEAR(ground->height, centre.z(), 1e-12);
    EXPECT_LT((ground->normal - doubled.normalized()).norm(), 1e-12);
  }
  EXPECT_NEAR(area, 8, 1e-12);
  const Aabb box = heightmap::bounds_of(map);
  EXPECT_EQ(box.low, Vec3(-1, -2, 0));
  EXPECT_EQ(box.high, Vec3(1, 2, 1.5));
}

}  // namespace
