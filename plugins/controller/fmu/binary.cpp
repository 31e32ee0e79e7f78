// SPDX-License-Identifier: MIT
#include "binary.hpp"

#include <dlfcn.h>
#include <fenv.h>

#include "muro/algorithm.hpp"
#include "muro/base/whole_library.hpp"
#include "plugins/common/text/one_line.hpp"
#include "plugins/controller/common/own_symbols/own_symbols.hpp"

namespace muro::fmu {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;  // sanitizers do not allow RTLD_DEEPBIND
#else
constexpr bool is_sanitized = false;
#endif

}  // namespace

std::vector<std::string> own_platforms(int version) {
#if defined(__x86_64__)
  if (version == 2) return {"linux64", "x86_64-linux"};
  return {"x86_64-linux"};
#elif defined(__aarch64__)
  static_cast<void>(version);
  return {"aarch64-linux"};
#else
  static_cast<void>(version);
  return {};
#endif
}

Binary::Binary(const std::filesystem::path& path) : path_(path.string()) {
  if (const std::string problem = missing_part_of_library(path_); !problem.empty())
    throw Error("its library " + path.filename().string() + " cannot be loaded: " + problem);
  handle_ = load(RTLD_NOW | RTLD_LOCAL);
  if (!handle_) fail_to_load();
  if (is_sanitized || interposed_symbols(handle_).empty()) return;
  // With RTLD_DEEPBIND its own functions come first. Not used always: some libraries are meant to be replaced.
  dlclose(handle_);
  handle_ = load(RTLD_NOW | RTLD_LOCAL | RTLD_DEEPBIND);
  if (!handle_) fail_to_load();
}

void* Binary::load(int flags) const {
  fenv_t environment{};  // a library linked with -ffast-math turns off subnormal numbers in the thread that loads it
  fegetenv(&environment);
  void* const handle = dlopen(path_.c_str(), flags);
  fesetenv(&environment);
  return handle;
}

void Binary::fail_to_load() const {
  const char* message = dlerror();
  std::string reason = one_line(message ? message : "unknown reason");
  const std::string name = std::filesystem::path(path_).filename().string();
  if (const std::size_t at = reason.find(path_); at != reason.npos) reason.replace(at, path_.size(), name);
  const auto says = [&](const char* part) { return reason.find(part) != reason.npos; };
  if (says("undefined symbol: Py") || says("undefined symbol: _Py"))
    reason +=
        "; it takes Python from the program that loads it: start muro with LD_PRELOAD=libpython3.11.so.1.0, or "
        "as the library of Python is called here";
  else if (says("cannot open shared object file"))
    reason += "; install that library, or add its folder to LD_LIBRARY_PATH";
  throw Error("its library cannot be loaded: " + reason);
}

void* Binary::find(const char* function) const { return dlsym(handle_, function); }

void* Binary::needed(const char* name) const {
  if (void* const found = find(name)) return found;
  throw Error("its library has no function `" + std::string(name) + "`, which the standard and its flags ask for");
}

}  // namespace muro::fmu
