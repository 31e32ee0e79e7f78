// SPDX-License-Identifier: MIT
// laser.auto measures to choose a method, reports its choice, and keeps it.
#include "tests/conformance/laser/room.hpp"

namespace muro {
namespace {

using namespace test;

constexpr Key<std::uint32_t> method_key{"laser.method", "1", ""};

struct Choosing : Room {
  std::string notes;

  Choosing() {
    furnish();
    set_log([this](LogLevel, std::string_view text) { notes += std::string(text) + "\n"; });
  }
  std::uint32_t method() { return world().value(sensor(0), method_key); }
};

const Settings by_itself{{"method", std::string("auto")}, {"rays", std::int64_t(100)}};

TEST(TheChoiceOfALaser, IsMeasuredAtTheStartAndToldWithItsFigures) {
  Choosing s;
  s.add_laser("laser.auto", by_itself);
  s.build_and_run();
  EXPECT_GE(s.method(), 1u);
  EXPECT_LE(s.method(), 3u);
  EXPECT_NE(s.notes.find("laser.auto: a scan by all 1 scanners takes raycast "), std::string::npos) << s.notes;
  EXPECT_NE(s.notes.find("would fix"), std::string::npos);
  EXPECT_NEAR(s.ranges(0)[50], 5 / std::cos(pi / 100), 0.02);
}

TEST(TheChoiceOfALaser, IsOfWhatSeesMeshesWhereThereAreSome) {
  Choosing s;
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.size = Vec3::Ones();
  mesh.mesh = s.world().intern(MURO_TEST_SOURCE_DIR "/examples/sensors/crate.obj");
  s.put("crate", mesh, {{3, 0, 1}, Quat::Identity()});
  s.add_laser("laser.auto", by_itself);
  s.build_and_run();
  EXPECT_NE(s.method(), 1u);
  EXPECT_NE(s.notes.find("laser.auto leaves raycast out: it does not see the meshes of crate"), std::string::npos)
      << s.notes;
}

TEST(TheChoiceOfALaser, LeavesOutWhatCannotDoIt) {
  Choosing s;
  s.add_laser("laser.auto", with(by_itself, {{"rays", std::int64_t(30000)}}));
  s.build_and_run();
  EXPECT_NE(s.method(), 2u);
  EXPECT_NE(s.notes.find("laser.auto leaves zbuffer out"), std::string::npos) << s.notes;
}

TEST(TheChoiceOfALaser, CanBeMadeByTheUser) {
  for (const auto& [name, number] : {std::pair{"raycast", 1u}, {"zbuffer", 2u}, {"embree", 3u}}) {
    Choosing s;
    s.add_laser("laser.auto", with(by_itself, {{"method", std::string(name)}}));
    s.build_and_run();
    EXPECT_EQ(s.method(), number);
  }
}

TEST(TheChoiceOfALaser, IsKeptOverARestoreEvenToBeforeIt) {
  Choosing s;
  s.add_laser("laser.auto", by_itself);
  s.build_and_run(0);
  const Snapshot before = s.snapshot();
  s.run_for(0.25);
  const std::uint64_t end = s.state_hash();
  s.restore(before);
  s.run_for(0.25);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(TheChoiceOfALaser, TouchesOnlyWhatIsDeclared) {
  Choosing s;
  s.add_laser("laser.auto", by_itself);
  s.build_and_run(0);
  s.verify_access();
  EXPECT_NO_THROW(s.run_for(0.25));
}

}  // namespace
}  // namespace muro
