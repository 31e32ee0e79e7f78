// SPDX-License-Identifier: MIT
#include "document.hpp"

namespace muro::model_file {

namespace {

/// Finds the start tags of a well-formed text, in order.
class TagScanner {
 public:
  explicit TagScanner(std::string_view text) : text_(text) {}

  /// Finds the location of the next start tag and its name. Returns false at the end.
  bool next(Location& location, std::string_view& name) {
    while (true) {
      const std::size_t open = text_.find('<', at_);
      if (open == std::string_view::npos) return false;
      advance(open);
      const std::string_view rest = text_.substr(open);
      if (rest.starts_with("<!--")) {
        skip_past("-->");
      } else if (rest.starts_with("<![CDATA[")) {
        skip_past("]]>");
      } else if (rest.starts_with("<?")) {
        skip_past("?>");
      } else if (rest.starts_with("<!") || rest.starts_with("</")) {
        skip_past(">");
      } else {
        location = {line_, int(open - line_start_) + 1};
        name = rest.substr(1, rest.find_first_of(" \t\r\n/>", 1) - 1);
        skip_tag();
        return true;
      }
    }
  }

 private:
  void advance(std::size_t to) {
    for (; at_ < to; ++at_) {
      if (text_[at_] != '\n') continue;
      ++line_;
      line_start_ = at_ + 1;
    }
  }
  void skip_past(std::string_view end) {
    const std::size_t found = text_.find(end, at_);
    advance(found == std::string_view::npos ? text_.size() : found + end.size());
  }
  /// Moves past the `>` that closes the tag; a `>` within quotes does not.
  void skip_tag() {
    char quote = 0;
    std::size_t i = at_;
    for (; i < text_.size(); ++i) {
      const char c = text_[i];
      if (quote != 0) {
        if (c == quote) quote = 0;
      } else if (c == '"' || c == '\'') {
        quote = c;
      } else if (c == '>') {
        break;
      }
    }
    advance(i);
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

/// Visits elements in the order of their start tags.
class LocationMarker final : public tinyxml2::XMLVisitor {
 public:
  LocationMarker(std::string_view text, std::vector<Location>& places) : scanner_(text), locations_(places) {}

  bool VisitEnter(const Element& element, const tinyxml2::XMLAttribute*) override {
    Location location;
    std::string_view name;
    in_step_ = in_step_ && scanner_.next(location, name) && name == element.Name();
    locations_[count_] = in_step_ ? location : Location{element.GetLineNum(), 0};
    const_cast<Element&>(element).SetUserData(&locations_[count_++]);
    return true;
  }

 private:
  TagScanner scanner_;
  std::vector<Location>& locations_;
  std::size_t count_ = 0;
  bool in_step_ = true;
};

class ElementCounter final : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const Element&, const tinyxml2::XMLAttribute*) override {
    ++count;
    return true;
  }
  std::size_t count = 0;
};

std::string_view meaning_of(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "a closing tag does not match the element that is open";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "an element's tag is not written correctly";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not written as name=\"value\", or stands twice";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment <!-- is not closed by -->";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
      return "a section <![CDATA[ is not closed by ]]>";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
      return "text is not followed by a closing tag";
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
      return "a declaration <?xml ... ?> stands out of place or is not closed";
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a <!...> section is not closed";
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "there is no element";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested more than 100 deep";
    default:
      return "an element is not closed";
  }
}

}  // namespace

bool Document::parse(const std::string& text, Location& location, std::string& error) {
  if (const auto code = xml_.Parse(text.data(), text.size()); code != tinyxml2::XML_SUCCESS) {
    location = {xml_.ErrorLineNum(), 0};
    error = concat("the file is not well-formed XML: ", meaning_of(code));
    return false;
  }
  ElementCounter counter;
  xml_.Accept(&counter);
  locations_.resize(counter.count);
  LocationMarker marker(text, locations_);
  xml_.Accept(&marker);
  return true;
}

Location location_of(const Element& element) {
  const auto* location = static_cast<const Location*>(element.GetUserData());
  return location ? *location : Location{};
}

std::vector<Element*> children(Element& parent, const char* name) {
  std::vector<Element*> found;
  for (Element* e = parent.FirstChildElement(name); e; e = e->NextSiblingElement(name)) found.push_back(e);
  return found;
}

}  // namespace muro::model_file
