// SPDX-License-Identifier: MIT
#include "source_file.hpp"

#include <algorithm>
#include <cctype>

#include "checks.hpp"
#include "plugins/common/model_file/numbers.hpp"
#include "plugins/common/model_file/text_file.hpp"

namespace muro::sdf {

namespace {

constexpr char format[] = "SDFormat";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '&':
        out += "&amp;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        // no line breaks within a tag, as lines are counted
        out += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return out;
}

void print(const Element& e, SourceFile& source) {
  source.normalized += concat(source.line_locations.empty() ? "" : "\n", "<", e.Name());
  source.line_locations.push_back(model_file::location_of(e));
  for (const auto* a = e.FirstAttribute(); a; a = a->Next())
    source.normalized += concat(" ", a->Name(), "=\"", escaped(a->Value()), "\"");
  source.normalized += ">";
  for (const Element* child = e.FirstChildElement(); child; child = child->NextSiblingElement()) print(*child, source);
  if (!e.FirstChildElement()) source.normalized += escaped(text_of(e));
  source.normalized += concat("</", e.Name(), ">");
}

/// Returns the <world> or <model> of a file. Warns if there are several.
Element* content_of(Element& root, Content wanted, const SourceFile& source, Problems& problems) {
  const char* name = wanted == Content::world ? "world" : "model";
  const std::vector<Element*> found = model_file::children(root, name);
  if (found.size() > 1)
    problems.warning(source.location_of(*found[1]),
                     concat("the file holds ", found.size(), " <", name, ">; the first one is read"));
  for (Element* e : model_file::children(root))
    if (e != (found.empty() ? nullptr : found.front()) && std::string_view(e->Name()) == name) root.DeleteChild(e);
  return found.empty() ? nullptr : found.front();
}

/// Returns the light or actor of a file without models, such as that of Gazebo's sun.
const Element* only_light_or_actor(const Element& root) {
  if (root.FirstChildElement("world")) return nullptr;
  const Element* light = root.FirstChildElement("light");
  return light ? light : root.FirstChildElement("actor");
}

}  // namespace

int SourceFile::version_number() const {
  std::string error, digits = version;
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const auto whole = model_file::parse_numbers(digits.substr(0, point), error);
  const auto part = model_file::parse_numbers(digits.substr(std::min(point + 1, digits.size())), error);
  if (!error.empty() || whole.size() != 1 || part.size() != 1 || !(whole[0] >= 0 && whole[0] < 1000)) return 0;
  return int(100 * whole[0] + std::clamp(part[0], 0.0, 99.0));
}

bool SourceFiles::parse(SourceFile& source, std::string bytes, bool included, std::string& reason) {
  const auto fail = [&](Location location, const std::string& text) {
    reason = text;
    if (!included) problems_.error({source.display_name, location}, text);
    return false;
  };
  const auto [error, warning] = model_file::decode(bytes, format, "sdf");
  if (!error.text.empty()) return fail(error.location, error.text);
  if (!warning.text.empty()) problems_.warning({source.display_name, warning.location}, warning.text);
  source.document = std::make_unique<model_file::Document>();
  Location location;
  std::string text;
  if (!source.document->parse(bytes, location, text)) return fail(location, text);
  Element* root = source.document->root();
  // name of the root up to SDFormat 1.2
  if (root && std::string_view(root->Name()) == "gazebo") root->SetName("sdf");
  if (!root || std::string_view(root->Name()) != "sdf")
    return fail(
        root ? model_file::location_of(*root) : Location{},
        concat("the file holds no <sdf> element", root ? concat(", but ", quote(root->Name())) : std::string(),
               root && std::string_view(root->Name()) == "robot" ? "; it is URDF, so give it the ending .urdf" : "",
               "; an SDFormat file is <sdf version=\"1.9\"> with a <model> or a <world>"));
  const char* version = root->Attribute("version");
  if (!version) return fail(model_file::location_of(*root), "<sdf> has no version; write <sdf version=\"1.9\">");
  source.version = version;
  const int number = source.version_number();
  if (number < 102)
    return fail(model_file::location_of(*root),
                concat("the file is of SDFormat ", quote(version), "; versions 1.2 to 1.9 are ",
                       "read. `gz sdf -p FILE` of Gazebo converts older ones"));
  if (number > 109) {
    problems_.warning({source.display_name, model_file::location_of(*root)},
                      concat("the file is of SDFormat ", quote(version), " and is read as 1.9"));
    root->SetAttribute("version", "1.9");
  }
  source.elements = source.document->element_count();
  return true;
}

bool SourceFiles::load(std::string bytes, Content wanted) {
  sources_.push_back(std::make_unique<SourceFile>());
  SourceFile& source = *sources_.back();
  source.folder = folder_;
  std::string reason;
  if (!parse(source, std::move(bytes), false, reason)) return false;
  Element& root = *source.document->root();
  source.content = content_of(root, wanted, source, problems_);
  if (const Element* only = source.content || wanted == Content::world ? nullptr : only_light_or_actor(root)) {
    source.alone = attribute(*only, "name");
    if (source.alone.empty()) source.alone = only->Name();
    problems_.warning(source.location_of(*only),
                      concat("the file holds only the ", only->Name(), " ", quote(source.alone),
                             ", which is not simulated; the robot is a frame without a body"));
    return true;
  }
  if (!source.content) {
    const bool world = wanted == Content::world;
    const bool other = root.FirstChildElement(world ? "model" : "world") != nullptr;
    problems_.error(source.location_of(root),
                    concat("the file holds no <", world ? "world" : "model", ">",
                           other && world ? "; it describes a robot: name it as the `model` of a robot" : "",
                           other && !world ? "; it describes a world: name it under `world: {file: ...}`" : ""));
    return false;
  }
  check(source, *this, problems_);
  if (problems_.found_error()) return false;
  print(root, source);
  return true;
}

void SourceFiles::remove_from_world(Element& model) {
  SourceFile& source = *sources_.front();
  source.content->DeleteChild(&model);
  source.normalized.clear();
  source.line_locations.clear();
  print(*source.document->root(), source);
}

std::string SourceFiles::with_only(const Element& model) const {
  const SourceFile& source = *sources_.front();
  SourceFile part;
  part.normalized = concat("<sdf version=\"", source.document->root()->Attribute("version"), "\"><world name=\"w\">");
  print(model, part);
  return part.normalized + "</world></sdf>";
}

std::string SourceFiles::with_file_names(std::string text) const {
  for (const auto& source : sources_) {
    if (!source->memory) continue;
    const std::string path = source->memory->path();
    // /proc/self/fd/12 begins with /proc/self/fd/1
    for (std::size_t at = text.find(path); at != text.npos; at = text.find(path, at + 1)) {
      const std::size_t end = at + path.size();
      if (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) continue;
      text.replace(at, path.size(), source->display_name);
    }
  }
  return text;
}

const SourceFile* SourceFiles::include(const std::filesystem::path& path, std::string& reason) {
  if (const auto known = included_.find(path); known != included_.end()) {
    if (!known->second) reason = "it cannot be read, as reported before";
    return known->second;
  }
  if (std::find(open_.begin(), open_.end(), path) != open_.end()) {
    reason = "it includes itself";
    return nullptr;
  }
  const auto add = [&]() -> const SourceFile* {
    auto source = std::make_unique<SourceFile>();
    source->display_name = path.lexically_proximate(folder_).string();
    source->folder = path.parent_path();
    try {
      if (!parse(*source, model_file::load_file(path.string(), format), true, reason)) return nullptr;
    } catch (const Error& e) {
      reason = e.what();
      return nullptr;
    }
    Element& root = *source->document->root();
    source->content = content_of(root, Content::model, *source, problems_);
    if (!source->content) {
      Element* first = root.FirstChildElement();
      reason = concat("it holds no <model>", first ? concat(", but a ", quote(first->Name())) : std::string());
      return nullptr;
    }
    open_.push_back(path);
    // a file with mistakes is left out, and the file that includes it is read on
    Problems own([this](Severity severity, std::string_view text, int line, int column) {
      const Severity told = severity == Severity::error ? Severity::warning : severity;
      problems_.report(told, Location{line, column}, std::string(text));
    });
    check(*source, *this, own);
    open_.pop_back();
    if (own.found_error()) {
      reason = "it has mistakes, as reported before";
      return nullptr;
    }
    print(root, *source);
    source->memory = std::make_unique<MemoryFile>(source->normalized);
    sources_.push_back(std::move(source));
    return sources_.back().get();
  };
  const SourceFile* source = add();
  return included_[path] = source;
}

FileLocation SourceFiles::location_of(const std::string& file, int line) const {
  const auto is_named = [&](const auto& source) { return source->memory && source->memory->path() == file; };
  const auto included = std::find_if(sources_.begin(), sources_.end(), is_named);
  const SourceFile& source = included != sources_.end() ? **included : *sources_.front();
  if (line > 0 && std::size_t(line) <= source.line_locations.size())
    return {source.display_name, source.line_locations[std::size_t(line) - 1]};
  return {source.display_name, Location{}};
}

}  // namespace muro::sdf
