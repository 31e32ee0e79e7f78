// SPDX-License-Identifier: MIT
// Bodies and scenery whose shapes are triangle meshes.
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/conformance/motion/case.hpp"
#include "tests/support/files.hpp"

namespace muro::conformance {

namespace {

Shape mesh_shape(TextId file) {
  Shape s{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
  s.mesh = file;
  return s;
}

/// Checks that a mesh of a cube lies on a plane and on a box as a cube does.
Outcome lies(const std::string& motion) {
  const test::ScratchFolder folder;
  const std::string file =
      folder.file("box.stl", mesh::testing::stl_text(mesh::testing::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})));
  Trial t(motion);
  t.add_ground();
  const Shape table = Shape::box({1, 1, 1});
  t.world().add_scenery("table", {{5, 0, 0.5}, Quat::Identity()}, std::span<const Shape>(&table, 1));
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    const Shape s = mesh_shape(b.intern(file));
    b.base("body");
    b.set(keys::inertial, solid_box(1, {0.2, 0.2, 0.2}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&s, 1));
  });
  const RobotView& low = t.add("low", tree, {{0, 0, 0.12}, Quat::Identity()});
  const RobotView& high = t.add("high", tree, {{5, 0, 1.12}, Quat::Identity()});
  t.start();
  t.run_for(3);
  const double a = t.pose(low).position.z(), b = t.pose(high).position.z();
  return {std::max(std::abs(a - 0.1), std::abs(b - 1.1)), text(a) + " m for 0.1, " + text(b) + " m for 1.1"};
}

/// Returns the height of a ball of 0.1 m in a gutter along y, two sides of 45 deg that meet at z = 0, or on its hull.
double rests_at(const std::string& motion, bool exact) {
  mesh::Mesh m;
  m.vertices = {{-1, -1, 1}, {-1, 1, 1}, {0, -1, 0}, {0, 1, 0}, {1, -1, 1}, {1, 1, 1}};
  m.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
  const test::ScratchFolder folder;
  Trial t(motion);
  const Shape shape = mesh_shape(t.world().intern(folder.file("gutter.obj", mesh::testing::obj_text(m))));
  t.world().add_scenery("gutter", {}, std::span<const Shape>(&shape, 1));
  const RobotView& r = t.add("ball", ball(1, 0.1, 0.5), {{0, 0, exact ? 0.2 : 1.15}, Quat::Identity()});
  t.start({{"meshes", std::string(exact ? "exact" : "convex")}});
  t.run_for(2);
  return t.pose(r).position.z();
}
Outcome hollow(const std::string& motion) {
  const double z = rests_at(motion, true);
  return {std::abs(z - 0.1 * M_SQRT2), text(z) + " m for 0.1414214"};
}
Outcome hull(const std::string& motion) {
  const double z = rests_at(motion, false);
  return {std::abs(z - 1.1), text(z) + " m for 1.1"};
}

/// Checks a mesh of a box that falls on a corner, with an arbitrary number for its inertia. It must come to rest on a
/// face, and must not get faster than by its fall. The error is the excess of speed, or the error of its height.
Outcome placeholder(const std::string& motion) {
  const test::ScratchFolder folder;
  const std::string file =
      folder.file("box.stl", mesh::testing::stl_text(mesh::testing::box({-0.25, -0.2, -0.15}, {0.25, 0.2, 0.15})));
  Trial t(motion);
  t.add_ground();
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    const Shape s = mesh_shape(b.intern(file));
    b.base("body");
    b.set(keys::inertial, Inertia{.mass = 1, .ixx = 1e-9, .iyy = 1e-9, .izz = 1e-9});
    b.set_array(keys::collision_shapes, std::span<const Shape>(&s, 1));
  });
  constexpr double start = 0.5;
  const RobotView& r = t.add("crate", tree, {{0, 0, start}, from_rpy(0.4, 0.3, 0)});
  t.start();
  double fastest = 0;
  for (int i = 0; i < 400; ++i) {
    t.run_for(0.01);
    fastest = std::max(fastest, t.twist(r).linear.norm());
  }
  const double z = t.pose(r).position.z(), by_fall = std::sqrt(2 * g * start);
  return {std::max(std::abs(z - 0.15), fastest - by_fall), text(z) + " m for 0.15, at most " + text(fastest) + " m/s"};
}

}  // namespace

std::vector<Case> mesh_cases() {
  return {
      {"a mesh of a cube lies as a cube", "m", feature_contact | feature_convex_meshes, 2e-3, lies},
      {"the hull of a gutter carries a ball", "m", feature_contact | feature_convex_meshes, 2e-3, hull},
      {"a gutter as it is holds a ball in its hollow", "m", feature_contact | feature_concave_meshes, 2e-3, hollow},
      {"a mesh with a placeholder for its inertia comes to rest on a face", "m, m/s",
       feature_forces | feature_contact | feature_convex_meshes, 2e-3, placeholder, "motion.simplified"},
  };
}

}  // namespace muro::conformance
