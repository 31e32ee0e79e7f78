// SPDX-License-Identifier: MIT
// Robots that clients control, for tests.
#pragma once

#include "plugins/controller/common/wire_protocol/dialogue_testing.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro::joints {

using wire::ask;
using wire::Client;
using wire::next_line;
using wire::numbers_of;
using wire::Settings;
using wire::Texts;

/// Returns an arm: a fixed base, a shoulder that turns from -1.5 to 2 rad, an elbow, a slide from 0 to 0.5 m.
inline RobotTree arm_tree() {
  return test::tree_of([](RobotBuilder& b) {
    const Inertia inertia{.mass = 1, .ixx = 0.01, .iyy = 0.01, .izz = 0.01};
    b.base("foot");
    b.set(keys::inertial, inertia);
    b.revolute("shoulder", Vec3::UnitZ(), {.lower = -1.5, .upper = 2, .velocity = 3});
    b.body("upper");
    b.set(keys::inertial, inertia);
    b.translation({0.5, 0, 0});
    b.revolute("elbow", Vec3::UnitZ(), {});
    b.body("lower");
    b.set(keys::inertial, inertia);
    b.prismatic("slide", Vec3::UnitX(), {.lower = 0, .upper = 0.5});
    b.body("hand");
    b.set(keys::inertial, inertia);
  });
}

inline Settings stream_at(const std::string& where, Settings more = {}) {
  more["stream"] = Texts{where};
  return more;
}

/// Arms whose joints follow targets of one mode, at 1000 Hz. The controller runs at 100 Hz.
struct Arms : wire::Served {
  explicit Arms(const std::string& mode, int count = 1, Settings settings = stream_at("tcp=0"), double rate = 100) {
    for (int i = 0; i < count; ++i) arms.push_back(&add("arm_" + std::to_string(i), arm_tree()));
    use("motion.simplified", 1000, all_robots(), {{"base", "fixed"}, {"joints", mode}});
    use("controller.joints", rate, all_robots(), std::move(settings));
  }
  double& joint(const std::string& name, const Key<double>& key) { return world().value("arm_0/" + name, key); }
  double position(const std::string& name) { return joint(name, keys::joint_position); }
  std::vector<const RobotView*> arms;
};

/// Balls that motion.point moves as commanded.
struct Rovers : wire::Served {
  explicit Rovers(Settings settings = stream_at("tcp=0"), int count = 1, double rate = 50) {
    for (int i = 0; i < count; ++i)
      rovers.push_back(&add("rover_" + std::to_string(i),
                            test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1})));
    use("motion.point", 1000, all_robots());
    use("controller.joints", rate, all_robots(), std::move(settings));
  }
  Twist& command(int rover = 0) { return world().value(rovers[std::size_t(rover)]->base(), keys::command_twist); }
  std::vector<const RobotView*> rovers;
};

}  // namespace muro::joints
