// SPDX-License-Identifier: MIT
// A plugin's description as JSON text. Written at build time, read by the host in place of the plugin.
#pragma once

#include <cmath>
#include <sstream>
#include <string>

#include "muro/abi.hpp"
#include "muro/toolkit/random.hpp"

namespace muro::abi {

namespace detail {

inline std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      constexpr std::string_view hex = "0123456789abcdef";
      out += "\\u00";
      out += hex[static_cast<std::size_t>(c >> 4)];
      out += hex[static_cast<std::size_t>(c & 15)];
    } else {
      out += c;
    }
  }
  return out + '"';
}

inline std::string number(double x) {
  if (!std::isfinite(x)) return "null";
  std::ostringstream out;
  out.precision(17);
  out << x;
  return out.str();
}

/// [a, b, ...] of what `each` makes of the elements.
template <class Elements, class Each>
std::string list(const Elements& elements, Each each) {
  std::string out = "[";
  for (const auto& e : elements) {
    if (out.size() > 1) out += ", ";
    out += each(e);
  }
  return out + "]";
}

inline std::string parameter(const Parameter& p) {
  constexpr std::string_view types[] = {"real", "integer", "boolean", "text", "reals", "texts"};
  std::string out = "\n      {\"name\": " + quoted(p.name) + ", \"type\": " + quoted(types[static_cast<int>(p.type)]) +
                    ", \"unit\": " + quoted(p.unit) + ", \"doc\": " + quoted(p.doc) +
                    ", \"required\": " + (p.is_required ? "true" : "false") +
                    ", \"tunable\": " + (p.tunable ? "true" : "false");
  if (p.type == ParameterType::text) {
    out += ", \"default\": " + quoted(p.default_text);
    if (!p.choices.empty()) out += ", \"choices\": " + list(p.choices, quoted);
  } else if (p.type == ParameterType::reals) {
    out += ", \"default\": " + list(p.default_reals, number);
    if (p.length > 0) out += ", \"length\": " + number(p.length);
  } else if (p.type == ParameterType::texts) {
    out += ", \"default\": []";
  } else if (p.type == ParameterType::boolean) {
    out += std::string(", \"default\": ") + (p.default_number != 0 ? "true" : "false");
  } else {
    out += ", \"default\": " + number(p.default_number);
  }
  if (std::isfinite(p.min)) out += ", \"min\": " + number(p.min);
  if (std::isfinite(p.max)) out += ", \"max\": " + number(p.max);
  return out + "}";
}

inline std::string use(const PropertyUse& u) {
  return "{\"key\": " + quoted(u.key) + ", \"doc\": " + quoted(u.doc) +
         (u.when.empty() ? "" : ", \"when\": " + quoted(u.when)) + "}";
}

inline std::string capabilities(std::uint32_t bits) {
  constexpr std::string_view names[] = {"deterministic", "batched",   "allocation_free",
                                        "restorable",    "needs_gpu", "world"};
  std::string out = "[";
  for (int i = 0; i < 6; ++i)
    if ((bits & (1u << i)) != 0) out += (out.size() > 1 ? ", " : "") + quoted(names[i]);
  return out + "]";
}

inline std::string features(Features bits) {
  std::string out = "[";
  for (const FeatureInfo& f : feature_infos)
    if ((bits & f.bit) != 0) out += (out.size() > 1 ? ", " : "") + quoted(f.name);
  return out + "]";
}

inline std::string algorithm(const AlgorithmEntry& entry) {
  const Description& d = *entry.description;
  return "\n    {\"id\": " + quoted(d.id) + ", \"kind\": " + quoted(name_of(d.kind)) +
         ", \"version\": " + quoted(d.version) + ",\n     \"summary\": " + quoted(d.summary) +
         ",\n     \"capabilities\": " + capabilities(d.capabilities) + ",\n     \"features\": " + features(d.features) +
         ",\n     \"parameters\": " + list(d.parameters, parameter) + ",\n     \"reads\": " + list(d.reads, use) +
         ",\n     \"writes\": " + list(d.writes, use) + "}";
}

inline std::string reader(const ReaderEntry& entry) {
  const ReaderDescription& d = *entry.description;
  return "\n    {\"id\": " + quoted(d.id) + ", \"kind\": \"reader\", \"version\": " + quoted(d.version) +
         ", \"summary\": " + quoted(d.summary) + ", \"extensions\": " + list(d.extensions, quoted) + "}";
}

inline std::string body(const PluginTable& t) {
  return "  \"name\": " + quoted(t.name) + ",\n  \"version\": " + quoted(t.version) +
         ",\n  \"licence\": " + quoted(t.licence) + ",\n  \"summary\": " + quoted(t.summary) +
         ",\n  \"compiler\": " + quoted(t.stamp.compiler) + ",\n  \"algorithms\": " + list(t.algorithms, algorithm) +
         ",\n  \"readers\": " + list(t.readers, reader);
}

}  // namespace detail

/// Ties a description file to the library it was made from: the hash of the description's text.
inline std::string token(const PluginTable& table) {
  const std::uint64_t hash = fnv1a(detail::body(table));
  std::string out;
  for (int shift = 60; shift >= 0; shift -= 4) out += "0123456789abcdef"[(hash >> shift) & 15];
  return out;
}

inline std::string describe(const PluginTable& table) {
  return "{\n  \"muro_plugin\": 1,\n  \"token\": " + detail::quoted(token(table)) + ",\n" + detail::body(table) + "\n}";
}

}  // namespace muro::abi
