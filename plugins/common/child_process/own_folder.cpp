// SPDX-License-Identifier: MIT
#include "own_folder.hpp"

#include <dlfcn.h>

#include <filesystem>

namespace muro {

std::string own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&own_folder), &info) == 0 || !info.dli_fname) return {};
  std::error_code unused;
  return std::filesystem::absolute(info.dli_fname, unused).parent_path().string();
}

}  // namespace muro
