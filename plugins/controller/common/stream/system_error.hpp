// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::stream {

/// Returns the system's text for an error number. Adds advice when the reason has nothing to do with streams.
inline std::string system_reason(int error) {
  std::string text = std::system_category().message(error);
  if (error == EMFILE || error == ENFILE) {
    rlimit limit{};
    getrlimit(RLIMIT_NOFILE, &limit);
    text += "; this process may have " + std::to_string(limit.rlim_cur) +
            " files open, streams and their clients included: raise that with `ulimit -n`, or use fewer streams";
  }
  return text;
}

/// Returns the same text for an error in making a file at `path`.
inline std::string reason_at(const std::string& path, int error) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code unknown;
  if (error != ENOENT || std::filesystem::exists(folder, unknown)) return system_reason(error);
  return "there is no folder " + quote(folder.string()) + "; create it, or choose another path";
}

[[noreturn]] inline void throw_system_error(const std::string& what, int error) {
  throw Error(what + ": " + system_reason(error));
}

}  // namespace muro::stream
