// SPDX-License-Identifier: MIT
// Lines and faces in contact: friction acts as it does with distributed pressure, and bodies tip over their edges.
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/mesh/files_testing.hpp"
#include "tests/conformance/motion/case.hpp"
#include "tests/support/files.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro::conformance {

namespace {

constexpr double mu = 0.5;

// --- wheels with a width

constexpr double track = 0.3, wheel_radius = 0.05;  // m

/// Returns a cart with two driven wheels, and balls without friction at front and rear.
RobotTree cart(const std::function<Shape(RobotBuilder&)>& wheel) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    b.set(keys::inertial, solid_box(4, {0.3, 0.2, 0.05}));
    Shape feet[] = {with(Shape::sphere(0.02), 0), with(Shape::sphere(0.02), 0)};
    feet[0].origin.position = {0.12, 0, 0.02 - wheel_radius};
    feet[1].origin.position = {-0.12, 0, 0.02 - wheel_radius};
    b.set_array(keys::collision_shapes, std::span<const Shape>(feet));
    for (const double side : {1.0, -1.0}) {
      b.fork();
      b.translation({0, 0.5 * side * track, 0});
      const std::string name = side > 0 ? "left" : "right";
      b.revolute(name + "_joint", Vec3::UnitY(), {});
      b.body(name);
      b.set(keys::inertial, test::round_body(0.5, wheel_radius));
      const Shape shape = with(wheel(b), 0.8);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
      b.end();
    }
    b.end();
    b.end();
  });
}

/// Returns the rate of a cart (rad/s) with wheels that turn for `speed` (m/s) and `rate` (rad/s) about their middles.
double turns(const std::string& motion, const RobotTree& tree, double speed, double rate) {
  Trial t(motion);
  t.add_ground(0.8);
  const RobotView& r = t.add("r", tree, {{0, 0, wheel_radius}, Quat::Identity()});
  t.start();
  t.run_for(0.2);
  t.joint("r/left_joint", keys::joint_velocity_target) = (speed - 0.5 * rate * track) / wheel_radius;
  t.joint("r/right_joint", keys::joint_velocity_target) = (speed + 0.5 * rate * track) / wheel_radius;
  t.run_for(0.8);
  const auto heading = [&] { return yaw_of(t.pose(r).orientation); };
  const double before = heading();
  t.run_for(1);
  return std::remainder(heading() - before, 2 * M_PI);
}

/// Returns the rate of a cart with wide wheels. A wheel rolls about a point s b / 2 outside its middle: there the
/// torque of its traction, mu N s at the arm T / 2, equals that of friction across it, mu N (1 - s^2) b / 4.
double rate_with_width(double rate, double width) {
  const double k = width / (2 * track), s = 2 * k / (1 + std::sqrt(1 + 4 * k * k));
  return rate * track / (track + s * width);
}

Outcome turns_with_width(const std::string& motion, double width, const RobotTree& tree) {
  Outcome worst;
  for (const auto& [speed, rate] : {std::pair(0.0, 0.5), {0.3, 0.5}, {0.1, 1.0}, {0.5, -0.1}}) {
    const Outcome found = relative(turns(motion, tree, speed, rate), rate_with_width(rate, width));
    if (found.error >= worst.error) worst = found;
  }
  return worst;
}
RobotTree cart_with_width(double width) {
  return cart([&](RobotBuilder&) { return test::tyre(wheel_radius, width); });
}
Outcome narrow_wheels(const std::string& motion) { return turns_with_width(motion, 0.03, cart_with_width(0.03)); }
Outcome wide_wheels(const std::string& motion) { return turns_with_width(motion, 0.06, cart_with_width(0.06)); }
Outcome balls(const std::string& motion) {
  return turns_with_width(motion, 0, cart([](RobotBuilder&) { return Shape::sphere(wheel_radius); }));
}

/// Checks wheels that are prisms of many sides.
Outcome mesh_wheels(const std::string& motion) {
  constexpr double width = 0.03;
  constexpr std::uint32_t sides = 120;
  mesh::Mesh m;
  for (std::uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * M_PI * i / sides, x = wheel_radius * std::cos(angle), z = wheel_radius * std::sin(angle);
    m.vertices.insert(m.vertices.end(), {{x, 0.5 * width, z}, {x, -0.5 * width, z}});
    const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % sides);
    m.triangles.insert(m.triangles.end(), {{a, b, a + 1}, {b, b + 1, a + 1}});
    if (i > 0 && i + 1 < sides) m.triangles.insert(m.triangles.end(), {{0, b, a}, {1, a + 1, b + 1}});
  }
  const test::ScratchFolder folder;
  const std::string file = folder.file("wheel.obj", mesh::testing::obj_text(m));
  const auto wheel = [&](RobotBuilder& b) {
    Shape s{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
    s.mesh = b.intern(file);
    return s;
  };
  return turns_with_width(motion, width, cart(wheel));
}

// --- plates that spin

/// A body of 1 kg that lies on its face and spins. Its inertia is that of a flat body.
struct Plate : Trial {
  const RobotView* plate_;
  Plate(const std::string& motion, const Shape& shape, double inertia, double height, const Twist& twist)
      : Trial(motion) {
    add_ground(mu);
    plate_ = &add(
        "plate",
        test::single_body(with(shape, mu), {.mass = 1, .ixx = 0.6 * inertia, .iyy = 0.6 * inertia, .izz = inertia}),
        {{0, 0, 0.5 * height}, Quat::Identity()}, twist);
    start();
  }
  double spin() { return twist(*plate_).angular.z(); }
  double speed() { return twist(*plate_).linear.norm(); }
};

/// Checks the torque on a face, mu N times `arm` (m), the mean distance of the face from its middle.
Outcome spins(const std::string& motion, const Shape& shape, double inertia, double arm) {
  Plate t(motion, shape, inertia, 0.05, {Vec3::Zero(), {0, 0, 20}});
  t.run_for(0.1);
  const double before = t.spin(), duration = 0.3 * 20 * inertia / (mu * g * arm);
  t.run_for(duration);
  return relative((before - t.spin()) / duration, mu * g * arm / inertia);
}
/// Returns the mean distance of a rectangle with the half lengths a and b from its middle.
double mean_distance(double a, double b) {
  const double d = std::hypot(a, b);
  return (d + a * a / (2 * b) * std::log((b + d) / a) + b * b / (2 * a) * std::log((a + d) / b)) / 3;
}
Outcome spinning_box(const std::string& motion, double length, double width) {
  return spins(motion, Shape::box({length, width, 0.05}), (length * length + width * width) / 12,
               mean_distance(0.5 * length, 0.5 * width));
}
Outcome square(const std::string& motion) { return spinning_box(motion, 0.3, 0.3); }
Outcome rectangle(const std::string& motion) { return spinning_box(motion, 0.4, 0.2); }
Outcome rod(const std::string& motion) { return spinning_box(motion, 0.5, 0.01); }
Outcome disc(const std::string& motion) {
  return spins(motion, Shape::cylinder(0.2, 0.05), 0.5 * 0.2 * 0.2, 2.0 / 3 * 0.2);
}

/// Checks a disc of even pressure that slides at v and spins at w: both end at one instant (Farkas, Bartels, Unger,
/// Wolf, Frictional coupling between sliding and spinning motion, 2003), found by quadrature. The error is a fraction
/// of that time: the time between both ends (a hundredth of v and w), or half the error of the end of sliding.
Outcome slides_and_spins(const std::string& motion) {
  constexpr double rim = 0.2, inertia = 0.5 * rim * rim, v0 = 1, w0 = 6;
  double v = v0, w = w0, expected = 0;
  for (constexpr double tick = 1e-3; v > 0.01 * v0 || w > 0.01 * w0; expected += tick) {
    double force = 0, torque = 0;
    constexpr int rings = 20, sectors = 40;
    for (int i = 0; i < rings; ++i)
      for (int k = 0; k < sectors; ++k) {
        const double r = rim * std::sqrt((i + 0.5) / rings), angle = 2 * M_PI * (k + 0.5) / sectors;
        const double x = v - w * r * std::sin(angle), y = w * r * std::cos(angle), size = std::hypot(x, y);
        force += x / size / (rings * sectors);
        torque += r * (y * std::cos(angle) - x * std::sin(angle)) / size / (rings * sectors);
      }
    v -= tick * mu * g * force;
    w -= tick * mu * g * torque / inertia;
  }
  Plate t(motion, Shape::cylinder(rim, 0.05), inertia, 0.05, {{v0, 0, 0}, {0, 0, w0}});
  double slid = 0, spun = 0;
  for (double time = 0; time < 2 * expected; time += 1e-3) {
    t.run_for(1e-3);
    if (t.speed() > 0.01 * v0) slid = time;
    if (t.spin() > 0.01 * w0) spun = time;
  }
  return {std::max(std::abs(slid - expected) / 2, std::abs(spun - slid)) / expected,
          "slides for " + text(slid) + " s and spins for " + text(spun) + " s of " + text(expected)};
}

/// Checks that a block tips where the slope is as steep as its diagonal, whatever carries the friction.
Outcome tips_over_its_edge(const std::string& motion) {
  constexpr double b = 0.2, h = 0.5;
  const auto falls = [&](double slope) {
    Trial t(motion);
    t.add_slope(slope, 1.5);
    const Quat turn = from_rpy(0, -slope, 0);
    const RobotView& r = t.add("block", block(1, {b, b, h}, 1.5), {turn * Vec3(0, 0, 0.5 * h), turn});
    t.start();
    t.run_for(3);
    return (t.pose(r).orientation * Vec3::UnitZ()).dot(turn * Vec3::UnitZ()) < 0.9;
  };
  const double limit = std::atan(b / h);
  const bool below = falls(limit - 0.02), above = falls(limit + 0.02);
  return {below || !above ? 1.0 : 0.0,
          std::string(below ? "falls" : "stays") + " 1 deg below, " + (above ? "falls" : "stays") + " 1 deg above"};
}

}  // namespace

std::vector<Case> patch_cases() {
  constexpr Features needs = feature_contact | feature_friction;
  constexpr Features drive = needs | feature_velocity_targets;
  return {
      {"a cart on wheels of 3 cm turns with T + s b", "relative", drive, 5e-3, narrow_wheels},
      {"a cart on wheels of 6 cm turns with T + s b", "relative", drive, 5e-3, wide_wheels},
      {"a cart on wheels that are meshes turns with T + s b", "relative", drive | feature_convex_meshes, 5e-3,
       mesh_wheels},
      {"a cart on balls turns with T", "relative", drive, 5e-3, balls},
      {"a square that spins is slowed by its pressure", "relative", needs, 0.05, square},
      {"a rectangle that spins is slowed by its pressure", "relative", needs, 0.05, rectangle},
      {"a rod that spins is slowed by its pressure", "relative", needs, 0.05, rod},
      {"a disc that spins is slowed by its pressure", "relative", needs, 0.05, disc},
      {"a disc slides and spins until one instant", "relative", needs, 0.05, slides_and_spins},
      {"a block tips over its edge where tan is b / h", "falls wrongly", needs, 0, tips_over_its_edge},
  };
}

}  // namespace muro::conformance
