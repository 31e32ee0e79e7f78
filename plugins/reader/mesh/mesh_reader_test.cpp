// SPDX-License-Identifier: MIT
// Models of one body from mesh files, compared with closed forms.
#include <gtest/gtest.h>

#include <cstring>

#include "core/read_model.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "plugins/common/mesh/hull.hpp"
#include "plugins/common/mesh/solid.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

template <class T>
std::vector<T> constants_of(const RobotTree& tree, const Key<T>& key) {
  std::vector<T> values;
  for (const RobotTree::Constant& c : tree.components().front().constants)
    if (c.key.name == key.name) {
      values.resize(c.data.size() / sizeof(T));
      std::memcpy(static_cast<void*>(values.data()), c.data.data(), c.data.size());
    }
  return values;
}

RobotTree read(const mesh::Mesh& m) {
  const test::ScratchFolder folder;
  return read_model(test::plugins(), folder.file("body.STL", mesh::testing::stl_text(m)));
}

TEST(MeshReader, GivesABoxTheInertiaOfASolidOfWater) {
  const RobotTree tree = read(mesh::testing::box({1, 2, 3}, {1.2, 2.4, 3.6}));
  const Inertia i = constants_of(tree, keys::inertial).at(0);
  const double mass = 1000 * 0.2 * 0.4 * 0.6;
  EXPECT_NEAR(i.mass, mass, 1e-6 * mass);
  EXPECT_NEAR((i.com - Vec3(1.1, 2.2, 3.3)).norm(), 0, 1e-6);
  EXPECT_NEAR(i.ixx, mass * (0.4 * 0.4 + 0.6 * 0.6) / 12, 1e-4);
  EXPECT_NEAR(i.iyy, mass * (0.2 * 0.2 + 0.6 * 0.6) / 12, 1e-4);
  EXPECT_NEAR(i.izz, mass * (0.2 * 0.2 + 0.4 * 0.4) / 12, 1e-4);
  EXPECT_NEAR(i.ixy, 0, 1e-4);
}

TEST(MeshReader, TellsTheCornersOfTheHull) {
  mesh::Mesh m = mesh::testing::box({0, 0, 0}, {1, 1, 1});
  const mesh::Mesh inner = mesh::testing::box({0.4, 0.4, 0.4}, {0.6, 0.6, 0.6});
  for (const mesh::Triangle& t : inner.triangles) m.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  m.vertices.insert(m.vertices.end(), inner.vertices.begin(), inner.vertices.end());
  EXPECT_EQ(constants_of(read(m), keys::mesh_corners).size(), 8u);
}

TEST(MeshReader, TellsTheCornersOfAMeshTooHeavyToBeWater) {
  const RobotTree tree = read(mesh::testing::box({0, 0, 0}, {400, 200, 100}));
  EXPECT_EQ(constants_of(tree, keys::mesh_corners).size(), 8u);
  const Inertia i = constants_of(tree, keys::inertial).at(0);
  EXPECT_EQ(i.mass, 1e9);  // 8e9 kg of water
  EXPECT_NEAR(i.izz, 1e9 * (400. * 400 + 200. * 200) / 12, 1e7);
  ASSERT_EQ(tree.problems().size(), 1u);
  EXPECT_NE(tree.problems()[0].text.find("metres"), std::string::npos);
}

TEST(MeshReader, ReadsAFlatMeshAsABodyWithoutMass) {
  mesh::Mesh m = mesh::testing::box({0, 0, 0}, {1, 1, 1});
  m.triangles.resize(2);
  mesh::clean(m);
  const RobotTree tree = read(m);
  EXPECT_TRUE(constants_of(tree, keys::inertial).empty());
  EXPECT_EQ(constants_of(tree, keys::mesh_corners).size(), 4u);
}

TEST(SolidInertia, OfATetrahedronIsThatOfTononsNumericalExample) {
  mesh::Mesh m;
  m.vertices = {{8.33220, -11.86875, 0.93355},
                {0.75523, 5.00000, 16.37072},
                {52.61236, 5.00000, -5.38580},
                {2.00000, 5.00000, 3.00000}};
  m.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  if (mesh::volume_of(m) < 0)
    for (mesh::Triangle& t : m.triangles) std::swap(t[1], t[2]);
  const Inertia i = mesh::solid_inertia(m, 1);
  EXPECT_NEAR(i.com.x(), 15.92492, 1e-4);
  EXPECT_NEAR(i.com.y(), 0.78281, 1e-5);
  EXPECT_NEAR(i.com.z(), 3.72962, 1e-5);
  EXPECT_NEAR(i.ixx / 43520.33257, 1, 1e-6);
  EXPECT_NEAR(i.iyy / 194711.28938, 1, 1e-6);
  EXPECT_NEAR(i.izz / 191168.76173, 1, 1e-6);
  EXPECT_NEAR(std::abs(i.iyz) / 4417.66150, 1, 1e-6);
  EXPECT_NEAR(std::abs(i.ixz) / 46343.16662, 1, 1e-6);
  EXPECT_NEAR(std::abs(i.ixy) / 11996.20119, 1, 1e-6);
}

}  // namespace
}  // namespace muro
