// SPDX-License-Identifier: MIT
// Descriptions by other people: models.txt gives the result of each. Everything usable is read, connects to
// motion.point and runs. Everything lost is reported, and nothing else.
#include "tests/models/model_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

using test::ModelCase;

std::string path_of(const ModelCase& c) { return test::models_folder() + "/" + c.file; }

/// Result of building a scenario: a simulation, or lines of errors.
struct Outcome {
  BuiltScenario built;
  std::vector<std::string> said;
};

Outcome outcome_of(const ModelCase& c) {
  const test::ScratchFolder folder;
  const std::string text =
      c.is_world() ? "world: {file: \"" + path_of(c) + "\"}\n"
                   : "robots: {r: {model: \"" + path_of(c) + "\", motion: {use: motion.point, rate: 100}}}\n";
  Outcome out;
  try {
    out.built = build(read_scenario(folder.file("s.yaml", text), {}), test::plugins());
    out.said = out.built.notes;
  } catch (const SetupError& e) {
    std::istringstream lines(e.what());
    for (std::string line; std::getline(lines, line);) out.said.push_back(line);
  }
  return out;
}

bool is_note(const std::string& line) { return line.find(": note: ") != line.npos; }

/// Checks that each expected part is in a line of its own, and that other lines are notes.
void expect_said(const ModelCase& c, std::vector<std::string> lines) {
  for (const std::string& part : c.said) {
    const auto found =
        std::find_if(lines.begin(), lines.end(), [&](const std::string& line) { return line.find(part) != line.npos; });
    if (found == lines.end()) {
      ADD_FAILURE() << c.file << ": nothing says `" << part << "` in " << testing::PrintToString(lines);
    } else {
      lines.erase(found);
    }
  }
  std::erase_if(lines, is_note);
  EXPECT_EQ(lines, std::vector<std::string>{}) << c.file << ": said, but not in models.txt";
}

class Models : public testing::TestWithParam<ModelCase> {};

TEST_P(Models, AreReadAsFarAsTheyMakeSenseAndWhatIsLostIsTold) {
  const ModelCase& c = GetParam();
  const Outcome out = outcome_of(c);
  for (const std::string& line : out.said) EXPECT_EQ(line.find("/proc/"), line.npos) << line;
  expect_said(c, out.said);
  ASSERT_EQ(out.built.simulation == nullptr, c.is_refused) << testing::PrintToString(out.said);
  if (c.is_refused) return;
  const World& world = out.built.simulation->world();
  if (c.is_world()) return;
  ASSERT_EQ(world.robots().size(), 1u);
  EXPECT_EQ(world.robots()[0]->links.size(), std::size_t(c.links));
  out.built.simulation->run_for(0.1);
  for (const Link& link : world.robots()[0]->links) {
    const Pose pose = world.value(link.object, keys::pose);
    EXPECT_TRUE(pose.position.allFinite() && pose.orientation.coeffs().allFinite()) << c.file;
  }
}

TEST_P(Models, OfAWorldAreThereButForTheBadOne) {
  const ModelCase& c = GetParam();
  if (!c.is_world()) return;
  const test::ScratchFolder folder;
  Simulation simulation(test::plugins());
  const WorldModel world = simulation.read_world(path_of(c));
  EXPECT_EQ(world.scenery().size(), std::size_t(c.links)) << c.file;
  EXPECT_EQ(world.models().size(), std::size_t(c.models)) << c.file;
}

std::string name_of(const testing::TestParamInfo<ModelCase>& info) {
  std::string name = info.param.file;
  for (char& character : name)
    if (!std::isalnum(static_cast<unsigned char>(character))) character = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, Models, testing::ValuesIn(test::model_cases()), name_of);

TEST(ModelTable, NamesEachDescriptionOfTheFolderOnce) {
  std::multiset<std::string> named, there;
  for (const ModelCase& c : test::model_cases()) named.insert(c.file);
  for (const auto& entry : std::filesystem::directory_iterator(test::models_folder())) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".urdf" || extension == ".xacro" || extension == ".sdf" || extension == ".world")
      there.insert(entry.path().filename().string());
  }
  EXPECT_EQ(named, there);
}

}  // namespace
}  // namespace muro::host
