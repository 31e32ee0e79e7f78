// SPDX-License-Identifier: MIT
// Meshes in every collision algorithm: as convex hulls, and exact.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/collision/touching.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::CollisionScene;

struct EveryCollisionOfMeshes : ::testing::TestWithParam<std::string> {
  test::ScratchFolder folder;

  /// Returns the file of a box with these lengths about its centre.
  std::string box_file(const Vec3& lengths) const {
    std::ostringstream out;
    for (int i = 0; i < 8; ++i)
      out << "v " << (i & 1 ? 0.5 : -0.5) * lengths.x() << ' ' << (i & 2 ? 0.5 : -0.5) * lengths.y() << ' '
          << (i & 4 ? 0.5 : -0.5) * lengths.z() << '\n';
    out << "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    return folder.file("box.obj", out.str());
  }
  /// Returns the file of squares of 0.5 m at height 0, each of two triangles: open, from -2 to 2 along x and y.
  std::string floor_file() const {
    std::ostringstream out;
    for (int i = 0; i <= 8; ++i)
      for (int k = 0; k <= 8; ++k) out << "v " << 0.5 * i - 2 << ' ' << 0.5 * k - 2 << " 0\n";
    for (int i = 0; i < 8; ++i)
      for (int k = 0; k < 8; ++k) {
        const int a = 9 * i + k + 1, b = a + 9;
        out << "f " << a << ' ' << b << ' ' << b + 1 << "\nf " << a << ' ' << b + 1 << ' ' << a + 1 << '\n';
      }
    return folder.file("floor.obj", out.str());
  }
  /// Returns a channel along x, open above, 2 m long: bottom at height 0, y -0.5 to 0.5; walls 0.5 m thick, 1 m high.
  std::string channel_file() const {
    const double profile[8][2] = {{-1, -0.5}, {1, -0.5}, {1, 1}, {0.5, 1}, {0.5, 0}, {-0.5, 0}, {-0.5, 1}, {-1, 1}};
    std::ostringstream out;
    for (const double x : {-1, 1})
      for (const auto& p : profile) out << "v " << x << ' ' << p[0] << ' ' << p[1] << '\n';
    for (int k = 0; k < 8; ++k) {
      const int next = (k + 1) % 8;
      out << "f " << k + 1 << ' ' << k + 9 << ' ' << next + 9 << ' ' << next + 1 << '\n';
    }
    out << "f 1 2 5 6\nf 2 3 4 5\nf 1 6 7 8\n";
    out << "f 9 14 13 10\nf 10 13 12 11\nf 9 16 15 14\n";
    return folder.file("channel.obj", out.str());
  }
  template <class Interns>
  static Shape mesh(Interns& texts, const std::string& file, const Vec3& scale = Vec3::Ones()) {
    Shape s{.kind = ShapeKind::mesh, .size = scale};
    s.mesh = texts.intern(file);
    return s;
  }
  static RobotTree mesh_robot(const std::string& file, const Vec3& scale = Vec3::Ones()) {
    return test::tree_of([&](RobotBuilder& b) {
      const Shape s = mesh(b, file, scale);
      b.base("body");
      b.set(keys::inertial, test::unit_inertia);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&s, 1));
    });
  }
};

const Pose origin{};
Pose at(double x, double y, double z, const Quat& q = Quat::Identity()) { return {{x, y, z}, q}; }

TEST_P(EveryCollisionOfMeshes, TheHullOfABoxTouchesAsTheBox) {
  const std::string file = box_file({1, 2, 3});
  const std::tuple<Shape, Pose> floors[] = {{Shape::plane(), origin}, {Shape::box({9, 9, 1}), at(0, 0, -0.5)}};
  for (const auto& [floor, place] : floors) {
    std::vector<Contact> lists[2];
    for (const bool as_mesh : {false, true}) {
      CollisionScene scene(GetParam());
      scene.add_scenery("floor", floor, place);
      const Pose pose = at(0.2, -0.1, 0.5 - 0.01, from_rpy(0, M_PI / 2, 0));
      const RobotView& r = as_mesh ? scene.add_dynamic("robot", mesh_robot(file, {2, 1, 0.5}), pose)
                                   : scene.add_dynamic("robot", Shape::box({2, 2, 1.5}), pose);
      scene.finish_setup();
      scene.step_once();
      lists[as_mesh] = scene.contacts(r);
    }
    EXPECT_EQ(lists[0].size(), 4u);
    ASSERT_EQ(lists[1].size(), lists[0].size()) << test::text_of(lists[1]);
    for (const Contact& c : lists[0])
      EXPECT_EQ(std::count_if(lists[1].begin(), lists[1].end(),
                              [&](const Contact& m) {
                                return (m.point - c.point).norm() + (m.normal - c.normal).norm() +
                                           std::abs(m.depth - c.depth) <
                                       1e-6;
                              }),
                1)
          << test::text_of(lists[1]);
  }
}

TEST_P(EveryCollisionOfMeshes, ABallInAChannelTouchesItOnlyWhereItIsTakenAsItIs) {
  const std::string file = channel_file();
  for (const double height : {0.29, 0.31})
    for (const bool exact : {false, true}) {
      CollisionScene scene(GetParam());
      scene.parameters = {{"meshes", std::string(exact ? "exact" : "convex")}};
      scene.add_scenery("channel", mesh(scene.world(), file), origin);
      const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.3), at(0.21, 0.07, height));
      scene.finish_setup();
      scene.step_once();
      const std::vector<Contact> contacts = scene.contacts(r);
      if (!exact) {
        ASSERT_GT(contacts.size(), 0u);
        EXPECT_GT(test::deepest(contacts).depth, 0.6) << "the hull fills the channel";
      } else if (height > 0.3) {
        EXPECT_EQ(contacts.size(), 0u) << test::text_of(contacts);
      } else {
        ASSERT_EQ(contacts.size(), 1u) << test::text_of(contacts);
        EXPECT_NEAR(contacts[0].depth, 0.01, 1e-6);
        EXPECT_LT((contacts[0].normal - Vec3(0, 0, 1)).norm(), 1e-6);
        EXPECT_LT((contacts[0].point - Vec3(0.21, 0.07, -0.005)).norm(), 1e-6);
      }
    }
}

TEST_P(EveryCollisionOfMeshes, ABoxOnAMeshAsItIsRestsOnItsCornersWithEveryNormalUp) {
  CollisionScene scene(GetParam());
  scene.parameters = {{"meshes", std::string("exact")}};
  scene.add_scenery("floor", mesh(scene.world(), floor_file()), origin);
  const RobotView& r = scene.add_dynamic("box", Shape::box({1.1, 0.9, 0.4}), at(0.03, 0.06, 0.2 - 0.01));
  scene.finish_setup();
  scene.step_once();
  const std::vector<Contact> contacts = scene.contacts(r);
  ASSERT_GE(contacts.size(), 4u);
  EXPECT_LE(contacts.size(), 8u);
  for (const Contact& c : contacts) {
    EXPECT_LT((c.normal - Vec3(0, 0, 1)).norm(), 1e-6) << test::text_of(contacts);
    EXPECT_NEAR(c.depth, 0.01, 1e-6);
  }
  for (const double x : {-0.52, 0.58})
    for (const double y : {-0.39, 0.51})
      EXPECT_TRUE(std::any_of(contacts.begin(), contacts.end(),
                              [&](const Contact& c) { return (c.point - Vec3(x, y, -0.005)).norm() < 0.15; }))
          << x << ' ' << y << test::text_of(contacts);
}

/// Robot of one link with gravity on scenery of one shape, pushed by contact.penalty.
struct Standing : test::Scene {
  const RobotView* robot = nullptr;

  void finish(const std::string& collision, bool exact) {
    use("motion.simplified", 1000, {{robot, robot->base()}});
    use_kinematics();
    use("scene.bvh", 0);
    use(collision, 0, {}, {{"meshes", std::string(exact ? "exact" : "convex")}});
    use("contact.penalty", 0);
    build();
  }
  /// `may_turn`: limit of the rotation within 4 s, rad.
  void expect_stands(double height, const std::string& what, double may_turn = 1e-4) {
    run_for(1);
    const Pose settled = pose(*robot);
    EXPECT_NEAR(settled.position.z(), height, 1e-3) << what;
    run_for(4);
    EXPECT_LT((pose(*robot).position - settled.position).norm(), 2e-5) << what;
    EXPECT_LT(pose(*robot).orientation.angularDistance(settled.orientation), may_turn) << what;
  }
};

TEST_P(EveryCollisionOfMeshes, RobotsStandStillOnAMeshAsItIs) {
  const std::pair<const char*, RobotTree> robots[] = {
      {"box", test::single_body(Shape::box({0.6, 0.5, 0.5}), test::unit_inertia)},
      {"cylinder", test::single_body(Shape::cylinder(0.3, 0.5), test::unit_inertia)},
      {"mesh", mesh_robot(box_file({0.5, 0.6, 0.5}))}};
  for (const auto& [name, tree] : robots) {
    Standing scene;
    const Shape floor = mesh(scene.world(), floor_file());
    scene.world().add_scenery("floor", {}, std::span<const Shape>(&floor, 1));
    scene.robot = &scene.add("robot", tree, at(0.1, -0.13, 0.25, from_rpy(0, 0, 0.3)));
    scene.finish(GetParam(), true);
    // contact points of a cylinder change, and their anchors with them
    scene.expect_stands(0.25, name, name == std::string("cylinder") ? 2e-4 : 1e-4);
  }
}

TEST_P(EveryCollisionOfMeshes, ARobotThatIsAMeshRestsOnAPlaneWhereTheClosedFormSays) {
  for (const bool exact : {false, true}) {
    Standing scene;
    scene.add_ground();
    scene.robot = &scene.add("robot", mesh_robot(box_file({0.5, 0.6, 0.5})), at(0.1, -0.13, 0.25, from_rpy(0, 0, 0.3)));
    scene.finish(GetParam(), exact);
    scene.expect_stands(0.25, exact ? "exact" : "convex");
    // contact.penalty at 50 Hz, critically damped, steps of 1 ms: see its README, Integration
    const double w = 2 * M_PI * 50, h = 1e-3, softer = 1 + std::tanh(w * h) + w * w * h * h / 4;
    EXPECT_NEAR(0.25 - scene.pose(*scene.robot).position.z(), softer * 9.81 / (w * w), 1e-8);
  }
}

TEST_P(EveryCollisionOfMeshes, TheHullOfABoxMeetsEveryKindAsTheBox) {
  const std::string file = box_file({1, 1.2, 0.8});
  const std::pair<Shape, Pose> others[] = {{Shape::sphere(0.3), at(0.1, 0.2, 0.65)},
                                           {Shape::box({0.5, 0.4, 0.6}), at(0.1, 0.2, 0.65, from_rpy(0.2, 0.1, 0.7))},
                                           {Shape::cylinder(0.3, 0.6), at(0.1, 0.2, 0.66, from_rpy(1.3, 0.1, 0.7))},
                                           {Shape::capsule(0.2, 0.6), at(0.1, 0.2, 0.65, from_rpy(1.1, 0.1, 0.7))}};
  for (const auto& [other, pose] : others) {
    std::vector<Contact> lists[2];
    for (const bool as_mesh : {false, true}) {
      CollisionScene scene(GetParam());
      scene.add_scenery("box", as_mesh ? mesh(scene.world(), file) : Shape::box({1, 1.2, 0.8}), origin);
      const RobotView& r = scene.add_dynamic("robot", other, pose);
      scene.finish_setup();
      scene.step_once();
      lists[as_mesh] = scene.contacts(r);
    }
    ASSERT_GT(lists[0].size(), 0u) << int(other.kind);
    ASSERT_GT(lists[1].size(), 0u) << int(other.kind);
    const Contact &box = test::deepest(lists[0]), &hull = test::deepest(lists[1]);
    EXPECT_NEAR(hull.depth, box.depth, 1e-5) << int(other.kind);
    EXPECT_LT((hull.normal - box.normal).norm(), 1e-3) << int(other.kind) << test::text_of(lists[1]);
    EXPECT_LT((hull.point - box.point).norm(), 1e-3) << int(other.kind) << test::text_of(lists[1]);
  }
}

TEST_P(EveryCollisionOfMeshes, ARobotThatIsAMeshStandsStillOnABox) {
  for (const bool exact : {false, true}) {
    Standing scene;
    const Shape floor = Shape::box({9, 9, 1});
    scene.world().add_scenery("floor", at(0, 0, -0.5), std::span<const Shape>(&floor, 1));
    scene.robot = &scene.add("robot", mesh_robot(box_file({0.5, 0.6, 0.5})), at(0.1, -0.13, 0.25, from_rpy(0, 0, 0.3)));
    scene.finish(GetParam(), exact);
    scene.expect_stands(0.25, exact ? "exact" : "convex");
  }
}

TEST_P(EveryCollisionOfMeshes, ABallRollsOverTheEdgesOfTrianglesAsOverAPlane) {
  Pose ends[2];
  for (const bool as_mesh : {false, true}) {
    Standing scene;
    const Shape floor = as_mesh ? mesh(scene.world(), floor_file()) : Shape::plane();
    scene.world().add_scenery("floor", {}, std::span<const Shape>(&floor, 1));
    scene.robot = &scene.add("robot", test::single_body(Shape::sphere(0.2), test::unit_inertia), at(-1.5, 0.1, 0.2),
                             {{1, 0.2, 0}, {-1, 5, 0}});
    scene.finish(GetParam(), true);
    scene.run_for(2.5);
    ends[as_mesh] = scene.pose(*scene.robot);
  }
  EXPECT_GT(ends[0].position.x(), 0.9);
  EXPECT_LT((ends[1].position - ends[0].position).norm(), 1e-3);
}

struct EveryAllocationFreeCollisionOfMeshes : EveryCollisionOfMeshes {};

TEST_P(EveryAllocationFreeCollisionOfMeshes, AllocatesNothingOnceWarm) {
  for (const bool exact : {false, true}) {
    Standing scene;
    const Shape floor = mesh(scene.world(), floor_file());
    const Shape slab = Shape::box({9, 9, 1});
    if (exact) scene.world().add_scenery("floor", {}, std::span<const Shape>(&floor, 1));
    if (!exact) scene.world().add_scenery("slab", at(0, 0, -0.5), std::span<const Shape>(&slab, 1));
    scene.robot = &scene.add("robot", mesh_robot(box_file({0.5, 0.6, 0.5})), at(0.1, -0.13, 0.25));
    scene.finish(GetParam(), exact);
    scene.run_for(0.5);
    const std::uint64_t before = test::allocations();
    scene.run_for(0.5);
    EXPECT_EQ(test::allocations() - before, 0u) << (exact ? "exact" : "convex");
  }
}

TEST_P(EveryCollisionOfMeshes, AMeshThatCannotBeReadIsOneClearMessage) {
  CollisionScene scene(GetParam());
  scene.add_scenery("rock", mesh(scene.world(), folder.path("rock.stl")), origin);
  scene.add_dynamic("ball", Shape::sphere(0.3), origin);
  try {
    scene.finish_setup();
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("`rock`: mesh " + folder.path("rock.stl") + " is not there"),
              std::string::npos)
        << e.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryCollisionOfMeshes, ::testing::ValuesIn(test::algorithms_of("collision")),
                         test::name_of);
INSTANTIATE_TEST_SUITE_P(Conformance, EveryAllocationFreeCollisionOfMeshes,
                         ::testing::ValuesIn(test::collisions_that_promise(allocation_free)), test::name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryCollisionOfMeshes);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryAllocationFreeCollisionOfMeshes);

}  // namespace
}  // namespace muro
