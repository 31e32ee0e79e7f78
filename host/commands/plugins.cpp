// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/registry.hpp"
#include "host/commands/commands.hpp"

namespace muro::host {

namespace {

using Json = nlohmann::ordered_json;

std::string number(const Json& n) { return fmt::format("{}", n.get<double>()); }

std::string default_of(const Json& p) {
  if (p["required"].get<bool>()) return "required";
  const Json& d = p["default"];
  if (d.is_string()) return "default \"" + d.get<std::string>() + "\"";
  return "default " + (d.is_number() ? number(d) : d.dump());
}

std::string range_of(const Json& p) {
  if (p.contains("choices")) return ", one of " + p["choices"].dump();
  const bool low = p.contains("min"), high = p.contains("max");
  if (low && high) return fmt::format(", from {} to {}", number(p["min"]), number(p["max"]));
  if (low) return ", at least " + number(p["min"]);
  return high ? ", at most " + number(p["max"]) : "";
}

void print_info(const CatalogEntry& found, const Json& plugin, const Json& entry) {
  fmt::print("{}  ({}, version {})\n{}\n\n", found.id, found.kind, found.version, found.summary);
  fmt::print("plugin        {} {}, licence {}\nlibrary       {}\nbuilt by      {}\n", plugin["name"].get<std::string>(),
             plugin["version"].get<std::string>(), plugin["licence"].get<std::string>(), found.library,
             plugin["compiler"].get<std::string>());
  if (entry.contains("extensions")) fmt::print("reads files of type {}\n", entry["extensions"].dump());
  if (entry.contains("capabilities")) fmt::print("capabilities  {}\n", entry["capabilities"].dump());
  if (found.features) fmt::print("features      {}\n", entry["features"].dump());
  if (entry.contains("parameters") && !entry["parameters"].empty()) {
    fmt::print("\nparameters\n");
    for (const Json& p : entry["parameters"]) {
      const std::string unit = p["unit"] == "1" ? "" : ", " + p["unit"].get<std::string>();
      fmt::print("  {:<24} {}{}, {}{}\n  {:<24} {}\n", p["name"].get<std::string>(), p["type"].get<std::string>(), unit,
                 default_of(p), range_of(p), "", p["doc"].get<std::string>());
    }
  }
  for (const char* list : {"reads", "writes"})
    if (entry.contains(list) && !entry[list].empty()) {
      fmt::print("\n{}\n", list);
      for (const Json& u : entry[list])
        fmt::print("  {:<24} {}\n", u["key"].get<std::string>(), u["doc"].get<std::string>());
    }
}

void print_catalog_json(const Registry& registry) {
  Json all = Json::array();
  for (const CatalogEntry& e : registry.catalog())
    all.push_back(
        {{"id", e.id}, {"kind", e.kind}, {"version", e.version}, {"summary", e.summary}, {"library", e.library}});
  fmt::print("{}\n", all.dump(2));
}

void print_catalog_markdown(const Registry& registry) {
  fmt::print(
      "# Plugins\n\n"
      "For everyone who writes a scenario: the algorithms and model readers that come with muro, by name.\n"
      "`muro plugins list --markdown` writes this page; `muro plugins info NAME` shows the parameters of\n"
      "one of them, and the properties that it reads and writes.\n\n"
      "| name | kind | what it does |\n|---|---|---|\n");
  for (const CatalogEntry& e : registry.catalog()) fmt::print("| `{}` | {} | {} |\n", e.id, e.kind, e.summary);
}

void print_catalog(const Registry& registry) {
  for (const CatalogEntry& e : registry.catalog())
    fmt::print("{:<28} {:<13} {:<8} {}\n", e.id, e.kind, e.version, e.summary);
  if (!registry.catalog().empty()) return;
  fmt::print(stderr, "no plugin was found in:\n");
  for (const std::string& f : registry.folders()) fmt::print(stderr, "  {}\n", f);
  fmt::print(stderr, "set MURO_PLUGIN_PATH or --plugin-path\n");
}

}  // namespace

int list_plugins(const std::vector<std::string>& plugin_path, Format format) {
  const Registry registry(Registry::search_path(plugin_path));
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  if (format == Format::json)
    print_catalog_json(registry);
  else if (format == Format::markdown)
    print_catalog_markdown(registry);
  else
    print_catalog(registry);
  return 0;
}

int plugin_info(const std::string& id, const std::vector<std::string>& plugin_path, bool json) {
  const Registry registry(Registry::search_path(plugin_path));
  const CatalogEntry& found = registry.find(id);
  std::ifstream file(found.description);
  const Json plugin = Json::parse(file);
  for (const char* list : {"algorithms", "readers"})
    for (const Json& entry : plugin[list]) {
      if (entry["id"] != id) continue;
      if (json)
        fmt::print("{}\n", entry.dump(2));
      else
        print_info(found, plugin, entry);
    }
  return 0;
}

}  // namespace muro::host
