// SPDX-License-Identifier: MIT
// Promises of every algorithm, kept by laser methods: same bits, state in properties.
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

class EveryLasersState : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Conformance, EveryLasersState, testing::ValuesIn(laser_methods()), method_name);

/// Three scanners of one method among robots that drive.
struct Crowd : Room {
  explicit Crowd(const std::string& method) {
    add_ground();
    scatter(3, 40);
    const Settings few{{"rays", std::int64_t(90)}, {"rows", std::int64_t(3)}, {"max_elevation", 0.3}};
    add_laser(method, with(few, {{"hits", true}}));
    add_laser(method, with(few, {{"divergence", 0.003}, {"incidence", true}}));
    add_laser(method, with(few, {{"sweep_steps", std::int64_t(4)}, {"hits", true}}));
    build_and_run();
    drive();
  }
  void drive() {
    for (const RobotView* r : world().robots())
      world().value(r->base(), keys::command_twist) = {{0.3 + 0.05 * double(index_of(r->id)), 0, 0}, {0, 0, 0.5}};
  }
};

TEST_P(EveryLasersState, IsTheSameInTwoRuns) {
  Crowd a(GetParam()), b(GetParam());
  a.run_for(0.6);
  b.run_for(0.6);
  EXPECT_EQ(a.state_hash(), b.state_hash());
}

TEST_P(EveryLasersState, IsTheSameOnAnyNumberOfThreads) {
  Crowd one(GetParam()), three(GetParam());
  three.set_threads(3);
  one.run_for(0.6);
  three.run_for(0.6);
  EXPECT_EQ(one.state_hash(), three.state_hash());
}

TEST_P(EveryLasersState, GoesOnFromASnapshotToTheSameBits) {
  Crowd s(GetParam());
  s.run_for(0.35);
  const Snapshot middle = s.snapshot();
  s.run_for(0.3);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.3);
  EXPECT_EQ(s.state_hash(), end);
}

TEST_P(EveryLasersState, IsFreshAfterAReset) {
  Crowd s(GetParam());
  s.reset();
  s.drive();
  s.run_for(0.4);
  const std::uint64_t first = s.state_hash();
  s.reset();
  s.drive();
  s.run_for(0.4);
  EXPECT_EQ(s.state_hash(), first);
}

TEST_P(EveryLasersState, TouchesOnlyWhatIsDeclared) {
  Crowd s(GetParam());
  s.verify_access();
  EXPECT_NO_THROW(s.run_for(0.35));
}

TEST_P(EveryLasersState, IsReadByThePropertiesThatAllLasersHave) {
  Room s;
  s.furnish();
  s.add_laser(GetParam(), with(urg(), {{"offset", std::vector<double>{0.1, 0, 0}}}));
  s.build_and_run();
  const World& w = s.world();
  EXPECT_EQ(w.value(s.sensor(0), keys::laser_columns), 682u);
  EXPECT_EQ(w.value(s.sensor(0), keys::laser_rows), 1u);
  EXPECT_NEAR(w.value(s.sensor(0), keys::laser_min_angle), -340 * 2 * pi / 1024, 1e-15);
  EXPECT_NEAR(w.value(s.sensor(0), keys::laser_angle_increment), 2 * pi / 1024, 1e-15);
  EXPECT_EQ(w.value(s.sensor(0), keys::laser_min_range), 0.02);
  EXPECT_EQ(w.value(s.sensor(0), keys::laser_max_range), 5.6);
  EXPECT_EQ(w.value(s.sensor(0), keys::sensor_origin).position, Vec3(0.1, 0, 0));
}

}  // namespace
}  // namespace muro
