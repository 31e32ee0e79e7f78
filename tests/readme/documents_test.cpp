// SPDX-License-Identifier: MIT
// What the documents show can be run, and what they link to is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <vector>

#include "tests/support/files.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;
using test::text_of;

const fs::path root = MURO_TEST_SOURCE_DIR;

/// Paths of all documents below `folders`, relative to the repository.
std::vector<std::string> documents_in(const std::vector<std::string>& folders) {
  std::vector<std::string> found{"README.md", "CONTRIBUTING.md"};
  for (const std::string& folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (entry.path().extension() == ".md") found.push_back(fs::relative(entry.path(), root));
  std::sort(found.begin(), found.end());
  return found;
}

/// All matches of the pattern's first group.
std::vector<std::string> all_of(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern); it != std::sregex_iterator(); ++it)
    found.push_back((*it)[1].str());
  return found;
}

TEST(Documents, EveryFileTheyLinkToExists) {
  for (const std::string& page : documents_in({"docs", "examples", "plugins", "sdk", "tests"}))
    for (const std::string& link : all_of(text_of(root / page), std::regex(R"(\]\(([^)#:\s]+)(#[^)]*)?\))")))
      EXPECT_TRUE(fs::exists((root / page).parent_path() / link)) << page << " links to " << link;
}

TEST(Documents, TheControllerTheyShowSteersVehicles) {
  const test::ScratchFolder scratch;
  const std::string shown = all_of(text_of(root / "docs/controllers.md"), std::regex("\n```c\n([^`]*)```")).at(0);
  const std::string source = scratch.file("brake.c", shown), library = scratch.path("brake.so");
  const auto result = test::run_command(
      "cd " MURO_TEST_SOURCE_DIR " && cc -std=c11 -Wall -Werror -shared -fPIC -I sdk/c -o " + library + " " + source +
      " -lm && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM
      " run examples/urban/urban.yaml --duration 1 --set robots.rovers.control.library=" +
      library);
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

/// The commands of a document: lines that begin with `build/bin/muro`, and blocks of shell.
std::vector<std::string> commands_of(const std::string& page) {
  const std::string text = text_of(root / page);
  std::vector<std::string> commands;
  for (std::string line : all_of(text, std::regex("\n    (build/bin/muro [^\n]*)"))) {
    line = std::regex_replace(line, std::regex(" +# .*"), "");
    if (line.starts_with("build/bin/muro run") && line.find("--duration") == std::string::npos) line += " --duration 1";
    if (line.find("--view") != std::string::npos) line = "xvfb-run -a " + line;  // a display without a screen
    commands.push_back(line);
  }
  for (const std::string& block : all_of(text, std::regex("\n```sh\n([^`]*)```"))) commands.push_back(block);
  return commands;
}

class SlowDocument : public testing::TestWithParam<std::string> {};

TEST_P(SlowDocument, HasCommandsThatRun) {
  for (const std::string& shown : commands_of(GetParam())) {
    // what it writes goes to a folder of this test
    const test::ScratchFolder scratch;
    const std::string folder = scratch.path("");
    std::string command =
        std::regex_replace(shown, std::regex("--(out|report|timeline|csv|video) (?!out/)"), "--$1 out/");
    command = std::regex_replace(command, std::regex(" out/"), " " + folder + "/");
    command = std::regex_replace(command, std::regex("mkdir -p out"), "mkdir -p " + folder);
    command = std::regex_replace(command, std::regex("build/bin/muro"), MURO_PROGRAM);
    const auto result = test::run_command(
        "cd " MURO_TEST_SOURCE_DIR "\nexport MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR "\nset -e\n" + command);
    EXPECT_EQ(result.exit_code, 0) << shown << "\n" << result.output;
  }
}

std::string name_of(const testing::TestParamInfo<std::string>& page) {
  return std::regex_replace(page.param, std::regex("[^A-Za-z0-9]"), "_");
}

std::vector<std::string> documents_with_commands() {
  std::vector<std::string> pages = documents_in({"docs", "examples", "plugins"});
  std::erase_if(pages, [](const std::string& page) { return commands_of(page).empty(); });
  return pages;
}

INSTANTIATE_TEST_SUITE_P(Slow, SlowDocument, testing::ValuesIn(documents_with_commands()), name_of);

}  // namespace
}  // namespace muro
