// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <tuple>
#include <utility>

#include "message.hpp"
#include "muro/robot_builder.hpp"

namespace muro::model_file {

/// Location in a file; lines and columns count from 1, and are 0 when unknown.
struct Location {
  int line = 0;
  int column = 0;
};

/// Location in the file that is read, or in one that it includes.
struct FileLocation {
  std::string file;  ///< empty: the file that is read
  int line = 0;
  int column = 0;

  FileLocation() = default;
  FileLocation(Location l) : line(l.line), column(l.column) {}
  FileLocation(std::string in_file, Location l) : file(std::move(in_file)), line(l.line), column(l.column) {}

  bool operator<(const FileLocation& b) const {
    return std::tie(file, line, column) < std::tie(b.file, b.line, b.column);
  }
  /// Returns "12", or "wheel.sdf:12", for a list of locations.
  std::string line_text() const { return file.empty() ? concat(line) : concat(file, ":", line); }
};

/// Reports problems of a model to the host, and keeps whether the model is still usable.
class Problems {
 public:
  using Report = std::function<void(Severity, std::string_view, int line, int column)>;
  explicit Problems(Report report) : report_(std::move(report)) {}
  /// Returns an object that reports to a RobotBuilder or a WorldBuilder.
  template <class Builder>
  static Problems reported_to(Builder& builder) {
    return Problems([&builder](Severity severity, std::string_view text, int line, int column) {
      builder.report(severity, text, line, column);
    });
  }

  /// Reports something that the user may want to know, while the robot is what the file describes.
  void note(const FileLocation& at, const std::string& text) { report(Severity::note, at, text); }
  /// Reports something that was omitted or replaced; the text says by what.
  void warning(const FileLocation& at, const std::string& text) { report(Severity::warning, at, text); }
  /// Reports that no robot can be made of the file; the text says what is allowed.
  void error(const FileLocation& at, const std::string& text) { report(Severity::error, at, text); }
  void report(Severity severity, const FileLocation& at, const std::string& text) {
    found_error_ = found_error_ || severity == Severity::error;
    if (at.file.empty()) return report_(severity, text, at.line, at.column);
    report_(severity, concat("in ", at.file, ":", at.line, ":", at.column, ": ", text), 0, 0);
  }
  bool found_error() const { return found_error_; }

 private:
  Report report_;
  bool found_error_ = false;
};

}  // namespace muro::model_file
