// SPDX-License-Identifier: MIT
#include "control_library.hpp"

#include <dlfcn.h>
#include <fenv.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "control_table.hpp"
#include "muro/algorithm.hpp"
#include "muro/base/whole_library.hpp"
#include "plugins/common/child_process/own_folder.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/own_symbols/own_symbols.hpp"
#include "table_check.hpp"

namespace muro::control {

namespace {

namespace fs = std::filesystem;

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

bool is_file(const fs::path& path) {
  std::error_code unused;
  return fs::is_regular_file(path, unused);
}

/// Restores the floating-point environment at its end. A library linked with -ffast-math turns off subnormal numbers in
/// the thread that loads it (gcc before 13, clang before 19). That would change every result.
class FloatingPointGuard {
 public:
  FloatingPointGuard() { fegetenv(&environment_); }
  ~FloatingPointGuard() { fesetenv(&environment_); }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  fenv_t environment_{};
};

/// Throws Error when the library does not get its own functions: it would run functions of another library instead.
void check_own_symbols(void* library, const std::string& path) {
  const std::vector<Interposed> lost = interposed_symbols(library);
  if (lost.empty()) return;
  constexpr std::size_t most = 5;
  std::string names;
  for (const Interposed& i : std::span(lost).first(std::min(most, lost.size())))
    names += (names.empty() ? "" : ", ") + quote(i.name) + " (of " + i.by + ")";
  if (lost.size() > most) names += ", and " + std::to_string(lost.size() - most) + " more";
  throw Error("library " + path + " would use functions of others in place of its own: " + names +
              "; link it with -Wl,-Bsymbolic, or make them static");
}

/// Returns the loader's last message without the path, which our message already contains.
std::string loader_message(const std::string& path) {
  const char* message = dlerror();
  std::string text = message ? message : "unknown reason";
  if (text.rfind(path + ": ", 0) == 0) text.erase(0, path.size() + 2);
  return text;
}

}  // namespace

std::vector<std::string> search_folders(const std::string& scenario_folder) {
  std::vector<std::string> folders{scenario_folder};
  const char* variable = std::getenv("MURO_CONTROLLER_PATH");
  for (std::string_view rest = variable ? variable : ""; !rest.empty();) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) folders.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  folders.push_back((fs::path(own_folder()) / "controllers").string());
  return folders;
}

std::string find_library(std::string_view name, const std::string& as_path, std::span<const std::string> folders) {
  if (name.empty()) throw Error("parameter `library` is empty; give the path or the name of a library");
  if (name.find('/') != std::string_view::npos) {
    if (is_file(as_path)) return as_path;
    throw Error("there is no library " + quote(as_path) + "; relative paths start at the scenario's folder");
  }
  std::vector<std::string> files{std::string(name)};
  if (!ends_with(name, ".so")) files = {files[0] + ".so", "lib" + files[0] + ".so"};
  std::string searched;
  for (const std::string& folder : folders) {
    for (const std::string& file : files)
      if (const fs::path path = fs::path(folder) / file; is_file(path)) return fs::absolute(path).string();
    searched += (searched.empty() ? "" : ", ") + folder;
  }
  throw Error("no library " + quote(files[0]) + (files.size() > 1 ? " or " + quote(files[1]) : "") +
              " in any of these folders: " + searched + "; give its path, or add its folder to MURO_CONTROLLER_PATH");
}

muro_controller_table load_library(const std::string& path) {
  const FloatingPointGuard guard;
  if (const std::string problem = missing_part_of_library(path); !problem.empty())
    throw Error("library " + path + " cannot be loaded: " + problem);
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed: the table is used until the end
  if (!library) throw Error("library " + path + " cannot be loaded: " + loader_message(path));
  void* symbol = dlsym(library, "muro_controller");
  if (!symbol)
    throw Error(
        "library " + path +
        " exports no `muro_controller`; include muro_controller.h and define this function (in C++ the header makes it "
        "extern \"C\")");
  check_own_symbols(library, path);
  const auto* table = reinterpret_cast<const muro_controller_table* (*)()>(symbol)();
  check_table(table, path);
  return complete(*table);
}

}  // namespace muro::control
