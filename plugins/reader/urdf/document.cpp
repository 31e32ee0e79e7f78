// SPDX-License-Identifier: MIT
#include "document.hpp"

#include "plugins/common/model_file/numbers.hpp"

namespace muro::urdf {

bool Document::parse(const std::string& text, Problems& problems) {
  Place place;
  std::string trouble;
  if (!file_.parse(text, place, trouble)) {
    problems.error(place, trouble);
    return false;
  }
  Element* root = file_.root();
  robot_ = root && std::string_view(root->Name()) != "robot" ? root->NextSiblingElement("robot") : root;
  if (robot_) return true;
  problems.error(root ? place_of(*root) : Place{},
                 say("the file holds no <robot> element", root ? say(", but ", cited(root->Name())) : std::string(),
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
    problems.warning(place_of(*found[1]),
                     say(owner, " has ", found.size(), " <", name, "> elements; only the first one counts"));
  for (std::size_t i = 1; i < found.size(); ++i) remove(*found[i]);
  return found.front();
}

std::optional<std::vector<double>> numbers(Element& element, const char* attribute, std::size_t count,
                                           const std::string& owner, Problems& problems) {
  const char* text = element.Attribute(attribute);
  if (!text) return std::nullopt;
  std::string trouble;
  auto values = model_file::parse_numbers(text, trouble);
  if (trouble.empty() && values.size() != count)
    trouble = say("has ", values.size(), values.size() == 1 ? " number" : " numbers", ", and needs ", count,
                  count == 1 ? "" : " separated by blanks");
  if (!trouble.empty()) {
    problems.error(place_of(element),
                   say(owner, ", <", element.Name(), " ", attribute, ">: ", cited(text), " ", trouble));
    return std::nullopt;
  }
  std::string rewritten;
  for (const double v : values) rewritten += (rewritten.empty() ? "" : " ") + shortest(v);
  element.SetAttribute(attribute, rewritten.c_str());
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
