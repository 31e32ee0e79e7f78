// SPDX-License-Identifier: MIT
#include <algorithm>

#include "checks.hpp"
#include "muro/toolkit/did_you_mean.hpp"

namespace muro::sdf {

namespace {

std::string_view kind_of(const Element& e) {
  return std::string_view(e.Name()) == "include" ? "model" : std::string_view(e.Name());
}

/// The name that an element of a model or world has for the others.
std::string name_of(Element& e) {
  return std::string_view(e.Name()) == "include" ? child_text(e, "name") : attribute(e, "name");
}

}  // namespace

bool Check::named(Element& e, const char* what) {
  if (!attribute(e, "name").empty()) return true;
  problems_.error(location_of(e), concat("a ", what, " has no name; write <", e.Name(), " name=\"...\">"));
  return false;
}

/// Links, joints, frames and models share one set of names.
void Check::names(Element& model, Scope& scope) {
  for (Element* e : model_file::children(model)) {
    const std::string_view element = e->Name();
    if (element == "include" && e->BoolAttribute("merge")) scope.open = true;
    if (element != "link" && element != "joint" && element != "frame" && element != "model" && element != "include")
      continue;
    if (element != "include" && !named(*e, e->Name())) continue;
    std::string name = name_of(*e);
    if (source_.version_number() >= 108 && name.find("::") != name.npos)
      problems_.error(location_of(*e),
                      concat("the ", kind_of(*e), " is named ", quote(name),
                             "; names have no `::` since SDFormat 1.8. Write a <model> within the model"));
    if (name.empty() || scope.names.emplace(name, e).second) continue;
    const Element& first = *scope.names.at(name);
    if (element == "joint" && kind_of(first) == "link") {
      // allowed up to SDFormat 1.6, and still common
      while (!scope.names.emplace(name, e).second) name += "_joint";
      problems_.note(location_of(*e), concat("joint ", quote(attribute(*e, "name")),
                                             " has the name of a link; it is called ", quote(name)));
      e->SetAttribute("name", name.c_str());
      continue;
    }
    problems_.error(location_of(*e),
                    concat("a ", kind_of(*e), " has the name ", quote(name), " of the ", kind_of(first), " in line ",
                           location_of(first).line_text(), "; names are unique within a ", model.Name()));
  }
}

void Check::check_name(const Element& e, const std::string& what, const std::string& name, const Scope& scope) {
  if (name.empty() || scope.open || name.find("::") != name.npos || name.starts_with("__")) return;
  if (name == "world" && (scope.is_world || what == "parent")) return;
  if (scope.names.count(name) != 0) return;
  std::vector<std::string> names;
  for (const auto& [known, unused] : scope.names) names.push_back(known);
  const auto* parent = e.Parent()->ToElement();
  const std::string owner =
      parent && parent->Attribute("name") ? concat(" of ", parent->Name(), " ", quote(attribute(*parent, "name"))) : "";
  problems_.error(location_of(e), concat(what, owner, ": there is no ", quote(name), did_you_mean(name, names),
                                         "; there are ", quoted_list(names)));
}

void Check::reference(Element& e, const char* name, const Scope& scope) {
  if (e.Attribute(name)) check_name(e, concat("<", e.Name(), " ", name, ">"), attribute(e, name), scope);
}

/// What names a frame must name one of the model or world it stands in.
void Check::references(Element& model, const Scope& scope) {
  const auto pose = [&](Element& e) {
    if (Element* p = e.FirstChildElement("pose")) {
      reference(*p, "relative_to", scope);
      reference(*p, "frame", scope);
    }
  };
  for (Element* e : model_file::children(model)) {
    const std::string_view element = e->Name();
    if (element == "pose") continue;
    pose(*e);
    if (element == "frame") reference(*e, "attached_to", scope);
    if (element == "link")
      for (Element* part : model_file::children(*e)) pose(*part);
    if (element != "joint") continue;
    for (const char* end : {"parent", "child"})
      if (Element* link = e->FirstChildElement(end)) check_name(*link, end, text_of(*link), scope);
    for (const char* axis : {"axis", "axis2"})
      if (Element* a = e->FirstChildElement(axis))
        if (Element* xyz = a->FirstChildElement("xyz")) reference(*xyz, "expressed_in", scope);
  }
  if (!scope.is_world) reference(model, "canonical_link", scope);
}

}  // namespace muro::sdf
