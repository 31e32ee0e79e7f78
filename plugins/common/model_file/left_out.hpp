// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "problems.hpp"

namespace muro::model_file {

/// Elements of a file that are not used. If an element is in several places, there is one message.
class LeftOut {
 public:
  /// `element`: its name in the message, such as "`<sensor>` in `<link>`"; `reason` ends the sentence.
  void add(Severity severity, const std::string& element, const std::string& reason, FileLocation at);
  /// Reports all in the order in which they were found, each with its lines. Then forgets them.
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
