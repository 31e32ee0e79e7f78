// SPDX-License-Identifier: MIT
// Two robots that touch: each feels the other, whichever motions move them and whatever computes their contact.
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

constexpr double mass = 2, body_mass = 1.5;  // of the load, and of its part above the sole
const Vec3 spot(0.05, 0.03, 0);              // of the load, on the tray

/// Returns a load that stands on a sole of 0.04 m, with a fixed joint between body and sole.
RobotTree standing_load() {
  const Shape sole = test::with(Shape::box({0.1, 0.1, 0.04}), 0.8);
  return test::tree_of([&](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, test::solid_box(body_mass, {0.1, 0.1, 0.1}));
    b.translation({0, 0, -0.05});
    b.body("sole");
    b.set(keys::inertial, test::solid_box(mass - body_mass, {0.1, 0.1, 0.04}));
    b.set_array(keys::collision_shapes, std::span<const Shape>(&sole, 1));
  });
}

std::vector<std::string> motions_by_forces() {
  std::vector<std::string> some = motions();
  std::erase_if(some, [](const std::string& motion) { return family_of(motion) != Family::forces; });
  return some;
}

/// A carrier at rest with a load of another motion, or of its own, on its tray.
struct Carrying : Trial {
  const RobotView *carrier, *load;
  Carrying(const std::string& motion, const std::string& motion_of_load) : Trial(motion) {
    const double height = family() == Family::forces ? 0.1 : 0.3;  // other carriers hang in the air
    if (family() == Family::forces) add_ground();
    carrier = &add_carrier({{0, 0, height}, Quat::Identity()});
    load = &add_load(motion_of_load, standing_load(), {spot + Vec3(0, 0, height + 0.57), Quat::Identity()});
  }
  ObjectId sensor(const RobotView& r, const std::string& id, const std::string& on, Parameters parameters = {}) {
    const std::string name = "sensor_" + std::to_string(world().object_count());
    const ObjectId object = add_sensor_object(r, name, world().object(std::string(r.name) + "/" + on));
    use(id, 1000, {{&r, object}}, std::move(parameters));
    return object;
  }
  void settle() {
    start();
    run_for(1.0005);
  }
};

/// Returns the worst result of all motions that the load may have.
Outcome worst_of_loads(const std::string& motion, Outcome (*run)(const std::string&, const std::string&)) {
  Outcome worst{0, "all alike"};
  for (const std::string& other : motions_by_forces())
    if (const Outcome o = run(motion, other); !(o.error <= worst.error)) worst = {o.error, other + ": " + o.seen};
  return worst;
}

Outcome tray_bears(const std::string& motion, const std::string& motion_of_load) {
  Carrying t(motion, motion_of_load);
  const ObjectId s = t.sensor(*t.carrier, "sensor.force_torque", "tray");
  t.settle();
  const Wrench seen = t.world().value(s, keys::sensed_wrench);
  const Vec3 weight(0, 0, -mass * g);
  const Outcome force = difference(seen.force / (mass * g), Vec3(0, 0, -1 - 0.2 / mass));
  const Outcome torque = difference(seen.torque / (mass * g), Vec3(spot.cross(weight) / (mass * g)));
  return force.error > torque.error ? force : torque;
}
Outcome tray_bears_all(const std::string& motion) { return worst_of_loads(motion, tray_bears); }

/// Checks a bumper with a threshold below the weight, and one with a threshold above it.
Outcome tray_is_pressed(const std::string& motion, const std::string& motion_of_load) {
  Carrying t(motion, motion_of_load);
  const auto bumper = [&](double threshold) {
    return t.sensor(*t.carrier, "sensor.bumper", "tray", {{"threshold", threshold * mass * g}});
  };
  const ObjectId below = bumper(0.95), above = bumper(1.05);
  t.settle();
  return difference(
      double(t.world().value(below, keys::bumper_pressed)) - double(t.world().value(above, keys::bumper_pressed)), 1);
}
Outcome tray_is_pressed_by_all(const std::string& motion) { return worst_of_loads(motion, tray_is_pressed); }

/// Checks the sensors of the load: its sole carries its weight, and its body stands on the sole.
Outcome load_stands(const std::string& motion, const std::string& motion_of_load) {
  Carrying t(motion, motion_of_load);
  const ObjectId foot = t.sensor(*t.load, "sensor.foot", "sole"),
                 joint = t.sensor(*t.load, "sensor.force_torque", "sole"),
                 bumper = t.sensor(*t.load, "sensor.bumper", "sole", {{"threshold", 0.95 * mass * g}});
  t.settle();
  const Vec3 seen(t.world().value(foot, keys::foot_force) / (mass * g),
                  t.world().value(joint, keys::sensed_wrench).force.z() / (body_mass * g),
                  t.world().value(bumper, keys::bumper_pressed));
  return difference(seen, Vec3(1, 1, 1));
}
Outcome all_loads_stand(const std::string& motion) { return worst_of_loads(motion, load_stands); }

/// Checks a foot sensor on the carrier's base, turned so that z points up to the ground: the weight of both.
Outcome carrier_stands(const std::string& motion, const std::string& motion_of_load) {
  Carrying t(motion, motion_of_load);
  const ObjectId foot = t.sensor(*t.carrier, "sensor.foot", "base_link");
  t.settle();
  return difference(t.world().value(foot, keys::foot_force) / ((2 + 0.2 + mass) * g), 1);
}
Outcome carriers_stand(const std::string& motion) { return worst_of_loads(motion, carrier_stands); }

/// Checks a box that slides without friction into a carrier that nothing has touched before.
Outcome is_run_into(const std::string& motion, const std::string& motion_of_load) {
  Trial t(motion);
  t.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  t.add_carrier({{0, 0, 0.3}, Quat::Identity()});
  const ObjectId bumper = t.add_sensor("sensor.bumper", "tray"), base = t.add_sensor("sensor.bumper", t.base_name());
  t.add_load(motion_of_load, test::block(mass, {0.1, 0.1, 0.1}, 0), {{0.3, 0, 0.79}, Quat::Identity()},
             {{-1, 0, 0}, Vec3::Zero()});
  t.start();
  t.run_for(0.0905);
  const double before = t.world().value(bumper, keys::bumper_pressed);
  double during = 0, elsewhere = 0;
  for (int k = 0; k < 60; ++k) {
    t.run_for(0.001);
    during = std::max(during, double(t.world().value(bumper, keys::bumper_pressed)));
    elsewhere = std::max(elsewhere, double(t.world().value(base, keys::bumper_pressed)));
  }
  return difference(Vec3(before, during, elsewhere), Vec3(0, 1, 0));
}
Outcome is_run_into_by_all(const std::string& motion) { return worst_of_loads(motion, is_run_into); }

constexpr How a = How::analytic, d = How::differenced, none = How::left_out;

}  // namespace

std::vector<Case> pair_cases() {
  return {
      {"a tray bears what stands on it, of any motion by forces",
       "sensor.force_torque",
       "m g, m g m",
       {a, a, d},
       {1e-3, 1e-3, 1e-3},
       tray_bears_all},
      {"a tray is pressed by what stands on it, with its weight",
       "sensor.bumper",
       "1",
       {a, a, a},
       {0, 0, 0},
       tray_is_pressed_by_all},
      {"what stands on a tray feels its own weight", "all", "m g", {a, a, d}, {1e-3, 1e-3, 1e-3}, all_loads_stand},
      {"a foot feels what its robot carries", "sensor.foot", "relative", {none, none, a}, {0, 0, 1e-3}, carriers_stand},
      {"a bumper is pressed by a robot that runs into it",
       "sensor.bumper",
       "1",
       {a, a, a},
       {0, 0, 0},
       is_run_into_by_all},
  };
}

}  // namespace muro::sensor_conformance
