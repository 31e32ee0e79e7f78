// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace muro {

/// A mistake of the user that was found before the simulation could run: one line for each problem.
class SetupError : public std::runtime_error {
 public:
  explicit SetupError(const std::string& message) : std::runtime_error(message) {}
  explicit SetupError(const std::vector<std::string>& problems) : std::runtime_error(joined(problems)) {}

 private:
  static std::string joined(const std::vector<std::string>& problems) {
    std::string all;
    for (const std::string& p : problems) all += (all.empty() ? "" : "\n") + p;
    return all;
  }
};

/// A failure inside a step, with algorithm, object and simulated time in its text.
class StepError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace muro
