// SPDX-License-Identifier: MIT
// Bodies on heightmaps: a plane of cells, hills, rims, and fast and thin bodies.
#include <cstring>
#include <random>

#include "muro/toolkit/heightmap.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/conformance/motion/case.hpp"
#include "tests/support/files.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

/// Heights (m) on a grid, which can be put into a scene.
class Hills {
 public:
  template <class Height>
  Hills(std::uint32_t columns, std::uint32_t rows, double x, double y, Height height)
      : values_(std::size_t(columns) * rows), map_{values_, columns, rows, {x, y, 1}} {
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const Vec3 p = map_.node(c, r);
        values_[r * columns + c] = float(height(p.x(), p.y()));
      }
  }
  const Heightmap& map() const { return map_; }

  void stand_in(Trial& t, double friction, const Pose& pose = {}) const {
    const std::int32_t counts[] = {std::int32_t(map_.rows), std::int32_t(map_.columns)};
    std::string bytes(sizeof counts + sizeof(float) * values_.size(), '\0');
    std::memcpy(bytes.data(), counts, sizeof counts);
    std::memcpy(bytes.data() + sizeof counts, values_.data(), sizeof(float) * values_.size());
    Shape shape = with({.kind = ShapeKind::heightmap, .size = map_.size}, friction);
    shape.mesh = t.world().intern(folder_.file("hills.bin", bytes));
    t.world().add_scenery("hills", pose, std::span<const Shape>(&shape, 1));
  }

 private:
  test::ScratchFolder folder_;
  std::vector<float> values_;
  Heightmap map_;
};

/// A plane of cells that rises along x by `angle` (rad); a body lies on many cells.
struct SlopeOfCells : Trial {
  Quat tilt;
  const RobotView* body;

  SlopeOfCells(const std::string& motion, double angle, double friction, const RobotTree& tree, double height,
               const Quat& turn = Quat::Identity())
      : Trial(motion), tilt(from_rpy(0, -angle, 0)) {
    const Hills hills(301, 41, 30, 4, [&](double x, double) { return x * std::tan(angle); });
    hills.stand_in(*this, friction);
    body = &add("body", tree, {tilt * Vec3(0.013, 0.021, height), tilt * turn});
    start();
  }
  double speed_down() { return -twist(*body).linear.dot(tilt * Vec3::UnitX()); }
  double gain_of_speed() {
    run_for(0.5);
    const double before = speed_down();
    run_for(1);
    return speed_down() - before;
  }
};

const Vec3 block_size(0.33, 0.27, 0.1);

Outcome lies_on_terrain(const std::string& motion) {
  SlopeOfCells t(motion, 0, 0.8, block(3, block_size, 0.8), 0.05);
  t.run_for(2);
  const double sunk = std::abs(t.pose(*t.body).position.z() - 0.05);
  return {sunk, text(sunk) + " m"};
}

/// Checks a wedge that lies on its longest face.
Outcome mesh_lies(const std::string& motion) {
  const test::ScratchFolder folder;
  mesh::Mesh wedge;
  wedge.vertices = {{-0.2, -0.1, 0}, {0.2, -0.1, 0}, {0.2, 0.1, 0}, {-0.2, 0.1, 0}, {0.2, -0.1, 0.1}, {0.2, 0.1, 0.1}};
  wedge.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {2, 3, 5}, {1, 2, 5}, {1, 5, 4}, {0, 4, 5}, {0, 5, 3}};
  const std::string file = folder.file("wedge.obj", mesh::testing::obj_text(wedge));
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    Shape shape{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    shape.mesh = b.intern(file);
    b.base("body");
    b.set(keys::inertial, solid_box(1, {0.4, 0.2, 0.1}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  });
  constexpr double angle = 20 * M_PI / 180;
  SlopeOfCells t(motion, angle, 0.8, tree, 0.02);
  t.run_for(2);
  const double off = std::abs((t.tilt.conjugate() * t.pose(*t.body).position).z());
  const double turned = t.pose(*t.body).orientation.angularDistance(t.tilt);
  return {off + turned, text(off) + " m, " + text(turned) + " rad"};
}

Outcome slides(const std::string& motion) {
  SlopeOfCells t(motion, M_PI / 6, 0.3, block(1, block_size, 0.3), 0.05);
  return relative(t.gain_of_speed(), 2.3562872);
}

Outcome sticks(const std::string& motion) {
  SlopeOfCells t(motion, M_PI / 6, 0.6, block(1, block_size, 0.6), 0.05);  // tan 30 deg = 0.577
  t.run_for(1);
  const Vec3 before = t.pose(*t.body).position;
  t.run_for(3);
  const double creep = (t.pose(*t.body).position - before).norm() / 3;
  return {creep, text(creep) + " m/s"};
}

Outcome stops(const std::string& motion) {
  SlopeOfCells t(motion, 0, 0.4, block(1, block_size, 0.4), 0.05);
  t.run_for(0.5);
  const double start = t.pose(*t.body).position.x();
  t.twist(*t.body).linear.x() = 2;
  t.run_for(2);
  return relative(t.pose(*t.body).position.x() - start, 4 / (2 * 0.4 * g));
}

Outcome rolls(const std::string& motion) {
  constexpr double angle = 20 * M_PI / 180;
  SlopeOfCells t(motion, angle, 0.5, ball(1, 0.1, 0.5), 0.1);
  return relative(t.gain_of_speed(), 5.0 / 7 * g * std::sin(angle));
}

Outcome cylinder_rolls(const std::string& motion) {
  constexpr double angle = 20 * M_PI / 180, r = 0.1, l = 0.25;
  const RobotTree tree = test::single_body(with(Shape::cylinder(r, l), 0.5), solid_cylinder(1, r, l));
  SlopeOfCells t(motion, angle, 0.5, tree, r, from_rpy(M_PI / 2, 0, 0));
  return relative(t.gain_of_speed(), 2.0 / 3 * g * std::sin(angle));
}

/// Checks the first three impacts of a ball of restitution 0.7 that falls from 1 m.
Outcome bounces(const std::string& motion) {
  SlopeOfCells t(motion, 0, 0.5, ball(1, 0.05, 0.5, 0.7), 1.05);
  constexpr double expected[] = {0.451524, 1.083657, 1.526150};
  double worst = 0;
  std::string seen;
  int impacts = 0;
  for (double before = 0; impacts < 3 && t.now() < 3'000'000'000;) {
    t.run_for(0.001);
    const double v = t.twist(*t.body).linear.z();
    if (before < -0.1 && v >= 0) {
      const double time = 1e-9 * double(t.now());
      worst = std::max(worst, std::abs(time - expected[impacts++]));
      seen += (seen.empty() ? "" : " ") + text(time);
    }
    before = v;
  }
  if (impacts < 3) return {1, seen + " and no more"};
  return {worst, seen};
}

/// Checks four levels, one in each quarter of a map that is longer than wide, turned and shifted.
Outcome is_where_it_stands(const std::string& motion) {
  const auto level = [](double x, double y) { return (x > 0 ? 0.3 : 0.0) + (y > 0 ? 0.8 : 0.1) - (x > 0 && y > 0); };
  const Hills hills(61, 31, 6, 3, level);
  const Pose at{{4, -2, 1.5}, from_rpy(0, 0, 0.6)};
  Trial t(motion);
  hills.stand_in(t, 0.8, at);
  std::vector<std::pair<const RobotView*, double>> boxes;
  for (const double x : {-2.1, 1.9})
    for (const double y : {-1.1, 0.9}) {
      const Vec3 place = at * Vec3(x, y, level(x, y) + 0.15);
      boxes.emplace_back(
          &t.add("box_" + std::to_string(boxes.size()), block(1, {0.2, 0.2, 0.2}, 0.8), {place, at.orientation}),
          place.z() - 0.05);
    }
  t.start();
  t.run_for(1);
  double worst = 0;
  for (const auto& [box, height] : boxes) worst = std::max(worst, std::abs(t.pose(*box).position.z() - height));
  return {worst, text(worst) + " m"};
}

/// Checks that a ball that rolls at 2 m/s falls over the rim, which it reaches after 0.25 s.
Outcome ends_at_its_rim(const std::string& motion) {
  const Hills flat(21, 21, 2, 2, [](double, double) { return 0.3; });
  Trial t(motion);
  flat.stand_in(t, 0.5);
  const RobotView& r = t.add("ball", ball(1, 0.1, 0.5), {{0.5, 0.13, 0.4}, Quat::Identity()}, {{2, 0, 0}, {0, 20, 0}});
  t.start();
  t.run_for(0.24);
  const double on_it = std::abs(t.pose(r).position.z() - 0.4);
  t.run_for(0.76);
  const double z = t.pose(r).position.z();
  return {on_it + (z < -1.5 ? 0 : 1), text(on_it) + " m before, falls to " + text(z) + " m"};
}

/// Checks bodies of all kinds on rough ground: the depth of a centre below it, and speed beyond that of their fall.
Outcome carries_all(const std::string& motion) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> rough(0, 0.12f);
  const Hills hills(41, 41, 8, 8, [&](double x, double y) { return 0.05 * (x * x + y * y) + double(rough(random)); });
  Trial t(motion);
  hills.stand_in(t, 0.6);
  const auto body = [](const Shape& shape, double radius) {
    return test::single_body(with(shape, 0.6), test::round_body(1, radius));
  };
  const RobotTree trees[] = {body(Shape::box({0.3, 0.2, 0.1}), 0.1), body(Shape::sphere(0.07), 0.07),
                             body(Shape::cylinder(0.1, 0.15), 0.08), body(Shape::capsule(0.06, 0.2), 0.08)};
  std::vector<const RobotView*> bodies;
  std::uniform_real_distribution<double> turn(-3, 3);
  for (int i = 0; i < 12; ++i) {
    const int row = i / 4, column = i % 4;
    const double x = 1.3 * column - 2, y = 1.6 * row - 1.6, roll = turn(random), pitch = turn(random);
    bodies.push_back(&t.add("body_" + std::to_string(i), trees[i % 4],
                            {{x, y, 0.05 * (x * x + y * y) + 0.5}, from_rpy(roll, pitch, 0)}));
  }
  t.start();
  double deepest = 0, fastest = 0;
  for (int k = 0; k < 150; ++k) {
    t.run_for(0.02);
    for (const RobotView* b : bodies) {
      const Vec3 p = t.pose(*b).position;
      const auto ground = hills.map().ground_at(p.x(), p.y());
      if (!p.allFinite() || !ground) return {1, "it is beyond the rim"};
      deepest = std::max(deepest, ground->height - p.z());
      fastest = std::max(fastest, t.twist(*b).linear.norm());
    }
  }
  // no body falls by more than 1.2 m
  return {deepest + std::max(0.0, fastest - std::sqrt(2 * g * 1.2)),
          text(deepest) + " m below, " + text(fastest) + " m/s"};
}

/// Checks a plate of 1 cm, flat and on edge, and a ball, so fast that they move farther in a step than they are thick.
Outcome stops_what_is_fast(const std::string& motion) {
  const Hills rough(21, 21, 4, 4, [](double x, double y) { return 0.1 * std::sin(3 * x) * std::cos(2 * y); });
  const Hills flat(3, 3, 4, 4, [](double, double) { return 0.0; });
  int passed = 0;
  std::string seen;
  const RobotTree plate = block(1, {0.3, 0.3, 0.01}, 0.5), small = ball(1, 0.05, 0.5);
  for (int i = 0; i < 6; ++i) {
    const int k = i % 3;
    const Hills& hills = i < 3 ? rough : flat;
    Trial t(motion);
    hills.stand_in(t, 0.5);
    const RobotView& r = t.add("body", k < 2 ? plate : small, {{0.1, 0.2, 1}, from_rpy(k == 1 ? M_PI / 2 : 0, 0, 0)},
                               {{0, 0, k < 2 ? -40.0 : -150.0}, Vec3::Zero()});
    t.start({{"watch", std::string("off")}});
    double above = 0;
    for (int step = 0; step < 30; ++step) {
      t.run_for(0.01);
      const Vec3 p = t.pose(r).position;
      const auto ground = hills.map().ground_at(p.x(), p.y());
      above = p.z() - (ground ? ground->height : 0);
    }
    seen += text(above) + " ";
    passed += above > -0.01 ? 0 : 1;
  }
  return {double(passed), "ends " + seen + "m above"};
}

/// Checks a vehicle with balls as wheels.
Outcome carries_a_vehicle(const std::string& motion) {
  const Hills flat(201, 41, 20, 4, [](double, double) { return 0.0; });
  constexpr double radius = 0.06;
  Trial t(motion);
  flat.stand_in(t, 0.8);
  const RobotView& r = t.add(
      "r",
      test::rover(
          {.chassis = {0.35, 0.2, 0.1}, .wheel = Shape::sphere(radius), .wheel_inertia = test::round_body(0.3, radius)},
          0.8),
      {{0.02, 0.03, 0.09}, Quat::Identity()});
  t.start();
  for (const char* name : {"front_left", "rear_left", "front_right", "rear_right"})
    t.joint("r/" + std::string(name) + "_joint", keys::joint_velocity_target) = 10;
  t.run_for(1);
  const Vec3 before = t.pose(r).position;
  t.run_for(2);
  return relative((t.pose(r).position - before).x() / 2, 10 * radius);
}

/// Checks a cylinder that swings in a gutter of radius R as a pendulum of length 3/2 (R - r): the mean of two periods,
/// with the first term of their growth with the amplitude.
Outcome swings_in_a_gutter(const std::string& motion) {
  constexpr double gutter = 1, rim = 0.1, width = 0.2;  // m, m, rad
  const Hills hills(401, 21, 1.2, 1, [](double x, double) { return gutter - std::sqrt(gutter * gutter - x * x); });
  Trial t(motion);
  hills.stand_in(t, 0.8);
  const double length = 0.2;
  const RobotTree tree = test::single_body(with(Shape::cylinder(rim, length), 0.8), solid_cylinder(1, rim, length));
  const double way = gutter - rim;
  const RobotView& r =
      t.add("disk", tree, {{way * std::sin(width), 0, gutter - way * std::cos(width)}, from_rpy(M_PI / 2, 0, 0)});
  t.start();
  std::vector<double> crossings;
  double before = t.pose(r).position.x();
  while (crossings.size() < 5 && t.now() < 12'000'000'000) {
    t.run_for(0.001);
    const double x = t.pose(r).position.x();
    if (before * x < 0) crossings.push_back(1e-9 * double(t.now()) - 0.001 * x / (x - before));
    before = x;
  }
  if (crossings.size() < 5) return {1, text(double(crossings.size())) + " of 5 crossings"};
  const double seen = (crossings[4] - crossings[0]) / 2,
               expected = 2 * M_PI * std::sqrt(1.5 * way / g) * (1 + width * width / 16);
  return relative(seen, expected);
}

}  // namespace

std::vector<Case> heightmap_cases() {
  constexpr Features needs = feature_contact | feature_forces | feature_heightmaps,
                     with_friction = needs | feature_friction;
  return {
      {"a box lies on a flat heightmap, not in it", "m", needs, 1e-3, lies_on_terrain},
      {"a mesh lies on a heightmap of 20 deg as it lies on a plane", "m, rad", with_friction | feature_convex_meshes,
       2e-3, mesh_lies},
      {"a block slides down a heightmap of 30 deg with g (sin - mu cos)", "relative", with_friction, 1e-3, slides},
      {"a block holds on a heightmap of 30 deg when tan is below mu", "m/s", with_friction, 2e-6, sticks},
      {"a block that slides on a heightmap stops after v^2 / (2 mu g)", "relative", with_friction, 0.01, stops},
      {"a solid sphere rolls down a heightmap of 20 deg with 5/7 g sin", "relative", with_friction, 2e-3, rolls},
      {"a cylinder rolls down a heightmap of 20 deg with 2/3 g sin", "relative", with_friction, 2e-3, cylinder_rolls},
      {"a cylinder swings in a gutter with the period of 3/2 (R - r)", "relative", with_friction, 0.02,
       swings_in_a_gutter},
      {"a ball of restitution 0.7 bounces on a heightmap when it should", "s", needs | feature_restitution, 0.01,
       bounces},
      {"a heightmap that is turned and shifted carries boxes where its levels are", "m", needs, 1e-3,
       is_where_it_stands},
      {"a ball rolls to the rim of a heightmap and falls", "m, falls not", with_friction, 1e-3, ends_at_its_rim},
      {"rough ground carries boxes, balls, cylinders and capsules", "m, m/s", with_friction, 0, carries_all},
      {"a heightmap stops what is thin and fast", "passed", needs, 0, stops_what_is_fast},
      {"a rover drives over a heightmap as fast as its wheels turn", "relative", with_friction, 5e-3,
       carries_a_vehicle},
  };
}

}  // namespace muro::conformance
