// SPDX-License-Identifier: MIT
#include "model.hpp"

namespace muro::urdf {

namespace {

bool is_macro(const Element& element) { return std::string_view(element.Name()).starts_with("xacro:"); }

/// Finds text that only a macro processor understands: xacro's elements, and ${...} and $(...) in values.
class MacroFinder final : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const Element& element, const tinyxml2::XMLAttribute* attributes) override {
    const std::string_view name = element.Name();
    // plugins of other simulators may use such text for their own purposes
    if (name == "gazebo" || name == "plugin" || name == "transmission") return false;
    if (is_macro(element)) {
      elements.push_back(&element);
      return false;
    }
    for (const auto* a = attributes; a; a = a->Next()) {
      const std::string_view value = a->Value();
      const std::size_t begin = std::min(value.find("${"), value.find("$("));
      // a mesh of this name is reported as not found
      if (begin == value.npos || std::string_view(a->Name()) == "filename") continue;
      const std::size_t end = value.find_first_of("})", begin);
      if (expressions++ > 0) continue;
      first = value.substr(begin, end == value.npos ? end : end + 1 - begin);
      location = location_of(element);
    }
    return true;
  }

  std::vector<const Element*> elements;
  std::size_t expressions = 0;
  std::string first;  ///< first expression
  Location location;  ///< location of the first expression
};

constexpr char advice[] = "run `xacro FILE -o model.urdf` (of ROS, or from `pip install xacro`) and read model.urdf";

}  // namespace

bool take_macros(Element& robot, Problems& problems) {
  MacroFinder finder;
  robot.Accept(&finder);
  if (finder.expressions == 0 && finder.elements.empty()) return true;
  const auto and_more = [](std::size_t count) {
    return count > 1 ? concat(", and ", count - 1, " more") : std::string();
  };
  if (finder.expressions > 0 || !robot.FirstChildElement("link")) {
    const bool element = finder.expressions == 0;
    problems.error(element ? location_of(*finder.elements.front()) : finder.location,
                   concat("the file is xacro source, not URDF: ",
                          quote(element ? concat("<", finder.elements.front()->Name(), ">") : finder.first),
                          " is left in", and_more(finder.expressions + finder.elements.size()), "; ", advice));
    return false;
  }
  problems.warning(
      location_of(*finder.elements.front()),
      concat(quote(concat("<", finder.elements.front()->Name(), ">")), " of xacro is left in",
             and_more(finder.elements.size()), "; it is left out. If what it stands for is missing, ", advice));
  for (const Element* e : finder.elements) remove(const_cast<Element&>(*e));
  return true;
}

}  // namespace muro::urdf
