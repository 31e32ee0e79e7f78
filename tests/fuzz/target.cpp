// SPDX-License-Identifier: MIT
#include "tests/fuzz/target.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace muro::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all{{"scenario", read_as_scenario},
                                       {"urdf", read_as_urdf},
                                       {"sdf", read_as_sdf},
                                       {"mesh", read_as_mesh},
                                       {"picture", read_as_picture},
                                       {"description", read_as_description},
                                       {"controller", read_as_controller},
                                       {"jsonrpc", read_as_jsonrpc},
#ifdef MURO_FUZZ_FMU
                                       {"fmu", read_as_fmu},
#endif
#ifdef MURO_FUZZ_MJCF
                                       {"mjcf", read_as_mjcf},
#endif
                                       {"library", read_as_library},
                                       {"lines", read_as_lines},
                                       {"frames", read_as_frames},
                                       {"part", read_as_part},
                                       {"scip2", read_as_scip2}};
  return all;
}

namespace {

/// Counters of our own, which libFuzzer reads like its own.
__attribute__((used, section("__libfuzzer_extra_counters"))) volatile std::uint8_t outcomes[1 << 12];

/// A folder that is removed at the end of the process that made it.
class Folder {
 public:
  Folder() {
    namespace fs = std::filesystem;
    std::error_code none;
    std::string pattern = fs::is_directory("/dev/shm", none)
                              ? "/dev/shm/muro-fuzz-XXXXXX"
                              : (fs::temp_directory_path() / "muro-fuzz-XXXXXX").string();
    require(mkdtemp(pattern.data()) != nullptr, "a folder cannot be made");
    path_ = pattern;
  }
  ~Folder() {
    std::error_code none;
    if (getpid() == owner_) std::filesystem::remove_all(path_, none);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  pid_t owner_ = getpid();
  std::string path_;
};

}  // namespace

std::string file_with(Bytes bytes, const std::string& name) {
  static const Folder folder;
  const std::string path = folder.path() + "/" + name;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  return path;
}

void outcome(std::string_view text) {
  require(!text.empty(), "an error has no text");
  std::uint32_t hash = 2166136261u;
  bool quoted = false, in_path = false;
  for (const char c : text.substr(0, 2000)) {
    if (c == '`') quoted = !quoted;
    in_path = c == '/' || (in_path && c != ' ');
    if (!quoted && !in_path && (c < '0' || c > '9')) hash = (hash ^ std::uint8_t(c)) * 16777619u;
  }
  outcomes[hash % std::size(outcomes)] = 1;
}

void require(bool fine, const char* text) {
  if (fine) return;
  std::fprintf(stderr, "fuzz: %s\n", text);
  std::abort();
}

}  // namespace muro::fuzz
