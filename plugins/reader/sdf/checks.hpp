// SPDX-License-Identifier: MIT
#pragma once

#include "known.hpp"
#include "source.hpp"

namespace muro::sdf {

/// Looks at every element of a file: what is not read is told and removed, so that libsdformat sees only what the
/// reader uses, with numbers that all parsers read alike, and includes and meshes under the paths of files.
void check(Source& source, Sources& sources, Problems& problems);

/// What the checks of one file share.
class Check {
 public:
  Check(Source& source, Sources& sources, Problems& problems)
      : source_(source), sources_(sources), problems_(problems) {}
  void run();

 private:
  // check.cpp: all elements alike
  void section(Element& e, std::string_view as);
  void attributes(Element& e, std::string_view section);
  void leaf(Element& e, const Known& known);
  void numbers(Element& e, std::size_t count, bool infinite);
  void leave_out(Element& e, const Known* known, std::string_view inside);
  void tell_left_out();
  At at(const Element& e) const { return source_.at(e); }

  // check_names.cpp: names within a model or world
  struct Scope {
    std::map<std::string, Element*> names;
    bool open = false;  ///< an include that is merged brings more names
    bool is_world = false;
  };
  bool named(Element& e, const char* what);
  void names(Element& model, Scope& scope);
  void references(Element& model, const Scope& scope);
  void reference(Element& e, const char* attribute, const Scope& scope);
  void known_name(const Element& e, const std::string& what, const std::string& name, const Scope& scope);

  // check_parts.cpp: what each kind of element needs
  void prepare(Element& e, std::string_view section);
  bool complete(Element& e, std::string_view section);
  bool complete_joint(Element& joint);
  void take_mimic(Element& joint, Element& axis, int number);
  bool complete_shape(Element& e);
  void find_picture(Element& workflow);
  std::string trouble_of_shape(Element& shape);
  bool complete_include(Element& include);
  void put_ground_plane(Element& include);

  struct LeftOut {
    Severity severity;
    std::string what, why;
    std::vector<At> places;
  };
  Source& source_;
  Sources& sources_;
  Problems& problems_;
  std::vector<LeftOut> left_out_;
};

/// The value of an attribute, or "".
inline std::string attribute(const Element& e, const char* name) {
  const char* text = e.Attribute(name);
  return text ? text : "";
}
/// The text within an element without the blanks around it, or "".
std::string text_of(const Element& e);
/// That of a child.
std::string child_text(Element& e, const char* name);

}  // namespace muro::sdf
