// SPDX-License-Identifier: MIT
// The text of an MJCF file before MuJoCo reads it.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "library.hpp"
#include "plugins/common/model_file/document.hpp"
#include "plugins/common/model_file/problems.hpp"

namespace muro::mjcf {

using model_file::concat;
using model_file::Element;
using model_file::Location;
using model_file::Problems;

class Source {
 public:
  /// Takes the contents of the file at `path` (absolute). Reports a problem and returns false if they are not MJCF.
  bool load(std::string bytes, const std::string& path, Problems& problems);

  /// Compiles the text with the elements `more` added at its end. Returns no model, with a report, if MuJoCo refuses.
  Compiled compile(Problems& problems, const std::string& more = "") const;

  const std::string& path() const { return path_; }
  std::filesystem::path folder() const { return std::filesystem::path(path_).parent_path(); }
  /// Returns the location of the first element `tag` with this name; none if it is in an included file or has no name.
  Location location_of(const std::string& tag, const std::string& name) const;
  /// Whether the values of this height field are written in the file itself.
  bool has_elevation(const std::string& height_field) const { return elevations_.contains(height_field); }

 private:
  void find_names();
  void allow_for_files() const;

  std::string path_, text_;
  model_file::Document document_;
  std::map<std::pair<std::string, std::string>, Location> places_;  ///< by tag and name
  std::set<std::string> elevations_;                                ///< names of height fields
  bool has_includes_ = false;
};

}  // namespace muro::mjcf
