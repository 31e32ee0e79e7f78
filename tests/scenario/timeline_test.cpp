// SPDX-License-Identifier: MIT
#include "host/outputs/timeline.hpp"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "host/scenario/builder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// File of a run of 30 vehicles on three threads for a tenth of a second.
struct Timelines : ::testing::Test {
  test::ScratchFolder folder;
  BuiltScenario built = build(
      read_scenario(MURO_TEST_SOURCE_DIR "/examples/urban/urban.yaml", {"robots.rovers.count=30"}), test::plugins());
  nlohmann::json events;

  void SetUp() override {
    Simulation& s = *built.simulation;
    s.set_threads(3);
    s.scheduler().executor().set_always_parallel(true);
    s.scheduler().executor().timeline().start(100'000);
    s.run_for(0.1);
    write_timeline(folder.path("timeline.json"), s);
    events = nlohmann::json::parse(test::text_of(folder.path("timeline.json"))).at("traceEvents");
  }
};

TEST_F(Timelines, ShowEveryItemOfEveryAlgorithmOnceAnInstant) {
  std::map<std::pair<std::string, double>, int> served;
  for (const auto& e : events)
    if (e.at("ph") == "X" && e.at("args").at("phase") == 0)
      served[{e.at("name"), e.at("args").at("simulated_s")}] +=
          e.at("args").at("end").get<int>() - e.at("args").at("first").get<int>();
  std::map<std::string, int> instants;
  for (const auto& [call, items] : served) {
    if (call.first != "rovers.motion" && call.first != "kinematics") continue;
    EXPECT_EQ(items, 30) << call.first << " at " << call.second;
    ++instants[call.first];
  }
  EXPECT_EQ(instants["rovers.motion"], 100);
  EXPECT_EQ(instants["kinematics"], 100);
}

TEST_F(Timelines, CallsOfAThreadDoNotOverlap) {
  std::map<int, double> until;
  for (const auto& e : events) {
    if (e.at("ph") != "X") continue;
    double& last = until[e.at("tid")];
    EXPECT_GE(e.at("ts").get<double>(), last - 0.002);  // the file has a resolution of 0.001 us
    last = e.at("ts").get<double>() + e.at("dur").get<double>();
  }
  EXPECT_GE(until.size(), 1u);
}

TEST_F(Timelines, NameEachThread) {
  int names = 0;
  for (const auto& e : events) names += e.at("ph") == "M" && e.at("name") == "thread_name";
  EXPECT_EQ(names, 3);
}

TEST(Timeline, StopsWhenItIsFullAndSaysSo) {
  Timeline timeline;
  EXPECT_FALSE(timeline.on());
  timeline.start(2);
  timeline.add(0, {});
  EXPECT_FALSE(timeline.full());
  timeline.add(0, {});
  timeline.add(0, {});
  EXPECT_TRUE(timeline.full());
  EXPECT_EQ(timeline.threads()[0].size(), 2u);
}

}  // namespace
}  // namespace muro::host
