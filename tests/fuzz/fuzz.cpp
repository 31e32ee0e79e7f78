// SPDX-License-Identifier: MIT
// The program of libFuzzer. The environment variable MURO_FUZZ_TARGET names the target, such as urdf. All arguments are
// options of libFuzzer: https://llvm.org/docs/LibFuzzer.html
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/fuzz/target.hpp"

namespace {

const muro::fuzz::Target* target = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  const char* const name = std::getenv("MURO_FUZZ_TARGET");
  for (const muro::fuzz::Target& t : muro::fuzz::targets())
    if (name && std::strcmp(t.name, name) == 0) target = &t;
  if (target) return 0;
  std::fputs("MURO_FUZZ_TARGET must be one of:", stderr);
  for (const muro::fuzz::Target& t : muro::fuzz::targets()) std::fprintf(stderr, " %s", t.name);
  std::fputs("\n", stderr);
  std::exit(2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target->run({data, size});
  return 0;
}
