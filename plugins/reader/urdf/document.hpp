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
  /// False, with an error reported, when `text` is not well-formed or holds no <robot>.
  bool parse(std::string text, Problems& problems);
  /// The <robot> element; valid after parse returned true.
  Element& robot() { return *robot_; }
  /// The <robot> element as text.
  std::string printed() const;

 private:
  model_file::Document file_;
  Element* robot_ = nullptr;
};

/// The only child named `name`, or null. More than one: a warning, and all but the first are deleted,
/// as urdfdom looks at no others. `owner` is who the message names: "link `wheel`".
Element* only_child(Element& parent, const char* name, const std::string& owner, Problems& problems);

void remove(Element& element);

/// Problems to `problems`, with errors `as` something milder that ends in `consequence`; found_error() tells whether
/// there were any.
Problems softened(Problems& problems, const std::string& consequence, Severity as = Severity::warning);

/// The value of an attribute that is one finite number, which is then rewritten in a form that every
/// parser reads alike. Nothing when the attribute is missing, or is no number; the latter is an error.
std::optional<double> number(Element& element, const char* attribute, const std::string& owner, Problems& problems);
/// As `number`, for `count` numbers separated by blanks.
std::optional<std::vector<double>> numbers(Element& element, const char* attribute, std::size_t count,
                                           const std::string& owner, Problems& problems);
void set(Element& element, const char* attribute, double value);

}  // namespace muro::urdf
