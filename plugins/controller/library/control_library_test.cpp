// SPDX-License-Identifier: MIT
// Search and checks of a library, and effects of loading it.
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "library_testing.hpp"
#include "muro_controller.h"

namespace muro::control {
namespace {

TEST(ControllerLibrary, FindsALibraryByItsNameOnThePath) {
  Team missing;
  missing.control("circle");
  const std::string said = refusal(missing);
  EXPECT_TRUE(says(said, "no library `circle.so` or `libcircle.so` in any of these folders: " +
                             std::filesystem::current_path().string()));
  EXPECT_TRUE(
      says(said, MURO_TEST_PLUGIN_DIR "/controllers; give its path, or add its folder to MURO_CONTROLLER_PATH"));

  ASSERT_EQ(setenv("MURO_CONTROLLER_PATH", ("/nowhere::" + folder).c_str(), 1), 0);
  for (const char* name : {"circle", "circle.so"}) {
    Team team;
    team.control(name);
    EXPECT_NO_THROW(team.build()) << name;
  }
  Team prefixed;
  prefixed.control("prefixed");
  EXPECT_NO_THROW(prefixed.build());
  Team wrong;
  wrong.control("circel");
  EXPECT_TRUE(says(refusal(wrong), ", /nowhere, " + folder + ", "));
  unsetenv("MURO_CONTROLLER_PATH");
}

TEST(ControllerLibrary, TakesPathsRelativeToTheScenario) {
  Team team;
  AlgorithmSetup setup;
  setup.use = "controller.library";
  setup.rate = Rate(10);
  setup.items = team.all_robots();
  setup.folder = std::filesystem::path(folder).parent_path().parent_path().string();
  setup.parameters["library"] = std::string("controllers/circle.so");
  team.Simulation::add(setup);
  EXPECT_NO_THROW(team.build());
  Team wrong;
  setup.items = wrong.all_robots();
  setup.parameters["library"] = std::string("controllers/circel.so");
  wrong.Simulation::add(setup);
  EXPECT_TRUE(says(refusal(wrong), "there is no library `" + setup.folder + "/controllers/circel.so`"));
}

TEST(ControllerLibrary, ThatWasCopiedByHalfIsRefused) {
  const std::string half = testing::TempDir() + "half.so";
  std::filesystem::copy_file(folder + "circle.so", half, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(half, 5000);
  Team team;
  team.control(half);
  const std::string said = refusal(team);
  EXPECT_NE(said.find("library " + half + " cannot be loaded: the file has 5000 bytes and should have at "),
            std::string::npos)
      << said;
}

TEST(ControllerLibrary, NamesWhatIsWrongWithALibrary) {
  for (const auto& [library, message] : {
           std::pair<std::string, std::string>{"no_symbol.so", "exports no `muro_controller`"},
           {"unresolved.so", "cannot be loaded: undefined symbol: function_of_no_library"},
           {"open_step.so", "would use functions of others in place of its own: `step` (of "},
           {"no_table.so", "`muro_controller` returns no table"},
           {"other_abi.so", "abi is 7, this muro has 1; build it with the muro_controller.h of this muro"},
           {"other_size.so", "table_size is 8, this muro has " + std::to_string(sizeof(muro_controller_table)) +
                                 ", and older headers have 88; build it"},
           {"no_name.so", "its table has no name"},
           {"no_step.so", "its table has no function `step`"},
           {"huge_state.so", "state_size is 1099511627776 bytes; at most 2147483647 are allowed"},
           {"no_inputs.so", "has 2 inputs, but its table points to none"},
           {"nameless_input.so", "input 1 has no name"},
           {"same_inputs.so", "has two inputs named `pose`; names are unique"},
           {"open_output.so", "output `command.twist` has size 0; only inputs may leave their size open"},
           {"unknown_output.so",
            "output `comand.twist` of `one` cannot be connected: no object of robot `a` has a property "
            "`comand.twist` (did you mean `command.twist`?); its objects have `"},
           {"wrong_unit.so", "`a/body:command.twist` is in \"m/s, rad/s\", but the library works in \"km/h\""},
           {"wrong_size.so",
            "robot `a`: output `command.twist` of `one` has 2 numbers in the library, but the connected properties "
            "have 6"},
       })
    EXPECT_TRUE(says(refusal_of(library), message));
}

TEST(ControllerLibrary, HasItsOwnStepWhereTheCLibraryHasOneToo) {
  Team team;
  team.control(folder + "bound_step.so");
  team.build();
  EXPECT_NO_THROW(team.run_for(1));
}

TEST(ControllerLibrary, ALibraryBuiltWithFastMathChangesNobodysArithmetic) {
  const volatile double smallest_normal = std::numeric_limits<double>::min();
  Team team;
  team.control(folder + "fast_math.so");
  team.build();
  EXPECT_GT(smallest_normal / 2, 0) << "subnormal numbers are still there";
}

}  // namespace
}  // namespace muro::control
