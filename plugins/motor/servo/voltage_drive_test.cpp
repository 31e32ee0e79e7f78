// SPDX-License-Identifier: MIT
// motor.servo with a motor driven by a voltage, in front of every motion whose joints take efforts.
#include <gtest/gtest.h>

#include <fstream>

#include "muro/base/motor_model.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;

constexpr double mass = 0.49, length = 0.1, weight = mass * 9.81 * length;

/// A pendulum on a fixed base: 0.49 kg at 0.1 m; at 0 it hangs down. With `vertical` it turns about the vertical.
RobotTree pendulum(bool vertical) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("stand");
    b.set(keys::inertial, Inertia{.mass = 10, .ixx = 1, .iyy = 1, .izz = 1});
    b.revolute("joint", vertical ? Vec3(Vec3::UnitZ()) : Vec3(-Vec3::UnitY()), {});
    b.body("bob");
    const Vec3 com = vertical ? Vec3(length, 0, 0) : Vec3(0, 0, -length);
    b.set(keys::inertial, Inertia{.mass = mass, .com = com, .ixx = 1e-7, .iyy = 1e-7, .izz = 1e-7});
  });
}

constexpr double bob_inertia = mass * length * length + 1e-7;

struct VoltageBench : test::Scene {
  explicit VoltageBench(const Parameters& servo, const std::string& motion = "motion.simplified", double rate = 1000,
                        double start = 0, bool vertical = false) {
    add("r", pendulum(vertical));
    world().set(world().object("r/joint"), keys::initial_joint_position, start);
    use(motion, rate, all_robots(), {{"joints", "effort"}, {"base", "fixed"}});
    use("motor.servo", rate, all_robots(), servo);
    if (motion == "motion.articulated") use_contacts();  // it gets contacts from them
    build();
  }
  double& of(const Key<double>& key) { return world().value("r/joint", key); }
  double& of(const char* name) { return of(Key<double>{name, "", ""}); }
  double& goal() { return of(keys::joint_position_target); }
  double q() { return of(keys::joint_position); }
  double v() { return of(keys::joint_velocity); }
};

struct MotionName {
  std::string id, name;
};
void PrintTo(const MotionName& m, std::ostream* to) { *to << m.id; }

class VoltageDriveAt : public testing::TestWithParam<MotionName> {
 protected:
  void SetUp() override {
    const std::vector<CatalogEntry>& all = test::plugins().catalog();
    if (std::none_of(all.begin(), all.end(), [](const CatalogEntry& e) { return e.id == GetParam().id; }))
      GTEST_SKIP() << GetParam().id << " is not built";
  }
  std::string motion() const { return GetParam().id; }
};
INSTANTIATE_TEST_SUITE_P(, VoltageDriveAt,
                         testing::Values(MotionName{"motion.simplified", "simplified"},
                                         MotionName{"motion.articulated", "articulated"},
                                         MotionName{"motion.ode", "ode"}, MotionName{"motion.bullet", "bullet"},
                                         MotionName{"motion.mujoco", "mujoco"}),
                         [](const auto& test) { return test.param.name; });

TEST_P(VoltageDriveAt, AStepOfTheVoltageMeetsTheClosedForm) {
  const double kt = 1.622, r = 3.949, volts = 12 * 0.9625;
  const motor::MotorModel mx64{
      .kt = kt, .resistance = r, .armature = 0.01195, .friction = {.coulomb = 0.0904, .viscous = 0.0117}};
  const double w0 = mx64.no_load_speed(volts), constant = mx64.time_constant(bob_inertia);
  const auto error = [&](double rate) {
    VoltageBench s({{"part", "mx64"}, {"friction_model", "m1"}}, motion(), rate, 0, true);
    s.goal() = 1e4;
    s.run_for(0.02);
    const double most = std::abs(s.v() - w0 * (1 - std::exp(-0.02 / constant)));
    s.run_for(0.5);
    EXPECT_NEAR(s.v(), w0, 1e-3 * w0);
    return most;
  };
  const double fine = error(10000);
  EXPECT_LT(fine, 7.5e-3);
  EXPECT_NEAR(error(5000) / fine, 2, 0.2) << "the error halves with the step";
}

TEST_P(VoltageDriveAt, FrictionHoldsAPendulum) {
  for (const double angle : {0.1, 0.4}) {
    VoltageBench s({{"part", "mx64"}, {"friction_model", "m1"}, {"friction", 0.2}}, motion(), 1000, angle);
    s.of("servo.torque_enable") = 0;
    s.run_for(3);
    if (motion() == "motion.simplified" || motion() == "motion.articulated") {
      EXPECT_EQ(s.q(), angle) << "bit-equal";
    } else {
      EXPECT_NEAR(s.q(), angle, motion() == "motion.ode" ? 4e-3 : 2e-5) << "ODE's rows are soft";
    }
    EXPECT_EQ(s.of("motor.effort"), 0);
  }
  VoltageBench s({{"part", "mx64"}, {"friction_model", "m1"}, {"friction", 0.2}}, motion(), 1000, 0.5);
  s.of("servo.torque_enable") = 0;
  s.run_for(1);
  EXPECT_LT(s.q(), std::asin(0.2 / weight)) << "0.23 N m are more than it can hold";
}

/// The pendulum by the pure model, which knows the load.
struct PurePendulum {
  motor::MotorModel motor;
  double q = 0, w = 0;
  void run(double goal, double volts, double dt) {
    const double load = -weight * std::sin(q), torque = motor.torque(motor.duty(goal - q) * volts, w);
    const double v = motor::next_velocity(w, torque + load, motor.friction.budget(w, torque, load),
                                          bob_inertia + motor.armature, dt);
    q += 0.5 * dt * (w + v), w = v;
  }
};

TEST_P(VoltageDriveAt, MovesAsTheModelThatIdentificationUses) {
  for (const std::string model : {"m1", "m4"}) {
    PurePendulum pure{{.kt = 0.387,
                       .resistance = 4.017,
                       .armature = 0.00181,
                       .gain = 400 * 0.0028774,
                       .friction = {.coulomb = 0.0128, .viscous = 0.0037}}};
    if (model == "m4")
      pure.motor = {.kt = 0.386,
                    .resistance = 3.403,
                    .armature = 0.00190,
                    .gain = 400 * 0.0028774,
                    .friction = {.coulomb = 0.0088,
                                 .stribeck_velocity = 2.56,
                                 .stribeck_exponent = 0.76,
                                 .load = 0.068,
                                 .load_stribeck = 0.074}};
    VoltageBench s({{"part", "xl330"}, {"friction_model", model}}, motion());
    double most = 0;
    for (int k = 0; k < 3000; ++k) {
      const double goal = std::sin(0.001 * k * 3) * 1.2;
      s.goal() = goal;
      s.run_for(0.001);
      pure.run(goal, 7.4, 0.001);
      most = std::max(most, std::abs(s.q() - pure.q));
    }
    EXPECT_LT(most, model == "m1" ? 3e-3 : 6e-3) << model;
  }
}

TEST(VoltageDrive, ServosOfAScenarioOverrideThePart) {
  VoltageBench s({{"part", "mx64"}, {"supply_voltage", 15.0}, {"duty_limit", 0.5}}, "motion.simplified", 1000, 0, true);
  s.goal() = 1e4;
  s.run_for(0.001);
  EXPECT_EQ(s.of("servo.duty"), 0.5);
  EXPECT_EQ(s.of("servo.supply_voltage"), 15);
  EXPECT_NEAR(s.of("motor.effort"), 1.663 * 7.5 / 3.156, 1e-12) << "the model that knows most is taken";
}

TEST(VoltageDrive, AnOffsetIsInTheErrorThatMakesTheDuty) {
  VoltageBench s({{"part", "mx64"}, {"offset", -0.02}, {"p_gain", 1.0}}, "motion.simplified", 1000, 0.1, true);
  s.goal() = 0.2;
  s.run_for(0.0005);
  EXPECT_NEAR(s.of("servo.duty"), 0.158 * (0.2 - (0.1 + 0.02)), 1e-12);
}

TEST(VoltageDrive, TheSupplyMayFallWhileItRuns) {
  VoltageBench s({{"part", "mx64"}, {"friction_model", "m1"}}, "motion.simplified", 1000, 0, true);
  s.goal() = 1e4;
  s.run_for(0.5);
  const double fast = s.v();
  s.of("servo.supply_voltage") = 6;
  s.run_for(0.5);
  EXPECT_NEAR(s.v(), fast * (6 * 0.9625 * 1.622 / 3.949 - 0.0904) / (12 * 0.9625 * 1.622 / 3.949 - 0.0904), 1e-6);
}

TEST(VoltageDrive, GoesOnFromASnapshotToTheSameBits) {
  VoltageBench s({{"part", "mx106"}}, "motion.simplified", 1000, 0.3);
  s.goal() = 1;
  s.run_for(0.0831);
  const Snapshot middle = s.snapshot();
  s.run_for(0.4);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.4);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(VoltageDrive, EveryReadyPartReachesAGoal) {
  for (const char* part : {"mx28", "mx64", "mx106", "xl320", "xl330", "sts3215"}) {
    VoltageBench s({{"part", part}}, "motion.simplified", 1000, 0, true);
    s.goal() = 1;
    s.run_for(3);
    EXPECT_NEAR(s.q(), 1, 0.06) << part;
    EXPECT_EQ(s.v(), 0) << part << " sticks where its friction holds it";
  }
}

std::string refusal_of(const Parameters& servo) {
  try {
    VoltageBench s(servo);
    s.run_for(0.01);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(VoltageDrive, MistakesAreNamedWithAdviceToo) {
  const std::string file = testing::TempDir() + "muro_part_with_a_mistake.yaml";
  std::ofstream(file) << "supply_voltage: 12\nm1:\n  kt: 1\n  resistence: 2\n";
  const std::pair<Parameters, std::string> cases[] = {
      {{{"part", "mx65"}}, "there is no part `mx65` (did you mean"},
      {{{"part", "mx64"}, {"friction_model", "m7"}}, "`friction_model` is `m7`, but mx64 has `m1`, `m4`"},
      {{{"part", "mx64"}, {"stiffness", 3.0}}, "`stiffness` belongs to servos without `part` and `kt`"},
      {{{"part", "mx64"}, {"mode", "velocity"}}, "follows positions"},
      {{{"kt", 1.0}}, "`supply_voltage` is 0; a motor needs it above 0, in V"},
      {{{"stiffness", 3.0}, {"resistance", 1.0}}, "`resistance` belongs to a motor driven by a voltage"},
      {{{"part", file}}, ":4:3: there is no parameter `resistence` (did you mean `resistance`?)"},
      {{{"part", "nowhere.yaml"}}, "cannot be read"},
      {{{"part", "mx106"}, {"armature", 0.0}, {"resistance", 0.01}}, "the back EMF would stop the joint within"},
  };
  for (const auto& [servo, text] : cases)
    EXPECT_NE(refusal_of(servo).find(text), std::string::npos) << text << "\n" << refusal_of(servo);
}

/// Another motion, which takes no efforts, has swung the joint: the effort needed for this is no load of this motion.
TEST(VoltageDrive, TakesNoLoadFromAnotherMotion) {
  const motor::MotorModel model{.kt = 0.386,
                                .resistance = 3.403,
                                .armature = 0.0019,
                                .gain = 0.2,
                                .duty_limit = 1,
                                .friction = {.coulomb = 0.0088, .viscous = 0.01, .load = 0.068}};
  test::Scene s;
  const RobotView& r = s.add("r", pendulum(true));
  s.set_levels(r, {"commanded", "forces"}, 0);
  s.use("motion.point", 1000, {{&r, r.base(), 0}}, {{"joints", "position"}});
  s.use("motion.simplified", 1000, {{&r, r.base(), 1}}, {{"joints", "effort"}, {"base", "fixed"}});
  s.use("motor.servo", 1000, s.all_robots(),
        {{"kt", model.kt},
         {"resistance", model.resistance},
         {"armature", model.armature},
         {"supply_voltage", 7.4},
         {"p_gain", 1.0},
         {"duty_gain", model.gain},
         {"friction", model.friction.coulomb},
         {"viscous_friction", model.friction.viscous},
         {"load_friction", model.friction.load}});
  s.build();
  const auto of = [&](const KeyInfo& key) -> double& {
    return s.world().value("r/joint", Key<double>{key.name, key.unit, key.doc});
  };
  double& goal = of(keys::joint_position_target);
  for (int k = 0; k < 300; ++k) {
    goal = std::sin(0.02 * k);
    s.run_for(0.001);
  }
  EXPECT_GT(std::abs(of(keys::joint_velocity)), 1) << "it swings";
  s.world().value(r.base(), keys::motion_level_target) = 1;
  const double q = of(keys::joint_position), v = of(keys::joint_velocity);
  s.run_for(0.001);
  const double torque = model.torque(7.4 * model.duty(goal - q), v);
  EXPECT_NEAR(of(keys::joint_drive_friction), model.friction.budget(v, torque, 0), 1e-12);
}

TEST(VoltageDrive, CommandsThatAreNoNumbersAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const auto& [name, value, text] :
       {std::tuple("servo.supply_voltage", nan, "`r/joint:servo.supply_voltage` is nan V; command a finite number"),
        std::tuple("servo.supply_voltage", -7.4, "`r/joint:servo.supply_voltage` is -7.4 V; command a finite"),
        std::tuple("servo.p_gain", nan, "`r/joint:servo.p_gain` is nan; command a finite number, 0 or more"),
        std::tuple("servo.p_gain", inf, "`r/joint:servo.p_gain` is inf; command a finite number, 0 or more")}) {
    VoltageBench s(Parameters{{"part", "mx64"}});
    s.run_for(0.1);
    s.of(name) = value;
    try {
      s.run_for(0.1);
      ADD_FAILURE() << name << " = " << value;
    } catch (const std::exception& e) {
      EXPECT_NE(std::string(e.what()).find(text), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace muro
