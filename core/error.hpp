// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace muro {

/// Returns `text` as it is shown to a user, with its lines. Control characters are escaped. A text in backquotes that
/// is longer than a name or a path of a file is cut. A message may hold names from files that nothing has checked.
std::string message_text(std::string_view text);

/// Returns `name` in backquotes, on one line, cut when it is long: for names and values from outside.
std::string in_backquotes(std::string_view name);

/// A mistake of the user that was found before the simulation could run; one line for each problem.
class SetupError : public std::runtime_error {
 public:
  explicit SetupError(const std::string& message) : std::runtime_error(message_text(message)) {}
  explicit SetupError(const std::vector<std::string>& problems) : SetupError(joined(problems)) {}

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
  explicit StepError(const std::string& message) : std::runtime_error(message_text(message)) {}
};

}  // namespace muro
