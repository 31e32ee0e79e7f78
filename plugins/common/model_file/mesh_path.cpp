// SPDX-License-Identifier: MIT
#include "mesh_path.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "message.hpp"

namespace muro::model_file {

namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

/// Returns the file beside `path` whose name differs only in case; the first by name if there are several.
std::optional<fs::path> in_other_case(const fs::path& path) {
  const std::string wanted = lower_case(path.filename().string());
  std::optional<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(path.parent_path(), error), end; !error && entry != end; entry.increment(error))
    if (lower_case(entry->path().filename().string()) == wanted && is_file(entry->path()))
      if (!found || entry->path() < *found) found = entry->path();
  return found;
}

std::vector<fs::path> paths_in(const char* variable) {
  std::vector<fs::path> paths;
  const char* value = std::getenv(variable);
  std::string_view rest = value ? value : "";
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) paths.emplace_back(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return paths;
}

/// Decodes %20 and similar (RFC 3986, section 2.1).
std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto digit = [&](std::size_t k) {
      return k < text.size() && std::isxdigit(static_cast<unsigned char>(text[k]));
    };
    if (text[i] == '%' && digit(i + 1) && digit(i + 2)) {
      decoded += char(std::strtol(std::string(text.substr(i + 1, 2)).c_str(), nullptr, 16));
      i += 2;
    } else {
      decoded += text[i];
    }
  }
  return decoded;
}

/// Variables of paths where Gazebo searches models and their parts.
constexpr const char* gazebo_paths[] = {"GZ_SIM_RESOURCE_PATH", "IGN_GAZEBO_RESOURCE_PATH", "SDF_PATH"};

/// Whether the folder is the package `name` by its package.xml, whatever the folder is called.
bool is_package(const fs::path& folder, const std::string& name) {
  std::ifstream file(folder / "package.xml");
  if (!file) return false;
  std::string text(16384, '\0');
  file.read(text.data(), std::streamsize(text.size()));
  text.resize(std::size_t(file.gcount()));
  const std::size_t begin = text.find("<name>");
  const std::size_t end = text.find("</name>");
  if (begin == text.npos || end == text.npos || end < begin) return false;
  std::string_view found = std::string_view(text).substr(begin + 6, end - begin - 6);
  constexpr std::string_view blanks = " \t\r\n";
  found.remove_prefix(std::min(found.find_first_not_of(blanks), found.size()));
  return found.substr(0, found.find_last_not_of(blanks) + 1) == name;
}

/// Returns the package in `path` or a few levels below it, as ROS finds it: workspaces hold repositories with packages.
std::optional<fs::path> package_below(const fs::path& path, const std::string& name) {
  constexpr int deepest = 3;
  constexpr std::size_t most = 1000;  // folders
  std::vector<std::pair<fs::path, int>> folders = {{path, 0}};
  for (std::size_t i = 0; i < folders.size() && i < most; ++i) {
    const auto [folder, depth] = folders[i];
    std::error_code error;
    if (is_file(folder / "package.xml")) {
      if (folder.filename() == name || is_package(folder, name)) return folder;
      continue;  // packages do not hold others
    }
    if (depth == deepest) continue;
    std::vector<fs::path> inside;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
      if (is_folder(entry->path()) && entry->path().filename().string().front() != '.') inside.push_back(entry->path());
    std::sort(inside.begin(), inside.end());
    for (fs::path& f : inside) folders.emplace_back(std::move(f), depth + 1);
  }
  return std::nullopt;
}

/// Returns the folders that may be the package `name`.
std::vector<fs::path> package_folders(const std::string& name, const fs::path& folder, const Packages& packages) {
  if (const auto given = packages.find(name); given != packages.end()) return {given->second};
  std::vector<fs::path> found;
  const auto add = [&](const fs::path& above) {
    if (above.filename() == name) found.push_back(above);
    found.push_back(above / name);
  };
  for (fs::path above = folder;; above = above.parent_path()) {
    add(above);
    if (is_package(above, name)) found.push_back(above);
    if (above == above.parent_path()) break;
  }
  for (const fs::path& path : paths_in("ROS_PACKAGE_PATH")) {
    add(path);
    if (const auto below = package_below(path, name)) found.push_back(*below);
  }
  for (const char* variable : {"AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH"})
    for (const fs::path& path : paths_in(variable)) found.push_back(path / "share" / name);
  for (const char* variable : gazebo_paths)
    for (const fs::path& path : paths_in(variable)) add(path);
  for (const fs::path& path : paths_in("GAZEBO_MODEL_PATH")) add(path);
  return found;
}

struct Candidates {
  std::vector<fs::path> paths;           ///< all that the name may mean, best first
  std::vector<fs::path> elsewhere = {};  ///< places of the file if the model was written on another computer
  std::string package = {};
  std::vector<fs::path> package_folders = {};
};

/// Returns the ends of a path, longest first, beside the model and up to two folders above it. Of
/// /home/me/arm/meshes/hand.stl, meshes/hand.stl beside the model's folder is the fourth that is tried.
std::vector<fs::path> ends_beside(const fs::path& folder, const fs::path& path) {
  std::vector<fs::path> found;
  fs::path tail = path.relative_path();
  while (!tail.empty()) {
    for (const fs::path& above : {folder, folder.parent_path(), folder.parent_path().parent_path()})
      found.push_back(above / tail);
    fs::path shorter;
    for (auto part = std::next(tail.begin()); part != tail.end(); ++part) shorter /= *part;
    tail = shorter;
  }
  return found;
}

Candidates candidates(std::string name, const fs::path& folder, const Packages& packages) {
  std::replace(name.begin(), name.end(), '\\', '/');
  Candidates found;
  const std::size_t colon = name.find("://");
  const std::string scheme = colon == name.npos ? "" : lower_case(name.substr(0, colon));
  if (scheme == "package" || scheme == "model") {
    const std::string rest = percent_decoded(std::string_view(name).substr(colon + 3));
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const fs::path inside = fs::path(rest.substr(slash)).relative_path();
    found.package = rest.substr(0, slash);
    found.package_folders = package_folders(found.package, folder, packages);
    for (const fs::path& package : found.package_folders) found.paths.push_back(package / inside);
    if (inside.has_parent_path() && std::none_of(found.package_folders.begin(), found.package_folders.end(), is_folder))
      for (fs::path above = folder; above != above.root_path() && found.elsewhere.size() < 4;
           above = above.parent_path())
        found.elsewhere.push_back(above / inside);
    return found;
  }
  if (scheme == "file") name = percent_decoded(std::string_view(name).substr(colon + 3));
  // file:///C:/...
  if (name.size() > 3 && name[0] == '/' && std::isalpha(static_cast<unsigned char>(name[1])) && name[2] == ':')
    name.erase(0, 1);
  if (name.size() > 2 && std::isalpha(static_cast<unsigned char>(name[0])) && name[1] == ':') {
    found.paths.push_back(folder / fs::path(name.substr(2)).relative_path());
    found.elsewhere = ends_beside(folder, name.substr(2));
    return found;
  }
  // `folder / name` is `name` when that is absolute
  found.paths.push_back(folder / name);
  if (fs::path(name).is_absolute()) {
    found.elsewhere = ends_beside(folder, name);
    return found;
  }
  for (const char* variable : gazebo_paths)
    for (const fs::path& path : paths_in(variable)) found.paths.push_back(path / name);
  for (const fs::path& path : paths_in("GAZEBO_RESOURCE_PATH")) found.paths.push_back(path / name);
  return found;
}

/// Kind of file to find.
enum class Wanted { mesh, file, file_or_folder };

MeshPath find(std::string_view name, const fs::path& folder, const Packages& packages, Wanted wanted) {
  const bool folders = wanted == Wanted::file_or_folder;
  MeshPath result;
  const Candidates all = candidates(std::string(name), folder, packages);
  result.package = all.package;
  result.has_package = std::any_of(all.package_folders.begin(), all.package_folders.end(), is_folder);
  const auto take = [&](const fs::path& path) {
    if (is_file(path) || (folders && is_folder(path))) {
      result.path = path.string();
    } else if (is_folder(path.parent_path())) {
      if (const auto other = in_other_case(path)) {
        result.path = other->string();
        result.other_case = true;
      }
    }
    return !result.path.empty();
  };
  for (const fs::path& candidate : all.paths) {
    const fs::path path = candidate.lexically_normal();
    if (take(path)) return result;
    result.searched.push_back(path);
  }
  if (wanted != Wanted::mesh) return result;
  for (const fs::path& candidate : all.elsewhere)
    if (take(candidate.lexically_normal())) {
      result.elsewhere = true;
      break;
    }
  return result;
}

}  // namespace

MeshPath find_mesh(std::string_view filename, const fs::path& folder, const Packages& packages) {
  return find(filename, folder, packages, Wanted::mesh);
}

MeshPath find_file(std::string_view name, const fs::path& folder, const Packages& packages) {
  return find(name, folder, packages, Wanted::file);
}

std::string note_on(std::string_view filename, const MeshPath& found) {
  if (found.elsewhere) return concat("mesh ", quote(filename), " is not there and is read from ", found.path);
  if (found.other_case)
    return concat("mesh ", quote(filename), " is read from ", found.path,
                  ", whose name differs in upper and lower case");
  return "";
}

std::string advice_for_missing(std::string_view filename, const MeshPath& missing) {
  const std::string scheme = lower_case(std::string(filename.substr(0, filename.find("://"))));
  if (scheme == "http" || scheme == "https") return "nothing is fetched from the network: save it and give its path";
  if (missing.package.empty()) return "correct its path";
  if (missing.has_package) return concat("package ", quote(missing.package), " is found, but not this file in it");
  const char* const variable = scheme == "package" ? "ROS_PACKAGE_PATH" : "GZ_SIM_RESOURCE_PATH";
  return concat("package ", quote(missing.package), " is unknown: add the folder that holds it to ", variable,
                ", or write `packages: {", missing.package, ": FOLDER}` in the scenario");
}

std::string searched_places(const MeshPath& missing) {
  constexpr std::size_t max = 6;
  std::string text;
  for (std::size_t i = 0; i < std::min(max, missing.searched.size()); ++i)
    text += (i ? ", " : "") + missing.searched[i].string();
  if (missing.searched.size() > max) text += concat(" and ", missing.searched.size() - max, " more places");
  return text;
}

MeshPath find_file_or_folder(std::string_view name, const fs::path& folder, const Packages& packages) {
  return find(name, folder, packages, Wanted::file_or_folder);
}

}  // namespace muro::model_file
