// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "muro/robot_builder.hpp"
#include "plugins/common/model_file/say.hpp"

namespace muro::urdf {

using model_file::cited;
using model_file::listed;
using model_file::Place;
using model_file::say;
using model_file::shortest;

/// What is wrong with a model, on its way to the host, and whether the model is still of use.
class Problems {
 public:
  explicit Problems(RobotBuilder& builder) : builder_(builder) {}

  /// Nothing is lost, but the user may want to know.
  void note(Place at, std::string_view text) { builder_.report(Severity::note, text, at.line, at.column); }
  /// Something was left out or replaced; the text says by what.
  void warning(Place at, std::string_view text) { builder_.report(Severity::warning, text, at.line, at.column); }
  /// No robot can be made of the file; the text says what is allowed.
  void error(Place at, std::string_view text) {
    found_error_ = true;
    builder_.report(Severity::error, text, at.line, at.column);
  }
  bool found_error() const { return found_error_; }

 private:
  RobotBuilder& builder_;
  bool found_error_ = false;
};

}  // namespace muro::urdf
