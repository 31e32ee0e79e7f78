// SPDX-License-Identifier: MIT
// The files that a model or world consists of, checked and made ready for libsdformat.
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

/// The <mimic> of SDFormat 1.11, which libsdformat 12 does not know: q = multiplier (q_joint - reference) +
/// offset.
struct Mimic {
  std::string joint, axis;
  double multiplier = 1, offset = 0, reference = 0;
  FileLocation location;
};

/// One file.
struct SourceFile {
  std::string display_name;  ///< in messages; empty: the file that is read
  std::filesystem::path folder;
  std::string version;
  std::unique_ptr<model_file::Document> document;
  std::string normalized;                ///< text for libsdformat: one start tag a line
  std::vector<Location> line_locations;  ///< where the tag of each line of `normalized` is in the file
  std::unique_ptr<MemoryFile> memory;    ///< of an included file
  std::size_t elements = 0;              ///< with those of the files it includes
  Element* content = nullptr;            ///< <world> or <model>; null where there is only what `alone` names
  std::string alone = {};                ///< a light or an actor that is all that a model's file holds

  FileLocation location_of(const Element& e) const { return {display_name, model_file::location_of(e)}; }
  /// 1.4 is 104.
  int version_number() const;
};

/// Of a file with all that it includes.
inline constexpr std::size_t max_elements = 200'000;

/// What an SDFormat file holds.
enum class Content { model, world };

class SourceFiles {
 public:
  SourceFiles(std::filesystem::path folder, Problems& problems, model_file::Packages packages = {})
      : folder_(std::move(folder)), packages_(std::move(packages)), problems_(problems) {}

  /// Checks the text of the file that is read, and the files that it includes. False, with errors reported, when there
  /// is nothing to read.
  bool load(std::string bytes, Content wanted);
  const SourceFile& main() const { return *sources_.front(); }

  /// The included file; null, with a reason, when there is none. For the checks of a file that includes.
  const SourceFile* include(const std::filesystem::path& path, std::string& reason);
  const std::filesystem::path& folder() const { return folder_; }
  const model_file::Packages& packages() const { return packages_; }
  /// Takes a model or an <include> out of the world that is read.
  void remove_from_world(Element& model);
  /// The text of the file that is read, with nothing in its world but `model`.
  std::string with_only(const Element& model) const;
  /// `text` of libsdformat, with the names of included files in place of where they are kept for it.
  std::string with_file_names(std::string text) const;

  /// Where an element that libsdformat has read is: `file` is the path by which libsdformat knows its file.
  FileLocation location_of(const std::string& file, int line) const;
  /// Mimics by the location of their joint and the number of the axis.
  std::map<std::pair<FileLocation, int>, Mimic> mimics;
  /// kg m^2 or kg, by the location of their joint: what it feels of the rotor of its drive, which SDFormat has no word
  /// for.
  std::map<FileLocation, double> armatures;
  /// By the location of the link, joint or model that has them.
  std::map<FileLocation, std::vector<sdf_devices::Device>> devices;
  std::set<FileLocation> weightless;      ///< links whose <gravity> is off
  std::set<FileLocation> self_colliding;  ///< links and models

 private:
  bool parse(SourceFile& source, std::string bytes, bool included, std::string& reason);

  std::filesystem::path folder_;
  model_file::Packages packages_;
  Problems& problems_;
  std::vector<std::unique_ptr<SourceFile>> sources_;
  std::map<std::filesystem::path, const SourceFile*> included_;
  std::vector<std::filesystem::path> open_;  ///< files within which another one is being read
};

}  // namespace muro::sdf
