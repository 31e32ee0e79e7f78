// SPDX-License-Identifier: MIT
// Bodies without a drive gain no energy, whatever they roll, spin or fall on.
#include <algorithm>
#include <limits>
#include <numbers>
#include <span>

#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/conformance/motion/case.hpp"
#include "tests/conformance/motion/energies.hpp"
#include "tests/support/files.hpp"
#include "tests/support/randoms.hpp"

namespace muro::conformance {

namespace {

/// One body on a plane.
struct PassiveBody {
  Shape shape;
  Inertia inertia;
  Pose at;
  Twist twist;
  double seconds = 2;
  std::string mesh{};  ///< path of the mesh file, if it is a mesh
  double friction = 1;
};

std::vector<Energies> energies(const std::string& motion, const PassiveBody& s, double rate) {
  Trial t(motion, rate);
  t.add_ground(s.friction);
  Shape shape = with(s.shape, s.friction);
  if (!s.mesh.empty()) shape.mesh = t.world().intern(s.mesh);
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    if (!s.mesh.empty()) shape.mesh = b.intern(s.mesh);
    b.base("body");
    b.set(keys::inertial, s.inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
  });
  const RobotView& r = t.add("body", tree, s.at, s.twist);
  t.start({{"meshes", std::string("convex")}});
  const auto held = [&] {
    return held_by_springs(motion, s.inertia, t.pose(r), t.world().values(r.base(), keys::contacts), rate);
  };
  std::vector<Energies> means{{energy_of(s.inertia, s.at, s.twist), 0}};
  for (int k = 0; k < int(20 * s.seconds); ++k) {
    means.push_back(mean_of_window(t, rate, [&] {
      return Energies{energy_of(s.inertia, t.pose(r), t.twist(r)), held()};
    }));
  }
  return means;
}

/// Returns the gain of a body that begins on the ground. When it has settled there, springs count up to the energy that
/// springs of 50 Hz need to carry it.
double gain_on_ground(std::span<const Energies> means, double mass) {
  constexpr std::size_t settled = 6;
  constexpr double omega = 2 * M_PI * 50;
  return std::max(gain_of(means), gain_of(means, 0.5 * mass * g * g / (omega * omega), settled));
}

constexpr double step_rates[] = {250, 500, 1000, 4000};  // Hz

/// `gain`: function of the result of energies().
template <class Gain>
Outcome worst_gain(const std::string& motion, const PassiveBody& scene, const Gain& gain) {
  Outcome worst;
  for (const double rate : step_rates) {
    const double seen = gain(energies(motion, scene, rate));
    worst.error = std::max(worst.error, seen);
    worst.seen += text(seen) + " at " + text(rate) + " Hz ";
  }
  return worst;
}
Outcome worst_gain(const std::string& motion, const PassiveBody& scene) {
  return worst_gain(motion, scene,
                    [&](std::span<const Energies> means) { return gain_on_ground(means, scene.inertia.mass); });
}

Outcome tilted_cylinder(const std::string& motion) {
  return worst_gain(motion, {Shape::cylinder(0.04, 0.1),
                             solid_cylinder(0.5, 0.04, 0.1),
                             {{0, 0, 0.0537}, from_rpy(0, 0.1, 0)},
                             {Vec3::Zero(), {0, 0, 1}}});
}
Outcome spinning_coin(const std::string& motion) {
  return worst_gain(motion, {Shape::cylinder(0.05, 0.005),
                             solid_cylinder(0.1, 0.05, 0.005),
                             {{0, 0, 0.05}, from_rpy(0, M_PI / 2 - 0.05, 0)},
                             {Vec3::Zero(), {0, 0, 12}}});
}
/// Checks a leaning wheel that rolls in a circle.
Outcome leaning_wheel(const std::string& motion) {
  const double rim = 0.3, width = 0.02, lean = 0.3, speed = 2;
  return worst_gain(motion,
                    {Shape::cylinder(rim, width),
                     solid_cylinder(1, rim, width),
                     {{0, 0, rim * std::cos(lean) + width / 2 * std::sin(lean)}, from_rpy(M_PI / 2 - lean, 0, 0)},
                     {{speed, 0, 0}, {0, speed / rim, 0}}});
}
Outcome rolling_disk(const std::string& motion) {
  return worst_gain(motion, {Shape::cylinder(0.1, 0.02),
                             solid_cylinder(0.5, 0.1, 0.02),
                             {{0, 0, 0.1}, from_rpy(M_PI / 2 - 0.2, 0, 0)},
                             {{1, 0, 0}, {0, 10, 0}}});
}

/// A thin disk that rolls round while its centre rests. Its contact goes round at sqrt(4 g / (R sin tilt)). Here the
/// disk is the lower face of a cylinder.
struct EulersDisk {
  static constexpr double rim = 0.05, mass = 0.2;  // m, kg
  double tilt;                                     // rad
  double turns = std::sqrt(4 * g / (rim * std::sin(tilt)));
  PassiveBody body() const {
    Shape shape = Shape::cylinder(rim, 0.01);
    shape.origin.position = {0, 0, 0.005};
    const double across = mass * rim * rim / 4;
    const Quat tilted = from_rpy(0, tilt, 0);
    return {.shape = shape,
            .inertia = {.mass = mass, .ixx = across, .iyy = across, .izz = 2 * across},
            .at = {{0, 0, rim * std::sin(tilt)}, tilted},
            .twist = {Vec3::Zero(), -turns * std::sin(tilt) * (tilted * Vec3::UnitX())},
            .friction = 0.8};
  }
};

Outcome flat_disk(const std::string& motion) { return worst_gain(motion, EulersDisk{.tilt = 0.3}.body()); }

/// Returns the largest relative error of the speed at which it goes round, and of its energy.
Outcome euler(const std::string& motion) {
  constexpr double rate = 2000, seconds = 1;
  const EulersDisk disk{.tilt = 0.5};
  const PassiveBody body = disk.body();
  Trial t(motion, rate);
  t.add_ground(body.friction);
  const RobotView& r =
      t.add("disk", test::single_body(with(body.shape, body.friction), body.inertia), body.at, body.twist);
  t.start();
  double angle = 0, before = 0;
  for (int i = 0; i < int(rate * seconds); ++i) {
    t.run_for(1 / rate);
    const Vec3 axis = t.pose(r).orientation * Vec3::UnitZ();
    const double now = std::atan2(axis.y(), axis.x());
    angle += std::remainder(now - before, 2 * M_PI), before = now;
  }
  const double seen = energy_of(body.inertia, t.pose(r), t.twist(r)),
               expected = 1.5 * disk.mass * g * disk.rim * std::sin(disk.tilt), turns = std::abs(angle) / seconds;
  return {std::max(std::abs(turns / disk.turns - 1), std::abs(seen / expected - 1)),
          text(turns) + " rad/s for " + text(disk.turns) + ", " + text(seen) + " J for " + text(expected)};
}

/// Checks a box that nearly stands on an edge, and one on a corner, until they lie on a face.
Outcome tipping_boxes(const std::string& motion) {
  const Vec3 size(0.1, 0.1, 0.3);
  const auto gain = [](std::span<const Energies> means) { return gain_of(means); };
  const PassiveBody on_edge{Shape::box(size), solid_box(1, size), {{0, 0, 0.159}, from_rpy(0, 0.3, 0)}, {}};
  const PassiveBody on_corner{
      Shape::box(size), solid_box(1, size), {{0, 0, 0.17}, from_rpy(0.1, 0.3, 0)}, {Vec3::Zero(), {0, 0, 2}}};
  const Outcome a = worst_gain(motion, on_edge, gain), b = worst_gain(motion, on_corner, gain);
  return a.error > b.error ? a : b;
}

mesh::Mesh cone_mesh(double rim, double height) {
  mesh::Mesh m;
  constexpr std::uint32_t sides = 48;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides;
    m.vertices.push_back({rim * std::cos(angle), rim * std::sin(angle), -height / 4});
  }
  m.vertices.push_back({0, 0, 0.75 * height});
  m.vertices.push_back({0, 0, -height / 4});
  for (std::uint32_t i = 0; i < sides; ++i) {
    m.triangles.push_back({i, (i + 1) % sides, sides});
    m.triangles.push_back({(i + 1) % sides, i, sides + 1});
  }
  return m;
}
mesh::Mesh ellipsoid_mesh(const Vec3& half) {
  mesh::Mesh m;
  constexpr std::uint32_t rings = 24, sides = 32;
  const auto at = [](std::uint32_t ring, std::uint32_t side) { return 1 + (ring - 1) * sides + side % sides; };
  m.vertices.push_back({0, 0, half.z()});
  for (std::uint32_t i = 1; i < rings; ++i)
    for (std::uint32_t k = 0; k < sides; ++k) {
      const double a = M_PI * i / rings, b = 2 * M_PI * k / sides;
      m.vertices.push_back(half.cwiseProduct(Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a))));
    }
  const auto last = std::uint32_t(m.vertices.size());
  m.vertices.push_back({0, 0, -half.z()});
  for (std::uint32_t k = 0; k < sides; ++k) {
    m.triangles.push_back({0, at(1, k), at(1, k + 1)});
    m.triangles.push_back({last, at(rings - 1, k + 1), at(rings - 1, k)});
    for (std::uint32_t i = 1; i + 1 < rings; ++i) {
      m.triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      m.triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  }
  return m;
}
Outcome of_mesh(const std::string& motion, const mesh::Mesh& mesh, PassiveBody scene) {
  const test::ScratchFolder folder;
  scene.shape = {.kind = ShapeKind::mesh, .size = {1, 1, 1}};
  scene.mesh = folder.file("body.obj", mesh::testing::obj_text(mesh));
  return worst_gain(motion, scene);
}
/// Checks a cone that rolls round on its side.
Outcome rolling_cone(const std::string& motion) {
  const double rim = 0.05, height = 0.12, slope = std::atan(rim / height), rate = 6;
  const double across = 0.15 * 0.3 * (rim * rim + height * height / 4);
  const Quat lies = from_rpy(0, -(M_PI / 2 + slope), 0);
  const double middle = 0.75 * height * std::sin(slope);
  // the line of contact is at rest
  return of_mesh(motion, cone_mesh(rim, height),
                 {.shape = {},
                  .inertia = {.mass = 0.3, .ixx = across, .iyy = across, .izz = 0.3 * 0.3 * rim * rim},
                  .at = {{0, 0, middle + 1e-4}, lies},
                  .twist = {{0, rate * middle, 0}, {-rate, 0, 0}}});
}
Outcome rolling_ellipsoid(const std::string& motion) {
  const Vec3 half(0.08, 0.05, 0.03), square = half.cwiseAbs2() * (0.4 / 5);
  return of_mesh(motion, ellipsoid_mesh(half),
                 {.shape = {},
                  .inertia = {.mass = 0.4,
                              .ixx = square.y() + square.z(),
                              .iyy = square.x() + square.z(),
                              .izz = square.x() + square.y()},
                  .at = {{0, 0, 0.05}, from_rpy(0.4, 0.2, 0)},
                  .twist = {{0.3, 0, 0}, {0, 3, 5}}});
}

/// Checks a chain of ten links that lies on a table, half of it over the edge.
Outcome chain_over_an_edge(const std::string& motion) {
  constexpr int count = 10;
  constexpr double length = 0.1, thick = 0.01, mass = 0.05, height = 1;  // m, m, kg, m
  const double across = mass * length * length / 12;
  const Inertia inertia{.mass = mass, .com = {length / 2, 0, 0}, .ixx = 0.02 * across, .iyy = across, .izz = across};
  Shape shape = with(Shape::capsule(thick, length - 2 * thick), 0.3);
  shape.origin = {{length / 2, 0, 0}, from_rpy(0, M_PI / 2, 0)};
  const RobotTree tree = test::tree_of([&](RobotBuilder& b) {
    for (int i = 0; i < count; ++i) {
      const std::string number = std::to_string(i);
      if (i > 0) b.translation({length, 0, 0});
      if (i > 0) b.revolute("joint" + number, i % 2 != 0 ? Vec3::UnitY() : Vec3::UnitZ(), {});
      if (i == 0)
        b.base("link0");
      else
        b.body("link" + number);
      b.set(keys::inertial, inertia);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
    }
  });
  Outcome worst;
  for (const double rate : step_rates) {
    Trial t(motion, rate);
    const Shape table = with(Shape::box({1, 1, height}), 0.3);
    t.world().add_scenery("table", {{-0.5, 0, 0.5 * height}, Quat::Identity()}, std::span<const Shape>(&table, 1));
    const RobotView& r = t.add("chain", tree, {{-0.52, 0, height + thick}, Quat::Identity()});
    t.start({{"joints", std::string("passive")}});
    const auto energy = [&] {
      double sum = 0;
      for (const Link& link : r.links)
        sum += energy_of(inertia, t.world().value(link.object, keys::pose), t.world().value(link.object, keys::twist));
      return sum;
    };
    t.run_for(1 / rate);
    std::vector<Energies> means{{energy(), 0}};
    for (int k = 0; k < 20; ++k) means.push_back(mean_of_window(t, rate, [&] { return Energies{energy(), 0}; }));
    const double gain = gain_of(means);
    worst.error = std::max(worst.error, gain);
    worst.seen += text(gain) + " at " + text(rate) + " Hz ";
  }
  return worst;
}

/// Checks boxes, cylinders and capsules that fall at a slant.
Outcome random_bodies(const std::string& motion) {
  Outcome worst;
  test::Randoms random(5);
  for (int i = 0; i < 12; ++i) {
    const Vec3 size(random.uniform(0.05, 0.3), random.uniform(0.05, 0.3), random.uniform(0.05, 0.3));
    const Shape shapes[] = {Shape::box(size), Shape::cylinder(size.x() / 2, size.z()),
                            Shape::capsule(size.x() / 2, size.z())};
    const Inertia inertia = i % 3 == 0 ? solid_box(1, size) : solid_cylinder(1, size.x() / 2, size.z());
    const double spin = random.uniform(0, 5);
    PassiveBody s{
        shapes[i % 3], inertia, {{0, 0, 0.4}, random.rotation()}, {random.direction(), spin * random.direction()}};
    s.friction = random.uniform(0, 1);
    const double gain = gain_of(energies(motion, s, 1000));
    worst.error = std::max(worst.error, gain);
  }
  worst.seen = text(worst.error);
  return worst;
}

}  // namespace

std::vector<Case> passivity_cases() {
  constexpr Features needs = feature_contact | feature_friction;
  constexpr double most = 1e-3;
  return {
      {"a tilted cylinder that turns gains no energy", "of the energy", needs, most, tilted_cylinder},
      {"a coin that spins gains no energy", "of the energy", needs, most, spinning_coin},
      {"a wheel that leans gains no energy", "of the energy", needs, most, leaning_wheel},
      {"a disk that rolls and falls over gains no energy", "of the energy", needs, most, rolling_disk},
      {"Euler's disk goes round by sqrt(4 g / (R sin tilt))", "relative", needs, 0.02, euler},
      {"Euler's disk gains no energy", "of the energy", needs, most, flat_disk},
      {"boxes that tip over gain no energy", "of the energy", needs, most, tipping_boxes},
      {"a cone that rolls round gains no energy", "of the energy", needs | feature_convex_meshes, most, rolling_cone},
      {"an ellipsoid that rolls gains no energy", "of the energy", needs | feature_convex_meshes, most,
       rolling_ellipsoid},
      {"a chain that slides over an edge gains no energy", "of the energy", needs | feature_link_dynamics, most,
       chain_over_an_edge},
      {"random bodies that fall gain no energy", "of the energy", needs, most, random_bodies},
  };
}

}  // namespace muro::conformance
