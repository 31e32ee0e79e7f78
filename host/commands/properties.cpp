// SPDX-License-Identifier: MIT
// The standard properties: types, units, and the plugins that read and write them.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/registry.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/standard_properties.hpp"
#include "host/names.hpp"
#include "host/outputs/json_text.hpp"

namespace muro::host {

namespace {

using Json = nlohmann::ordered_json;
using Names = std::vector<std::string>;

/// Returns the algorithms whose description lists the property among `uses`.
Names users_of(const Registry& registry, std::string_view property, Names CatalogEntry::*uses) {
  Names ids;
  for (const CatalogEntry& e : registry.catalog())
    if (std::find((e.*uses).begin(), (e.*uses).end(), property) != (e.*uses).end()) ids.push_back(e.id);
  return ids;
}

Json describe_key(const Registry& registry, const KeyInfo& key) {
  return {{"property", key.name},
          {"type", key.type->name},
          {"unit", key.unit},
          {"is_command", key.role == Role::command},
          {"doc", key.doc},
          {"written_by", users_of(registry, key.name, &CatalogEntry::writes)},
          {"read_by", users_of(registry, key.name, &CatalogEntry::reads)}};
}

Json describe_groups(const Registry& registry) {
  Json all = Json::array();
  for (const PropertyGroup& group : standard_properties()) {
    Json properties = Json::array();
    for (const KeyInfo* key : group.keys) properties.push_back(describe_key(registry, *key));
    all.push_back({{"title", group.title}, {"object", group.object}, {"properties", properties}});
  }
  return all;
}

std::string code_list(const Json& ids) {
  Names all;
  for (const auto& id : ids) all.push_back(fmt::format("`{}`", id.get<std::string>()));
  return comma_separated(all);
}

void print_markdown(const Json& groups) {
  fmt::print(
      "# Properties\n\n"
      "For everyone who records, commands or computes with properties: the standard ones, with type, unit\n"
      "and frame, and the plugins that write and read them. `muro properties --markdown` writes this page\n"
      "from [vocabulary](../../sdk/muro/vocabulary) and from the descriptions of the plugins.\n\n"
      "Units are SI; 1 stands for a number without unit. Frames follow REP-103: x forward, y left, z up.\n"
      "`muro describe SCENARIO` shows the properties of one scenario, including those that plugins declare\n"
      "for themselves.\n");
  for (const Json& group : groups) {
    fmt::print("\n## {}\n\n{}\n\n", group["title"].get<std::string>(), group["object"].get<std::string>());
    fmt::print("| property | type | unit | what it is | written by | read by |\n|---|---|---|---|---|---|\n");
    for (const Json& p : group["properties"])
      fmt::print("| `{}` | {} | {} | {} | {} | {} |\n", p["property"].get<std::string>(), p["type"].get<std::string>(),
                 p["unit"].get<std::string>(), p["doc"].get<std::string>(), code_list(p["written_by"]),
                 code_list(p["read_by"]));
  }
}

void print_plain(const Json& groups) {
  for (const Json& group : groups) {
    fmt::print("{}\n", group["title"].get<std::string>());
    for (const Json& p : group["properties"])
      fmt::print("  {:<28} {:<12} {:<18} {}\n", p["property"].get<std::string>(), p["type"].get<std::string>(),
                 p["unit"].get<std::string>(), p["doc"].get<std::string>());
  }
}

}  // namespace

int list_properties(const std::vector<std::string>& plugin_path, Format format) {
  const Registry registry(Registry::search_path(plugin_path));
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  const Json groups = describe_groups(registry);
  if (format == Format::json)
    fmt::print("{}\n", json_text(groups));
  else if (format == Format::markdown)
    print_markdown(groups);
  else
    print_plain(groups);
  return 0;
}

}  // namespace muro::host
