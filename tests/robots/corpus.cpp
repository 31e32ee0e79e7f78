// SPDX-License-Identifier: MIT
#include "tests/robots/corpus.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "tests/robots/trial.hpp"

namespace muro::robots {

namespace {

using Clock = std::chrono::steady_clock;

/// Reads all that comes through `pipe` until its other end is closed; false: the time `end` came first.
bool read_until(Clock::time_point end, int pipe, std::string& text) {
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd waiting{pipe, POLLIN, 0};
    if (left <= 0 || poll(&waiting, 1, int(left)) == 0) return false;
    char buffer[4096];
    const ssize_t n = read(pipe, buffer, sizeof buffer);
    if (n > 0) text.append(buffer, std::size_t(n));
    if (n == 0) return true;
  }
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Returns the outcome: "fine", "odd", "refused" or "failed" as its first word.
std::string outcome_of(const Observations& seen) {
  if (!seen.refused.empty()) return "refused " + first_line(seen.refused);
  if (!seen.failure.empty()) return "failed " + first_line(seen.failure);
  std::ostringstream text;
  text << std::setprecision(3);
  if (seen.norm_error > 1e-9) text << "; orientation off unit by " << seen.norm_error;
  if (seen.limit_violation > 0.02)
    text << "; joint " << seen.violating_joint << " is " << seen.limit_violation << " outside of its limits";
  if (seen.deepest < -0.05) text << "; " << -seen.deepest << " m below the ground";
  const double energy_gain = std::max(seen.energy_gain, seen.late_energy_gain) / seen.energy_scale;
  if (energy_gain > 0.02) text << "; gains energy, " << energy_gain << " m of height";
  return text.str().empty() ? "fine " : "odd " + text.str().substr(2);
}

/// Returns the worse of two outcomes.
std::string worse(const std::string& a, const std::string& b) {
  const auto rank = [](const std::string& s) {
    constexpr std::string_view order[] = {"fine", "odd", "refused", "failed"};
    return std::find(std::begin(order), std::end(order), s.substr(0, s.find(' '))) - std::begin(order);
  };
  return rank(a) >= rank(b) ? a : b;
}

}  // namespace

Isolated isolated(const std::function<std::string()>& work, double limit) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {true, false, "no pipe"};
  const pid_t child = fork();
  if (child < 0) return {true, false, "no process"};
  if (child == 0) {
    close(ends[0]);
    std::string text;
    try {
      text = work();
    } catch (const std::exception& e) {
      text = std::string("failed by an exception: ") + e.what();
    }
    for (std::size_t sent = 0; sent < text.size();) {
      const ssize_t n = write(ends[1], text.data() + sent, text.size() - sent);
      if (n <= 0) _exit(2);
      sent += std::size_t(n);
    }
    _exit(0);
  }
  close(ends[1]);
  Isolated result;
  result.too_long =
      !read_until(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limit)),
                  ends[0], result.text);
  if (result.too_long) kill(child, SIGKILL);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (result.too_long) {
    std::ostringstream text;
    text << "failed: not done after " << limit << " s";
    result.text = text.str();
  } else if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    result.crashed = true;
    result.text = "failed: crashed, " + (WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                                             : "exit " + std::to_string(WEXITSTATUS(status)));
  }
  return result;
}

CorpusCount run_corpus(const std::string& folder, double duration, double limit, std::ostream& out) {
  CorpusCount count;
  for (const std::string& file : descriptions_below(folder))
    for (const std::string& motion : motions()) {
      const Isolated result = isolated(
          [&] {
            std::string outcome = "fine ";
            for (const bool passive : {false, true})
              outcome = worse(outcome, outcome_of(run({file, motion, false, passive, duration})));
            return outcome;
          },
          limit);
      const std::string word = result.text.substr(0, result.text.find_first_of(" :"));
      const std::string rest = result.text.substr(std::min(result.text.size(), word.size() + 1));
      ++(word == "fine" ? count.fine : word == "refused" ? count.refused : word == "odd" ? count.odd : count.failed);
      out << std::left << std::setw(8) << word << std::setw(18) << motion
          << std::filesystem::path(file).lexically_relative(folder).string() << (rest.empty() ? "" : "  ") << rest
          << std::endl;
    }
  out << count.fine << " fine, " << count.odd << " odd, " << count.refused << " refused, " << count.failed
      << " failed\n";
  return count;
}

}  // namespace muro::robots
