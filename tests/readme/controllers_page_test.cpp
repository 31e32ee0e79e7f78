// SPDX-License-Identifier: MIT
// The library shown in docs/guide/controllers.md compiles and steers vehicles.
#include <gtest/gtest.h>

#include <regex>

#include "tests/support/files.hpp"

namespace muro {
namespace {

/// Builds the library that the page shows in a language, by the command that the page shows, and runs it; `change`: of
/// the source.
test::CommandResult run_as_shown(const std::string& language, const std::string& compiler,
                                 const std::pair<std::string, std::string>& change = {}) {
  const std::string page = test::text_of(MURO_TEST_SOURCE_DIR "/docs/guide/controllers.md");
  std::smatch code, command;
  if (!std::regex_search(page, code, std::regex("\n```" + language + "\n([^`]*)```")) ||
      !std::regex_search(page, command, std::regex("\n    (" + compiler + R"( (?:[^\n]*\\\n)*[^\n]*))")))
    throw std::runtime_error("the page shows no library, or no command that builds it");
  const test::ScratchFolder scratch;
  std::string source = code[1];
  if (const std::size_t at = source.find(change.first); at != std::string::npos)
    source.replace(at, change.first.size(), change.second);
  scratch.file("brake." + language, source);
  const std::string build = std::regex_replace(command[1].str(), std::regex("/path/to/muro"), MURO_TEST_SOURCE_DIR);
  return test::run_command("cd " + scratch.path("") + " && " + build +
                           " -Werror && cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR
                           " " MURO_PROGRAM
                           " run examples/urban/urban.yaml --duration 1 --set robots.rovers.control.library=" +
                           scratch.path("brake.so"));
}

TEST(ControllersPage, TheLibraryThatItShowsSteersVehicles) {
  const auto result = run_as_shown("c", "cc -std=c11");
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST(ControllersPage, TheClassThatItShowsSteersVehicles) {
  const auto result = run_as_shown("cpp", R"(c\+\+ -std=c\+\+20)");
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

TEST(ControllersPage, ItsCommandKeepsAStepThatTheCLibraryHasToo) {
  const auto result = run_as_shown("c", "cc -std=c11", {"static int step(", "int step("});
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

}  // namespace
}  // namespace muro
