// SPDX-License-Identifier: MIT
// Requirements on every plugin of the build: on its library, and on its documentation.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstdio>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "describe/describe.hpp"
#include "muro/detail/stamp.hpp"

namespace muro {
namespace {

struct Built {
  const char* name;
  const char* library;
  const char* folder;  ///< folder of its sources

  friend void PrintTo(const Built& plugin, std::ostream* out) { *out << plugin.name; }
};
constexpr Built built[] = {
#include "plugins.inc"  // a line for each, from CMake
};

/// Returns the lines that a command prints.
std::vector<std::string> lines_of(const std::string& command) {
  std::vector<std::string> lines;
  FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) throw std::runtime_error("cannot run " + command);
  std::string all;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) all += char(c);
  if (pclose(pipe) != 0) throw std::runtime_error("failed: " + command);
  std::istringstream stream(all);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string content(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the table of a plugin, which stays loaded until the program ends.
const abi::PluginTable& table_of(const Built& plugin) {
  void* library = dlopen(plugin.library, RTLD_NOW | RTLD_LOCAL);
  if (!library) throw std::runtime_error(dlerror());
  return *static_cast<const abi::PluginTable*>(dlsym(library, abi::table_symbol));
}

/// First words of an id that fit each kind.
const std::map<Kind, std::set<std::string>> families{{Kind::motion, {"motion"}},
                                                     {Kind::kinematics, {"kinematics"}},
                                                     {Kind::scene, {"scene"}},
                                                     {Kind::sensor, {"sensor", "laser", "camera", "radio"}},
                                                     {Kind::sensor_error, {"sensor", "laser", "camera", "radio"}},
                                                     {Kind::controller, {"controller"}},
                                                     {Kind::recorder, {"recorder"}},
                                                     {Kind::drive, {"drive", "motor"}},
                                                     {Kind::collision, {"collision"}},
                                                     {Kind::contact, {"contact"}},
                                                     {Kind::view, {"view"}},
                                                     {Kind::level, {"level"}}};

class Plugin : public testing::TestWithParam<Built> {};

TEST_P(Plugin, ExportsExactlyOneSymbol) {
  const auto symbols = lines_of(std::string(MURO_NM) + " -D --defined-only -j " + GetParam().library);
  EXPECT_EQ(symbols, std::vector<std::string>{"muro_plugin"});
}

TEST_P(Plugin, NeedsNoSymbolOfMuro) {
  for (const std::string& symbol : lines_of(std::string(MURO_NM) + " -D --undefined-only -C " + GetParam().library))
    EXPECT_EQ(symbol.find("muro"), std::string::npos) << symbol;
}

TEST_P(Plugin, IsDescribedByTheFileBesideIt) {
  std::string description = GetParam().library;
  description.replace(description.rfind(".so"), 3, ".muro.json");
  EXPECT_EQ(content(description), abi::describe(table_of(GetParam())) + "\n");
}

TEST_P(Plugin, HasANameForEachOfItsCapabilities) {
  for (const abi::AlgorithmEntry& entry : table_of(GetParam()).algorithms) {
    const std::uint32_t bits = entry.description->capabilities;
    EXPECT_EQ(abi::detail::capabilities(bits).size(), std::size_t(std::popcount(bits))) << entry.description->id;
  }
}

TEST_P(Plugin, BearsTheStampOfThisBuild) {
  const abi::PluginTable& table = table_of(GetParam());
  constexpr abi::Stamp own = abi::make_stamp();
  EXPECT_EQ(std::memcmp(&table.stamp, &own, offsetof(abi::Stamp, compiler)), 0);
  EXPECT_EQ(table.table_size, sizeof(abi::PluginTable));
}

TEST_P(Plugin, SaysWhatItIs) {
  const abi::PluginTable& table = table_of(GetParam());
  const std::regex version("[0-9]+\\.[0-9]+\\.[0-9]+");
  EXPECT_EQ(table.name, GetParam().name);
  EXPECT_TRUE(std::regex_match(std::string(table.version), version)) << table.version;
  EXPECT_FALSE(table.licence.empty());
  EXPECT_FALSE(table.summary.empty());
  EXPECT_GT(table.algorithms.size() + table.readers.size(), 0u);
  for (const abi::AlgorithmEntry& entry : table.algorithms) {
    const Description& d = *entry.description;
    SCOPED_TRACE(d.id);
    EXPECT_TRUE(std::regex_match(std::string(d.id), std::regex("[a-z]+\\.[a-z0-9_]+")));
    EXPECT_TRUE(families.at(d.kind).contains(std::string(d.id.substr(0, d.id.find('.'))))) << name_of(d.kind);
    EXPECT_TRUE(std::regex_match(std::string(d.version), version)) << d.version;
    EXPECT_FALSE(d.summary.empty());
    for (const auto& uses : {d.reads, d.writes})
      for (const PropertyUse& use : uses) EXPECT_FALSE(use.key.empty() || use.doc.empty()) << use.key;
  }
  for (const abi::ReaderEntry& entry : table.readers) {
    const ReaderDescription& d = *entry.description;
    SCOPED_TRACE(d.id);
    EXPECT_TRUE(std::regex_match(std::string(d.id), std::regex("reader\\.[a-z0-9_]+")));
    EXPECT_TRUE(std::regex_match(std::string(d.version), version)) << d.version;
    EXPECT_FALSE(d.summary.empty());
    EXPECT_FALSE(d.extensions.empty());
    for (const std::string_view e : d.extensions)
      EXPECT_TRUE(std::regex_match(std::string(e), std::regex("\\.[a-z0-9.]+"))) << e;
  }
}

TEST_P(Plugin, ExplainsEveryParameterAndKeepsItsDefaultsWithinTheRange) {
  for (const abi::AlgorithmEntry& entry : table_of(GetParam()).algorithms)
    for (const Parameter& p : entry.description->parameters) {
      SCOPED_TRACE(std::string(entry.description->id) + " " + std::string(p.name));
      EXPECT_TRUE(std::regex_match(std::string(p.name), std::regex("[a-z][a-z0-9_]*")));
      EXPECT_FALSE(p.doc.empty());
      EXPECT_FALSE(p.unit.empty());
      if (p.is_required) continue;
      if (p.type == ParameterType::real || p.type == ParameterType::integer) {
        EXPECT_GE(p.default_number, p.min);
        EXPECT_LE(p.default_number, p.max);
      }
      if (p.type == ParameterType::reals && p.length > 0) {
        EXPECT_EQ(p.default_reals.size(), p.length);
      }
      for (const double x : p.default_reals) EXPECT_TRUE(p.min <= x && x <= p.max) << x;
      if (p.type == ParameterType::text && !p.choices.empty()) {
        EXPECT_NE(std::find(p.choices.begin(), p.choices.end(), p.default_text), p.choices.end()) << p.default_text;
      }
    }
}

/// Returns the page of a folder and the pages that it links to. Text that plugins share is written only once.
std::string pages_of(const std::string& folder) {
  std::string pages = content(folder + "/README.md");
  const std::regex link(R"(\]\(([^)]*README\.md)\))");
  const std::string own = pages;
  for (std::sregex_iterator it(own.begin(), own.end(), link), end; it != end; ++it)
    pages += content(folder + "/" + (*it)[1].str());
  return pages;
}

TEST_P(Plugin, HasAReadmeThatNamesAllItOffers) {
  const std::string readme = pages_of(GetParam().folder);
  for (const abi::AlgorithmEntry& entry : table_of(GetParam()).algorithms) {
    EXPECT_NE(readme.find(entry.description->id), std::string::npos) << entry.description->id;
    for (const Parameter& p : entry.description->parameters)
      EXPECT_NE(readme.find("`" + std::string(p.name) + "`"), std::string::npos)
          << entry.description->id << ": " << p.name;
  }
  for (const abi::ReaderEntry& entry : table_of(GetParam()).readers)
    EXPECT_NE(readme.find(entry.description->id), std::string::npos) << entry.description->id;
}

INSTANTIATE_TEST_SUITE_P(Built, Plugin, testing::ValuesIn(built),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Plugins, OfferEachNameOnce) {
  std::map<std::string_view, std::string> offered;
  const auto offer = [&](std::string_view id, const char* plugin) {
    const auto [place, isNew] = offered.emplace(id, plugin);
    EXPECT_TRUE(isNew) << id << " is offered by " << place->second << " and by " << plugin;
  };
  for (const Built& plugin : built) {
    for (const abi::AlgorithmEntry& entry : table_of(plugin).algorithms) offer(entry.description->id, plugin.name);
    for (const abi::ReaderEntry& entry : table_of(plugin).readers) offer(entry.description->id, plugin.name);
  }
}

}  // namespace
}  // namespace muro
