// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muro::fmu {

/// Names of the folders in `binaries` whose libraries run on this machine, the one that is looked for first in front:
/// "linux64" in FMI 2, "x86_64-linux" in FMI 3.
std::vector<std::string> own_platforms(int version);

/// The library of an FMU, loaded for the life of the process. Where it has functions with names that others have, too,
/// such as `step` of the C library, it gets its own.
class Binary {
 public:
  /// Throws Error with the reason of the loader.
  explicit Binary(const std::filesystem::path& path);

  const std::string& path() const { return path_; }
  /// Null where the library does not have it.
  void* find(const char* function) const;
  /// Sets `place` to the function of that name. Throws Error where the library does not have it.
  template <class Function>
  void get(Function*& place, const char* name) const {
    place = reinterpret_cast<Function*>(needed(name));
  }

 private:
  void* load(int flags) const;
  [[noreturn]] void fail_to_load() const;
  void* needed(const char* name) const;

  std::string path_;
  void* handle_ = nullptr;
};

}  // namespace muro::fmu
