// SPDX-License-Identifier: MIT
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>
#include <vector>

#include "muro/geometry.hpp"
#include "problems.hpp"

namespace muro::urdf {

using Element = tinyxml2::XMLElement;

/// The file as a tree of elements that knows where each of them stands.
class Document {
 public:
  /// False, with an error reported, when `text` is not well-formed or holds no <robot>.
  bool parse(const std::string& text, Problems& problems);
  /// The <robot> element; valid after parse returned true.
  Element& robot() { return *robot_; }
  /// The <robot> element as text.
  std::string printed() const;

 private:
  tinyxml2::XMLDocument xml_;
  std::vector<Place> places_;
  Element* robot_ = nullptr;
};

/// Where the element begins.
Place place_of(const Element& element);

/// The children named `name`, collected first, so that they may be deleted in a loop over them.
std::vector<Element*> children(Element& parent, const char* name);

/// The only child named `name`, or null. More than one: a warning, and all but the first are deleted,
/// as urdfdom looks at no others. `owner` is who the message names: "link `wheel`".
Element* only_child(Element& parent, const char* name, const std::string& owner, Problems& problems);

void remove(Element& element);

/// The value of an attribute that is one finite number, which is then rewritten in a form that every
/// parser reads alike. Nothing when the attribute is missing, or is no number; the latter is an error.
std::optional<double> number(Element& element, const char* attribute, const std::string& owner, Problems& problems);
/// As `number`, for `count` numbers separated by blanks.
std::optional<std::vector<double>> numbers(Element& element, const char* attribute, std::size_t count,
                                           const std::string& owner, Problems& problems);
void set(Element& element, const char* attribute, double value);

}  // namespace muro::urdf
