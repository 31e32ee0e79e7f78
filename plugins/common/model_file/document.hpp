// SPDX-License-Identifier: MIT
#pragma once

#include <tinyxml2.h>

#include <string>
#include <vector>

#include "problems.hpp"

namespace muro::model_file {

using Element = tinyxml2::XMLElement;

/// An XML file as a tree of elements that knows where each of them stands.
class Document {
 public:
  /// False, with the error and where it is, when `text` is not well-formed.
  bool parse(const std::string& text, Location& location, std::string& error);
  /// Null when there is none.
  Element* root() { return xml_.RootElement(); }
  std::size_t element_count() const { return locations_.size(); }

 private:
  tinyxml2::XMLDocument xml_;
  std::vector<Location> locations_;
};

/// Where the element begins; nowhere for one that was added later.
Location location_of(const Element& element);

/// The children named `name` (null: all), collected first, so that they may be deleted in a loop over them.
std::vector<Element*> children(Element& parent, const char* name = nullptr);

}  // namespace muro::model_file
