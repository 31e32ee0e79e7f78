// SPDX-License-Identifier: MIT
// muro_describe PLUGIN.so OUT.json: loads a plugin and writes its description.
#include <dlfcn.h>

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>

#include "describe/describe.hpp"
#include "muro/detail/stamp.hpp"

namespace {

/// Whether this thread still computes with subnormal numbers, as IEEE 754 requires.
bool has_subnormals() {
  const volatile double smallest_normal = std::numeric_limits<double>::min();
  return smallest_normal / 2 > 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: muro_describe PLUGIN.so OUT.json\n");
    return 2;
  }
  const auto failed = [&](const char* what, const char* detail) {
    std::remove(argv[2]);
    std::fprintf(stderr, "%s: %s%s\n", argv[1], what, detail);
    return 1;
  };
  void* library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (!library) return failed("cannot be loaded: ", dlerror());
  if (!has_subnormals())
    return failed("loading it turns off subnormal numbers in the whole program; ",
                  "build it without -ffast-math, -Ofast and -funsafe-math-optimizations");
  const auto* table = static_cast<const muro::abi::PluginTable*>(dlsym(library, muro::abi::table_symbol));
  if (!table) return failed("exports no `muro_plugin`; ", "close the plugin with MURO_PLUGIN");
  constexpr muro::abi::Stamp own = muro::abi::make_stamp();
  if (std::memcmp(&table->stamp, &own, offsetof(muro::abi::Stamp, compiler)) != 0)
    return failed("is built with other settings than this SDK; ", "link muro::sdk, or use muro_add_plugin");
  std::ofstream out(argv[2]);
  out << muro::abi::describe(*table) << '\n';
  out.close();
  if (!out) return failed("its description cannot be written to ", argv[2]);
  return 0;
}
