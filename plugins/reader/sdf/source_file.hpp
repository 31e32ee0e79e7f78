// SPDX-License-Identifier: MIT
// The files of a model or world, checked and prepared for libsdformat.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "memory_file.hpp"
#include "plugins/common/model_file/document.hpp"
#include "plugins/common/model_file/mesh_path.hpp"
#include "plugins/common/model_file/problems.hpp"
#include "plugins/reader/common/sdf_devices/subsystem.hpp"

namespace muro::sdf {

using model_file::concat;
using model_file::Element;
using model_file::FileLocation;
using model_file::Location;
using model_file::Problems;

/// The <mimic> of SDFormat 1.11, which libsdformat 12 does not know:
/// q = multiplier (q_joint - reference) + offset.
struct Mimic {
  std::string joint, axis;
  double multiplier = 1, offset = 0, reference = 0;
  FileLocation location;
};

/// One file.
struct SourceFile {
  std::string display_name;  ///< name in messages; empty: the file that is read
  std::filesystem::path folder;
  std::string version;
  std::unique_ptr<model_file::Document> document;
  std::string normalized;                ///< text for libsdformat: one start tag a line
  std::vector<Location> line_locations;  ///< location in the file of the tag in each line of `normalized`
  std::unique_ptr<MemoryFile> memory;    ///< only of an included file
  std::size_t elements = 0;              ///< number of elements, with those of included files
  Element* content = nullptr;            ///< <world> or <model>; null if the file holds only what `alone` names
  std::string alone = {};                ///< name of a light or an actor that is the only content of a model's file

  FileLocation location_of(const Element& e) const { return {display_name, model_file::location_of(e)}; }
  /// Returns the version as a number: 104 for 1.4.
  int version_number() const;
};

/// Limit of elements in a file and the files that it includes.
inline constexpr std::size_t max_elements = 200'000;

/// Content of an SDFormat file.
enum class Content { model, world };

class SourceFiles {
 public:
  SourceFiles(std::filesystem::path folder, Problems& problems, model_file::Packages packages = {})
      : folder_(std::move(folder)), packages_(std::move(packages)), problems_(problems) {}

  /// Checks the text of the file that is read, and of the files that it includes. Reports errors and returns false if
  /// there is nothing to read.
  bool load(std::string bytes, Content wanted);
  const SourceFile& main() const { return *sources_.front(); }

  /// Returns the included file; null, with a reason, if it cannot be read. For the checks of the including file.
  const SourceFile* include(const std::filesystem::path& path, std::string& reason);
  const std::filesystem::path& folder() const { return folder_; }
  const model_file::Packages& packages() const { return packages_; }
  /// Removes a model or an <include> from the world that is read.
  void remove_from_world(Element& model);
  /// Returns the text of the file that is read, with only `model` in its world.
  std::string with_only(const Element& model) const;
  /// Returns `text` of libsdformat with the names of included files instead of the paths that libsdformat knows.
  std::string with_file_names(std::string text) const;

  /// Returns the location of an element that libsdformat has read. `file`: path by which libsdformat knows the file.
  FileLocation location_of(const std::string& file, int line) const;
  /// Mimics by the location of their joint and the number of the axis.
  std::map<std::pair<FileLocation, int>, Mimic> mimics;
  /// Reflected inertia of the rotor, kg m^2 or kg, by the location of the joint. SDFormat has no element for it.
  std::map<FileLocation, double> armatures;
  /// Devices by the location of their link, joint or model.
  std::map<FileLocation, std::vector<sdf_devices::Device>> devices;
  std::set<FileLocation> weightless;      ///< links with <gravity> off
  std::set<FileLocation> self_colliding;  ///< links and models with <self_collide> on

 private:
  bool parse(SourceFile& source, std::string bytes, bool included, std::string& reason);

  std::filesystem::path folder_;
  model_file::Packages packages_;
  Problems& problems_;
  std::vector<std::unique_ptr<SourceFile>> sources_;
  std::map<std::filesystem::path, const SourceFile*> included_;
  std::vector<std::filesystem::path> open_;  ///< stack of the files that are being read
};

}  // namespace muro::sdf
