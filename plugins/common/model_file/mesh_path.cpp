// SPDX-License-Identifier: MIT
#include "mesh_path.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

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

/// The file beside `path` whose name differs in case only; the first by name if there are several.
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

/// %20 and the like (RFC 3986, section 2.1).
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

/// The folders that may be the package `name`.
std::vector<fs::path> package_folders(const std::string& name, const fs::path& folder, bool is_model) {
  std::vector<fs::path> found;
  const auto add = [&](const fs::path& above) {
    if (above.filename() == name) found.push_back(above);
    found.push_back(above / name);
  };
  for (fs::path above = folder;; above = above.parent_path()) {
    add(above);
    if (above == above.parent_path()) break;
  }
  for (const fs::path& path : paths_in("ROS_PACKAGE_PATH")) add(path);
  for (const fs::path& path : paths_in("AMENT_PREFIX_PATH")) found.push_back(path / "share" / name);
  if (is_model)
    for (const char* variable : {"GAZEBO_MODEL_PATH", "GZ_SIM_RESOURCE_PATH"})
      for (const fs::path& path : paths_in(variable)) add(path);
  return found;
}

/// Everything the name may mean, best first.
std::vector<fs::path> candidates(std::string name, const fs::path& folder) {
  std::replace(name.begin(), name.end(), '\\', '/');
  std::vector<fs::path> found;
  const std::size_t colon = name.find("://");
  const std::string scheme = colon == name.npos ? "" : lower_case(name.substr(0, colon));
  if (scheme == "package" || scheme == "model") {
    const std::string rest = percent_decoded(std::string_view(name).substr(colon + 3));
    const std::size_t slash = std::min(rest.find('/'), rest.size());
    const fs::path inside = fs::path(rest.substr(slash)).relative_path();
    for (const fs::path& package : package_folders(rest.substr(0, slash), folder, scheme == "model"))
      found.push_back(package / inside);
    return found;
  }
  if (scheme == "file") name = percent_decoded(std::string_view(name).substr(colon + 3));
  // file:///C:/...
  if (name.size() > 3 && name[0] == '/' && std::isalpha(static_cast<unsigned char>(name[1])) && name[2] == ':')
    name.erase(0, 1);
  if (name.size() > 2 && std::isalpha(static_cast<unsigned char>(name[0])) && name[1] == ':') {
    fs::path tail = fs::path(name.substr(2)).relative_path();
    while (!tail.empty()) {
      found.push_back(folder / tail);
      fs::path shorter;
      for (auto part = std::next(tail.begin()); part != tail.end(); ++part) shorter /= *part;
      tail = shorter;
    }
    return found;
  }
  // `folder / name` is `name` when that is absolute
  found.push_back(folder / name);
  return found;
}

MeshPath find(std::string_view name, const fs::path& folder, bool folders) {
  MeshPath result;
  for (const fs::path& candidate : candidates(std::string(name), folder)) {
    const fs::path path = candidate.lexically_normal();
    if (is_file(path) || (folders && is_folder(path))) {
      result.path = path.string();
      return result;
    }
    if (is_folder(path.parent_path())) {
      if (const auto other = in_other_case(path)) {
        result.path = other->string();
        result.other_case = true;
        return result;
      }
    }
    result.searched.push_back(path);
  }
  return result;
}

}  // namespace

MeshPath find_mesh(std::string_view filename, const fs::path& folder) { return find(filename, folder, false); }

std::string advice_for_missing(std::string_view filename) {
  const std::string scheme = lower_case(std::string(filename.substr(0, filename.find("://"))));
  if (scheme == "http" || scheme == "https") return "nothing is fetched from the network: save it and give its path";
  if (scheme != "package" && scheme != "model") return "correct its path";
  const char* const variable = scheme == "package" ? "ROS_PACKAGE_PATH" : "GZ_SIM_RESOURCE_PATH";
  return std::string("correct its path, or add the folder that holds the package to ") + variable;
}

MeshPath find_file_or_folder(std::string_view name, const fs::path& folder) { return find(name, folder, true); }

}  // namespace muro::model_file
