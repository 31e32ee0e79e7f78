// SPDX-License-Identifier: MIT
#include "core/output_registry.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "muro/base/whole_file.hpp"

namespace muro {

namespace fs = std::filesystem;

OutputRegistry::Place OutputRegistry::place_of(const std::string& path) {
  std::error_code code;
  Place place{target_of(path, code).string(), {}};
  place.error = code.value();
  struct stat about {};
  if (code) return place;
  if (stat(place.target.c_str(), &about) != 0) {
    place.error = errno == ENOENT ? 0 : errno;
    return place;
  }
  place.exists = true;
  place.is_folder = S_ISDIR(about.st_mode);
  place.is_device = S_ISCHR(about.st_mode);
  place.is_regular = S_ISREG(about.st_mode);
  place.number[0] = about.st_dev;
  place.number[1] = about.st_ino;
  return place;
}

bool OutputRegistry::same_place(const Place& a, const Place& b) {
  if (a.exists && b.exists && a.number[0] == b.number[0] && a.number[1] == b.number[1]) return true;
  return a.target == b.target;
}

void OutputRegistry::file(std::string_view path) noexcept {
  outputs_.push_back({owner_, std::string(path), place_of(std::string(path)), "", "", false});
}

void OutputRegistry::series(std::string_view begin, std::string_view end) noexcept {
  const fs::path first(begin);
  // the folder may be created later
  const fs::path folder = first.parent_path().empty() ? fs::path(".") : first.parent_path();
  outputs_.push_back({owner_, fmt::format("{}#{}", begin, end), place_of(folder.string()), first.filename().string(),
                      std::string(end), true});
}

void OutputRegistry::add_input(const std::string& path, const std::string& what) {
  if (!known_inputs_.insert(path).second) return;
  inputs_.push_back({owner_, path, what, place_of(path)});
}

/// Whether a file lies in the folder of a series and has one of its names.
bool OutputRegistry::is_member(const Output& series, const std::string& target) {
  const fs::path file(target);
  const std::string name = file.filename().string();
  if (file.parent_path() != series.place.target || !name.starts_with(series.begin) || !name.ends_with(series.end) ||
      name.size() <= series.begin.size() + series.end.size())
    return false;
  const std::string number = name.substr(series.begin.size(), name.size() - series.begin.size() - series.end.size());
  return number.find_first_not_of("0123456789.") == std::string::npos;
}

/// Whether a file would have the name of the folder of a series, or of a folder above it.
bool OutputRegistry::is_folder_of(const Output& file, const Output& series) {
  return (series.place.target + "/").starts_with(file.place.target + "/");
}

bool OutputRegistry::are_one(const Output& a, const Output& b) {
  if (a.is_series && b.is_series) return same_place(a.place, b.place) && a.begin == b.begin && a.end == b.end;
  if (a.is_series) return is_member(a, b.place.target) || is_folder_of(b, a);
  if (b.is_series) return is_member(b, a.place.target) || is_folder_of(a, b);
  return same_place(a.place, b.place) && !a.place.is_device;
}

/// Whether `b` has the name under which `a` is kept until it is complete, see WholeFile.
bool OutputRegistry::is_part_of(const Output& a, const Output& b) {
  if (a.is_series || b.is_series) return false;
  fs::path with_extension(a.place.target);
  with_extension.replace_extension(".part" + with_extension.extension().string());
  return b.place.target == a.place.target + ".part" || b.place.target == with_extension;
}

void OutputRegistry::check_folder(const Output& output, std::vector<std::string>& problems) const {
  const auto cannot = [&](int reason) {
    problems.push_back(
        fmt::format("{}: file {} cannot be written: {}", output.owner, output.path, std::strerror(reason)));
  };
  if (output.place.error != 0) return cannot(output.place.error);
  if (output.is_series) {
    if (output.place.exists && !output.place.is_folder) return cannot(ENOTDIR);
    if (output.place.exists && access(output.place.target.c_str(), W_OK | X_OK) != 0) return cannot(errno);
    return;
  }
  const std::string folder = fs::path(output.place.target).parent_path().string();
  if (folder == fmt::format("/proc/{}/fd", getpid())) return;  // it is open already
  if (output.place.is_folder) return cannot(EISDIR);
  if (output.place.exists && access(output.place.target.c_str(), W_OK) != 0) return cannot(errno);
  if (output.place.exists && !output.place.is_regular) return;
  struct stat about {};
  if (stat(folder.c_str(), &about) != 0) return cannot(errno);
  if (!S_ISDIR(about.st_mode)) return cannot(ENOTDIR);
  if (access(folder.c_str(), W_OK | X_OK) != 0) return cannot(errno);
}

/// Creates the file and removes it again, since access rights alone do not say whether it can be created.
void OutputRegistry::try_to_write(const Output& output, std::vector<std::string>& problems) {
  if (output.is_series || (output.place.exists && !output.place.is_regular)) return;
  try {
    WholeFile(output.path).descriptor();
  } catch (const Error& e) {
    problems.push_back(fmt::format("{}: {}", output.owner, e.what()));
  }
}

void OutputRegistry::check() const {
  std::vector<std::string> found;
  for (const Output& output : outputs_) check_folder(output, found);
  for (std::size_t i = 0; i < outputs_.size(); ++i)
    for (std::size_t k = 0; k < outputs_.size(); ++k) {
      const Output &a = outputs_[i], &b = outputs_[k];
      if (i < k && are_one(a, b))
        found.push_back(fmt::format("{} and {} write to one file, {}{}; give each a file of its own", a.owner, b.owner,
                                    a.path, a.path == b.path ? "" : fmt::format(", which is also {}", b.path)));
      else if (i != k && is_part_of(a, b))
        found.push_back(
            fmt::format("{} keeps {} under the name {} until it is complete, and {} writes to it; choose "
                        "another name",
                        a.owner, a.path, b.path, b.owner));
    }
  for (const Output& output : outputs_)
    for (const Input& input : inputs_) {
      const bool same = output.is_series ? is_member(output, input.place.target)
                                         : input.place.is_regular && same_place(output.place, input.place);
      if (same && output.owner != input.owner)
        found.push_back(fmt::format("{} would overwrite {}{}, {}; choose another name", output.owner, output.path,
                                    output.path == input.path ? "" : fmt::format(", which is {}", input.path),
                                    input.what));
    }
  if (found.empty())
    for (const Output& output : outputs_) try_to_write(output, found);
  if (!found.empty()) throw OutputError(found);
}

}  // namespace muro
