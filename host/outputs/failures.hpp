// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>

namespace muro::host {

/// Lets everything be tried that is left to do after a failure, and keeps what went wrong: the first cause first, a
/// line for each, nothing twice.
class Failures {
 public:
  /// `text`: where they are kept; may hold one already.
  explicit Failures(std::string& text) : text_(text) {}

  template <class Work>
  void guard(const Work& work) {
    try {
      work();
    } catch (const std::exception& e) {
      if (text_.find(e.what()) == std::string::npos) text_ += (text_.empty() ? "" : "\n") + std::string(e.what());
    }
  }

 private:
  std::string& text_;
};

}  // namespace muro::host
