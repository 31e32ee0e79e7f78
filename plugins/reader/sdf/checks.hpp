// SPDX-License-Identifier: MIT
#pragma once

#include <set>

#include "plugins/common/model_file/left_out.hpp"
#include "plugins/common/model_file/missing_meshes.hpp"
#include "schema.hpp"
#include "source_file.hpp"

namespace muro::sdf {

/// Checks every element of a file. Reports and removes unsupported elements, so that libsdformat reads only the
/// elements in use. Writes numbers that all parsers read alike, and the paths of included files and meshes.
void check(SourceFile& source, SourceFiles& sources, Problems& problems);

/// Common state of the checks of one file.
class Check {
 public:
  Check(SourceFile& source, SourceFiles& sources, Problems& problems)
      : source_(source), sources_(sources), problems_(problems) {}
  void run();

 private:
  // check.cpp: checks of all elements
  void section(Element& e, std::string_view as);
  void attributes(Element& e, std::string_view section);
  void leaf(Element& e, const SchemaElement& schema);
  void numbers(Element& e, std::size_t count, bool infinite);
  void remove_unsupported(Element& e, const SchemaElement* schema, std::string_view parent);
  FileLocation location_of(const Element& e) const { return source_.location_of(e); }
  /// Reports an error, which ends the reading. Within a model of a world only that model is left out, with a warning.
  void error(const FileLocation& at, const std::string& text);
  void child_section(Element& child, std::string_view as);

  // check_names.cpp: names within a model or world
  struct Scope {
    std::map<std::string, Element*> names;
    bool open = false;  ///< whether a merged include adds unknown names
    bool is_world = false;
  };
  bool named(Element& e, const char* what);
  bool has_links(Element& joint, const Scope& scope);
  void names(Element& model, Scope& scope);
  void references(Element& model, const Scope& scope);
  void reference(Element& e, const char* attribute, const Scope& scope);
  /// Whether the name is known in the scope. If not, `advice` gets the message.
  bool is_known(const Element& e, const std::string& what, const std::string& name, const Scope& scope,
                std::string& advice) const;

  // check_elements.cpp: requirements of each kind of element
  void prepare(Element& e, std::string_view section);
  bool complete(Element& e, std::string_view section);
  bool complete_joint(Element& joint);
  void take_endless(Element& friction);
  void take_rotor(Element& joint, const std::string& owner, bool has_one_axis);
  void take_mimic(Element& joint, Element& axis, int number);
  bool complete_shape(Element& e);
  bool find_mesh(const Element& body, Element& uri);
  bool find_picture(Element& owner, const char* name);
  std::string error_of_shape(Element& shape);
  // check_heightmap.cpp
  bool complete_heightmap(const Element& body, Element& heightmap);
  bool complete_textures(Element& heightmap);
  // check_devices.cpp, check_include.cpp
  void take_device(Element& e);
  bool complete_include(Element& include);
  void put_ground_plane(Element& include);

  SourceFile& source_;
  SourceFiles& sources_;
  Problems& problems_;
  model_file::LeftOut left_out_;
  model_file::MissingMeshes missing_meshes_;
  std::string model_of_world_;  ///< model that is being checked: "model `house`"; empty outside of models of a world
  bool is_model_bad_ = false;
};

/// Returns the value of an attribute, or "".
inline std::string attribute(const Element& e, const char* name) {
  const char* text = e.Attribute(name);
  return text ? text : "";
}
/// Returns the text within an element without the blanks around it, or "".
std::string text_of(const Element& e);
/// Returns the text within a child, see text_of.
std::string child_text(Element& e, const char* name);

}  // namespace muro::sdf
