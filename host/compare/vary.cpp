// SPDX-License-Identifier: MIT
#include "host/compare/vary.hpp"

#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "host/scenario/defaults.hpp"
#include "host/scenario/section.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro::host {

namespace {

std::string family_of(const std::string& id) { return id.substr(0, id.rfind('.')); }

/// Reads `--vary text`; each step throws with the text before it.
class Reader {
 public:
  Reader(const std::string& text, const Scenario& scenario, const Registry& registry)
      : text_(text), scenario_(scenario), registry_(registry) {}

  Variety read() {
    const std::size_t equals = text_.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text_.size())
      fail("write PLACE=NAME,NAME,..., such as rovers.motion=point,simplified");
    find_place(text_.substr(0, equals));
    std::string names = text_.substr(equals + 1);
    for (std::size_t comma = 0; comma != std::string::npos; names.erase(0, comma + 1)) {
      comma = names.find(',');
      add_choice(names.substr(0, comma));
      if (comma == std::string::npos) break;
    }
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& why) const { throw SetupError("--vary " + text_ + ": " + why); }

  void find_place(std::string place) {
    for (const std::string prefix : {"robots.", "algorithms."})
      if (place.rfind(prefix, 0) == 0) place.erase(0, prefix.size());
    out_.name = place;
    const std::size_t dot = place.find('.');
    if (dot == std::string::npos) return find_algorithm(place);
    out_.robots = place.substr(0, dot);
    out_.subsystem = place.substr(dot + 1);
    out_.path = "robots." + place;
    find_subsystem();
  }

  /// Of the whole scene: one that the scenario names, or one that is added by itself.
  void find_algorithm(const std::string& name) {
    out_.subsystem = name;
    out_.path = "algorithms." + name;
    std::vector<std::string> names;
    for (const Subsystem& s : scenario_.algorithms) {
      if (s.name == name) return take(s.use);
      names.push_back(s.name);
    }
    for (const Default& d : defaults) {
      if (d.name == name) return take(d.use);
      names.emplace_back(d.name);
    }
    std::string places;
    for (const RobotTemplate& t : scenario_.robots)
      for (const std::string& s : subsystems_of(t)) names.push_back(t.name + "." + s);
    fail("the scenario has no `" + name + "`" + did_you_mean(name, names) + "; there are: " + listed(names));
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
      fail("the scenario has no robots `" + out_.robots + "`" + did_you_mean(out_.robots, names) +
           (names.empty() ? "" : "; there are: " + listed(names)));
    }
    out_.last = int(robots->subsystems.size()) - 1;
    if (!range.empty()) read_range(range);
    for (int i = out_.first; i <= out_.last; ++i)
      for (const Subsystem& s : robots->subsystems[std::size_t(i)])
        if (s.name == out_.subsystem) {
          if (s.level) step_into_levels();
          return take(s.use);
        }
    const std::vector<std::string> names = subsystems_of(*robots);
    fail("robots `" + out_.robots + "` have no `" + out_.subsystem + "`" + did_you_mean(out_.subsystem, names) +
         (names.empty() ? "" : "; they have: " + listed(names)));
  }

  /// `motion.near` is `near` among the levels of `motion`.
  void step_into_levels() {
    const std::size_t dot = out_.path.rfind('.');
    out_.path.replace(dot, 1, ".levels.");
  }

  /// "[3]" or "[0-4]".
  void read_range(const std::string& range) {
    const char* const end = range.data() + range.size();
    const int most = out_.last;
    auto r = std::from_chars(range.data() + 1, end, out_.first);
    out_.last = out_.first;
    if (r.ec == std::errc{} && r.ptr != end && *r.ptr == '-') r = std::from_chars(r.ptr + 1, end, out_.last);
    if (r.ec != std::errc{} || r.ptr + 1 != end || *r.ptr != ']' || out_.first < 0 || out_.last < out_.first ||
        out_.last > most)
      fail("`" + range + "` must be a robot or a range of them within [0-" + std::to_string(most) + "]");
  }

  static std::vector<std::string> subsystems_of(const RobotTemplate& t) {
    std::vector<std::string> names;
    for (const auto& robot : t.subsystems)
      for (const Subsystem& s : robot)
        if (std::find(names.begin(), names.end(), s.name) == names.end()) names.push_back(s.name);
    return names;
  }

  void take(const std::string& use) {
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
          fail("`" + choice.use + "` is of kind " + kind + ", but `" + out_.name + "` is a " + out_.kind);
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
  Variety out_;
};

}  // namespace

Variety read_vary(const std::string& text, const Scenario& scenario, const Registry& registry) {
  return Reader(text, scenario, registry).read();
}

std::vector<Variation> product(const std::vector<Variety>& varieties) {
  std::vector<Variation> all(1);
  for (const Variety& v : varieties) {
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
