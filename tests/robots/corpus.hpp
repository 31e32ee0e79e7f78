// SPDX-License-Identifier: MIT
// Runs unknown descriptions, each in a process of its own, with a time limit.
#pragma once

#include <functional>
#include <ostream>
#include <string>

namespace muro::robots {

/// Result of work in a process of its own.
struct Isolated {
  bool crashed = false;   ///< by a signal, or by an exit without returning
  bool too_long = false;  ///< it was stopped at the limit
  std::string text;       ///< what the work returned, or the reason of the crash
};
/// Runs `work` in a child of this process for at most `limit` (s).
Isolated isolated(const std::function<std::string()>& work, double limit);

struct CorpusCount {
  int fine = 0;
  int refused = 0;  ///< with a message
  int odd = 0;      ///< ran, but beyond a bound: energy, limits of joints, below the ground
  int failed = 0;   ///< crashed, not finite, or took too long
};

/// Runs every .urdf in `folder` and below in every motion for `duration` (s): base free, joints passive and then in
/// their default mode. Writes a table to `out`: outcome, motion, file, and observations.
CorpusCount run_corpus(const std::string& folder, double duration, double limit, std::ostream& out);

}  // namespace muro::robots
