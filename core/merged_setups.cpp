// SPDX-License-Identifier: MIT
#include "core/merged_setups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "core/collected_problems.hpp"
#include "muro/description.hpp"

namespace muro {
namespace {

/// Adds the items of `joining` to those of `all`; each keeps its name and its parameters.
void join(AlgorithmSetup& all, const AlgorithmSetup& joining) {
  all.item_setups.resize(all.items.size(), {all.name, all.place, all.parameters, all.parameter_places});
  all.items.insert(all.items.end(), joining.items.begin(), joining.items.end());
  all.item_setups.resize(all.items.size(), {joining.name, joining.place, joining.parameters, joining.parameter_places});
}

/// Robots of one world share an instance.
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
  join(world, joining);
}

/// Setups of one group and one name become one instance as they are.
void join_batch(AlgorithmSetup& all, const AlgorithmSetup& joining) {
  if (all.name == joining.name && all.item_setups.empty())
    all.items.insert(all.items.end(), joining.items.begin(), joining.items.end());
  else
    join(all, joining);
}

/// Joins a world. Robots of one group have one place; its problem is reported once. `refused`: places with a problem.
void join_world_told_once(AlgorithmSetup& world, const AlgorithmSetup& joining, std::set<std::string>& refused) {
  try {
    join_world(world, joining);
  } catch (const SetupError&) {
    if (joining.place.empty() || refused.insert(joining.place).second) throw;
  }
}

/// Checks kinds whose results would mix: only one algorithm serves an object, and one that serves the world serves all.
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

/// Takes setups one after the other.
class Merging {
 public:
  explicit Merging(Registry& registry) : registry_(registry) {}

  void add(const AlgorithmSetup& s, bool is_in_sequence) {
    const Use use = use_of(s, is_in_sequence);
    std::vector<std::size_t>& candidates = alike_[use.key];
    const auto known =
        use.is_shared && !s.items.empty()
            ? std::find_if(candidates.begin(), candidates.end(), [&](std::size_t m) { return shares(m, s, use); })
            : candidates.end();
    std::size_t number = all_.merged.size();
    if (known == candidates.end()) {
      candidates.push_back(number);
      all_.merged.push_back(s);
    } else {
      number = *known;
      if (use.is_of_world)
        problems_.run([&] { join_world_told_once(all_.merged[number], s, refused_); });
      else
        join_batch(all_.merged[number], s);
    }
    all_.merged_of_setup.push_back(number);
    if (use.is_of_any_group)
      for (const Item& item : s.items) moved_.emplace(number, item.robot);
  }

  /// Throws SetupError where uses exclude each other.
  MergedSetups result() {
    problems_.check();
    return std::move(all_);
  }

 private:
  /// The way in which an algorithm is used.
  struct Use {
    bool is_shared, is_of_world, is_of_any_group;
    std::string key;  ///< equal for all uses that may share an instance
  };

  static ParameterInput world_of(const AlgorithmSetup& s) {
    const auto named = s.parameters.find("world");
    return named == s.parameters.end() ? ParameterInput(std::string()) : named->second;
  }

  Use use_of(const AlgorithmSetup& s, bool is_in_sequence) const {
    const Description& d = *registry_.algorithm(s.use).description;
    const bool is_of_world = (d.capabilities & Capability::world) != 0;
    const bool is_batched = (d.capabilities & Capability::batched) != 0;
    Use use{is_batched || is_of_world, is_of_world, !is_of_world && d.kind == Kind::motion && !is_in_sequence,
            s.use + '\n'};
    const ParameterInput world = world_of(s);
    if (!is_of_world && !use.is_of_any_group)
      use.key += s.name;
    else if (is_of_world && std::holds_alternative<std::string>(world))
      use.key += std::get<std::string>(world);
    return use;
  }

  bool shares(std::size_t number, const AlgorithmSetup& s, const Use& use) const {
    const AlgorithmSetup& m = all_.merged[number];
    if (m.items.empty()) return false;
    if (use.is_of_world) return world_of(m) == world_of(s);
    if (m.rate != s.rate || m.phase != s.phase || m.parameters != s.parameters || m.folder != s.folder ||
        m.subsystem != s.subsystem || m.is_optional != s.is_optional)
      return false;
    if (m.name == s.name) return true;
    // each motion of a robot is an instance; check_single_roles() checks whether it may have several
    return use.is_of_any_group && m.items.front().level == s.items.front().level &&
           std::none_of(s.items.begin(), s.items.end(), [&](const Item& item) {
             return moved_.contains({number, item.robot});
           });
  }

  Registry& registry_;
  MergedSetups all_;
  CollectedProblems problems_;
  std::set<std::string> refused_;                             ///< places of the setups that worlds refuse
  std::map<std::string, std::vector<std::size_t>> alike_;     ///< merged, by Use::key
  std::set<std::pair<std::size_t, const RobotView*>> moved_;  ///< robots that a merged setup moves, by its index
};

}  // namespace

MergedSetups merge(const std::vector<AlgorithmSetup>& setups, const std::vector<std::vector<std::size_t>>& sequences,
                   Registry& registry) {
  std::vector<bool> is_in_sequence(setups.size());
  for (const auto& sequence : sequences)
    for (const std::size_t i : sequence) is_in_sequence[i] = true;
  Merging merging(registry);
  for (std::size_t i = 0; i < setups.size(); ++i) merging.add(setups[i], is_in_sequence[i]);
  MergedSetups result = merging.result();
  check_single_roles(result.merged, registry);
  return result;
}

}  // namespace muro
