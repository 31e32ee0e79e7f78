// SPDX-License-Identifier: MIT
#include <algorithm>

#include "checks.hpp"
#include "muro/base/did_you_mean.hpp"

namespace muro::sdf {

namespace {

std::string_view kind_of(const Element& e) {
  return std::string_view(e.Name()) == "include" ? "model" : std::string_view(e.Name());
}

/// Returns the name by which the other elements of a model or world refer to this one.
std::string name_of(Element& e) {
  return std::string_view(e.Name()) == "include" ? child_text(e, "name") : attribute(e, "name");
}

void rename(Element& e, const std::string& name) {
  if (std::string_view(e.Name()) != "include") return e.SetAttribute("name", name.c_str());
  Element* given = e.FirstChildElement("name");
  given->DeleteChildren();
  given->SetText(name.c_str());
}

}  // namespace

bool Check::named(Element& e, const char* what) {
  if (!attribute(e, "name").empty()) return true;
  problems_.warning(location_of(e),
                    concat("a ", what, " without a name is left out; write <", e.Name(), " name=\"...\">"));
  e.Parent()->DeleteChild(&e);
  return false;
}

/// Makes names unique: links, joints, frames and models share one set of names.
void Check::names(Element& model, Scope& scope) {
  for (Element* e : model_file::children(model)) {
    const std::string_view element = e->Name();
    if (element == "include" && e->BoolAttribute("merge")) scope.open = true;
    if (element != "link" && element != "joint" && element != "frame" && element != "model" && element != "include")
      continue;
    if (element != "include" && !named(*e, e->Name())) continue;
    std::string name = name_of(*e);
    if (source_.version_number() >= 108 && name.find("::") != name.npos)
      error(location_of(*e), concat("the ", kind_of(*e), " is named ", quote(name),
                                    "; names have no `::` since SDFormat 1.8. Write a <model> within the model"));
    if (name.empty() || scope.names.emplace(name, e).second) continue;
    const Element& first = *scope.names.at(name);
    // joints with the names of links were allowed up to SDFormat 1.6, and are still common
    const bool is_common = element == "joint" && kind_of(first) == "link";
    std::string other = name;
    if (is_common)
      while (!scope.names.emplace(other, e).second) other += "_joint";
    else
      for (int i = 2; !scope.names.emplace(other, e).second; ++i) other = concat(name, "_", i);
    const std::string text = is_common
                                 ? concat("joint ", quote(name), " has the name of a link; it is called ", quote(other))
                                 : concat("a ", kind_of(*e), " has the name ", quote(name), " of the ", kind_of(first),
                                          " in line ", location_of(first).line_text(), " and is called ", quote(other),
                                          "; names are unique within a ", model.Name());
    problems_.report(is_common ? Severity::note : Severity::warning, location_of(*e), text);
    rename(*e, other);
  }
}

bool Check::is_known(const Element& e, const std::string& what, const std::string& name, const Scope& scope,
                     std::string& advice) const {
  if (name.empty() || scope.open || name.starts_with("__")) return true;
  if (name == "world" && (scope.is_world || what == "parent")) return true;
  // for "arm::hand" only `arm` has to exist
  if (scope.names.count(name) != 0 || scope.names.count(name.substr(0, name.find("::"))) != 0) return true;
  std::vector<std::string> names;
  for (const auto& [known, unused] : scope.names) names.push_back(known);
  const auto* parent = e.Parent()->ToElement();
  const std::string owner =
      parent && parent->Attribute("name") ? concat(" of ", parent->Name(), " ", quote(attribute(*parent, "name"))) : "";
  advice =
      concat(what, owner, ": there is no ", quote(name), did_you_mean(name, names), "; there are ", quoted_list(names));
  return false;
}

void Check::reference(Element& e, const char* name, const Scope& scope) {
  std::string advice;
  if (e.Attribute(name) && !is_known(e, concat("<", e.Name(), " ", name, ">"), attribute(e, name), scope, advice))
    error(location_of(e), advice);
}

/// Returns false, with a warning, if a joint names a link that does not exist. The joint is left out.
bool Check::has_links(Element& joint, const Scope& scope) {
  std::string advice;
  for (const char* end : {"parent", "child"}) {
    Element* link = joint.FirstChildElement(end);
    if (!link || is_known(*link, end, text_of(*link), scope, advice)) continue;
    problems_.warning(location_of(*link), advice + "; the joint is left out");
    return false;
  }
  return true;
}

/// Checks that every reference names a frame of the model or world that contains the reference.
void Check::references(Element& model, const Scope& scope) {
  const auto pose = [&](Element& e) {
    if (Element* p = e.FirstChildElement("pose")) {
      reference(*p, "relative_to", scope);
      if (source_.version_number() < 107) return reference(*p, "frame", scope);
      if (!p->Attribute("frame")) return;
      problems_.warning(location_of(*p),
                        "<pose> has the attribute `frame`, which is `relative_to` since SDFormat 1.7; it "
                        "is not read");
      p->DeleteAttribute("frame");
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
    if (!has_links(*e, scope)) {
      model.DeleteChild(e);
      continue;
    }
    for (const char* axis : {"axis", "axis2"})
      if (Element* a = e->FirstChildElement(axis))
        if (Element* xyz = a->FirstChildElement("xyz")) reference(*xyz, "expressed_in", scope);
  }
  if (!scope.is_world) reference(model, "canonical_link", scope);
}

}  // namespace muro::sdf
