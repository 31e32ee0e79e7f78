// SPDX-License-Identifier: MIT
// Robots that carry each other: any number of threads, no allocation, hand-overs between motions.
#include <gtest/gtest.h>

#include "tests/conformance/sensor/case.hpp"
#include "tests/support/allocation_counter.hpp"

namespace muro::sensor_conformance {
namespace {

/// Boxes of 2 kg, each with a tray of 0.2 kg on top that carries a box of 1 kg at (0.05, 0.03).
struct Carriers : test::Scene {
  std::vector<Item> carriers, loads, trays, bumpers, load_bumpers;

  void add_pair(int number, const Vec3& at) {
    const Shape base = test::with(Shape::box({0.4, 0.3, 0.2}), 0.8),
                tray = test::with(Shape::box({0.3, 0.3, 0.02}), 0.8);
    const RobotView& carrier = add("carrier_" + std::to_string(number), test::tree_of([&](RobotBuilder& b) {
                                     b.base("base");
                                     b.set(keys::inertial, test::solid_box(2, {0.4, 0.3, 0.2}));
                                     b.set_array(keys::collision_shapes, std::span<const Shape>(&base, 1));
                                     b.translation({0, 0, 0.11});
                                     b.body("tray");
                                     b.set(keys::inertial, test::solid_box(0.2, {0.3, 0.3, 0.02}));
                                     b.set_array(keys::collision_shapes, std::span<const Shape>(&tray, 1));
                                   }),
                                   {at + Vec3(0, 0, 0.1), Quat::Identity()});
    const RobotView& load = add("load_" + std::to_string(number), test::block(1, {0.1, 0.1, 0.1}, 0.8),
                                {at + Vec3(0.05, 0.03, 0.27), Quat::Identity()});
    carriers.push_back({&carrier, carrier.base()});
    loads.push_back({&load, load.base()});
    const ObjectId on = world().object(std::string(carrier.name) + "/tray");
    trays.push_back({&carrier, add_sensor_object(carrier, "joint", on)});
    bumpers.push_back({&carrier, add_sensor_object(carrier, "bumper", on)});
    load_bumpers.push_back({&load, add_sensor_object(load, "bumper", load.base())});
  }
  /// Adds the sensors at 1000 Hz.
  void use_sensors() {
    use("sensor.force_torque", 1000, trays);
    use("sensor.bumper", 1000, bumpers, {{"threshold", 5.0}});
    use("sensor.bumper", 1000, load_bumpers, {{"threshold", 5.0}});
    use_contacts();
  }
  Wrench tray_of(std::size_t number) { return world().value(trays[number].object, keys::sensed_wrench); }
};

/// Carriers with loads; no force moves every other carrier.
struct Crowd : Carriers {
  explicit Crowd(unsigned threads) {
    add_ground();
    for (int i = 0; i < 24; ++i) add_pair(i, {0.8 * (i % 6), 0.8 * (i / 6), 0});
    std::vector<Item> kinematic, dynamic = loads;
    for (std::size_t i = 0; i < carriers.size(); ++i) (i % 2 ? kinematic : dynamic).push_back(carriers[i]);
    use("motion.simplified", 1000, dynamic);
    use("motion.point", 1000, kinematic);
    use_sensors();
    set_threads(threads);
    build();
  }
};

TEST(RobotsThatTouch, FeelTheSameOnAnyNumberOfThreads) {
  std::vector<std::uint64_t> hashes[2];
  for (const unsigned threads : {1u, 3u}) {
    Crowd crowd(threads);
    for (int k = 0; k < 20; ++k) {
      crowd.run_for(0.01);
      hashes[threads / 2].push_back(crowd.state_hash());
    }
    for (std::size_t i = 0; i < crowd.trays.size(); ++i) {
      EXPECT_EQ(crowd.world().value(crowd.bumpers[i].object, keys::bumper_pressed), 1u) << i;
      EXPECT_EQ(crowd.world().value(crowd.load_bumpers[i].object, keys::bumper_pressed), 1u) << i;
      EXPECT_NEAR(crowd.tray_of(i).force.z(), -1.2 * g, 0.1 * g) << i;
    }
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST(RobotsThatTouch, AreFeltWithoutAllocationOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(test::allocations(), 0u) << "sanitizers count allocations themselves";
#else
  Crowd crowd(1);
  crowd.run_for(0.3);
  const std::uint64_t before = test::allocations();
  crowd.run_for(0.3);
  EXPECT_EQ(test::allocations() - before, 0u);
#endif
}

TEST(RobotsThatTouch, TouchOnlyWhatTheyHaveDeclared) {
  Crowd crowd(1);
  crowd.verify_access();
  EXPECT_NO_THROW(crowd.run_for(0.005));
  Carriers s;  // its sensors read the list of a robot of an engine
  s.add_ground();
  for (int i = 0; i < 20; ++i) s.add_pair(i, Vec3(i, 0, 0));
  s.use("motion.point", 1000, s.carriers);
  s.use("motion.bullet", 1000, s.loads);
  s.use_sensors();
  s.build();
  s.verify_access();
  EXPECT_NO_THROW(s.run_for(0.005));
}

TEST(RobotsThatTouch, AreFeltOnceAtEachLevelOfDetail) {
  for (const char* own : {"motion.simplified", "motion.articulated", "motion.mujoco", "motion.bullet", "motion.ode"})
    for (const char* other : {"motion.simplified", "motion.articulated", "motion.mujoco", "motion.bullet"}) {
      Carriers s;
      s.add_ground();
      s.add_pair(0, Vec3::Zero());
      const RobotView& carrier = *s.carriers[0].robot;
      s.set_levels(carrier, {"commanded", "forces"}, 0);
      s.use("motion.point", 1000, {{&carrier, carrier.base(), 0}});
      s.use(own, 1000, {{&carrier, carrier.base(), 1}});
      s.use(other, 1000, s.loads);
      s.use_sensors();
      s.build();
      s.run_for(0.4005);
      for (int k = 0; k < 4; ++k) {
        const double before = s.tray_of(0).force.z();
        s.world().value(carrier.base(), keys::motion_level_target) = k % 2;
        s.run_for(0.001);
        EXPECT_NEAR(s.tray_of(0).force.z(), before, 1e-3 * g) << own << ", " << other << ", to level " << k % 2;
        s.run_for(0.4);
        const Wrench seen = s.tray_of(0);
        EXPECT_NEAR(seen.force.z(), -1.2 * g, 0.02 * g) << own << ", " << other << ", level " << k % 2;
        EXPECT_NEAR(seen.torque.x(), -0.03 * g, 2e-3 * g) << own << ", " << other << ", level " << k % 2;
        EXPECT_EQ(s.world().value(s.bumpers[0].object, keys::bumper_pressed), 1u) << own << ", " << other;
      }
    }
}

}  // namespace
}  // namespace muro::sensor_conformance
