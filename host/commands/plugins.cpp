// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/registry.hpp"
#include "host/commands/commands.hpp"

namespace muro::host {

namespace {

using Json = nlohmann::ordered_json;

std::string number(const Json& n) { return fmt::format("{}", n.get<double>()); }

std::string default_of(const Json& p) {
  if (p.at("required").get<bool>()) return "required";
  const Json& d = p.at("default");
  if (d.is_string()) return "default \"" + d.get<std::string>() + "\"";
  return "default " + (d.is_number() ? number(d) : d.dump());
}

std::string range_of(const Json& p) {
  if (p.contains("choices")) return ", one of " + p.at("choices").dump();
  const bool low = p.contains("min"), high = p.contains("max");
  if (low && high) return fmt::format(", from {} to {}", number(p.at("min")), number(p.at("max")));
  if (low) return ", at least " + number(p.at("min"));
  return high ? ", at most " + number(p.at("max")) : "";
}

void print_info(const CatalogEntry& found, const Json& plugin, const Json& entry) {
  fmt::print("{}  ({}, version {})\n{}\n\n", found.id, found.kind, found.version, found.summary);
  fmt::print("plugin        {} {}, licence {}\nlibrary       {}\nbuilt by      {}\n",
             plugin.at("name").get<std::string>(), plugin.at("version").get<std::string>(),
             plugin.at("licence").get<std::string>(), found.library, plugin.at("compiler").get<std::string>());
  if (entry.contains("extensions")) fmt::print("reads files of type {}\n", entry.at("extensions").dump());
  if (entry.contains("capabilities")) fmt::print("capabilities  {}\n", entry.at("capabilities").dump());
  if (found.features) fmt::print("features      {}\n", entry.at("features").dump());
  if (entry.contains("parameters") && !entry.at("parameters").empty()) {
    fmt::print("\nparameters\n");
    for (const Json& p : entry.at("parameters")) {
      const std::string unit = p.at("unit") == "1" ? "" : ", " + p.at("unit").get<std::string>();
      fmt::print("  {:<24} {}{}, {}{}\n  {:<24} {}\n", p.at("name").get<std::string>(), p.at("type").get<std::string>(),
                 unit, default_of(p), range_of(p), "", p.at("doc").get<std::string>());
    }
  }
  for (const char* list : {"reads", "writes"})
    if (entry.contains(list) && !entry.at(list).empty()) {
      fmt::print("\n{}\n", list);
      for (const Json& u : entry.at(list))
        fmt::print("  {:<24} {}\n", u.at("key").get<std::string>(), u.at("doc").get<std::string>());
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
  fmt::print("\nsearched\n");
  for (const PluginFolder& f : registry.folders()) fmt::print("  {}: {}\n", f.path, f.outcome());
  if (registry.catalog().empty()) fmt::print(stderr, "no plugin was found; set MURO_PLUGIN_PATH or --plugin-path\n");
}

}  // namespace

int list_plugins(const std::vector<std::string>& plugin_path, Format format) {
  const Registry registry(Registry::search_path(plugin_path));
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  for (const auto& [id, message] : registry.rivals()) fmt::print(stderr, "warning: {}\n", message);
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
  try {
    std::ifstream file(found.description);
    const Json plugin = Json::parse(file);
    for (const char* list : {"algorithms", "readers"})
      for (const Json& entry : plugin.at(list)) {
        if (entry.at("id") != id) continue;
        if (json)
          fmt::print("{}\n", entry.dump(2, ' ', false, Json::error_handler_t::replace));
        else
          print_info(found, plugin, entry);
      }
  } catch (const Json::exception& e) {
    throw SetupError(
        fmt::format("the description {} is damaged: {}; build the plugin again", found.description, e.what()));
  }
  return 0;
}

}  // namespace muro::host
