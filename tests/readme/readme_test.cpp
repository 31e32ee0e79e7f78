// SPDX-License-Identifier: MIT
// What the README says is what the program does.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>

#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::run_command;
using test::text_of;

const std::string root = MURO_TEST_SOURCE_DIR "/";
const std::string readme = text_of(root + "README.md");
const std::string here = "cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ";
const std::string muro_program = here + MURO_PROGRAM;

TEST(Readme, ItsTableOfPluginsIsWhatTheProgramPrints) {
  const auto table = run_command(muro_program + " plugins list --markdown");
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_NE(readme.find(table.output), std::string::npos) << "put this into the README:\n" << table.output;
}

TEST(Readme, ItsScenarioIsTheUrbanExample) {
  const std::size_t begin = readme.find("```yaml\n") + 8;
  const std::string shown = readme.substr(begin, readme.find("```", begin) - begin);
  std::string example = text_of(root + "examples/urban/urban.yaml");
  example.erase(std::remove(example.begin(), example.end(), '\n'), example.end());
  std::string flat = shown;
  flat.erase(std::remove(flat.begin(), flat.end(), '\n'), flat.end());
  EXPECT_NE(example.find(flat.substr(flat.find("robots:"))), std::string::npos);
}

TEST(Readme, EveryFileItLinksToExists) {
  for (const char* page : {"README.md", "CONTRIBUTING.md", "docs/architecture.md", "docs/scenario.md",
                           "docs/determinism.md", "docs/controllers.md", "docs/plugin-contract.md"}) {
    const std::string text = text_of(root + page);
    ASSERT_FALSE(text.empty()) << page;
    const std::regex link(R"(\]\(([^)#:]+)\))");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), link); it != std::sregex_iterator(); ++it) {
      const auto target = (std::filesystem::path(root + page).parent_path() / (*it)[1].str()).lexically_normal();
      EXPECT_TRUE(std::filesystem::exists(target)) << page << " links to " << (*it)[1].str();
    }
  }
}

TEST(Readme, ItsRunCommandsWork) {
  const std::regex command(R"(    build/bin/muro ((run|render) [^\n]*))");
  int commands = 0;
  for (auto it = std::sregex_iterator(readme.begin(), readme.end(), command); it != std::sregex_iterator();
       ++it, ++commands) {
    const test::ScratchFolder scratch;
    std::string arguments = (*it)[1].str();
    arguments = std::regex_replace(arguments, std::regex("--(out|report|timeline) "), "--$1 " + scratch.path("") + "/");
    if ((*it)[2] == "run" && arguments.find("--duration") == std::string::npos) arguments += " --duration 2";
    const bool view = arguments.find("--view") != std::string::npos;  // on a display without a screen
    const auto result = run_command(here + (view ? "xvfb-run -a " : "") + MURO_PROGRAM + " " + arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.output;
  }
  EXPECT_GE(commands, 3);
}

}  // namespace
}  // namespace muro
