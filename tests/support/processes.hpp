// SPDX-License-Identifier: MIT
// Other processes, as /proc reports them.
#pragma once

#include <dirent.h>
#include <sys/types.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace muro::test {

struct ProcessState {
  char letter = 'X';  ///< X: it does not exist, Z: it has ended, and its parent has not waited for it
  pid_t parent = 0;
};

inline ProcessState state_of_process(pid_t pid) {
  char line[1024];
  std::size_t length = 0;
  // not by a stream, which throws if the process disappears meanwhile
  if (std::FILE* const file = std::fopen(("/proc/" + std::to_string(pid) + "/stat").c_str(), "r")) {
    length = std::fread(line, 1, sizeof line, file);
    std::fclose(file);
  }
  const std::string text(line, length);
  const std::size_t end = text.rfind(')');  // after the name
  ProcessState state;
  if (end != std::string::npos) std::sscanf(text.c_str() + end + 1, " %c %d", &state.letter, &state.parent);
  return state;
}

inline bool is_running(pid_t pid) {
  const char letter = state_of_process(pid).letter;
  return letter != 'X' && letter != 'Z';
}

/// Waits up to 10 s until the state of the process is one of these letters.
inline bool comes_to(pid_t pid, std::string_view letters) {
  const auto is_there = [&] { return letters.find(state_of_process(pid).letter) != std::string_view::npos; };
  for (int i = 0; i < 1000 && !is_there(); ++i) usleep(10'000);
  return is_there();
}
inline bool ends_soon(pid_t pid) { return comes_to(pid, "XZ"); }

/// Returns the processes that this process has started, also those that have ended and were not waited for.
inline std::vector<pid_t> child_processes() {
  std::vector<pid_t> found;
  DIR* const all = opendir("/proc");
  while (const dirent* const entry = all ? readdir(all) : nullptr) {
    const pid_t pid = std::atoi(entry->d_name);
    if (pid > 0 && state_of_process(pid).parent == getpid()) found.push_back(pid);
  }
  if (all) closedir(all);
  return found;
}

}  // namespace muro::test
