// SPDX-License-Identifier: MIT
// The library that docs/controllers.md shows compiles, and steers vehicles.
#include <gtest/gtest.h>

#include <regex>

#include "tests/support/files.hpp"

namespace muro {
namespace {

TEST(ControllersPage, TheLibraryThatItShowsSteersVehicles) {
  const std::string page = test::text_of(MURO_TEST_SOURCE_DIR "/docs/controllers.md");
  std::smatch shown;
  ASSERT_TRUE(std::regex_search(page, shown, std::regex("\n```c\n([^`]*)```")));
  const test::ScratchFolder scratch;
  const std::string source = scratch.file("brake.c", shown[1].str()), library = scratch.path("brake.so");
  const auto result = test::run_command(
      "cd " MURO_TEST_SOURCE_DIR " && cc -std=c11 -Wall -Werror -shared -fPIC -I sdk/c -o " + library + " " + source +
      " -lm && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM
      " run examples/urban/urban.yaml --duration 1 --set robots.rovers.control.library=" +
      library);
  EXPECT_EQ(result.exit_code, 0) << result.output;
}

}  // namespace
}  // namespace muro
