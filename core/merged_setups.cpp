// SPDX-License-Identifier: MIT
#include "core/merged_setups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <unordered_map>

#include "core/collected_problems.hpp"
#include "muro/description.hpp"

namespace muro {
namespace {

/// Robots of one world share an instance; each keeps its parameters.
void join_world(AlgorithmSetup& world, const AlgorithmSetup& joining) {
  if (world.rate != joining.rate || world.phase != joining.phase)
    throw SetupError(
        fmt::format("{}{} and {} share a world of {} but have different rates or phases; give them the "
                    "same, or another `world` to one of them",
                    prefix_of(joining.place), joining.name, world.name, joining.use));
  for (const Item& item : joining.items) {
    const auto twin =
        std::find_if(world.items.begin(), world.items.end(), [&](const Item& k) { return k.robot == item.robot; });
    if (twin == world.items.end()) continue;
    const auto place_of_twin = std::size_t(twin - world.items.begin());
    const std::string& name = world.item_setups.empty() ? world.name : world.item_setups[place_of_twin].name;
    throw SetupError(
        fmt::format("{}{} and {} are of one robot and in one world of {}; give one of them another `world`",
                    prefix_of(joining.place), joining.name, name, joining.use));
  }
  world.item_setups.resize(world.items.size(), {world.name, world.place, world.parameters, world.parameter_places});
  world.items.insert(world.items.end(), joining.items.begin(), joining.items.end());
  world.item_setups.resize(world.items.size(),
                           {joining.name, joining.place, joining.parameters, joining.parameter_places});
}

/// Of robots of one group, which have one place in the scenario, one is told. `refused`: such places.
void join_world_told_once(AlgorithmSetup& world, const AlgorithmSetup& joining, std::set<std::string>& refused) {
  try {
    join_world(world, joining);
  } catch (const SetupError&) {
    if (joining.place.empty() || refused.insert(joining.place).second) throw;
  }
}

/// Of a kind whose results would mix, one algorithm serves an object, and one that serves the world serves all.
void check_single_roles(const std::vector<AlgorithmSetup>& setups, Registry& registry) {
  std::map<std::pair<Kind, ObjectId>, const AlgorithmSetup*> served;
  std::set<std::pair<const AlgorithmSetup*, const AlgorithmSetup*>> told;
  std::vector<std::string> problems;
  const auto conflict = [&](const AlgorithmSetup& s, const AlgorithmSetup& other, const KindInfo& kind) {
    if (&s == &other || !told.emplace(&other, &s).second) return;
    const std::string place = other.place.empty() ? "" : " at " + other.place;
    problems.push_back(
        fmt::format("{}{} ({}) is of kind {}, and so is {} ({}){}: their results would mix; remove one of them",
                    prefix_of(s.place), s.name, s.use, kind.name, other.name, other.use, place));
  };
  for (const AlgorithmSetup& s : setups) {
    const KindInfo& kind = info_of(registry.algorithm(s.use).description->kind);
    if (!kind.is_single) continue;
    if (s.items.empty()) {
      const auto any = served.lower_bound({kind.kind, world_object});
      if (any != served.end() && any->first.first == kind.kind) conflict(s, *any->second, kind);
      served.emplace(std::pair(kind.kind, world_object), &s);
    }
    const auto all = served.find({kind.kind, world_object});
    for (const Item& item : s.items)
      conflict(
          s, all != served.end() ? *all->second : *served.emplace(std::pair(kind.kind, item.object), &s).first->second,
          kind);
  }
  if (!problems.empty()) throw SetupError(problems);
}

}  // namespace

MergedSetups merge(const std::vector<AlgorithmSetup>& setups, Registry& registry) {
  CollectedProblems problems;
  MergedSetups result;
  std::vector<AlgorithmSetup>& merged = result.merged;
  const auto world_of = [](const AlgorithmSetup& s) {
    const auto named = s.parameters.find("world");
    return named == s.parameters.end() ? ParameterInput(std::string()) : named->second;
  };
  std::set<std::string> refused;
  std::unordered_map<std::string, std::vector<std::size_t>> alike;  // merged, by algorithm and the name they go by
  for (const AlgorithmSetup& s : setups) {
    const std::uint32_t capabilities = registry.algorithm(s.use).description->capabilities;
    const bool world = (capabilities & Capability::world) != 0, batched = (capabilities & Capability::batched) != 0;
    const auto same = [&](const AlgorithmSetup& m) {
      if (m.use != s.use || m.items.empty()) return false;
      if (world) return world_of(m) == world_of(s);
      return m.name == s.name && m.rate == s.rate && m.phase == s.phase && m.parameters == s.parameters &&
             m.folder == s.folder && m.subsystem == s.subsystem;
    };
    const ParameterInput in_world = world_of(s);
    const std::string* world_name = std::get_if<std::string>(&in_world);
    std::vector<std::size_t>& candidates = alike[s.use + '\n' +
                                                 (!world       ? s.name
                                                  : world_name ? *world_name
                                                               : std::string())];
    const auto known =
        (batched || world) && !s.items.empty()
            ? std::find_if(candidates.begin(), candidates.end(), [&](std::size_t m) { return same(merged[m]); })
            : candidates.end();
    if (known != candidates.end()) {
      AlgorithmSetup& m = merged[*known];
      if (world)
        problems.run([&] { join_world_told_once(m, s, refused); });
      else
        m.items.insert(m.items.end(), s.items.begin(), s.items.end());
      result.merged_of_setup.push_back(*known);
    } else {
      candidates.push_back(merged.size());
      result.merged_of_setup.push_back(merged.size());
      merged.push_back(s);
    }
  }
  problems.check();
  check_single_roles(merged, registry);
  return result;
}

}  // namespace muro
