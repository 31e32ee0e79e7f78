// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "core/simulation.hpp"
#include "muro/detail/stamp.hpp"

namespace muro {
namespace {

const std::string folder = BAD_PLUGIN_DIR "/";

/// Loads "motion.NAME" from the folder NAME. Returns the error, or "" when it is loaded.
std::string refusal(const std::string& name) {
  Registry registry({folder + name});
  try {
    registry.algorithm("motion." + name);
  } catch (const SetupError& e) {
    return e.what();
  }
  return "";
}

/// Path of the library NAME, as messages write it.
std::string library(const std::string& name) { return folder + name + "/" + name + ".so"; }

struct Difference {
  std::string plugin, text, more{};

  friend void PrintTo(const Difference& d, std::ostream* out) { *out << d.plugin; }
};

class ForeignPlugin : public testing::TestWithParam<Difference> {};

TEST_P(ForeignPlugin, IsRefusedWithTheFieldOfTheStampThatDiffers) {
  EXPECT_EQ(refusal(GetParam().plugin), "plugin " + library(GetParam().plugin) +
                                            " was built for another muro: " + GetParam().text +
                                            "; build it again with muro_add_plugin() of this muro" + GetParam().more);
}

std::string of_number(const char* field, std::uint32_t in_plugin, std::uint32_t here) {
  return std::string(field) + " is " + std::to_string(in_plugin) + " in the plugin and " + std::to_string(here) +
         " in this muro";
}

constexpr abi::Stamp ours = abi::make_stamp();
const Difference differences[] = {
    {"wrong_magic", "its table does not begin with \"MUROPLUG\""},
    {"wrong_stamp_size", of_number("stamp_size", ours.stamp_size + 4, ours.stamp_size)},
    {"wrong_sdk_major", of_number("sdk_major", ours.sdk_major + 1, ours.sdk_major),
     "; sdk/CHANGELOG.md says what to write for a new version of the SDK"},
    {"newer_sdk_minor", "sdk_minor is " + std::to_string(ours.sdk_minor + 1) + " in the plugin and only " +
                            std::to_string(ours.sdk_minor) + " in this muro"},
    {"wrong_string_layout", of_number("standard_library_abi", 0, 1)},
#ifndef MURO_SANITIZED
    {"debug_containers", of_number("standard_library_debug", 1, 0)},
#endif
    {"wrong_eigen_alignment", of_number("eigen_max_align_bytes", 32, 16)},
    {"wrong_eigen_malloc", of_number("eigen_malloc_already_aligned", 0, 1)},
    {"wrong_probe_size", of_number("probe_size", ours.probe_size + 8, ours.probe_size)},
    {"wrong_probe_layout", of_number("probe_layout", ours.probe_layout ^ 1U, ours.probe_layout)},
};
INSTANTIATE_TEST_SUITE_P(Stamp, ForeignPlugin, testing::ValuesIn(differences),
                         [](const auto& test) { return test.param.plugin; });

TEST(BadPlugin, WithATableOfAnotherSizeIsRefused) {
  const std::size_t size = sizeof(abi::PluginTable);
  EXPECT_EQ(refusal("wrong_table_size"), "plugin " + library("wrong_table_size") + " has a table of " +
                                             std::to_string(size + 16) + " bytes instead of " + std::to_string(size) +
                                             "; build it again with muro_add_plugin() of this muro");
}

TEST(BadPlugin, WithoutTheSymbolIsRefused) {
  EXPECT_EQ(refusal("no_symbol"), "plugin " + library("no_symbol") +
                                      " exports no `muro_plugin`: it is no muro plugin; close it with MURO_PLUGIN");
}

TEST(BadPlugin, WithAnUnresolvedSymbolIsRefusedWhenItIsLoaded) {
  const std::string said = refusal("unresolved_symbol");
  EXPECT_EQ(said.find("plugin " + library("unresolved_symbol") + " cannot be loaded: "), 0u) << said;
  EXPECT_NE(said.find("undefined symbol: function_that_nobody_wrote"), std::string::npos) << said;
}

TEST(BadPlugin, WhoseSdkHasOtherStructsIsRefused) {
  const std::string said = refusal("wrong_layout");
  EXPECT_EQ(said.find("plugin " + library("wrong_layout") + " was built for another muro: layout is "), 0u) << said;
  EXPECT_NE(said.find("structs of its SDK were changed; build it again"), std::string::npos) << said;
}

TEST(BadPlugin, ThatIsATextFileIsRefused) {
  const std::string said = refusal("text_file");
  EXPECT_EQ(said.find("plugin " + library("text_file") + " cannot be loaded: "), 0u) << said;
  EXPECT_TRUE(said.find("file too short") != std::string::npos || said.find("invalid ELF header") != std::string::npos)
      << said;
}

TEST(BadPlugin, ThatWasCopiedByHalfIsRefused) {
  const std::string said = refusal("half");
  EXPECT_EQ(said.find("plugin " + library("half") + " cannot be loaded: the file has 10000 bytes and should have at "),
            0u)
      << said;
}

TEST(BadPlugin, WhoseLibraryIsGoneIsPassedOver) {
  EXPECT_EQ(refusal("no_library"),
            "no plugin offers `motion.no_library`; no plugin was found; set MURO_PLUGIN_PATH or --plugin-path; "
            "searched: " +
                folder + "no_library (0 plugins); passed over: " + folder +
                "no_library/no_library.muro.json: it describes " + library("no_library") + ", which is not beside it");
}

TEST(BadPlugin, WithoutADescriptionIsPassedOver) {
  EXPECT_EQ(refusal("no_description"),
            "no plugin offers `motion.no_description`; no plugin was found; set MURO_PLUGIN_PATH or --plugin-path; "
            "searched: " +
                folder + "no_description (0 plugins); passed over: " + library("no_description") +
                ": it has no description no_description.muro.json beside it; muro_add_plugin() or the program "
                "muro_describe writes one");
}

TEST(Folder, ThatDoesNotExistIsNamedByWhoFindsNothing) {
  const std::string said = refusal("never_made");
  EXPECT_NE(said.find("searched: " + folder + "never_made (it does not exist)"), std::string::npos) << said;
}

TEST(BadPlugin, ThatIsNotTheOneItsDescriptionDescribesIsRefused) {
  EXPECT_EQ(refusal("stale_description"),
            "plugin " + library("stale_description") + " is not the one that " + folder +
                "stale_description/stale_description.muro.json describes; build it again, so that "
                "both are new");
}

/// Looks for "motion.twice". Returns the error, or the library that offers it.
std::string who_offers_twice(const std::vector<std::string>& folders,
                             const std::map<std::string, PluginChoice>& choices = {}) {
  try {
    std::vector<std::string> paths;
    for (const std::string& f : folders) paths.push_back(folder + f);
    Registry registry(paths);
    registry.choose(choices);
    return registry.find("motion.twice").library;
  } catch (const SetupError& e) {
    return e.what();
  }
}

TEST(TwoPlugins, OfOneNameAreAnErrorThatNamesBoth) {
  const std::string first = folder + "two_of_a_name/first.so", second = folder + "two_of_a_name/second.so",
                    third = folder + "other_folder/third.so",
                    offered = "`motion.twice` is offered by several plugins: ",
                    advice =
                        "; remove the others, or choose one in the scenario: `plugins: {motion.twice: " + first + "}`";
  EXPECT_EQ(who_offers_twice({"two_of_a_name"}), offered + first + " and " + second + advice);
  EXPECT_EQ(who_offers_twice({"two_of_a_name", "other_folder"}),
            offered + first + " and " + second + " and " + third + advice);
}

TEST(TwoPlugins, ThatAreTheSameAreOne) {
  EXPECT_EQ(who_offers_twice({"other_folder", "copy"}), folder + "other_folder/third.so");
  EXPECT_EQ(who_offers_twice({"other_folder", "other_folder/../other_folder"}), folder + "other_folder/third.so");
}

TEST(TwoPlugins, AreToldApartByTheChoiceOfAScenario) {
  const std::string second = folder + "two_of_a_name/second.so", third = folder + "other_folder/third.so";
  EXPECT_EQ(who_offers_twice({"two_of_a_name"}, {{"motion.twice", {second, ""}}}), second);
  EXPECT_EQ(who_offers_twice({"two_of_a_name"}, {{"motion.twice", {third, ""}}}), third) << "of no folder";
  EXPECT_EQ(who_offers_twice({"other_folder"}, {{"motion.other", {third, "a.yaml:3:5"}}}),
            "a.yaml:3:5: " + third + " cannot be chosen for `motion.other`: it offers motion.twice");
  const std::string gone = folder + "other_folder/gone.so";
  EXPECT_EQ(who_offers_twice({"other_folder"}, {{"motion.twice", {gone, ""}}}),
            gone + " cannot be chosen for `motion.twice`: there is no such file");
}

TEST(BadPlugin, WithAnUnreadableDescriptionIsAProblemAndStopsNoOther) {
  const Registry registry({folder + "bad_description", folder + "throws"});
  ASSERT_EQ(registry.problems().size(), 1u);
  EXPECT_EQ(registry.problems()[0].find(library("bad_description") +
                                        " is passed over: its description bad_description.muro.json cannot be read: "),
            0u)
      << registry.problems()[0];
  EXPECT_EQ(registry.find("motion.step_throws").plugin, "throws");
}

/// Returns the error of a run of one robot with the algorithm.
std::string failure(const std::string& algorithm) {
  Registry registry({folder + "throws"});
  Simulation simulation(registry);
  RobotTree tree;
  tree.base("base");
  tree.close();
  const RobotView& robot = simulation.world().add_robot("rover", tree, {});
  try {
    AlgorithmSetup motion;
    motion.name = "rover.motion";
    motion.use = algorithm;
    motion.rate = Rate(100);
    motion.items = {{&robot, robot.base()}};
    simulation.add(motion);
    simulation.build();
  } catch (const SetupError& e) {
    return std::string("set-up: ") + e.what();
  }
  try {
    simulation.run_for(1);
  } catch (const StepError& e) {
    return std::string("step: ") + e.what();
  }
  return "";
}

TEST(FailingAlgorithm, IsNamedWithItsOwnWordsWhereverItFails) {
  EXPECT_EQ(failure("motion.create_throws"),
            "set-up: rover.motion (motion.create_throws) cannot be created: no licence file; put one at /etc/example");
  EXPECT_EQ(failure("motion.connect_throws"),
            "set-up: rover.motion (motion.connect_throws) cannot be connected: an exception that is no std::exception");
  EXPECT_EQ(failure("motion.start_throws"),
            "set-up: rover.motion (motion.start_throws) cannot start: port 4711 is taken; choose another one");
  EXPECT_EQ(failure("motion.step_throws"),
            "step: rover.motion (motion.step_throws), robot `rover`, failed at t = 0.030000 s: matrix is singular");
  EXPECT_EQ(failure("motion.step_has_no_memory"),
            "step: rover.motion (motion.step_has_no_memory), robot `rover`, failed at t = 0.000000 s: std::bad_alloc");
}

}  // namespace
}  // namespace muro
