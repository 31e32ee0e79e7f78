// SPDX-License-Identifier: MIT
#include "host/scenario/model_subsystems.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/names.hpp"
#include "host/scenario/subsystem_reader.hpp"
#include "host/scenario/yaml.hpp"

namespace muro::host {

namespace {

/// Returns "laser" for "laser.raycast".
std::string_view family_of(const Subsystem& s) { return std::string_view(s.use).substr(0, s.use.find('.')); }

bool takes_parameter(const Description& d, const std::string& name) {
  return std::any_of(d.parameters.begin(), d.parameters.end(), [&](const Parameter& p) { return p.name == name; });
}

/// The subsystems in the model of one template.
class ModelSubsystems {
 public:
  ModelSubsystems(const RobotTemplate& t, const RobotTree& tree, const std::string& file, Algorithms& algorithms,
                  Problems& problems)
      : algorithms_(algorithms) {
    for (const RobotTree::Subsystem& s : tree.subsystems())
      problems.collect("", [&] {
        read(s, {file, s.line, s.column}, fmt::format("the model of robot `{}`", t.name), problems);
      });
  }

  bool has(const std::string& name) const {
    return std::any_of(brought_.begin(), brought_.end(), [&](const Subsystem& s) { return s.name == name; });
  }

  /// Returns the end of the message that there is nothing of this name.
  std::string suggestion_for(const std::string& name) const {
    std::vector<std::string> names;
    for (const Subsystem& s : brought_) names.push_back(s.name);
    return names.empty() ? std::string() : suggestion(name, names, "the model brings");
  }

  /// Returns the subsystems of one robot, completed.
  std::vector<Subsystem> completed(std::vector<Subsystem> own) const {
    for (const Subsystem& s : brought_)
      if (s.use.empty())
        add_to_motions(s, own);
      else
        add(s, own);
    std::erase_if(own, [](const Subsystem& s) { return s.switched_off || s.use.empty(); });
    remove_errors_without_sensor(own);
    return own;
  }

 private:
  void read(const RobotTree::Subsystem& given, const Location& at, const std::string& owner, Problems& problems) {
    const Node node = parse_yaml(given.text, at);
    if (node.kind != Node::Kind::map) return problems.add(at, fmt::format("{} brings no map: {}", owner, given.text));
    for (const auto& [name, value] : node.map)
      if (check_name(name, at, "a subsystem", problems)) {
        brought_.push_back(read_subsystem(name, value, owner, problems));
        brought_.back().is_optional = brought_.back().from_model = true;
      }
  }

  /// Adds the parameters that the motions have and the scenario does not give.
  void add_to_motions(const Subsystem& brought, std::vector<Subsystem>& own) const {
    for (Subsystem& s : own)
      if (s.use.starts_with("motion.") && algorithms_.is_installed(s.use)) add_parameters(brought, s);
  }

  void add_parameters(const Subsystem& brought, Subsystem& s) const {
    const Description* const d = algorithms_.describe(s);
    if (!d) return;
    for (const auto& [name, value] : brought.parameters)
      if (takes_parameter(*d, name)) s.parameters.emplace(name, value);
  }

  void add(const Subsystem& brought, std::vector<Subsystem>& own) const {
    const auto same = std::find_if(own.begin(), own.end(), [&](const Subsystem& s) { return s.name == brought.name; });
    if (same != own.end()) {
      if (!same->switched_off) complete(brought, *same);
    } else if (algorithms_.is_installed(brought.use) && !is_replaced(brought, own)) {
      own.push_back(brought);
    }
  }

  /// When the scenario changes only some keys, the model gives all others. An entry with `use` replaces the model's.
  void complete(const Subsystem& brought, Subsystem& s) const {
    if (!s.use.empty() || !algorithms_.is_installed(brought.use)) return;
    s.use = brought.use;
    s.from_model = true;
    if (!s.rate && !s.on_demand) s.rate = brought.rate, s.on_demand = brought.on_demand;
    if (s.on.empty()) s.on = brought.on, s.on_location = brought.on_location;
    add_parameters(brought, s);
  }

  static bool drives_wheels(const Subsystem& s) {
    return family_of(s) == "drive" && s.use != "drive.gravity_compensation";
  }

  /// Whether two errors change the same reading; an error without `of` may change any reading.
  static bool changes_same(const Subsystem& a, const Subsystem& b) {
    const auto of_a = a.parameters.find("of"), of_b = b.parameters.find("of");
    return of_a == a.parameters.end() || of_b == b.parameters.end() || of_a->second == of_b->second;
  }

  /// A robot has one drive, and a reading has one error: those of the scenario replace those of the model.
  static bool is_replaced(const Subsystem& brought, const std::vector<Subsystem>& own) {
    return std::any_of(own.begin(), own.end(), [&](const Subsystem& s) {
      if (s.from_model) return false;
      return (drives_wheels(brought) && drives_wheels(s)) ||
             (brought.use == "sensor.error" && s.use == brought.use && s.on == brought.on && changes_same(brought, s));
    });
  }

  /// Removes errors of the model whose sensor was switched off, or replaced.
  static void remove_errors_without_sensor(std::vector<Subsystem>& own) {
    std::vector<std::string> brought;
    for (const Subsystem& s : own)
      if (s.from_model) brought.push_back(s.name);
    std::erase_if(own, [&](const Subsystem& s) {
      return s.from_model && s.use == "sensor.error" &&
             std::find(brought.begin(), brought.end(), s.on) == brought.end();
    });
  }

  Algorithms& algorithms_;
  std::vector<Subsystem> brought_;
};

}  // namespace

void add_model_subsystems(RobotTemplate& t, const RobotTree& tree, const std::string& file, Algorithms& algorithms,
                          Problems& problems) {
  const ModelSubsystems model(t, tree, file, algorithms, problems);
  for (const UnknownSubsystem& u : t.unknown)
    if (!model.has(u.name)) problems.add(u.location, u.problem + model.suggestion_for(u.name));
  SubsystemsOfRobots completed;
  for (const std::vector<Subsystem>& list : t.subsystems.lists()) completed.add_list(model.completed(list));
  for (std::size_t i = 0; i < t.subsystems.size(); ++i) completed.add(t.subsystems.list_of(i));
  t.subsystems = std::move(completed);
}

}  // namespace muro::host
