// SPDX-License-Identifier: MIT
// A plugin's description as JSON text. Written at build time; the host reads it instead of loading the plugin.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "muro/base/random.hpp"
#include "muro/detail/abi.hpp"
#include "muro/detail/names.hpp"

namespace muro::abi {

namespace detail {

using Json = nlohmann::ordered_json;

inline Json json_of(const Parameter& p) {
  constexpr const char* types[] = {"real", "integer", "boolean", "text", "reals", "texts"};
  Json json{{"name", p.name},
            {"type", types[static_cast<int>(p.type)]},
            {"unit", p.unit},
            {"doc", p.doc},
            {"required", p.is_required},
            {"tunable", p.tunable}};
  switch (p.type) {
    case ParameterType::text:
      json["default"] = p.default_text;
      if (!p.choices.empty()) json["choices"] = std::vector(p.choices.begin(), p.choices.end());
      break;
    case ParameterType::reals:
      json["default"] = std::vector(p.default_reals.begin(), p.default_reals.end());
      if (p.length > 0) json["length"] = p.length;
      break;
    case ParameterType::texts:
      json["default"] = Json::array();
      break;
    case ParameterType::boolean:
      json["default"] = p.default_number != 0;
      break;
    case ParameterType::integer:
      json["default"] = std::llround(p.default_number);
      break;
    case ParameterType::real:
      json["default"] = p.default_number;
  }
  if (std::isfinite(p.min)) json["min"] = p.min;
  if (std::isfinite(p.max)) json["max"] = p.max;
  return json;
}

inline Json json_of(const PropertyUse& u) {
  Json json{{"key", u.key}, {"doc", u.doc}};
  if (!u.when.empty()) json["when"] = u.when;
  return json;
}

Json json_of(const AlgorithmEntry& entry);
Json json_of(const ReaderEntry& entry);

/// Returns [a, b, ...] of the json_of() of all elements.
template <class Elements>
Json list_of(const Elements& elements) {
  Json list = Json::array();
  for (const auto& e : elements) list.push_back(json_of(e));
  return list;
}

inline Json capabilities(std::uint32_t bits) {
  Json names = Json::array();
  for (std::uint32_t bit = 1; bit != 0; bit <<= 1)
    if ((bits & bit) != 0 && !name_of(Capability{bit}).empty()) names.push_back(name_of(Capability{bit}));
  return names;
}

inline Json features(Features bits) {
  Json names = Json::array();
  for (const FeatureInfo& f : feature_infos)
    if ((bits & f.bit) != 0) names.push_back(f.name);
  return names;
}

inline Json json_of(const AlgorithmEntry& entry) {
  const Description& d = *entry.description;
  return {{"id", d.id},
          {"kind", name_of(d.kind)},
          {"version", d.version},
          {"summary", d.summary},
          {"capabilities", capabilities(d.capabilities)},
          {"features", features(d.features)},
          {"parameters", list_of(d.parameters)},
          {"reads", list_of(d.reads)},
          {"writes", list_of(d.writes)}};
}

inline Json json_of(const ReaderEntry& entry) {
  const ReaderDescription& d = *entry.description;
  return {{"id", d.id},
          {"kind", "reader"},
          {"version", d.version},
          {"summary", d.summary},
          {"extensions", std::vector(d.extensions.begin(), d.extensions.end())}};
}

inline Json json_of(const PluginTable& t) {
  return {{"name", t.name},
          {"version", t.version},
          {"licence", t.licence},
          {"summary", t.summary},
          {"compiler", std::string(t.stamp.compiler)},
          {"algorithms", list_of(t.algorithms)},
          {"readers", list_of(t.readers)}};
}

/// Bytes that are not UTF-8 are replaced, so no text of a plugin makes this fail.
inline std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace); }

}  // namespace detail

/// Returns the hash of the description's text, which ties a description file to the library it was made from.
inline std::string token(const PluginTable& table) {
  const std::uint64_t hash = fnv1a(detail::text_of(detail::json_of(table)));
  std::string out;
  for (int shift = 60; shift >= 0; shift -= 4) out += "0123456789abcdef"[(hash >> shift) & 15];
  return out;
}

inline std::string describe(const PluginTable& table) {
  detail::Json json{{"muro_plugin", 1}, {"token", token(table)}};
  json.update(detail::json_of(table));
  return detail::text_of(json);
}

}  // namespace muro::abi
