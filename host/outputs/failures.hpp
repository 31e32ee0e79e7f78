// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <string>

namespace muro::host {

/// Carries out everything that remains to be done after a failure, and keeps the error texts: the first cause first,
/// one line for each, each once.
class Failures {
 public:
  /// `text`: receives the error texts; may hold one already.
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
