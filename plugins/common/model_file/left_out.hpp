// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "problems.hpp"

namespace muro::model_file {

/// Elements of a file that are not used. The same element in several places is one message.
class LeftOut {
 public:
  /// `element`: as the message names it, "`<sensor>` in `<link>`"; `reason` ends the sentence.
  void add(Severity severity, const std::string& element, const std::string& reason, FileLocation at);
  /// Tells all, in the order in which they were found, each with its lines; then forgets them.
  void report(Problems& problems);

 private:
  struct Kind {
    Severity severity;
    std::string element, reason;
    std::vector<FileLocation> locations;
  };
  std::vector<Kind> kinds_;
};

}  // namespace muro::model_file
