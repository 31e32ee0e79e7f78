// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/scenario/node.hpp"

namespace muro::host {

/// The source of a text. Locations have lines and columns in a file, but not on the command line.
struct TextSource {
  std::string name;
  bool is_file;
};

/// Counts the values of a scenario. A short text can expand to very many values, by aliases of aliases and by files
/// that are included many times.
class ValueCount {
 public:
  /// Throws SetupError when there are more than are allowed in a scenario.
  void add(std::size_t values, const Location& at);

 private:
  std::size_t values_ = 0;
};

/// Parses one YAML document; includes are not resolved. Throws SetupError with file:line:column.
Node parse_tree(const std::string& text, const TextSource& source, ValueCount& count);

}  // namespace muro::host
