// SPDX-License-Identifier: MIT
#include "host/tools/compare/factor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "host/names.hpp"
#include "host/scenario/defaults.hpp"

namespace muro::host {

namespace {

std::string family_of(const std::string& id) { return id.substr(0, id.rfind('.')); }

/// Reads `--vary TEXT`; its errors begin with this option.
class FactorReader {
 public:
  FactorReader(const std::string& text, const Scenario& scenario, const Registry& registry)
      : text_(text), scenario_(scenario), registry_(registry) {}

  Factor read() {
    const std::size_t equals = text_.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text_.size())
      fail("write SUBSYSTEM=NAME,NAME,..., such as rovers.motion=point,simplified");
    find_target(text_.substr(0, equals));
    std::string names = text_.substr(equals + 1);
    for (std::size_t comma = 0; comma != std::string::npos; names.erase(0, comma + 1)) {
      comma = names.find(',');
      add_choice(names.substr(0, comma));
      if (comma == std::string::npos) break;
    }
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw SetupError(fmt::format("--vary {}: {}", text_, why)); }

  /// Finds the varied subsystem or algorithm.
  void find_target(std::string name) {
    for (const std::string prefix : {"robots.", "algorithms."})
      if (name.rfind(prefix, 0) == 0) name.erase(0, prefix.size());
    out_.name = name;
    const std::size_t dot = name.find('.');
    if (dot == std::string::npos) return find_algorithm(name);
    out_.robots = name.substr(0, dot);
    out_.subsystem = name.substr(dot + 1);
    out_.path = "robots." + name;
    find_subsystem();
  }

  /// Finds an algorithm of the whole scene: one in the scenario, or a default one.
  void find_algorithm(const std::string& name) {
    out_.subsystem = name;
    out_.path = "algorithms." + name;
    std::vector<std::string> names;
    for (const Subsystem& s : scenario_.algorithms) {
      if (s.name == name) return set_kind_of(s.use);
      names.push_back(s.name);
    }
    for (const DefaultAlgorithm& d : default_algorithms) {
      if (d.name == name) return set_kind_of(d.use);
      names.emplace_back(d.name);
    }
    for (const RobotTemplate& t : scenario_.robots)
      for (const std::string& s : subsystems_of(t)) names.push_back(t.name + "." + s);
    fail(fmt::format("the scenario has no `{}`{}", name, suggestion(name, names)));
  }

  void find_subsystem() {
    const std::size_t bracket = out_.robots.find('[');
    const std::string range = bracket == std::string::npos ? "" : out_.robots.substr(bracket);
    out_.robots.erase(std::min(bracket, out_.robots.size()));
    const auto robots = std::find_if(scenario_.robots.begin(), scenario_.robots.end(),
                                     [&](const RobotTemplate& t) { return t.name == out_.robots; });
    if (robots == scenario_.robots.end()) {
      std::vector<std::string> names;
      for (const RobotTemplate& t : scenario_.robots) names.push_back(t.name);
      fail(fmt::format("the scenario has no robots `{}`{}", out_.robots, suggestion(out_.robots, names)));
    }
    out_.last = int(robots->subsystems.size()) - 1;
    if (!range.empty()) read_range(range);
    for (int i = out_.first; i <= out_.last; ++i)
      for (const Subsystem& s : robots->subsystems[std::size_t(i)])
        if (s.name == out_.subsystem) {
          if (s.level) insert_levels_into_path();
          return set_kind_of(s.use);
        }
    const std::vector<std::string> names = subsystems_of(*robots);
    fail(fmt::format("robots `{}` have no `{}`{}", out_.robots, out_.subsystem,
                     suggestion(out_.subsystem, names, "they have")));
  }

  /// Makes `motion.near` the level `near` of `motion`.
  void insert_levels_into_path() {
    const std::size_t dot = out_.path.rfind('.');
    out_.path.replace(dot, 1, ".levels.");
  }

  /// Reads "[3]" or "[0-4]".
  void read_range(const std::string& range) {
    const char* const end = range.data() + range.size();
    const int max = out_.last;
    auto r = std::from_chars(range.data() + 1, end, out_.first);
    out_.last = out_.first;
    if (r.ec == std::errc{} && r.ptr != end && *r.ptr == '-') r = std::from_chars(r.ptr + 1, end, out_.last);
    if (r.ec != std::errc{} || r.ptr + 1 != end || *r.ptr != ']' || out_.first < 0 || out_.last < out_.first ||
        out_.last > max)
      fail(fmt::format("`{}` must be a robot or a range of them within [0-{}]", range, max));
  }

  static std::vector<std::string> subsystems_of(const RobotTemplate& t) {
    std::vector<std::string> names;
    for (const auto& list : t.subsystems.lists())
      for (const Subsystem& s : list)
        if (std::find(names.begin(), names.end(), s.name) == names.end()) names.push_back(s.name);
    return names;
  }

  void set_kind_of(const std::string& use) {
    family_ = family_of(use);
    out_.kind = registry_.find(use).kind;
  }

  void add_choice(const std::string& name) {
    if (name.empty()) fail("a name is missing between commas");
    Choice choice{name, name};
    if (name != "off") {
      if (name.find('.') == std::string::npos) choice.use = family_ + "." + name;
      try {
        const std::string& kind = registry_.find(choice.use).kind;
        if (kind != out_.kind)
          fail(fmt::format("`{}` is of kind {}, but `{}` is a {}", choice.use, kind, out_.name, out_.kind));
      } catch (const SetupError& e) {
        if (std::string(e.what()).rfind("--vary ", 0) == 0) throw;
        fail(e.what());
      }
      choice.label = family_of(choice.use) == family_ ? choice.use.substr(family_.size() + 1) : choice.use;
    }
    for (const Choice& c : out_.choices)
      if (c.use == choice.use) fail("`" + choice.label + "` is named twice");
    out_.choices.push_back(std::move(choice));
  }

  const std::string& text_;
  const Scenario& scenario_;
  const Registry& registry_;
  std::string family_;
  Factor out_;
};

}  // namespace

Factor read_factor(const std::string& text, const Scenario& scenario, const Registry& registry) {
  return FactorReader(text, scenario, registry).read();
}

std::vector<Variation> all_variations(const std::vector<Factor>& factors) {
  std::vector<Variation> all(1);
  for (const Factor& v : factors) {
    std::vector<Variation> more;
    for (const Variation& before : all)
      for (const Choice& c : v.choices) {
        Variation next = before;
        next.label += (next.label.empty() ? "" : " + ") + c.label;
        next.choices.push_back(&c);
        next.overrides.push_back(c.use == "off" ? v.path + "=off" : v.path + ".use=" + c.use);
        more.push_back(std::move(next));
      }
    all = std::move(more);
  }
  return all;
}

}  // namespace muro::host
