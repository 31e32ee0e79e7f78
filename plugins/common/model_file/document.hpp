// SPDX-License-Identifier: MIT
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "problems.hpp"

namespace muro::model_file {

using Element = tinyxml2::XMLElement;

/// An XML file as a tree of elements, with the location of each element.
class Document {
 public:
  /// Parses a text. Returns false, with the error and its location, if `text` is not well-formed.
  bool parse(const std::string& text, Location& location, std::string& error);
  /// Returns the root element; null if there is none.
  Element* root() { return xml_.RootElement(); }
  std::size_t element_count() const { return locations_.size(); }

 private:
  tinyxml2::XMLDocument xml_;
  std::vector<Location> locations_;
};

/// Returns where the element begins; nowhere for an element that was added later.
Location location_of(const Element& element);

/// Returns the children named `name` (null: all). They are collected first, so that a loop over them may delete them.
std::vector<Element*> children(Element& parent, const char* name = nullptr);

}  // namespace muro::model_file
