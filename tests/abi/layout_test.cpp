// SPDX-License-Identifier: MIT
// The layout that crosses the boundary is the same in all minor versions of a major one. layout_of_major_N.txt records
// it, with one line for each struct, member and virtual function.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "muro/detail/contract_layout.hpp"
#include "muro/detail/stamp.hpp"
#include "muro/ext/call_note.hpp"
#include "muro/ext/external_inputs.hpp"
#include "muro/ext/inspection.hpp"
#include "muro/ext/loaded_libraries.hpp"
#include "muro/ext/lockstep.hpp"
#include "muro/ext/outputs.hpp"
#include "muro/ext/package_folders.hpp"
#include "muro/ext/report_entries.hpp"
#include "muro/ext/run_control.hpp"
#include "muro/model_reader.hpp"
#include "muro_controller.h"

namespace muro {
namespace {

using Lines = std::vector<std::string>;

std::string line_of(const abi::Place& p) {
  const bool is_struct = p.name.find('.') == std::string_view::npos;
  if (is_struct && p.size == 0) return std::string(p.name) + ": may grow, alignment " + std::to_string(p.offset);
  return std::string(p.name) + (is_struct ? ": size " : ": offset ") + std::to_string(is_struct ? p.size : p.offset) +
         (is_struct ? ", alignment " : ", size ") + std::to_string(is_struct ? p.offset : p.size);
}

void add_places(std::span<const abi::Place> places, Lines& out) {
  for (const abi::Place& p : places) out.push_back(line_of(p));
}

template <class Function>
void add_function(const char* name, Function function, Lines& out) {
  out.push_back(std::string(name) + ": function " + std::to_string(abi::virtual_place(function) / sizeof(void*)));
}
#define FUNCTION(CLASS, NAME) add_function(#CLASS "::" #NAME, &CLASS::NAME, out)

/// Gives access to protected functions of interfaces.
struct OpenConnector : Connector {
  static void add_to(Lines& out) {
    add_function("Connector::bind", &OpenConnector::bind, out);
    add_function("Connector::constant_raw", &OpenConnector::constant_raw, out);
    add_function("Connector::set_raw", &OpenConnector::set_raw, out);
    add_function("Connector::rate", &OpenConnector::rate, out);
  }

 protected:
  ~OpenConnector() = default;
};
struct OpenRobotBuilder : RobotBuilder {
  static void add_to(Lines& out) { add_function("RobotBuilder::set_raw", &OpenRobotBuilder::set_raw, out); }

 protected:
  ~OpenRobotBuilder() = default;
};

void add_functions_of_hosts(Lines& out) {
  FUNCTION(Host, log);
  FUNCTION(Host, find_extension);
  FUNCTION(Connector, items);
  FUNCTION(Connector, parameters);
  FUNCTION(Connector, parameters_of);
  FUNCTION(Connector, host);
  FUNCTION(Connector, random_key);
  FUNCTION(Connector, resolve_path);
  FUNCTION(Connector, object_count);
  FUNCTION(Connector, object_name);
  FUNCTION(Connector, find_object);
  FUNCTION(Connector, robots);
  FUNCTION(Connector, robot_of);
  FUNCTION(Connector, text);
  FUNCTION(Connector, properties);
  FUNCTION(Connector, is_used);
  FUNCTION(Connector, state_block);
  OpenConnector::add_to(out);
  FUNCTION(RobotBuilder, base);
  FUNCTION(RobotBuilder, fork);
  FUNCTION(RobotBuilder, end);
  FUNCTION(RobotBuilder, translation);
  FUNCTION(RobotBuilder, rotation);
  FUNCTION(RobotBuilder, revolute);
  FUNCTION(RobotBuilder, prismatic);
  FUNCTION(RobotBuilder, mimic);
  FUNCTION(RobotBuilder, body);
  FUNCTION(RobotBuilder, intern);
  FUNCTION(RobotBuilder, report);
  OpenRobotBuilder::add_to(out);
  FUNCTION(RobotBuilder, find_extension);
  FUNCTION(WorldBuilder, gravity);
  FUNCTION(WorldBuilder, scenery);
  FUNCTION(WorldBuilder, model);
  FUNCTION(WorldBuilder, intern);
  FUNCTION(WorldBuilder, report);
  FUNCTION(WorldBuilder, friction_rule);
  FUNCTION(WorldBuilder, find_extension);
}

void add_functions_of_plugins(Lines& out) {
  using abi::AlgorithmInstance, abi::ReaderInstance;
  FUNCTION(AlgorithmInstance, connect);
  FUNCTION(AlgorithmInstance, connect_by_name);
  FUNCTION(AlgorithmInstance, start);
  FUNCTION(AlgorithmInstance, phases);
  FUNCTION(AlgorithmInstance, step);
  FUNCTION(AlgorithmInstance, on_handover);
  FUNCTION(AlgorithmInstance, restored);
  FUNCTION(AlgorithmInstance, finish);
  FUNCTION(AlgorithmInstance, destroy);
  FUNCTION(AlgorithmInstance, find_extension);
  FUNCTION(ReaderInstance, read);
  FUNCTION(ReaderInstance, destroy);
  FUNCTION(ReaderInstance, read_world);
}

void add_extension(const ExtensionId& id, Lines& out) {
  char layout[9];
  std::snprintf(layout, sizeof layout, "%08x", id.layout);
  out.push_back(std::string(id.name) + " " + std::to_string(id.version) + ": layout " + layout);
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
/// Adds the head of a plugin's table, which hosts compare before anything else, and the C interface of control code.
void add_tables(Lines& out) {
  using namespace abi;
  add_places(
      std::initializer_list<Place>{MURO_SIZE(Stamp), MURO_PLACE(Stamp, probe_layout), MURO_PLACE(Stamp, compiler),
                                   MURO_PLACE(PluginTable, table_size), MURO_PLACE(PluginTable, name),
                                   MURO_PLACE(PluginTable, summary), MURO_PLACE(PluginTable, algorithms),
                                   MURO_PLACE(PluginTable, readers), MURO_PLACE(PluginTable, layout)},
      out);
  add_places(std::initializer_list<Place>{MURO_SIZE(muro_port),
                                          MURO_PLACE(muro_port, name),
                                          MURO_PLACE(muro_port, unit),
                                          MURO_PLACE(muro_port, size),
                                          MURO_PLACE(muro_port, flags),
                                          MURO_SIZE(muro_controller_setup),
                                          MURO_PLACE(muro_controller_setup, robot),
                                          MURO_PLACE(muro_controller_setup, period),
                                          MURO_PLACE(muro_controller_setup, seed),
                                          MURO_PLACE(muro_controller_setup, input_sizes),
                                          MURO_PLACE(muro_controller_setup, arguments),
                                          MURO_PLACE(muro_controller_setup, output_sizes),
                                          MURO_PLACE(muro_controller_setup, index),
                                          MURO_PLACE(muro_controller_setup, count),
                                          MURO_PLACE(muro_controller_setup, tunables),
                                          MURO_PLACE(muro_controller_setup, log),
                                          MURO_SIZE(muro_controller_step),
                                          MURO_PLACE(muro_controller_step, time),
                                          MURO_PLACE(muro_controller_step, inputs),
                                          MURO_PLACE(muro_controller_step, outputs),
                                          MURO_PLACE(muro_controller_step, period),
                                          MURO_PLACE(muro_controller_step, index),
                                          MURO_PLACE(muro_controller_step, input_sizes),
                                          MURO_PLACE(muro_controller_step, output_sizes),
                                          MURO_PLACE(muro_controller_step, integer_inputs),
                                          MURO_PLACE(muro_controller_step, text_inputs),
                                          MURO_PLACE(muro_controller_step, integer_outputs),
                                          MURO_PLACE(muro_controller_step, text_outputs),
                                          MURO_PLACE(muro_controller_step, tunables),
                                          MURO_PLACE(muro_controller_step, log),
                                          MURO_SIZE(muro_tunable),
                                          MURO_PLACE(muro_tunable, name),
                                          MURO_PLACE(muro_tunable, unit),
                                          MURO_PLACE(muro_tunable, default_value),
                                          MURO_PLACE(muro_tunable, min),
                                          MURO_PLACE(muro_tunable, max),
                                          MURO_PLACE(muro_tunable, doc),
                                          MURO_SIZE(muro_log_sink),
                                          MURO_PLACE(muro_log_sink, context),
                                          MURO_PLACE(muro_log_sink, write),
                                          MURO_SIZE(muro_task),
                                          MURO_PLACE(muro_task, name),
                                          MURO_PLACE(muro_task, rate),
                                          MURO_PLACE(muro_task, step),
                                          MURO_SIZE(muro_controller_table),
                                          MURO_PLACE(muro_controller_table, abi),
                                          MURO_PLACE(muro_controller_table, table_size),
                                          MURO_PLACE(muro_controller_table, name),
                                          MURO_PLACE(muro_controller_table, version),
                                          MURO_PLACE(muro_controller_table, summary),
                                          MURO_PLACE(muro_controller_table, inputs),
                                          MURO_PLACE(muro_controller_table, input_count),
                                          MURO_PLACE(muro_controller_table, outputs),
                                          MURO_PLACE(muro_controller_table, output_count),
                                          MURO_PLACE(muro_controller_table, state_size),
                                          MURO_PLACE(muro_controller_table, create),
                                          MURO_PLACE(muro_controller_table, step),
                                          MURO_PLACE(muro_controller_table, tunables),
                                          MURO_PLACE(muro_controller_table, tunable_count),
                                          MURO_PLACE(muro_controller_table, tasks),
                                          MURO_PLACE(muro_controller_table, task_count),
                                          MURO_PLACE(muro_controller_table, instantiate),
                                          MURO_PLACE(muro_controller_table, destroy),
                                          MURO_PLACE(muro_controller_table, save_size),
                                          MURO_PLACE(muro_controller_table, save),
                                          MURO_PLACE(muro_controller_table, load)},
             out);
}
#pragma GCC diagnostic pop

Lines present() {
  Lines out;
  add_tables(out);
  add_places(abi::contract_places, out);
  add_places(abi::later_places, out);
  add_functions_of_hosts(out);
  add_functions_of_plugins(out);
  add_extension(Inspection::id(), out);
  add_extension(LoadedLibraries::id(), out);
  add_extension(Outputs::id(), out);
  add_extension(CallNotes::id(), out);
  add_extension(ExternalInputs::id(), out);
  add_extension(Lockstep::id(), out);
  add_extension(RunControl::id(), out);
  add_extension(ReportEntries::id(), out);
  add_extension(PackageFolders::id(), out);
  add_extension(PauseAttendant::id(), out);
  return out;
}

TEST(Contract, IsTheOneOnRecordForItsMajorVersion) {
  const std::string name = "layout_of_major_" + std::to_string(abi::sdk_major) + ".txt";
  const Lines now = present();
  std::ofstream file(testing::TempDir() + name);
  for (const std::string& line : now) file << line << '\n';
  file.close();
  std::ifstream record(ABI_SOURCE_DIR "/" + name);
  ASSERT_TRUE(record) << "there is no tests/abi/" << name << "; this one is: " << testing::TempDir() << name;
  Lines recorded;
  for (std::string line; std::getline(record, line);) recorded.push_back(line);
  for (const std::string& line : recorded)
    EXPECT_NE(std::find(now.begin(), now.end(), line), now.end())
        << "gone: " << line << "\nPlugins of SDK " << abi::sdk_major << " count on it; a change needs a new sdk_major.";
  for (const std::string& line : now)
    EXPECT_NE(std::find(recorded.begin(), recorded.end(), line), recorded.end())
        << "new: " << line << "\nA new function at the end needs a new sdk_minor and its line in tests/abi/" << name;
}

/// Converts to a value of any type within braces.
struct Any {
  template <class T>
  operator T() const;
};
template <class T, class... Values>
constexpr std::size_t members() {
  if constexpr (requires { T{Values{}..., Any{}}; })
    return members<T, Values..., Any>();
  else
    return sizeof...(Values);
}

/// Returns the number of members of a struct that are in the list.
std::size_t listed(const std::string& name) {
  const auto is_member = [&](const abi::Place& p) { return p.name.starts_with(name + "."); };
  return std::size_t(std::count_if(std::begin(abi::contract_places), std::end(abi::contract_places), is_member) +
                     std::count_if(abi::later_places.begin(), abi::later_places.end(), is_member));
}

TEST(Contract, HasEveryMemberOfItsStructsOnTheList) {
  struct Count {
    const char* name;
    std::size_t members;
  };
#define COUNT(STRUCT) \
  Count { #STRUCT, members < STRUCT>() }
  using namespace abi;
  for (const Count& c : {COUNT(Pose),
                         COUNT(Twist),
                         COUNT(Wrench),
                         COUNT(Inertia),
                         COUNT(ValueType),
                         COUNT(KeyInfo),
                         COUNT(ArrayHeader),
                         COUNT(ListHeader),
                         COUNT(SumHeader),
                         COUNT(Shape),
                         COUNT(JointLimits),
                         COUNT(Link),
                         COUNT(RobotView),
                         COUNT(Aabb),
                         COUNT(Collider),
                         COUNT(BvhNode),
                         COUNT(Bvh),
                         COUNT(RobotColliders),
                         COUNT(SceneIndex),
                         COUNT(Contact),
                         COUNT(ContactWrench),
                         COUNT(ExtensionId),
                         COUNT(Surface),
                         COUNT(Parameter),
                         COUNT(ParameterValue),
                         COUNT(PropertyUse),
                         COUNT(Description),
                         COUNT(ReaderDescription),
                         COUNT(Step),
                         COUNT(Range),
                         COUNT(Phase),
                         COUNT(Item),
                         COUNT(Usage),
                         COUNT(FoundProperty),
                         COUNT(AlgorithmEntry),
                         COUNT(ReaderEntry)})
    EXPECT_EQ(listed(c.name), c.members) << c.name;
}

/// Returns the number of virtual functions of an interface.
template <class Interface>
std::size_t functions() {
  return abi::virtual_place(&abi::OneMore<Interface>::one_more) / sizeof(void*);
}

TEST(Contract, HasEveryFunctionOfItsInterfacesOnTheList) {
  const Lines lines = present();
  const auto listed_of = [&](const std::string& name) {
    return std::size_t(
        std::count_if(lines.begin(), lines.end(), [&](const std::string& l) { return l.starts_with(name + "::"); }));
  };
  EXPECT_EQ(listed_of("Host"), functions<Host>());
  EXPECT_EQ(listed_of("Connector"), functions<Connector>());
  EXPECT_EQ(listed_of("RobotBuilder"), functions<RobotBuilder>());
  EXPECT_EQ(listed_of("WorldBuilder"), functions<WorldBuilder>());
  EXPECT_EQ(listed_of("AlgorithmInstance"), functions<abi::AlgorithmInstance>());
  EXPECT_EQ(listed_of("ReaderInstance"), functions<abi::ReaderInstance>());
}

}  // namespace
}  // namespace muro
