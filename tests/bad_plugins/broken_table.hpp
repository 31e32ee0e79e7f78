// SPDX-License-Identifier: MIT
// A valid plugin for tests that break one part of its table. PLUGIN_NAME: from CMake, e.g. wrong_magic.
#pragma once

#include "muro/plugin.hpp"

namespace broken {

constexpr muro::Description description{
    .id = "motion." PLUGIN_NAME, .kind = muro::Kind::motion, .version = "1.0.0", .summary = "Stands still"};

class Still final : public muro::Algorithm {
 public:
  void connect(muro::Connector& c) override {
    for (const muro::Item& item : c.items()) {
      c.variable(item.object, muro::keys::pose, muro::Pose{});
      c.variable(item.object, muro::keys::twist, muro::Twist{});
    }
  }
  void step(const muro::Step&, muro::Range) override {}
};

constexpr muro::abi::AlgorithmEntry algorithms[] = {muro::algorithm<Still>(description)};

/// Returns the table with the fault that `change` makes.
template <class Change>
constexpr muro::abi::PluginTable table(Change change) {
  muro::abi::PluginTable t = muro::plugin_table({.name = PLUGIN_NAME,
                                                 .version = "1.0.0",
                                                 .licence = "MIT",
                                                 .summary = "A broken plugin",
                                                 .algorithms = algorithms});
  change(t);
  return t;
}

}  // namespace broken

#define BROKEN_PLUGIN(...)                                                                    \
  extern "C" __attribute__((visibility("default"))) const muro::abi::PluginTable muro_plugin; \
  constinit const muro::abi::PluginTable muro_plugin =                                        \
      broken::table([](muro::abi::PluginTable& table) { __VA_ARGS__; });
