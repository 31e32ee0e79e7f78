// SPDX-License-Identifier: MIT
// Include this in one source file of a plugin, describe what it offers and close with MURO_PLUGIN.
#pragma once

#include "muro/detail/contract_layout.hpp"
#include "muro/detail/instances.hpp"
#include "muro/detail/stamp.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// `T` is default-constructible and derives from Algorithm.
template <class T>
constexpr abi::AlgorithmEntry algorithm(const Description& description) {
  return {&description, &abi::detail::make<abi::AlgorithmInstance, abi::detail::AlgorithmOf<T>>, sizeof description};
}

/// `T` is default-constructible and derives from ModelReader.
template <class T>
constexpr abi::ReaderEntry model_reader(const ReaderDescription& description) {
  return {&description, &abi::detail::make<abi::ReaderInstance, abi::detail::ReaderOf<T>>, sizeof description};
}

struct PluginInfo {
  std::string_view name, version, licence, summary;
  std::span<const abi::AlgorithmEntry> algorithms{};
  std::span<const abi::ReaderEntry> readers{};
};

constexpr abi::PluginTable plugin_table(const PluginInfo& p) {
  return {abi::make_stamp(), sizeof(abi::PluginTable), p.name, p.version, p.licence, p.summary, p.algorithms,
          p.readers,         abi::layout_of_contract()};
}

}  // namespace muro

/// Exports the plugin's table:
///
///     constexpr muro::abi::AlgorithmEntry algorithms[] = {muro::algorithm<Point>(description)};
///     MURO_PLUGIN(.name = "motion_point", .version = "1.0.0", .licence = "MIT",
///                 .summary = "...", .algorithms = algorithms)
#define MURO_PLUGIN(...)                                                                      \
  extern "C" __attribute__((visibility("default"))) const muro::abi::PluginTable muro_plugin; \
  constinit const muro::abi::PluginTable muro_plugin = muro::plugin_table(muro::PluginInfo{__VA_ARGS__});
