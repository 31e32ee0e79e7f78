// SPDX-License-Identifier: MIT
// muro_describe PLUGIN.so OUT.json: loads a plugin and writes what it says of itself.
#include <dlfcn.h>

#include <cstdio>
#include <fstream>

#include "muro/describe.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: muro_describe PLUGIN.so OUT.json\n");
    return 2;
  }
  void* library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (!library) {
    std::fprintf(stderr, "%s: cannot be loaded: %s\n", argv[1], dlerror());
    return 1;
  }
  const auto* table = static_cast<const muro::abi::PluginTable*>(dlsym(library, muro::abi::table_symbol));
  if (!table) {
    std::fprintf(stderr, "%s: exports no `%s`; close the plugin with MURO_PLUGIN\n", argv[1], muro::abi::table_symbol);
    return 1;
  }
  std::ofstream out(argv[2]);
  out << muro::abi::describe(*table) << '\n';
  out.close();
  if (!out) {
    std::fprintf(stderr, "%s: cannot be written\n", argv[2]);
    return 1;
  }
  return 0;
}
