// SPDX-License-Identifier: MIT
#include "spawn.hpp"

#include <signal.h>
#include <spawn.h>

#include <algorithm>
#include <cerrno>
#include <string_view>

namespace muro {

namespace {

using File = ChildProcess::File;

/// Settings for posix_spawn.
class SpawnSettings {
 public:
  SpawnSettings() {
    posix_spawn_file_actions_init(&files_);
    posix_spawnattr_init(&attributes_);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    // in its own group: Ctrl-C is for the simulation
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  /// All numbers of `ours` must be above `highest`, because files are put in place one after the other.
  void give(const std::vector<File>& files, int highest) {
    const auto is_given = [&](int number) {
      return std::any_of(files.begin(), files.end(), [&](const File& f) { return f.number == number; });
    };
    if (!is_given(0)) posix_spawn_file_actions_addopen(&files_, 0, "/dev/null", O_RDONLY, 0);
    for (const File& f : files) posix_spawn_file_actions_adddup2(&files_, f.ours, f.number);
    for (int number = STDERR_FILENO + 1; number < highest; ++number)
      if (!is_given(number)) posix_spawn_file_actions_addclose(&files_, number);
    posix_spawn_file_actions_addclosefrom_np(&files_, highest + 1);
  }

  int spawn(const ChildProcess::Setup& setup, std::vector<std::string> environment, pid_t& pid) const {
    std::vector<std::string> words{setup.program.substr(setup.program.rfind('/') + 1)};  // npos + 1 is 0
    words.insert(words.end(), setup.arguments.begin(), setup.arguments.end());
    return posix_spawn(&pid, setup.program.c_str(), &files_, &attributes_, pointers(words).data(),
                       pointers(environment).data());
  }

 private:
  static std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& t : texts) all.push_back(t.data());
    all.push_back(nullptr);
    return all;
  }

  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

std::vector<std::string> environment_with(std::vector<std::string> entries) {
  const std::size_t replaced = entries.size();
  for (char** entry = environ; *entry; ++entry) {
    const std::string_view text = *entry, name = text.substr(0, text.find('=') + 1);
    const auto has_name = [&](const std::string& e) { return !name.empty() && e.starts_with(name); };
    if (std::none_of(entries.begin(), entries.begin() + long(replaced), has_name)) entries.emplace_back(text);
  }
  return entries;
}

}  // namespace

int spawn(const ChildProcess::Setup& setup, int socket, pid_t& pid) {
  std::vector<File> files = setup.files;
  files.push_back({socket, child_socket});
  int highest = 0;
  for (const File& f : files) highest = std::max(highest, f.number);
  std::vector<Descriptor> raised;
  for (File& f : files) {
    if (f.ours > highest) continue;
    f.ours = raised.emplace_back(fcntl(f.ours, F_DUPFD_CLOEXEC, highest + 1)).get();
    if (f.ours < 0) return errno;
  }
  SpawnSettings settings;
  settings.give(files, highest);
  return settings.spawn(setup, environment_with(setup.environment), pid);
}

}  // namespace muro
