// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"

namespace muro {

/// Lets several steps of the set-up fail, so that all their problems are reported at once.
class CollectedProblems {
 public:
  /// Runs `work`. Returns whether it succeeded.
  template <class Work>
  bool run(Work work) {
    try {
      work();
    } catch (const SetupError& e) {
      problems_.emplace_back(e.what());
      return false;
    }
    return true;
  }
  void check() const {
    if (!problems_.empty()) throw SetupError(problems_);
  }

 private:
  std::vector<std::string> problems_;
};

}  // namespace muro
