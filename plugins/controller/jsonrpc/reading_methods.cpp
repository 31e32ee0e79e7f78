// SPDX-License-Identifier: MIT
// Methods that read the simulation.
#include <cstdio>
#include <set>

#include "method.hpp"
#include "plugins/common/text/quote.hpp"
#include "values.hpp"

namespace muro::jsonrpc {

namespace {

constexpr std::size_t most_names = 10'000;       ///< in one reply
constexpr std::size_t most_properties = 10'000;  ///< in one reply

std::string_view name_of(Multiplicity m) {
  constexpr std::string_view names[] = {"single", "array", "list"};
  return names[std::size_t(m)];
}

}  // namespace

void info(Call& c) {
  Reply calls = Reply::object();
  for (const Method& m : methods())
    calls.push_back({std::string(m.name), !m.is_granted || c.served.grants.may_call(m.name)});
  c.answer({{"server", "muro"},
            {"plugin", "controller.jsonrpc"},
            {"protocol", 1},
            {"period", c.served.period},
            {"methods", std::move(calls)},
            {"write", c.served.grants.patterns()}});
}

void tell_time(Call& c) {
  Reply result = time_reply(c.served.time);
  result["speed"] = c.served.run.speed();
  result["paused"] = c.served.run.is_paused();
  if (c.served.pauser) result["paused_by"] = c.served.pauser->client;
  c.answer(std::move(result));
}

void list(Call& c) {
  const std::string pattern = c.params.text("pattern", "*");
  std::size_t left_out = 0;
  Reply names = c.served.scene.matching(pattern, most_names, left_out);
  c.budget().spend_names(names.size());
  const bool names_objects = pattern.find(':') == std::string::npos;
  c.answer({{names_objects ? "objects" : "properties", std::move(names)}, {"left_out", left_out}});
}

void describe(Call& c) {
  const PropertyName name = c.served.scene.property(c.params.text("property"));
  const LiveProperty p = c.served.scene.live(name);
  Reply columns = Reply::array();
  for (const std::string_view label : p.key->type->labels) columns.push_back(std::string(label));
  Reply result{{"property", name.text},
               {"type", std::string(p.key->type->name)},
               {"unit", std::string(p.key->unit)},
               {"shape", std::string(name_of(p.multiplicity))},
               {"count", p.count},
               {"columns", std::move(columns)},
               {"kind", p.is_constant   ? "constant"
                        : p.is_variable ? "variable"
                                        : "derived"},
               {"has_values", has_values(p)},
               {"may_set", c.served.grants.may_set(name.text)}};
  if (!p.written_by.empty()) result["written_by"] = std::string(p.written_by);
  if (!p.key->doc.empty()) result["doc"] = std::string(p.key->doc);
  c.answer(std::move(result));
}

void get(Call& c) {
  const SceneNames& scene = c.served.scene;
  Reply values = Reply::object();
  std::set<std::string, std::less<>> told;
  const Encoding encoding = encoding_of(c.params);
  const std::vector<std::string> patterns = c.params.texts("properties", most_properties);
  for (const std::string& pattern : patterns) {
    const bool is_pattern = pattern.find_first_of("*?") != std::string::npos;
    for (const PropertyName& name : scene.properties(pattern, most_properties)) {
      const LiveProperty p = scene.live(name);
      if ((!has_values(p) && is_pattern) || !told.insert(name.text).second) continue;
      if (!has_values(p))
        throw RpcError{Code::refused, quote(name.text) + " is of type " + std::string(p.key->type->name) +
                                          ", which is not made of numbers"};
      c.budget().spend_names(1);
      c.budget().spend_numbers(c.params.has("element") ? p.key->type->scalars() : cost_of(p, encoding));
      if (c.params.has("element")) {
        const auto element = std::uint32_t(c.params.integer("element", 0, std::int64_t(p.count) - 1));
        values.push_back({name.text, value_of_element(p, element, scene.inspection())});
      } else {
        values.push_back({name.text, value_of(p, scene.inspection(), encoding)});
      }
    }
  }
  c.answer({{"time", c.served.time}, {"values", std::move(values)}});
}

void hash(Call& c) {
  if (!c.served.is_complete)
    throw RpcError{Code::refused, "the state has a hash only between two instants: call `pause` before"};
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(c.served.run.state_hash()));
  c.answer({{"time", c.served.time}, {"hash", digits}});
}

}  // namespace muro::jsonrpc
