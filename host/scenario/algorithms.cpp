// SPDX-License-Identifier: MIT
#include "host/scenario/algorithms.hpp"

#include <algorithm>
#include <filesystem>

#include "host/scenario/defaults.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

void Algorithms::complete() {
  for (const Subsystem& s : scenario_.algorithms) add_to_scene(s);
  add_kinematics();
  add_defaults();
  for (const auto& sequence : scenario_.sequences) add_sequence(sequence);
}

void Algorithms::add_to_scene(const Subsystem& s) {
  const Description* d = describe(s);
  if (!d) return;
  switch (d->kind) {
    case Kind::motion:
    case Kind::drive:
    case Kind::sensor:
    case Kind::sensor_error:
      problems_.add(s.location, "`" + s.use + "` serves a robot; name it in a robot, not under `algorithms`");
      break;
    case Kind::kinematics: {
      std::vector<Item> items;
      for (const RobotView* r : simulation_.world().robots())
        if (r->links.size() > 1 && has_kinematics_.count(r->number) == 0) items.push_back({r, r->base()});
      if (!items.empty()) add(s, s.name, std::move(items));
      break;
    }
    default:
      add(s, s.name, {});
  }
}

const Description* Algorithms::describe(const Subsystem& s) {
  const Description* d = nullptr;
  problems_.collect(s.location.text() + ": ", [&] { d = registry_.algorithm(s.use).description; });
  return d;
}

bool Algorithms::is_kind(const Subsystem& s, Kind kind) {
  const Description* d = describe(s);
  return d && d->kind == kind;
}

void Algorithms::add(const Subsystem& s, const std::string& name, std::vector<Item> items, const std::string& alias) {
  const Description* d = describe(s);
  for (const Name& other : s.alternatives)
    problems_.collect(other.location.text() + ": parameters of `" + s.name + "`: ",
                      [&] { registry_.find(other.text); });
  if (!d) return;
  AlgorithmSetup setup;
  setup.name = name;
  setup.use = s.use;
  setup.subsystem = s.name;
  setup.parameters = s.parameters;
  setup.items = std::move(items);
  setup.place = s.location.text();
  const std::filesystem::path file(s.location.in_file() ? s.location.file : scenario_.file);
  setup.folder = std::filesystem::absolute(file).parent_path().string();
  setup.phase = std::llround(s.phase.value_or(0) * 1e9);
  const KindInfo& kind = info_of(d->kind);
  const double rate = s.rate.value_or(kind.default_rate);
  if (s.on_demand && !kind.may_run_on_demand)
    problems_.add(s.location, "`" + s.name + "` cannot run on demand, since nobody asks a " + std::string(kind.name) +
                                  " for what it does; give it a `rate` in Hz");
  else if (!s.on_demand && rate < 0)
    problems_.add(s.location, "`" + s.name + "` needs a `rate` in Hz: how often `" + s.use + "` runs");
  else if (!s.on_demand)
    setup.rate = Rate(rate);
  used_.insert(s.use);
  note_needs(*d, s);
  if (d->kind == Kind::kinematics)
    for (const Item& item : setup.items)
      if (item.robot) has_kinematics_.insert(item.robot->number);
  const Rate scheduled = setup.rate;
  const std::int64_t phase = setup.phase;
  const Added added{simulation_.add(std::move(setup)), scheduled, phase};
  added_[name].push_back(added);
  if (!alias.empty() && alias != name) added_[alias].push_back(added);
}

bool Algorithms::is_off(const char* name) const {
  const auto& off = scenario_.switched_off;
  return std::find(off.begin(), off.end(), name) != off.end();
}

void Algorithms::add_unnamed(const std::string& name, const std::string& use, const std::string& reason,
                             std::vector<Item> items) {
  Subsystem s;
  s.name = name;
  s.use = use;
  s.location = {scenario_.file, 0, 0};
  const std::string why = scenario_.file + ": " + reason + ", by default `" + use +
                          "` (another goes under `algorithms: {" + name + ": {use: NAME}}`): ";
  if (problems_.collect(why, [&] { registry_.algorithm(use); })) add(s, name, std::move(items));
}

void Algorithms::add_kinematics() {
  if (is_off("kinematics")) return;
  for (const RobotView* r : simulation_.world().robots())
    if (r->links.size() > 1 && has_kinematics_.count(r->number) == 0)
      add_unnamed("kinematics", "kinematics.direct", "robots of several bodies need kinematics", {Item{r, r->base()}});
}

/// What the algorithm reads with these parameters. A world asks for forces from outside only when there are bodies that
/// forces move outside of it.
void Algorithms::note_needs(const Description& d, const Subsystem& s) {
  const bool world = (d.capabilities & Capability::world) != 0;
  if (world) {
    const auto named = s.parameters.find("world");
    const auto* name = named == s.parameters.end() ? nullptr : std::get_if<std::string>(&named->second);
    worlds_.insert(s.use + "/" + (name ? *name : ""));
  }
  for (const PropertyUse& use : d.reads) {
    if (world && use.key == keys::external_wrench.name) continue;
    const std::size_t equals = use.when.find('=');
    if (equals != std::string_view::npos) {
      const auto given = s.parameters.find(std::string(use.when.substr(0, equals)));
      const auto* text = given == s.parameters.end() ? nullptr : std::get_if<std::string>(&given->second);
      if (!text || *text != use.when.substr(equals + 1)) continue;
    }
    needs_.emplace(use.key, s.use);
  }
}

void Algorithms::add_defaults() {
  if (worlds_.size() > 1)
    needs_.emplace(keys::external_wrench.name, worlds_.begin()->substr(0, worlds_.begin()->find('/')));
  const auto is_written = [&](const char* property) {
    return std::any_of(used_.begin(), used_.end(), [&](const std::string& id) {
      const auto& names = registry_.find(id).writes;
      return std::find(names.begin(), names.end(), property) != names.end();
    });
  };
  for (const Default& d : defaults) {
    const auto need = needs_.find(d.property);
    if (is_off(d.name) || need == needs_.end() || is_written(d.property)) continue;
    add_unnamed(d.name, d.use, "`" + need->second + "` reads `" + d.property + "`, so something must write it", {});
  }
}

void Algorithms::add_sequence(const std::vector<Name>& sequence) {
  std::vector<std::size_t> numbers;
  const Added* first = nullptr;  // of those that have a rate
  for (const Name& name : sequence) {
    const auto known = added_.find(name.text);
    if (known == added_.end()) {
      std::vector<std::string> names;
      for (const auto& [n, unused] : added_) names.push_back(n);
      problems_.add(name.location, "no algorithm is named `" + name.text + "`" + did_you_mean(name.text, names));
      return;
    }
    for (const Added& a : known->second) {
      numbers.push_back(a.number);
      if (a.rate.on_demand()) continue;
      if (!first) first = &a;
      if (a.rate == first->rate && a.phase == first->phase) continue;
      problems_.add(
          name.location,
          "`" + name.text + "` has another rate or phase than what stands before it; a sequence runs at one rate");
      return;
    }
  }
  if (!numbers.empty() && !first)
    return problems_.add(sequence.front().location,
                         "all algorithms of the sequence run on demand; one of them needs a rate");
  if (numbers.size() > 1) simulation_.add_sequence(std::move(numbers));
}

}  // namespace muro::host
