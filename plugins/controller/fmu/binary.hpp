// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muro::fmu {

/// Returns the names of the folders in `binaries` with libraries for this machine, in the order of search: "linux64" in
/// FMI 2, "x86_64-linux" in FMI 3.
std::vector<std::string> own_platforms(int version);

/// The library of an FMU. It stays loaded until the process ends. A library uses its own functions, also when another
/// library has functions of the same name, such as `step` of the C library.
class Binary {
 public:
  /// Loads the library. Throws Error with the reason of the loader.
  explicit Binary(const std::filesystem::path& path);

  const std::string& path() const { return path_; }
  /// Returns null when the library does not have it.
  void* find(const char* function) const;
  /// Sets `place` to the function of that name. Throws Error when the library does not have it.
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
