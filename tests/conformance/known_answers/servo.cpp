// SPDX-License-Identifier: MIT
// motor.servo with motors driven by a voltage, in motion.simplified; for other motions see plugins/motor/servo.
#include "tests/conformance/known_answers/answer.hpp"
#include "tests/support/scene.hpp"

namespace muro::known_answers {

namespace {

using Parameters = std::map<std::string, ParameterInput>;

// MX-64, M1 (Rhoban/bam): N m/A, Ohm, kg m^2, N m, N m s/rad
constexpr double kt = 1.622, resistance = 3.949, armature = 0.01195, coulomb = 0.0904, viscous = 0.0117;
constexpr double mass = 0.49, length = 0.1, weight = mass * 9.81 * length;
constexpr double bob_inertia = mass * length * length + 1e-7;

/// A pendulum on a fixed base about a level axis, or about the vertical axis, where weight has no torque.
struct Bench : test::Scene {
  enum class Axis : std::uint8_t { level, vertical };
  Bench(const Parameters& servo, Axis axis, double rate = 1000, double start = 0) {
    const bool vertical = axis == Axis::vertical;
    add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("stand");
          b.set(keys::inertial, Inertia{.mass = 10, .ixx = 1, .iyy = 1, .izz = 1});
          b.revolute("joint", vertical ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitY()), {});
          b.body("bob");
          const Vec3 com = vertical ? Vec3(length, 0, 0) : Vec3(0, 0, -length);
          b.set(keys::inertial, Inertia{.mass = mass, .com = com, .ixx = 1e-7, .iyy = 1e-7, .izz = 1e-7});
        }));
    world().set(world().object("r/joint"), keys::initial_joint_position, start);
    use("motion.simplified", rate, all_robots(), {{"joints", "effort"}, {"base", "fixed"}});
    use("motor.servo", rate, all_robots(), servo);
    build();
  }
  double& of(const Key<double>& key) { return world().value("r/joint", key); }
  double& of(const char* name) { return of(Key<double>{name, "", ""}); }
  /// Applies the full voltage in the positive direction from now on.
  void full_voltage() { of(keys::joint_position_target) = 1e5; }
};

Parameters mx64(double volts) {
  return {{"part", "mx64"}, {"friction_model", "m1"}, {"supply_voltage", volts}, {"duty_limit", 1.0}};
}

double speed_at(double volts) {
  Bench b(mx64(volts), Bench::Axis::vertical);
  b.full_voltage();
  b.run_for(0.6);
  return b.of(keys::joint_velocity);
}

double no_load_speed(double volts) { return (kt * volts / resistance - coulomb) / (kt * kt / resistance + viscous); }

Found no_load_speed_at_12_v() { return {std::abs(speed_at(12) - no_load_speed(12)), 1e-6}; }

Found stall_torque() {
  Bench b(mx64(12), Bench::Axis::vertical);
  b.full_voltage();
  b.run_for(0.0005);
  const double stall = b.of("motor.effort") - b.of(keys::joint_drive_friction);
  return {std::abs(stall - (kt * 12 / resistance - coulomb)), 1e-12};
}

/// Returns the largest difference from w0 (1 - exp(-t / tau)), tau with the link's inertia.
double step_error(double rate) {
  const double w0 = no_load_speed(12), tau = (bob_inertia + armature) / (kt * kt / resistance + viscous);
  Bench b(mx64(12), Bench::Axis::vertical, rate);
  b.full_voltage();
  double worst = 0;
  for (int k = 1; k <= 20; ++k) {
    b.run_until(std::int64_t(k) * 5'000'000);
    worst = std::max(worst, std::abs(b.of(keys::joint_velocity) - w0 * (1 - std::exp(-0.005 * k / tau))));
  }
  return worst;
}
Found step_at_10_khz() { return {step_error(10000), 7.5e-3}; }
Found step_halves() { return {std::abs(step_error(5000) / step_error(10000) - 2), 0.2}; }

/// Speeds without load at 1 .. 15 V, rad/s: Rhoban/bam, atomic/data/velocity_mx64.json.
Found measured_speeds() {
  constexpr double measured[] = {0.53198, 1.12073, 1.70456, 2.29023, 2.87867, 3.46557, 4.05738, 4.63814,
                                 5.22198, 5.81624, 6.40007, 7.00109, 7.60517, 8.19146, 8.77406};
  double worst = 0;
  for (int volts = 1; volts <= 15; ++volts) worst = std::max(worst, std::abs(speed_at(volts) - measured[volts - 1]));
  return {worst, 0.021 * measured[14]};
}

/// Drift within 3 s at angles where m g l |sin q| is at most the friction budget.
Found sticking() {
  const double most = 0.2;
  double drift = 0;
  for (const double angle : {0.1, -0.2, 0.4, std::asin(most / weight) - 1e-9}) {
    Bench b({{"part", "mx64"}, {"friction_model", "m1"}, {"friction", most}}, Bench::Axis::level, 1000, angle);
    b.of("servo.torque_enable") = 0;
    b.run_for(3);
    drift = std::max(drift, std::abs(b.of(keys::joint_position) - angle));
  }
  return {drift, 0};
}

}  // namespace

std::vector<Answer> servo_answers() {
  const std::string_view s = "motor.servo";
  return {
      {s, "an MX-64 (M1) at 12 V turns at (kt V/R - Kc)/(kt^2/R + Kv) without load", "closed form: 7.135 rad/s",
       "rad/s", "rounding, stated", no_load_speed_at_12_v},
      {s, "the stall torque of this MX-64 is kt V/R - Kc", "closed form: 4.84 N m", "N m", "rounding", stall_torque},
      {s, "a step of the voltage is w0 (1 - exp(-t/tau)), at 10 kHz", "closed form", "rad/s", "0.1 % of w0",
       step_at_10_khz},
      {s, "the error of the step halves with the period", "first order", "of 2", "10 %", step_halves},
      {s, "speeds at 1 to 15 V are those that were measured at an MX-64", "Rhoban/bam, velocity_mx64", "rad/s",
       "2.1 % of the fastest", measured_speeds},
      {s, "friction holds a pendulum at any angle up to its budget, without drift", "closed form", "rad", "none",
       sticking},
  };
}

}  // namespace muro::known_answers
