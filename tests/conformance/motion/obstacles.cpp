// SPDX-License-Identifier: MIT
// Robots moved by commands among robots moved by forces.
#include "tests/conformance/motion/case.hpp"
#include "tests/conformance/motion/recorded_contacts.hpp"

namespace muro::conformance {

namespace {

/// The robots under test, and one that motion.point moves.
struct ObstacleTrial : Trial {
  std::string motion;
  std::vector<Item> tested;
  explicit ObstacleTrial(const std::string& id) : Trial(id), motion(id) {}

  /// Ends the list of robots under test; robots that are added later move by motion.point.
  void test_those() { tested = all_robots(); }
  void begin() {
    std::vector<Item> others(all_robots());
    others.erase(others.begin(), others.begin() + std::ptrdiff_t(tested.size()));
    use(motion, 1000, tested);
    use("motion.point", 1000, others);
    use_contacts();
    build();
  }
};

Outcome pushes(const std::string& motion) {
  ObstacleTrial m(motion);
  m.add_ground(0.3);
  const RobotView& box = m.add("box", block(2, {0.2, 0.2, 0.2}, 0.3), {{0.3, 0, 0.1}, Quat::Identity()});
  m.test_those();
  const RobotView& plate =
      m.add("plate", block(1, {0.1, 0.6, 0.1}, 0.3), {{0, 0, 0.15}, Quat::Identity()}, {{0.5, 0, 0}, Vec3::Zero()});
  m.begin();
  m.world().value(plate.base(), keys::command_twist) = {{0.5, 0, 0}, Vec3::Zero()};
  m.run_for(2);
  const double gap = m.pose(box).position.x() - m.pose(plate).position.x() - 0.15;
  const double plate_off = std::abs(m.pose(plate).position.x() - 1);
  return {std::max({std::abs(m.twist(box).linear.x() - 0.5), std::abs(gap), plate_off}),
          text(m.twist(box).linear.x()) + " m/s for 0.5, gap " + text(gap) + " m"};
}

/// Checks that a block on a plate that moves at 1 m/s is accelerated with mu g.
Outcome drags(const std::string& motion, bool to_the_end) {
  ObstacleTrial m(motion);
  const RobotView& box = m.add("box", block(1, {0.2, 0.2, 0.1}, 0.4), {{0, 0, 0.1}, Quat::Identity()});
  m.test_those();
  const RobotView& plate = m.add("plate", block(1, {4, 4, 0.1}, 0.4), {{0, 0, 0}, Quat::Identity()});
  m.begin();
  m.run_for(0.5);  // it has come to rest
  m.world().value(plate.base(), keys::command_twist) = {{1, 0, 0}, Vec3::Zero()};
  if (to_the_end) {
    m.run_for(1);
    return relative(m.twist(box).linear.x(), 1);
  }
  m.run_for(0.05);
  const double before = m.twist(box).linear.x();
  m.run_for(0.1);
  return relative(m.twist(box).linear.x() - before, 0.4 * g * 0.1);
}
Outcome drags_along(const std::string& motion) { return drags(motion, true); }
Outcome drags_with_friction(const std::string& motion) { return drags(motion, false); }

Outcome is_blocked(const std::string& motion) {
  ObstacleTrial m(motion);
  m.add_ground(0.5);
  const RobotView& r = m.add("ball", ball(1, 0.1, 0.5), {{0, 0, 0.1}, Quat::Identity()}, {{1, 0, 0}, {0, 10, 0}});
  m.test_those();
  const RobotView& wall = m.add("wall", block(1, {0.1, 2, 1}, 0), {{0.5, 0, 0.5}, Quat::Identity()});
  m.begin();
  m.run_for(2);
  const double past = std::max(m.pose(r).position.x() - 0.35, 0.0);
  return {past + (m.pose(wall).position - Vec3(0.5, 0, 0.5)).norm(), text(m.pose(r).position.x()) + " m of 0.35"};
}

/// Returns the largest speed of a part of 2 kg and its hardest contact. Two tilted plates squeeze its foot of 0.2 kg
/// from above and below by 2 mm each, move to and fro for 2 s, and release it at 0.5 m/s.
Outcome squeezes(const std::string& motion) {
  constexpr double size = 0.04, thickness = 0.02, tilt = 0.05, squeeze = 0.002;
  ObstacleTrial m(motion);
  const Shape shape = with(Shape::box({size, size, size}), 0.5);
  const RobotView& part = m.add("part", test::tree_of([&](RobotBuilder& b) {
                                  b.base("trunk");
                                  b.set(keys::inertial, solid_box(2, {0.1, 0.1, 0.1}));
                                  b.translation({0.15, 0, 0});
                                  b.revolute("ankle", Vec3::UnitY(), {.velocity = 10, .effort = 20});
                                  b.body("foot");
                                  b.set(keys::inertial, solid_box(0.2, {size, size, size}));
                                  b.set_array(keys::collision_shapes, std::span<const Shape>(&shape, 1));
                                }),
                                {{-0.15, 0, 1}, Quat::Identity()});
  m.test_those();
  const RobotView* plates[2];
  for (const int i : {0, 1}) {
    const double side = i == 0 ? 1 : -1;
    const double height = 0.5 * (size + thickness) + 0.5 * size * std::sin(tilt);
    plates[i] = &m.add(i == 0 ? "above" : "below", block(1, {0.2, 0.2, thickness}, 0.5),
                       {{0, 0, 1 + side * height}, Quat(Eigen::AngleAxisd(side * tilt, Vec3::UnitY()))});
  }
  double fastest = 0, hardest = 0;
  const auto go_on = [&](double seconds, double closing, double across) {
    for (const int i : {0, 1}) {
      const Vec3 v(across, 0, i == 0 ? -closing : closing);
      m.world().value(plates[i]->base(), keys::command_twist) = {m.pose(*plates[i]).orientation.conjugate() * v,
                                                                 Vec3::Zero()};
    }
    for (double t = 0; t < seconds - 1e-9; t += 1e-3) {
      m.run_for(1e-3);
      fastest = std::max(fastest, m.twist(part).linear.norm());
    }
  };
  const auto contacts = recorded_contacts(m, [&] {
    m.begin();
    go_on(0.02, squeeze / 0.02, 0);
    for (int i = 0; i < 20; ++i) go_on(0.1, i % 2 ? 0.01 : -0.01, i % 2 ? 0.05 : -0.05);
    go_on(0.05, -0.5, 0);
  });
  for (const RecordedContact& c : contacts) hardest = std::max(hardest, c.force.norm());
  return {std::max(fastest, hardest / 1000), text(fastest) + " m/s, " + text(hardest) + " N"};
}

}  // namespace

std::vector<Case> obstacle_cases() {
  constexpr Features needs = feature_contact | feature_forces;
  return {
      {"a robot that commands move pushes a box at its speed", "m/s, m", needs | feature_friction, 5e-3, pushes},
      {"a moving plate drags a block with mu g", "relative", needs | feature_friction, 2e-2, drags_with_friction},
      {"a moving plate takes a block along", "relative", needs | feature_friction, 1e-3, drags_along},
      {"what moving plates squeeze is not thrown", "of 1 m/s, 1 kN", needs | feature_friction | feature_joints, 1,
       squeezes},
      {"a robot that stands still stops a ball and stays", "m", needs, 2e-3, is_blocked},
  };
}

}  // namespace muro::conformance
