// SPDX-License-Identifier: MIT
#include "document.hpp"

#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/model_file/ranges.hpp"

namespace muro::urdf {

bool Document::parse(const std::string& text, Problems& problems) {
  Location location;
  std::string error;
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
  const bool is_value = std::string_view(attribute) == "value";  // of <mass value="..."/>
  if (values) error = model_file::range_problem(is_value ? element.Name() : attribute, *values);
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
