// SPDX-License-Identifier: MIT
#include "core/missing_file.hpp"

#include <filesystem>
#include <vector>

#include "muro/base/did_you_mean.hpp"

namespace muro {

namespace fs = std::filesystem;

std::string nearest_file(const std::string& path) {
  constexpr std::size_t most = 2000;  // comparing names takes time
  std::error_code code;
  std::vector<std::string> names;
  const fs::path folder = fs::absolute(path, code).parent_path();
  for (fs::directory_iterator at(folder, code), end; !code && at != end && names.size() < most; at.increment(code))
    names.push_back(at->path().filename().string());
  return did_you_mean(fs::path(path).filename().string(), names);
}

std::string why_missing(const std::string& path) {
  std::error_code code;
  const fs::path folder = fs::absolute(path, code).parent_path().lexically_normal();
  if (code) return " does not exist";
  if (!fs::is_directory(folder, code)) return " does not exist: there is no folder " + folder.string();
  return " does not exist in " + folder.string() + nearest_file(path);
}

}  // namespace muro
