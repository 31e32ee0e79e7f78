// SPDX-License-Identifier: MIT
#include "document.hpp"

#include <algorithm>

#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/model_file/ranges.hpp"

namespace muro::urdf {

namespace {

Location location_at(const std::string& text, std::size_t index) {
  const auto lines = std::count(text.begin(), text.begin() + std::ptrdiff_t(index), '\n');
  return {int(lines) + 1, int(index - (text.rfind('\n', index) + 1)) + 1};  // npos + 1 is 0
}

/// Replaces by blanks each declaration <?xml ... ?> that is not at the very beginning of the file, for example after a
/// comment of a macro processor. ROS accepts them.
void blank_stray_declarations(std::string& text, Problems& problems) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  for (std::size_t at = text.find("<?xml "); at != text.npos; at = text.find("<?xml ", at + 1)) {
    if (at == start) continue;
    const std::size_t end = text.find("?>", at);
    if (end == text.npos) return;
    problems.note(location_at(text, at),
                  "the declaration <?xml ... ?> is ignored here; it belongs at the very beginning of the file");
    for (std::size_t i = at; i < end + 2; ++i)
      if (text[i] != '\n') text[i] = ' ';
  }
}

/// Removes text after the robot, which ROS does not read.
void cut_text_behind(std::string& text, Problems& problems) {
  constexpr std::string_view end = "</robot>";
  const std::size_t at = text.rfind(end);
  if (at == text.npos) return;
  const std::size_t behind = text.find_first_not_of(" \t\r\n", at + end.size());
  if (behind == text.npos || text[behind] == '<') return;
  problems.warning(location_at(text, behind), "the text behind </robot> is left out");
  text.resize(at + end.size());
}

}  // namespace

bool Document::parse(std::string text, Problems& problems) {
  Location location;
  std::string error;
  blank_stray_declarations(text, problems);
  cut_text_behind(text, problems);
  if (!file_.parse(text, location, error)) {
    problems.error(location, error);
    return false;
  }
  Element* root = file_.root();
  robot_ = root && std::string_view(root->Name()) != "robot" ? root->NextSiblingElement("robot") : root;
  if (robot_) return true;
  problems.error(
      root ? location_of(*root) : Location{},
      concat("the file holds no <robot> element", root ? concat(", but ", quote(root->Name())) : std::string(),
             "; a URDF file is <robot name=\"...\"> with links and joints"));
  return false;
}

std::string Document::printed() const {
  tinyxml2::XMLPrinter printer(nullptr, true);
  robot_->Accept(&printer);
  return printer.CStr();
}

Problems softened(Problems& problems, const std::string& consequence, Severity as) {
  return Problems([&problems, consequence, as](Severity severity, std::string_view text, int line, int column) {
    const bool error = severity == Severity::error;
    problems.report(error ? as : severity, Location{line, column}, concat(text, error ? "; " + consequence : ""));
  });
}

void remove(Element& element) { element.Parent()->DeleteChild(&element); }

Element* only_child(Element& parent, const char* name, const std::string& owner, Problems& problems) {
  const std::vector<Element*> found = children(parent, name);
  if (found.empty()) return nullptr;
  if (found.size() > 1)
    problems.warning(location_of(*found[1]),
                     concat(owner, " has ", found.size(), " <", name, "> elements; only the first one counts"));
  for (std::size_t i = 1; i < found.size(); ++i) remove(*found[i]);
  return found.front();
}

std::optional<std::vector<double>> numbers(Element& element, const char* attribute, std::size_t count,
                                           const std::string& owner, Problems& problems) {
  const char* text = element.Attribute(attribute);
  if (!text) return std::nullopt;
  std::string error;
  auto values = model_file::parse_numbers(text, count, error);
  const bool is_value = std::string_view(attribute) == "value";  // <mass value="..."/>
  const char* const quantity = is_value ? element.Name() : attribute;
  if (values) {
    model_file::drop_tiny_sizes(quantity, *values);
    error = model_file::range_problem(quantity, *values);
  }
  if (!error.empty()) {
    problems.error(location_of(element),
                   concat(owner, ", <", element.Name(), " ", attribute, ">: ", quote(text), " ", error));
    return std::nullopt;
  }
  element.SetAttribute(attribute, model_file::text_of(*values).c_str());
  return values;
}

std::optional<double> number(Element& element, const char* attribute, const std::string& owner, Problems& problems) {
  const auto values = numbers(element, attribute, 1, owner, problems);
  if (!values) return std::nullopt;
  return values->front();
}

void set(Element& element, const char* attribute, double value) {
  element.SetAttribute(attribute, shortest(value).c_str());
}

}  // namespace muro::urdf
