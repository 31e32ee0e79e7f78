// SPDX-License-Identifier: MIT
#include "host/scenario/algorithms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "host/scenario/defaults.hpp"
#include "muro/base/did_you_mean.hpp"
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
      problems_.add(s.location, fmt::format("`{}` serves a robot; name it in a robot, not under `algorithms`", s.use));
      break;
    case Kind::kinematics: {
      if (scene_kinematics_)
        problems_.add(s.location, fmt::format("{} ({}) is of kind kinematics, and so is {} ({}) at {}: their results "
                                              "would mix; remove one of them",
                                              s.name, s.use, scene_kinematics_->name, scene_kinematics_->use,
                                              scene_kinematics_->location.text()));
      scene_kinematics_ = &s;
      std::vector<Item> items;
      for (const RobotView* r : simulation_.world().robots())
        if (r->links.size() > 1 && has_kinematics_.count(index_of(r->id)) == 0) items.push_back({r, r->base()});
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

bool Algorithms::is_installed(const std::string& use) const {
  const std::vector<CatalogEntry>& all = registry_.catalog();
  return std::any_of(all.begin(), all.end(), [&](const CatalogEntry& entry) { return entry.id == use; });
}

bool Algorithms::is_kind(const Subsystem& s, Kind kind) {
  const Description* d = describe(s);
  return d && d->kind == kind;
}

void Algorithms::add(const Subsystem& s, const std::string& name, std::vector<Item> items,
                     const std::string& template_name) {
  const Description* d = describe(s);
  for (const Name& other : s.alternatives)
    problems_.collect(fmt::format("{}: parameters of `{}`: ", other.location.text(), s.name),
                      [&] { registry_.find(other.text); });
  if (!d) return;
  AlgorithmSetup setup;
  setup.name = name;
  setup.use = s.use;
  setup.subsystem = s.name;
  setup.is_optional = s.is_optional;
  setup.parameters = s.parameters;
  setup.parameter_places = s.parameter_places;
  setup.items = std::move(items);
  setup.place = s.location.text();
  const std::filesystem::path file(s.location.in_file() ? s.location.file : scenario_.file);
  std::error_code deleted;  // the working directory may not exist any more; then the scenario has an absolute path
  setup.folder = std::filesystem::absolute(file, deleted).parent_path().string();
  setup.phase = std::llround(s.phase.value_or(0) * 1e9);
  setup.rate = rate_of(s, info_of(d->kind));
  used_.insert(s.use);
  record_reads(*d, s);
  if (d->kind == Kind::kinematics)
    for (const Item& item : setup.items)
      if (item.robot) has_kinematics_.insert(index_of(item.robot->id));
  Added added{0, setup.rate, setup.phase};
  added.number = simulation_.add(std::move(setup));
  added_[name].push_back(added);
  if (!template_name.empty() && template_name != name) added_[template_name].push_back(added);
}

Rate Algorithms::rate_of(const Subsystem& s, const KindInfo& kind) {
  const double rate = s.rate.value_or(kind.default_rate);
  if (!s.on_demand && rate >= 0) return Rate(rate);
  if (s.on_demand && !kind.may_run_on_demand)
    problems_.add(s.location,
                  fmt::format("`{}` cannot run on demand, because no algorithm reads what a {} computes; give "
                              "it a `rate` in Hz",
                              s.name, kind.name));
  else if (!s.on_demand)
    problems_.add(s.location, fmt::format("`{}` needs a `rate` in Hz: how often `{}` runs", s.name, s.use));
  return {};
}

bool Algorithms::is_switched_off(const char* name) const {
  const auto& off = scenario_.switched_off;
  return std::find(off.begin(), off.end(), name) != off.end();
}

void Algorithms::add_default(const std::string& name, const std::string& use, const std::string& reason,
                             std::vector<Item> items) {
  Subsystem s;
  s.name = name;
  s.use = use;
  s.location = {scenario_.file, 0, 0};
  const std::string prefix =
      fmt::format("{}: {}, by default `{}` (name another by `algorithms: {{{}: {{use: NAME}}}}`): ", scenario_.file,
                  reason, use, name);
  if (problems_.collect(prefix, [&] { registry_.algorithm(use); })) add(s, name, std::move(items));
}

void Algorithms::add_kinematics() {
  if (is_switched_off("kinematics")) return;
  for (const RobotView* r : simulation_.world().robots())
    if (r->links.size() > 1 && has_kinematics_.count(index_of(r->id)) == 0)
      add_default("kinematics", "kinematics.direct", "robots of several bodies need kinematics", {Item{r, r->base()}});
}

/// Records what the algorithm reads with these parameters. A world reads external wrenches only when forces move bodies
/// that are not in it, so its own declaration does not count.
void Algorithms::record_reads(const Description& d, const Subsystem& s) {
  const bool world = d.kind == Kind::motion && (d.capabilities & Capability::world) != 0;
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
    readers_.emplace(use.key, s.use);
  }
}

void Algorithms::add_defaults() {
  if (worlds_.size() > 1)
    readers_.emplace(keys::external_wrench.name, worlds_.begin()->substr(0, worlds_.begin()->find('/')));
  const auto is_written = [&](const char* property) {
    return std::any_of(used_.begin(), used_.end(), [&](const std::string& id) {
      const CatalogEntry& entry = registry_.find(id);
      if (entry.kind == name_of(Kind::drive)) return false;  // it serves robots, not a scene
      return std::find(entry.writes.begin(), entry.writes.end(), property) != entry.writes.end();
    });
  };
  for (const DefaultAlgorithm& d : default_algorithms) {
    const auto reader = readers_.find(d.property);
    if (is_switched_off(d.name) || reader == readers_.end() || is_written(d.property)) continue;
    add_default(d.name, d.use, fmt::format("`{}` reads `{}`, so something must write it", reader->second, d.property),
                {});
  }
}

void Algorithms::add_sequence(const std::vector<Name>& sequence) {
  std::vector<std::size_t> numbers;
  const Added* first = nullptr;  // the first algorithm with a rate
  for (const Name& name : sequence) {
    const auto named = added_.find(name.text);
    if (named == added_.end()) {
      std::vector<std::string> names;
      for (const auto& [n, unused] : added_) names.push_back(n);
      problems_.add(name.location,
                    fmt::format("no algorithm is named `{}`{}", name.text, did_you_mean(name.text, names)));
      return;
    }
    for (const Added& a : named->second) {
      numbers.push_back(a.number);
      if (a.rate.on_demand()) continue;
      if (!first) first = &a;
      if (a.rate == first->rate && a.phase == first->phase) continue;
      problems_.add(name.location,
                    fmt::format("`{}` has another rate or phase than the algorithms before it; a sequence "
                                "runs at one rate",
                                name.text));
      return;
    }
  }
  if (!numbers.empty() && !first)
    return problems_.add(sequence.front().location,
                         "all algorithms of the sequence run on demand; one of them needs a rate");
  if (numbers.size() > 1) simulation_.add_sequence(std::move(numbers));
}

}  // namespace muro::host
