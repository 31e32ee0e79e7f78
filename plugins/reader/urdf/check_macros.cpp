// SPDX-License-Identifier: MIT
#include "model.hpp"

namespace muro::urdf {

namespace {

/// Counts what only a macro processor understands: xacro's elements, and ${...} and $(...) in values.
class MacroFinder final : public tinyxml2::XMLVisitor {
 public:
  bool VisitEnter(const Element& element, const tinyxml2::XMLAttribute* attributes) override {
    const std::string_view name = element.Name();
    // plugins of other simulators may use such text for purposes of their own
    if (name == "gazebo" || name == "plugin" || name == "transmission") return false;
    if (name.starts_with("xacro:")) found(element, concat("<", name, ">"));
    for (const auto* a = attributes; a; a = a->Next()) {
      const std::string_view value = a->Value();
      const std::size_t begin = std::min(value.find("${"), value.find("$("));
      if (begin == value.npos) continue;
      const std::size_t end = value.find_first_of("})", begin);
      found(element, std::string(value.substr(begin, end == value.npos ? end : end + 1 - begin)));
    }
    return true;
  }

  std::size_t count = 0;
  Location location;
  std::string first;

 private:
  void found(const Element& element, const std::string& what) {
    if (count++ > 0) return;
    location = location_of(element);
    first = what;
  }
};

}  // namespace

bool has_macros(Element& robot, Problems& problems) {
  MacroFinder finder;
  robot.Accept(&finder);
  if (finder.count == 0) return false;
  problems.error(finder.location, concat("the file is xacro source, not URDF: ", quote(finder.first), " is left in",
                                         finder.count > 1 ? concat(", and ", finder.count - 1, " more") : std::string(),
                                         "; run `xacro FILE -o model.urdf` first and read model.urdf"));
  return true;
}

}  // namespace muro::urdf
