// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace muro::test {

/// A line of models.txt.
struct ModelCase {
  std::string file;
  bool is_refused = false;
  int links = 0;                  ///< of the robot; for a world: objects of its scenery
  int models = 0;                 ///< for a world: models that could be robots
  std::vector<std::string> said;  ///< a part of each warning or error, with line and column; notes may be included
  bool is_world() const { return file.ends_with(".world"); }
};

std::string models_folder();
/// Returns all lines of models.txt. Throws std::runtime_error with a line that it cannot read.
std::vector<ModelCase> model_cases();

}  // namespace muro::test
