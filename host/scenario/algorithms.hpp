// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/scenario.hpp"
#include "host/scenario/section.hpp"

namespace muro::host {

/// Gives algorithms to a simulation: those that a scenario names, and those that it leaves open.
class Algorithms {
 public:
  Algorithms(const Scenario& scenario, Registry& registry, Simulation& simulation, Problems& problems)
      : scenario_(scenario), registry_(registry), simulation_(simulation), problems_(problems) {}

  /// What the algorithm says of itself; nothing, and a problem, when it is not to be had.
  const Description* describe(const Subsystem& s);
  bool is_kind(const Subsystem& s, Kind kind);
  /// Adds an algorithm for these items. `alias`: another name under which sequences may call it.
  void add(const Subsystem& s, const std::string& name, std::vector<Item> items, const std::string& alias = "");
  /// Once all robots are there: the algorithms of the whole scene, defaults, sequences.
  void complete();

 private:
  void add_to_scene(const Subsystem& s);
  bool is_off(const char* name) const;
  /// Adds an algorithm that the scenario does not name; `reason` says in an error why it is needed.
  void add_unnamed(const std::string& name, const std::string& use, const std::string& reason, std::vector<Item> items);
  void note_needs(const Description& d, const Subsystem& s);
  void add_kinematics();
  void add_defaults();
  void add_sequence(const std::vector<Name>& sequence);

  const Scenario& scenario_;
  Registry& registry_;
  Simulation& simulation_;
  Problems& problems_;
  struct Added {
    std::size_t number;  ///< of Simulation::add
    Rate rate;
    std::int64_t phase;
  };
  std::map<std::string, std::vector<Added>> added_;  ///< by name and by alias
  std::set<std::string> used_;
  std::map<std::string, std::string, std::less<>> needs_;  ///< property that something reads: one of those that do
  std::set<std::string> worlds_;                           ///< worlds that robots are moved in
  std::set<std::uint32_t> has_kinematics_;                 ///< numbers of robots
};

}  // namespace muro::host
