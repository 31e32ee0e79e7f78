// SPDX-License-Identifier: MIT
// `muro identify` as a user runs it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "host/tools/identify/motor_fit.hpp"
#include "tests/identify/simulated_record.hpp"
#include "tests/support/files.hpp"

namespace muro::host {
namespace {

const std::string muro_program = "MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " ";

class IdentifyProgram : public testing::Test {
 protected:
  void SetUp() override {
    if (!can_fit()) GTEST_SKIP() << "built without NLopt";
    MotorEstimate e;
    e.motor = {.kt = 0.387,
               .resistance = 4.017,
               .armature = 0.00181,
               .gain = 0.0028773775,
               .friction = {.coulomb = 0.0128, .viscous = 0.0037}};
    e.offset = 0.03;
    test::SimulatedBench bench{.motor = e};
    bench.duration = 2;
    int number = 0;
    for (const MotorRecord& r : bench.records(200, 800)) {
      std::ostringstream out;
      out.precision(10);
      out << "# p_gain: " << r.p_gain
          << "\n# mass: 0.49\n# length: 0.1\ntime,position,goal,supply_voltage,torque_enable\n";
      for (const RecordSample& s : r.samples)
        out << s.time << "," << s.position << "," << s.goal << "," << s.supply_voltage << "," << s.torque_enable
            << "\n";
      folder.file("r" + std::to_string(number++) + ".csv", out.str());
    }
  }
  std::string text_of(const std::string& name) const { return test::text_of(folder.path(name)); }
  /// `arguments`: @ is replaced by the folder.
  test::CommandResult run(std::string arguments) const {
    for (std::size_t at = 0; (at = arguments.find('@', at)) != std::string::npos;)
      arguments.replace(at, 1, folder.path(""));
    return test::run_command(muro_program + arguments);
  }

  const test::ScratchFolder folder;
};

TEST_F(IdentifyProgram, WritesAReportAPictureAndAFragmentThatRuns) {
  const auto r = run("identify @r0.csv @r1.csv @r2.csv @r3.csv --model m1 --duty-gain 0.0028773775 --validate @../" +
                     std::filesystem::path(folder.path("")).parent_path().filename().string() +
                     "/r2.csv --report @r.md "
                     "--report @r.json --plot @r.svg --fragment @motor.yaml");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("Model M1 from 3 records: mean |error| 0.00"), std::string::npos) << r.output;
  EXPECT_NE(text_of("r.md").find("| r2.csv | 800 | left out |"), std::string::npos) << text_of("r.md");
  EXPECT_NE(text_of("r.json").find("\"viscous_friction\""), std::string::npos);
  EXPECT_NE(text_of("r.svg").find("</svg>"), std::string::npos);
  const std::string fragment = text_of("motor.yaml");
  ASSERT_EQ(fragment.substr(0, 24), "motor: {use: motor.servo");
  folder.file("arm.urdf",
              "<robot name='arm'><link name='stand'/><joint name='j' type='continuous'><parent link='stand'/><child "
              "link='bob'/><axis xyz='0 1 0'/></joint><link name='bob'><inertial><origin xyz='0 0 -0.1'/><mass "
              "value='0.49'/><inertia ixx='1e-6' iyy='1e-6' izz='1e-6' ixy='0' ixz='0' iyz='0'/></inertial></link>"
              "</robot>");
  folder.file("s.yaml",
              "duration: 0.2\nrobots:\n  arm:\n    model: arm.urdf\n    motion: {use: "
              "motion.simplified, joints: effort, base: fixed}\n    " +
                  fragment);
  const auto s = run("run @s.yaml");
  EXPECT_EQ(s.exit_code, 0) << s.output;
  // a run with the fragment has the errors that identify reports
  const auto against = run("compare @s.yaml --against @r0.csv @r1.csv @r3.csv @r2.csv --csv @t.csv");
  ASSERT_EQ(against.exit_code, 0) << against.output;
  std::istringstream table(text_of("t.csv"));
  std::string line;
  std::getline(table, line);
  for (const auto& record : nlohmann::json::parse(text_of("r.json"))["records"]) {
    double error = 0;
    std::getline(table, line);
    ASSERT_EQ(std::sscanf(line.c_str(), "%*[^,],%*[^,],%*[^,],%lf", &error), 1) << line;
    EXPECT_NEAR(error, record["mean_error"].get<double>(), 1e-4) << line;
  }
}

TEST_F(IdentifyProgram, TellsTheErrorOnRecordsThatItHasNotSeen) {
  const std::string all = "identify @r0.csv @r1.csv @r3.csv --model m1 --duty-gain 0.0028773775 ";
  const auto r = run(all + "--report @r.json");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("rad on what it has not seen.\n"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("each record in turn is left out, and predicted by a fit of the others"), std::string::npos);
  const nlohmann::json report = nlohmann::json::parse(text_of("r.json"));
  EXPECT_EQ(report["validation"]["unseen"], "each_record_in_turn");
  EXPECT_EQ(report["validation"]["fits"], 3);
  double sum = 0;
  for (const auto& record : report["records"]) sum += record["unseen_mean_error"].get<double>() / 3;
  EXPECT_NEAR(report["validation"]["mean_error"].get<double>(), sum, 1e-12);
  // equal to naming the record
  ASSERT_EQ(run(all + "--validate @r3.csv --report @v.json").exit_code, 0);
  const nlohmann::json named = nlohmann::json::parse(text_of("v.json"));
  EXPECT_EQ(named["validation"]["unseen"], "named_records");
  EXPECT_NEAR(named["validation"]["mean_error"].get<double>(), report["records"][2]["unseen_mean_error"].get<double>(),
              3e-4);
}

TEST_F(IdentifyProgram, OfASingleRecordItPredictsTheLastQuarter) {
  // an encoder slips by 0.2 rad at the start of the last quarter: the fit of the earlier part does not include it
  std::istringstream in(text_of("r1.csv"));
  std::string changed;
  for (std::string line; std::getline(in, line);) {
    double time = 0, position = 0;
    int end = 0;
    if (std::sscanf(line.c_str(), "%lf,%lf%n", &time, &position, &end) == 2 && time > 1.502)
      line = std::to_string(time) + "," + std::to_string(position + 0.2) + line.substr(std::size_t(end));
    changed += line + "\n";
  }
  folder.file("r1.csv", changed);
  const auto r = run("identify @r1.csv --model m1 --duty-gain 0.0028773775 --report @r.json");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("the last quarter of the record, predicted by a fit of what comes before it"),
            std::string::npos)
      << r.output;
  const nlohmann::json validation = nlohmann::json::parse(text_of("r.json"))["validation"];
  EXPECT_EQ(validation["unseen"], "last_quarter");
  EXPECT_NEAR(validation["mean_error"].get<double>(), 0.2, 0.01);
  EXPECT_LT(validation["fit_mean_error"].get<double>(), 0.19);
}

TEST_F(IdentifyProgram, ARecordWhoseDutiesSayAnotherGainKeepsIt) {
  // the same motions, the third by a firmware with twice the gain for each unit: its 400 is 800 elsewhere
  std::string third = text_of("r2.csv");
  third.replace(third.find("800"), 3, "400");
  std::istringstream in(third);
  std::string changed;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '#' || line[0] == 't') {
      changed += line + (line[0] == 't' ? ",duty\n" : "\n");
      continue;
    }
    double time = 0, position = 0, goal = 0;
    std::sscanf(line.c_str(), "%lf,%lf,%lf", &time, &position, &goal);
    changed += line + "," + std::to_string(std::clamp(2 * 0.0028773775 * 400 * (goal - position), -1.0, 1.0)) + "\n";
  }
  folder.file("r2.csv", changed);
  folder.file("r0.csv", "# motor: xl330\n" + text_of("r0.csv"));
  const auto r = run("identify @r0.csv @r1.csv @r2.csv @r3.csv --model m1");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("Model M1 from 4 records: mean |error| 0.00"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("r2.csv: its duties say a gain of 0.0057"), std::string::npos) << r.output;
}

TEST_F(IdentifyProgram, TheScenarioHasTheFirmwareOfTheRecords) {
  for (const char* const name : {"r0.csv", "r1.csv"})
    folder.file(name, "# motor: mx64\n# duty_gain: 0.0028773775\n# duty_limit: 0.9\n" + text_of(name));
  const auto r = run("identify @r0.csv @r1.csv --model m1 --fragment @motor.yaml");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(text_of("motor.yaml").find("duty_gain: 0.002877378"), std::string::npos) << text_of("motor.yaml");
  EXPECT_NE(text_of("motor.yaml").find("duty_limit: 0.9,"), std::string::npos) << text_of("motor.yaml");
  EXPECT_EQ(r.output.find("records differ"), std::string::npos) << r.output;

  folder.file("r1.csv", "# duty_limit: 0.8\n" + text_of("r3.csv"));
  const auto differ = run("identify @r0.csv @r1.csv --model m1 --fragment @motor.yaml");
  EXPECT_NE(differ.output.find("records differ in `duty_limit`"), std::string::npos) << differ.output;
}

TEST_F(IdentifyProgram, RecordsOfSeveralMotorsAreRefused) {
  folder.file("r0.csv", "# motor: xl330\n" + text_of("r0.csv"));
  folder.file("r1.csv", "# motor: mx64\n" + text_of("r1.csv"));
  const auto r = run("identify @r0.csv @r1.csv --model m1");
  EXPECT_EQ(r.exit_code, 2);
  EXPECT_NE(r.output.find("r0.csv is of `xl330` and "), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("r1.csv of `mx64`; identify one motor at a time"), std::string::npos) << r.output;
}

TEST_F(IdentifyProgram, MistakesAreOneMessageAndWriteNothing) {
  folder.file("bad.csv", "# p_gain: 1\ntime,position,goal\n0,0,zero\n");
  const std::pair<std::string, std::string> cases[] = {
      {"@none.csv", "none.csv cannot be read: No such file or directory"},
      {"@bad.csv", "bad.csv:3:5: `zero` is no number"},
      {"@r0.csv", "give --duty-gain"},
      {"@r0.csv --model m9", "`m9` is none of m1, m2, m3, m4"},
      {"@r0.csv --fit gains", "did you mean `gain`?"},
      {"@r0.csv --duty-gain 0.003 --fit temperature", "has no temperatures (column `temperature`, degrees Celsius)"},
      {"@r0.csv --fit gain --report @r.txt", "reports are Markdown (*.md) or JSON (*.json)"},
      {"@r0.csv --fit gain --plot @nowhere/r.svg", "there is no folder"},
      {"@r0.csv --fit gain --fragment @r0.csv", "is a record; it would be overwritten"},
      {"@r0.csv --fit gain --validate 0.1", "leaves none on one side"},
      {"@r0.csv @r1.csv --fit gain --validate @r1.csv @r0.csv", "names every record"},
      {"@r1.csv --fit gain --validate 1.5", "above 0 and below 1"},
  };
  for (const auto& [arguments, message] : cases) {
    const auto r = run("identify " + arguments);
    EXPECT_EQ(r.exit_code, 2) << message;
    EXPECT_NE(r.output.find(message), std::string::npos) << message << "\n" << r.output;
    EXPECT_EQ(std::count(r.output.begin(), r.output.end(), '\n'), 1) << r.output;
  }
}

}  // namespace
}  // namespace muro::host
