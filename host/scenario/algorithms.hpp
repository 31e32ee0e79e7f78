// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Adds algorithms to a simulation: those in the scenario, and default ones for tasks that it leaves open.
class Algorithms {
 public:
  Algorithms(const Scenario& scenario, Registry& registry, Simulation& simulation, Problems& problems)
      : scenario_(scenario), registry_(registry), simulation_(simulation), problems_(problems) {}

  /// Returns the description of a subsystem's algorithm. Returns null and adds a problem when it cannot be loaded.
  const Description* describe(const Subsystem& s);
  /// Whether there is an algorithm of this name.
  bool is_installed(const std::string& use) const;
  bool is_kind(const Subsystem& s, Kind kind);
  /// Adds an algorithm for these items. Sequences may name it by `name`, or by `template_name`, which the algorithms of
  /// all robots of the template share.
  void add(const Subsystem& s, const std::string& name, std::vector<Item> items, const std::string& template_name = "");
  /// Adds the algorithms of the whole scene, default algorithms and sequences. Call when all robots are added.
  void complete();

 private:
  void add_to_scene(const Subsystem& s);
  bool is_switched_off(const char* name) const;
  Rate rate_of(const Subsystem& s, const KindInfo& kind);
  /// Adds an algorithm that the scenario does not name; `reason` says in an error why it is needed.
  void add_default(const std::string& name, const std::string& use, const std::string& reason, std::vector<Item> items);
  void record_reads(const Description& d, const Subsystem& s);
  void add_kinematics();
  void add_defaults();
  void add_sequence(const std::vector<Name>& sequence);

  const Scenario& scenario_;
  Registry& registry_;
  Simulation& simulation_;
  Problems& problems_;
  struct Added {
    std::size_t number;  ///< result of Simulation::add
    Rate rate;
    std::int64_t phase;
  };
  std::map<std::string, std::vector<Added>> added_;  ///< by name and by template name
  std::set<std::string> used_;
  std::map<std::string, std::string, std::less<>> readers_;  ///< by property: an algorithm that reads it
  std::set<std::string> worlds_;                             ///< worlds in which robots are moved
  std::set<std::uint32_t> has_kinematics_;                   ///< numbers of robots
  const Subsystem* scene_kinematics_ = nullptr;              ///< the kinematics that serve all other robots
};

}  // namespace muro::host
