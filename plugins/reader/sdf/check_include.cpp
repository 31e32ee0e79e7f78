// SPDX-License-Identifier: MIT
// <include>: models of other files.
#include <algorithm>

#include "checks.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/model_file/mesh_path.hpp"
#include "plugins/common/model_file/text_file.hpp"

namespace muro::sdf {

namespace {

namespace fs = std::filesystem;

/// Returns the model's file in a folder: the file of the newest readable version in model.config, or model.sdf.
fs::path file_in(const fs::path& folder) {
  std::string best = "model.sdf";
  try {
    std::string bytes = model_file::load_file((folder / "model.config").string(), "model.config");
    model_file::Document document;
    Location location;
    std::string error;
    if (!model_file::decode(bytes, "model.config", "model").error.text.empty() ||
        !document.parse(bytes, location, error))
      return folder / best;
    int newest = -1;
    for (Element* sdf : model_file::children(*document.root(), "sdf")) {
      SourceFile source;
      source.version = attribute(*sdf, "version");
      const int version = source.version_number();
      if (text_of(*sdf).empty() || version > 109 || version <= newest) continue;
      newest = version;
      best = text_of(*sdf);
    }
  } catch (const Error&) {
    // no model.config
  }
  return folder / best;
}

}  // namespace

bool Check::complete_include(Element& include) {
  const std::string uri = child_text(include, "uri");
  const auto* around = include.Parent()->ToElement();
  const bool in_world = around && std::string_view(around->Name()) == "world";
  const auto fail = [&](const std::string& why) {
    const std::string text = concat("<include> of ", quote(uri), " is left out: ", why);
    problems_.warning(location_of(include), text);
    return false;
  };
  if (uri.empty()) return fail("it has no <uri>; write <uri>FOLDER/model.sdf</uri>");
  if (uri.starts_with("http://") || uri.starts_with("https://") || uri.starts_with("fuel://"))
    return fail("nothing is fetched from the network; save the model beside this file and give its path");
  const model_file::MeshPath found = model_file::find_file_or_folder(uri, source_.folder, sources_.packages());
  if (found.path.empty()) {
    // two models that most worlds for Gazebo include
    if (in_world && uri == "model://sun") {
      problems_.note(location_of(include), "<include> of `model://sun` is left out: there are no lights");
      return false;
    }
    if (in_world && uri == "model://ground_plane") {
      put_ground_plane(include);
      return false;
    }
    return fail(concat("there is no such file or folder; looked for ", model_file::searched_places(found), "; ",
                       model_file::advice_for_missing(uri, found)));
  }
  const fs::path path = fs::is_directory(found.path) ? file_in(found.path) : fs::path(found.path);
  std::string reason;
  const SourceFile* source = sources_.include(path.lexically_normal(), reason);
  if (!source) return fail(concat(path.string(), ": ", reason));
  source_.elements += source->elements;
  if (source_.elements > max_elements) {
    problems_.error(location_of(include), concat("<include> of ", quote(uri), ": with all its includes the file has ",
                                                 "more than ", max_elements, " elements"));
    return false;
  }
  Element* link = include.FirstChildElement("uri");
  link->DeleteChildren();
  link->SetText(source->memory->path().c_str());
  if (!include.FirstChildElement("name") && !include.BoolAttribute("merge")) {
    Element* name = include.InsertNewChildElement("name");
    name->SetText(attribute(*source->content, "name").c_str());
  }
  return true;
}

/// Replaces Gazebo's model of that name, if it is not installed, by a plane at z = 0.
void Check::put_ground_plane(Element& include) {
  problems_.note(location_of(include), "`model://ground_plane` is not found; a plane of friction 1 stands for it");
  Element* around = include.Parent()->ToElement();
  const auto child = [&](Element* parent, const char* name) {
    Element* made = parent->InsertNewChildElement(name);
    made->SetUserData(include.GetUserData());
    return made;
  };
  Element* model = child(around, "model");
  const std::string name = child_text(include, "name");
  model->SetAttribute("name", name.empty() ? "ground_plane" : name.c_str());
  child(model, "static")->SetText("true");
  if (Element* pose = include.FirstChildElement("pose")) model->InsertEndChild(pose);
  Element* link = child(model, "link");
  link->SetAttribute("name", "link");
  for (const char* kind : {"collision", "visual"}) {
    Element* shape = child(link, kind);
    shape->SetAttribute("name", kind);
    Element* plane = child(child(shape, "geometry"), "plane");
    child(plane, "normal")->SetText("0 0 1");
    child(plane, "size")->SetText("100 100");
  }
}

}  // namespace muro::sdf
