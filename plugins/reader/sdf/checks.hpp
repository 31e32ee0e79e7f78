// SPDX-License-Identifier: MIT
#pragma once

#include <set>

#include "plugins/common/model_file/left_out.hpp"
#include "plugins/common/model_file/missing_meshes.hpp"
#include "schema.hpp"
#include "source_file.hpp"

namespace muro::sdf {

/// Checks every element of a file: what is not supported is reported and removed, so that libsdformat sees only what
/// the reader uses, with numbers that all parsers read alike, and includes and meshes under the paths of files.
void check(SourceFile& source, SourceFiles& sources, Problems& problems);

/// What the checks of one file share.
class Check {
 public:
  Check(SourceFile& source, SourceFiles& sources, Problems& problems)
      : source_(source), sources_(sources), problems_(problems) {}
  void run();

 private:
  // check.cpp: all elements alike
  void section(Element& e, std::string_view as);
  void attributes(Element& e, std::string_view section);
  void leaf(Element& e, const SchemaElement& schema);
  void numbers(Element& e, std::size_t count, bool infinite);
  void remove_unsupported(Element& e, const SchemaElement* schema, std::string_view parent);
  FileLocation location_of(const Element& e) const { return source_.location_of(e); }
  /// Ends the reading, except within a model of a world: that model is left out, and the rest is read.
  void error(const FileLocation& at, const std::string& text);
  void child_section(Element& child, std::string_view as);

  // check_names.cpp: names within a model or world
  struct Scope {
    std::map<std::string, Element*> names;
    bool open = false;  ///< an include that is merged brings more names
    bool is_world = false;
  };
  bool named(Element& e, const char* what);
  bool has_links(Element& joint, const Scope& scope);
  void names(Element& model, Scope& scope);
  void references(Element& model, const Scope& scope);
  void reference(Element& e, const char* attribute, const Scope& scope);
  /// Whether there is something of this name; otherwise `advice` says it all.
  bool is_known(const Element& e, const std::string& what, const std::string& name, const Scope& scope,
                std::string& advice) const;

  // check_elements.cpp: what each kind of element needs
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
  // check_devices.cpp
  void take_device(Element& e);
  bool complete_include(Element& include);
  void put_ground_plane(Element& include);

  SourceFile& source_;
  SourceFiles& sources_;
  Problems& problems_;
  model_file::LeftOut left_out_;
  model_file::MissingMeshes missing_meshes_;
  std::string model_of_world_;  ///< that is being checked: "model `house`"; empty elsewhere
  bool is_model_bad_ = false;
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
