// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "muro/geometry.hpp"
#include "plugins/common/model_file/document.hpp"
#include "plugins/common/model_file/problems.hpp"

namespace muro::urdf {

using model_file::children;
using model_file::concat;
using model_file::Element;
using model_file::Location;
using model_file::location_of;
using model_file::Problems;
using model_file::shortest;

/// A file that holds a <robot>.
class Document {
 public:
  /// Reports an error and returns false if `text` is not well-formed or holds no <robot>.
  bool parse(std::string text, Problems& problems);
  /// The <robot> element; valid after parse returned true.
  Element& robot() { return *robot_; }
  /// Returns the <robot> element as text.
  std::string printed() const;

 private:
  model_file::Document file_;
  Element* robot_ = nullptr;
};

/// Returns the first child named `name`, or null. If there are several, warns and deletes the others, as urdfdom reads
/// only the first. `owner`: name of the parent in the message: "link `wheel`".
Element* only_child(Element& parent, const char* name, const std::string& owner, Problems& problems);

void remove(Element& element);

/// Returns a receiver that passes problems on to `problems`, with errors changed to severity `as` and followed by
/// `consequence`. Its found_error() returns whether there were errors.
Problems softened(Problems& problems, const std::string& consequence, Severity as = Severity::warning);

/// Returns the value of an attribute that is one finite number, and rewrites it so that all parsers read it alike.
/// Returns nothing if the attribute is missing or is no number; the latter is an error.
std::optional<double> number(Element& element, const char* attribute, const std::string& owner, Problems& problems);
/// Reads `count` numbers separated by blanks, see `number`.
std::optional<std::vector<double>> numbers(Element& element, const char* attribute, std::size_t count,
                                           const std::string& owner, Problems& problems);
void set(Element& element, const char* attribute, double value);

}  // namespace muro::urdf
