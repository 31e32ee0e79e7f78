// SPDX-License-Identifier: MIT
// A program that embeds muro sets the locale of its user, in which 0.5 is written 0,5.
#include <gtest/gtest.h>

#include <clocale>
#include <cstdlib>
#include <locale>
#include <nlohmann/json.hpp>

#include "host/outputs/report.hpp"
#include "host/scenario/builder.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

struct Comma : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

/// Sets both kinds of locale with a comma during its life: that of C++ by a facet, that of C by a locale made for the
/// test.
class CommaLocale {
 public:
  CommaLocale() {
    static const test::ScratchFolder folder;
    static const auto made =
        test::run_command("localedef -i de_DE -f UTF-8 " + folder.path("de_DE.UTF-8") + " 2>/dev/null");
    EXPECT_EQ(made.exit_code, 0) << "the package locales has what it takes";
    setenv("LOCPATH", folder.path("").c_str(), 1);                  // NOLINT(concurrency-mt-unsafe)
    EXPECT_TRUE(std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr);  // NOLINT(concurrency-mt-unsafe)
    EXPECT_EQ(std::to_string(0.5), "0,500000");
  }
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_ALL, "C");  // NOLINT(concurrency-mt-unsafe)
    unsetenv("LOCPATH");          // NOLINT(concurrency-mt-unsafe)
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;

 private:
  std::locale before_ = std::locale::global(std::locale(std::locale::classic(), new Comma));
};

/// Returns the hash of the state, the recorded file, and the numbers of the report.
std::string outcome_of(const test::ScratchFolder& folder, const std::string& model, const std::string& motion) {
  const std::string csv = folder.path(motion + ".csv");
  const std::string file = folder.file("s.yaml", R"(
world: {objects: {ground: {shape: plane}}}
robots:
  rover:
    model: )" + std::string(MURO_TEST_SOURCE_DIR "/examples/models/") +
                                                     model + R"(
    at: {x: 0.125, z: 1.375, roll: 0.25}
    motion: {use: motion.)" + motion + R"(, rate: 500}
algorithms:
  table: {use: recorder.csv, rate: 10, properties: ["rover/*:pose"], file: )" +
                                                     csv + "}\n");
  BuiltScenario b = build(read_scenario(file, {"robots.rover.at.y=0.0625"}), test::plugins());
  const Odometer odometer(*b.simulation);
  b.simulation->run_for(0.5);
  b.simulation->finish();
  RunResult result;
  result.simulated = 0.5;
  const auto written = report(result, *b.simulation, odometer);
  return std::to_string(b.simulation->state_hash()) + "\n" + test::text_of(csv) + written.at("robots").dump();
}

TEST(Locale, OfAnEmbeddingProgramChangesNothing) {
  const auto& catalog = test::plugins().catalog();
  const auto is_there = [&](const std::string& id) {
    return std::any_of(catalog.begin(), catalog.end(), [&](const CatalogEntry& e) { return e.id == id; });
  };
  for (const std::string motion : {"simplified", "bullet", "ode", "mujoco"}) {
    if (!is_there("motion." + motion)) continue;
    for (const std::string model : {"rover.urdf", "rover.sdf"}) {
      if (model == "rover.sdf" && (motion != "simplified" || !is_there("reader.sdf"))) continue;
      const test::ScratchFolder folder;
      const std::string before = outcome_of(folder, model, motion);
      const CommaLocale locale;
      EXPECT_EQ(outcome_of(folder, model, motion), before) << motion << " " << model;
    }
  }
}

TEST(Locale, OfAnEmbeddingProgramChangesNoMessage) {
  const auto complaint = [] {
    return test::complaint_of([] {
      test::Scene s;
      s.add("ball", test::tree_of([](RobotBuilder& b) { b.base("body"); }));
      s.use("motion.point", 100, s.all_robots(), {{"max_speed", -1234.5}});
      s.build();
    });
  };
  const std::string before = complaint();
  EXPECT_NE(before.find("-1234.5"), std::string::npos) << before;
  const CommaLocale locale;
  EXPECT_EQ(complaint(), before);
}

}  // namespace
}  // namespace muro::host
