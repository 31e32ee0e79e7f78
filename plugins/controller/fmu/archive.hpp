// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace muro::fmu {

/// A new folder that only this user may enter. It is removed with its content at the end.
class PrivateFolder {
 public:
  PrivateFolder() = default;
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  /// Makes it in the folder for temporary files (TMPDIR, else /tmp). Throws Error.
  void create();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;  ///< empty: there is none
};

/// Limits for the unpacked content of an archive.
struct ArchiveLimits {
  std::uint64_t entries = 20'000;
  std::uint64_t file_bytes = std::uint64_t(1) << 29;  ///< one file
  std::uint64_t all_bytes = std::uint64_t(1) << 30;   ///< total of all files
  std::uint64_t description_bytes = 64u << 20;        ///< modelDescription.xml
};

/// The content of an FMU.
struct Archive {
  std::string description;             ///< bytes of modelDescription.xml
  std::vector<std::string> platforms;  ///< names of the folders in `binaries`, sorted
  bool has_resources = false;
};

/// Reads the FMU at `path`, a zip archive, and writes its folders `binaries/PLATFORM` and `resources` into `folder`.
/// Only checks the other files. Refuses names that lead out of the folder, links, and files larger than `limits`.
/// Throws Error.
Archive unpack(const std::string& path, const std::filesystem::path& folder, const std::vector<std::string>& platforms,
               const ArchiveLimits& limits = {});

}  // namespace muro::fmu
