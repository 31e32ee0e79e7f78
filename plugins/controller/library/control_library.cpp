// SPDX-License-Identifier: MIT
#include "control_library.hpp"

#include <dlfcn.h>
#include <fenv.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "muro/algorithm.hpp"
#include "muro/toolkit/whole_library.hpp"
#include "own_symbols.hpp"
#include "plugins/common/text/quote.hpp"

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

/// The folder of this plugin's own file.
fs::path own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&own_folder), &info) == 0 || !info.dli_fname) return {};
  std::error_code unused;
  return fs::absolute(info.dli_fname, unused).parent_path();
}

/// Restores the floating-point environment at its end: a library linked with -ffast-math turns off subnormal numbers
/// in the thread that loads it (gcc before 13, clang before 19), which would change every result.
class FloatingPointGuard {
 public:
  FloatingPointGuard() { fegetenv(&environment_); }
  ~FloatingPointGuard() { fesetenv(&environment_); }
  FloatingPointGuard(const FloatingPointGuard&) = delete;
  FloatingPointGuard& operator=(const FloatingPointGuard&) = delete;

 private:
  fenv_t environment_{};
};

/// Throws Error when the library does not get its own functions: with them its steps would be those of a stranger.
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

/// The loader's last message without the path, which our message names already.
std::string loader_message(const std::string& path) {
  const char* message = dlerror();
  std::string text = message ? message : "unknown reason";
  if (text.rfind(path + ": ", 0) == 0) text.erase(0, path.size() + 2);
  return text;
}

void check_ports(const char* what, const muro_port* ports, std::uint32_t count, const std::string& library) {
  if (count > 0 && !ports)
    throw Error(library + " has " + std::to_string(count) + " " + what + "s, but its table points to none");
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!ports[i].name || !*ports[i].name)
      throw Error(library + ": " + what + " " + std::to_string(i) + " has no name");
    for (std::uint32_t k = 0; k < i; ++k)
      if (std::string_view(ports[i].name) == ports[k].name)
        throw Error(library + " has two " + what + "s named " + quote(ports[i].name) + "; names are unique");
  }
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
  folders.push_back((own_folder() / "controllers").string());
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

const muro_controller_table& load_library(const std::string& path) {
  const FloatingPointGuard guard;
  if (const std::string problem = missing_part_of_library(path); !problem.empty())
    throw Error("library " + path + " cannot be loaded: " + problem);
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // never closed: its table is used until the end
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
  return *table;
}

void check_table(const muro_controller_table* table, const std::string& path) {
  const std::string library = "library " + path;
  if (!table) throw Error(library + ": `muro_controller` returns no table");
  const auto built_for = [&](const char* field, std::uint32_t theirs, std::uint32_t ours) {
    if (theirs != ours)
      throw Error(library + ": " + field + " is " + std::to_string(theirs) + ", this muro has " + std::to_string(ours) +
                  "; build it with the muro_controller.h of this muro");
  };
  built_for("abi", table->abi, MURO_CONTROLLER_ABI);  // the first field: what follows depends on it
  built_for("table_size", table->table_size, sizeof(muro_controller_table));
  if (!table->name || !*table->name) throw Error(library + ": its table has no name");
  if (!table->step) throw Error(library + ": its table has no function `step`");
  if (table->state_size > std::numeric_limits<std::uint32_t>::max() / 2)
    throw Error(library + ": state_size is " + std::to_string(table->state_size) +
                " bytes; at most 2147483647 are allowed");
  check_ports("input", table->inputs, table->input_count, library);
  check_ports("output", table->outputs, table->output_count, library);
  for (std::uint32_t i = 0; i < table->output_count; ++i)
    if (table->outputs[i].size == 0)
      throw Error(library + ": output " + quote(table->outputs[i].name) +
                  " has size 0; only inputs may leave their size open");
}

}  // namespace muro::control
