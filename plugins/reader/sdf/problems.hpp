// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "muro/robot_builder.hpp"
#include "plugins/common/model_file/say.hpp"

namespace muro::sdf {

using model_file::cited;
using model_file::listed;
using model_file::Place;
using model_file::say;

/// Where something stands: in the file that is read, or in one that it includes.
struct At {
  std::string file;  ///< empty: the file that is read
  Place place{};

  bool operator<(const At& b) const {
    return std::tie(file, place.line, place.column) < std::tie(b.file, b.place.line, b.place.column);
  }
  bool operator==(const At& b) const { return !(*this < b) && !(b < *this); }
  /// "12", or "wheel.sdf:12", for a list of places.
  std::string line() const { return file.empty() ? say(place.line) : say(file, ":", place.line); }
};

/// What is wrong with a file, on its way to the host, and whether the file is still of use.
class Problems {
 public:
  using Report = std::function<void(Severity, std::string_view, int line, int column)>;
  explicit Problems(Report report) : report_(std::move(report)) {}

  /// Nothing is lost, but the user may want to know.
  void note(const At& at, const std::string& text) { tell(Severity::note, at, text); }
  /// Something was left out or replaced; the text says by what.
  void warning(const At& at, const std::string& text) { tell(Severity::warning, at, text); }
  /// No robot can be made of it; the text says what is allowed.
  void error(const At& at, const std::string& text) {
    found_error_ = true;
    tell(Severity::error, at, text);
  }
  void tell(Severity severity, const At& at, const std::string& text) {
    if (at.file.empty()) return report_(severity, text, at.place.line, at.place.column);
    report_(severity, say("in ", at.file, ":", at.place.line, ":", at.place.column, ": ", text), 0, 0);
  }
  bool found_error() const { return found_error_; }

 private:
  Report report_;
  bool found_error_ = false;
};

}  // namespace muro::sdf
