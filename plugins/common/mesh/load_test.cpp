// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "files_testing.hpp"
#include "muro/algorithm.hpp"
#include "store.hpp"
#include "tests/support/files.hpp"

namespace {

using namespace muro;
using namespace muro::mesh;
using namespace muro::mesh::testing;

const Vec3 low(-1, 2, 0.5), high(1, 5, 4.5);
constexpr double volume = 2 * 3 * 4;

/// Expects a box with these corners: closed, facing outward.
void expect_box(const Mesh& m, const Vec3& from, const Vec3& to, const std::string& what) {
  EXPECT_EQ(m.vertices.size(), 8u) << what;
  EXPECT_EQ(m.triangles.size(), 12u) << what;
  const Aabb box = bounds_of(m);
  EXPECT_LT((box.low - from).norm() + (box.high - to).norm(), 1e-5)
      << what << ": " << box.low.transpose() << " to " << box.high.transpose();
  EXPECT_TRUE(is_closed(m)) << what;
  EXPECT_TRUE(is_convex(m)) << what;
  EXPECT_NEAR(volume_of(m), (to - from).prod(), 1e-4) << what;
}

TEST(Load, EveryFormatGivesTheSameBox) {
  const test::ScratchFolder folder;
  const Mesh m = box(low, high);
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"text.stl", stl_text(m)},
           {"TEXT.STL", stl_text(m)},
           {"binary.stl", stl_binary(m)},
           {"Binary.Stl", stl_binary(m)},
           {"solid.stl", stl_binary(m, "solid made by an exporter that lies")},
           {"part.obj", obj_text(m)},
           {"PART.OBJ", obj_text(m)},
           {"part.dae", dae_text(m, "Z_UP", "1")},
           {"PART.DAE", dae_text(m, "Z_UP", "1")}})
    expect_box(load(folder.file(name, text), Vec3::Ones()), low, high, name);
}

TEST(Load, ColladaFilesComeInMetresWithZUp) {
  const test::ScratchFolder folder;
  const Mesh m = box(low, high);
  expect_box(load(folder.file("cm.dae", dae_text(m, "Z_UP", "0.01")), Vec3::Constant(100)), low, high, "centimetres");
  expect_box(load(folder.file("inch.dae", dae_text(m, "Z_UP", "0.0254")), Vec3::Ones()), 0.0254 * low, 0.0254 * high,
             "inches");
  // COLLADA 1.4.1, <up_axis>: y up has z towards the viewer, x up has y to the left
  expect_box(load(folder.file("y.dae", dae_text(m, "Y_UP", "1")), Vec3::Ones()), {-1, -4.5, 2}, {1, -0.5, 5}, "y up");
}

TEST(Load, GltfStandsOnItsFeet) {
  const test::ScratchFolder folder;
  const Mesh m = box(low, high);
  expect_box(load(folder.file("part.gltf", gltf_text(m)), Vec3::Ones()), {-1, -4.5, 2}, {1, -0.5, 5}, "glTF, y up");
}

TEST(Load, NodesStandWhereTheirTransformsPutThemAndAreOneMesh) {
  const test::ScratchFolder folder;
  const Mesh unit = box({0, 0, 0}, {1, 1, 1});
  const Mesh m = load(folder.file("two.dae", dae_text(unit, "Z_UP", "0.1",
                                                      {"<translate>10 0 0</translate><scale>2 1 1</scale>",
                                                       "<translate>0 0 -30</translate><rotate>0 0 1 90</rotate>"
                                                       "<scale>1 -1 1</scale>"})),
                      Vec3::Ones());
  EXPECT_EQ(m.vertices.size(), 16u);
  EXPECT_EQ(m.triangles.size(), 24u);
  EXPECT_TRUE(is_closed(m));
  EXPECT_FALSE(is_convex(m));
  EXPECT_NEAR(volume_of(m), 0.003, 1e-6) << "a mirrored node looks outward too";
  EXPECT_LT((bounds_of(m).low - Vec3(0, 0, -3)).norm(), 1e-5) << bounds_of(m).low.transpose();
  EXPECT_LT((bounds_of(m).high - Vec3(1.2, 0.1, 0.1)).norm(), 1e-5) << bounds_of(m).high.transpose();
}

TEST(Load, ScaleStretchesAndMirrors) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("part.stl", stl_text(box(low, high)));
  expect_box(load(file, {0.5, 1, 2}), {-0.5, 2, 1}, {0.5, 5, 9}, "stretched");
  expect_box(load(file, {1, -1, 1}), {-1, -5, 0.5}, {1, -2, 4.5}, "mirrored");
}

TEST(Load, PolygonsAreTriangulatedAndWhatHasNoAreaIsDropped) {
  const test::ScratchFolder folder;
  const Mesh m = load(folder.file("quad.obj",
                                  "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0 0\nv 9 9 9\n"
                                  "f 1 2 3 4\nf 1 5 2\nf 1 1 2\nl 1 6\np 6\n"),
                      Vec3::Ones());
  EXPECT_EQ(m.triangles.size(), 2u);
  EXPECT_EQ(m.vertices.size(), 4u);
  EXPECT_FALSE(is_closed(m));
}

TEST(Load, AClosedMeshLooksOutwardWhateverTheFileSays) {
  const test::ScratchFolder folder;
  Mesh inside_out = box(low, high);
  for (Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  const Mesh m = load(folder.file("part.stl", stl_text(inside_out)), Vec3::Ones());
  EXPECT_NEAR(volume_of(m), volume, 1e-4);
}

std::string message_of(const std::string& path, const Vec3& scale = Vec3::Ones()) {
  try {
    load(path, scale);
  } catch (const Error& e) {
    return e.what();
  }
  return "no error";
}

TEST(Load, SaysWhatIsWrongWithAFileAndWhatIsAllowed) {
  const test::ScratchFolder folder;
  const auto expect = [&](const std::string& path, const std::string& words, const Vec3& scale = Vec3::Ones()) {
    const std::string message = message_of(path, scale);
    EXPECT_NE(message.find(path), std::string::npos) << message;
    EXPECT_NE(message.find(words), std::string::npos) << message;
  };
  expect(folder.path("missing.stl"), "is not there; give the path of a DAE, STL, OBJ or glTF file");
  expect(folder.file("note.txt", "hello"), "cannot be read");
  expect(folder.file("empty.stl", ""), "cannot be read");
  expect(folder.file("broken.dae", "<COLLADA>"), "cannot be read");
  expect(folder.file("large.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n"),
         "run `git lfs pull`");
  expect(folder.file("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "no triangle with an area (1 without)");
  const std::string good = folder.file("part.stl", stl_text(box(low, high)));
  expect(good, "each factor must be finite and not 0", {1, 0, 1});
  EXPECT_EQ(message_of(good), "no error");
}

/// Returns a binary glTF file that claims to be 2 GB long.
std::string glb_of_two_gigabytes() {
  std::string bytes = "glTF";
  for (const std::uint32_t word : {2u, 0x7fffffffu, 0x7ffffff0u, 0x4e4f534au})
    bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
  return bytes + "{}";
}

/// Returns a COLLADA file that claims to have four billion coordinates.
std::string dae_of_many_numbers(const Mesh& m) {
  std::string text = dae_text(m, "Z_UP", "1");
  const std::size_t count = text.find("count=\"", text.find("<float_array")) + 7;
  return text.replace(count, text.find('"', count) - count, "4294967295");
}

TEST(Load, AFileThatFillsTheMemoryIsAnErrorAndTheNextIsRead) {
  const test::ScratchFolder folder;
  const Mesh m = box(low, high);
  const std::string good = folder.file("part.stl", stl_text(m));
  for (const auto& [name, text] :
       {std::pair("many.dae", dae_of_many_numbers(m)), {"two.glb", glb_of_two_gigabytes()}}) {
    const std::string path = folder.file(name, text), message = message_of(path);
    EXPECT_EQ(message.find("mesh " + path + " cannot be read: "), 0u) << message;
    EXPECT_EQ(message_of(good), "no error");
  }
}

TEST(Load, CoordinatesBeyondAnyWorldAreAnError) {
  const test::ScratchFolder folder;
  for (const char* number : {"1e30", "-2e8", "nan", "inf"}) {
    const std::string path =
        folder.file("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 " + std::string(number) + "\nf 1 2 3\nf 1 2 4\n");
    const std::string message = message_of(path);
    EXPECT_TRUE(message.find("a coordinate that is not from -1e8 to 1e8 m") != message.npos ||
                message.find("cannot be read") != message.npos)
        << number << ": " << message;
  }
}

TEST(Store, ReadsAFileOnceForEachScaleAndKeepsWhatItGave) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("part.stl", stl_text(box(low, high)));
  Store store;
  const Mesh& first = store.mesh(file, Vec3::Ones());
  const Hull& hull = store.hull(file, Vec3::Ones());
  std::remove(file.c_str());
  EXPECT_EQ(&store.mesh(file, Vec3::Ones()), &first);
  EXPECT_EQ(&store.hull(file, Vec3::Ones()), &hull);
  for (int i = 0; i < 2; ++i) EXPECT_THROW(store.mesh(file, Vec3::Constant(2)), Error);
}

}  // namespace
