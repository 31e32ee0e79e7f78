// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace muro::fmu {

/// A new folder that only this user may enter, removed with all that is in it at its end.
class PrivateFolder {
 public:
  PrivateFolder() = default;
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  /// In the folder for temporary files (TMPDIR, else /tmp). Throws Error.
  void create();
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;  ///< empty: there is none
};

/// What an archive may hold at most, unpacked.
struct ArchiveLimits {
  std::uint64_t entries = 20'000;
  std::uint64_t file_bytes = std::uint64_t(1) << 29;  ///< one file
  std::uint64_t all_bytes = std::uint64_t(1) << 30;   ///< all files together
  std::uint64_t description_bytes = 64u << 20;        ///< modelDescription.xml
};

/// What is in an FMU.
struct Archive {
  std::string description;             ///< the bytes of modelDescription.xml
  std::vector<std::string> platforms;  ///< the names of the folders in `binaries`, sorted
  bool has_resources = false;
};

/// Reads the FMU at `path`, a zip archive, and writes its folders `binaries/PLATFORM` and `resources` into `folder`;
/// the rest is only checked. Names that lead out of the folder, links and what is larger than `limits` are refused.
/// Throws Error.
Archive unpack(const std::string& path, const std::filesystem::path& folder, const std::vector<std::string>& platforms,
               const ArchiveLimits& limits = {});

}  // namespace muro::fmu
