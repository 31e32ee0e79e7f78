// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/instance.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/outputs/json_text.hpp"

namespace muro::host {

namespace {

using Json = nlohmann::ordered_json;

std::string type_of(const PropertyStore& store, const Slot& s) {
  std::string type(store.key_of(s).type->name);
  if (s.multiplicity == Multiplicity::array) type += "[" + std::to_string(s.count) + "]";
  if (s.multiplicity == Multiplicity::list) type += " list";
  return type;
}

bool reads(Usage u) { return u.access == Access::read || u.access == Access::read_sum; }

Json describe_property(const PropertyStore& store, const PropertyStore::NamedSlot& named, ObjectId object) {
  const Slot& s = store.slot(named.slot);
  const KeyInfo& key = store.key_of(s);
  constexpr const char* kinds[] = {"unused", "constant", "variable", "derived"};
  Json p = {{"property", named.key},
            {"type", type_of(store, s)},
            {"unit", key.unit},
            {"is", kinds[static_cast<int>(s.kind)]}};
  Json writers = Json::array(), readers = Json::array();
  for (const Slot::User& u : s.users) {
    Json& list = reads(u.usage) ? readers : writers;
    const std::string& who = store.accessor_name(u.accessor);
    if (std::find(list.begin(), list.end(), Json(who)) == list.end()) list.push_back(who);
  }
  p["writers"] = writers;
  p["readers"] = readers;
  if (s.object != object && s.object != no_object) p["shared_with"] = store.object_name(s.object);
  return p;
}

/// All tasks in the order of their kinds. Sequences and readers on demand change it, as in the first instant.
Json describe_schedule(const Simulation& simulation) {
  const std::vector<Task>& tasks = simulation.scheduler().tasks();
  std::vector<TaskId> ids(tasks.size());
  std::iota(ids.begin(), ids.end(), TaskId{0});
  std::stable_sort(ids.begin(), ids.end(), [&](TaskId a, TaskId b) { return tasks[a].order() < tasks[b].order(); });
  Json list = Json::array();
  for (const TaskId t : ids) {
    const Task& task = tasks[t];
    Json entry = {{"name", task.name}, {"items", task.items}};
    entry["rate_hz"] = task.rate.on_demand() ? Json("on_demand") : Json(task.rate.hertz());
    entry["phase_s"] = 1e-9 * double(task.phase);
    entry["order"] = task.order();
    list.push_back(entry);
  }
  return list;
}

/// The algorithms that run at t = 0, in their order.
Json describe_first_instant(const Simulation& simulation) {
  Json names = Json::array();
  for (const TaskId t : simulation.scheduler().order_at(0)) names.push_back(simulation.scheduler().tasks()[t].name);
  return names;
}

std::string joined(const Json& list) {
  std::string all;
  for (const auto& e : list) all += (all.empty() ? "" : ", ") + e.get<std::string>();
  return all.empty() ? "-" : all;
}

void print(const Json& all) {
  for (const auto& object : all["objects"]) {
    fmt::print("{}\n", object["object"].get<std::string>());
    for (const auto& p : object["properties"]) {
      fmt::print("  {:<26} {:<18} {:<16} {:<9}", p["property"].get<std::string>(), p["type"].get<std::string>(),
                 p["unit"].get<std::string>(), p["is"].get<std::string>());
      if (!p["writers"].empty()) fmt::print("  written by {}", joined(p["writers"]));
      if (!p["readers"].empty()) fmt::print("  read by {}", joined(p["readers"]));
      if (p.contains("shared_with")) fmt::print("  shared with {}", p["shared_with"].get<std::string>());
      fmt::print("\n");
    }
  }
  fmt::print("\nAlgorithms, in the order of their kinds:\n");
  for (const auto& e : all["schedule"])
    fmt::print("  {:<32} {:>6} items  {:<12}{}\n", e["name"].get<std::string>(), e["items"].get<int>(),
               e["rate_hz"].is_string() ? std::string("on demand") : fmt::format("{:g} Hz", e["rate_hz"].get<double>()),
               e["phase_s"] != 0.0 ? fmt::format(" from {:g} s", e["phase_s"].get<double>()) : "");
  fmt::print("\nThe first instant: {}\n", joined(all["first_instant"]));
}

}  // namespace

int describe(const ScenarioOptions& options, bool json) {
  Registry registry(Registry::search_path(options.plugin_path));
  const BuiltScenario built = look_at_scenario(options, registry);
  const World& world = built.simulation->world();
  Json all = {{"scenario", built.scenario.name}, {"objects", Json::array()}};
  for (std::uint32_t i = 0; i < world.object_count(); ++i) {
    const ObjectId id{i};
    Json properties = Json::array();
    for (const auto& named : world.store().properties(id))
      properties.push_back(describe_property(world.store(), named, id));
    all["objects"].push_back({{"object", world.object_name(id)}, {"properties", properties}});
  }
  all["schedule"] = describe_schedule(*built.simulation);
  all["first_instant"] = describe_first_instant(*built.simulation);
  if (json)
    fmt::print("{}\n", json_text(all));
  else
    print(all);
  return 0;
}

}  // namespace muro::host
