// SPDX-License-Identifier: MIT
#include "source.hpp"

#include <algorithm>
#include <regex>
#include <set>

#include "muro/algorithm.hpp"
#include "newer.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "plugins/common/parser_process/limits.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

namespace fs = std::filesystem;

/// Returns the message for a file with another root element: its format, and what to do.
std::string problem_of_root(const std::string& root) {
  if (root == "robot")
    return "the file begins with <robot>, so it is URDF and not MJCF; give it a name that ends in .urdf";
  if (root == "sdf")
    return "the file begins with <sdf>, so it is SDFormat and not MJCF; give it a name that ends in .sdf";
  if (root == "mujocoinclude")
    return "the file begins with <mujocoinclude>: it is a part of a model; name the file that includes it";
  return concat("the file begins with <", root, ">; MJCF begins with <mujoco>");
}

/// Visits an element and all its descendants.
template <class Visit>
void each_element(Element& root, Visit visit) {
  std::vector<Element*> stack = {&root};
  while (!stack.empty()) {
    Element* const e = stack.back();
    stack.pop_back();
    visit(*e);
    const std::vector<Element*> inner = model_file::children(*e);
    stack.insert(stack.end(), inner.rbegin(), inner.rend());
  }
}

std::string attribute(const Element& e, const char* name) {
  const char* const value = e.Attribute(name);
  return value ? value : "";
}

/// Adds up the sizes of the files that a document names, and of the files that its included files name.
class FileSizes {
 public:
  explicit FileSizes(fs::path folder) : folder_(std::move(folder)), folders_{folder_} {}

  void add(Element& root) {
    each_element(root, [this](const Element& e) {
      for (const char* name : {"meshdir", "texturedir", "assetdir"})
        if (const std::string in = attribute(e, name); !in.empty()) folders_.insert(folder_ / in);
    });
    each_element(root, [this](const Element& e) {
      const std::string file = attribute(e, "file");
      if (file.empty()) return;
      if (std::string_view(e.Name()) == "include") return include(file);
      for (const fs::path& f : folders_) {
        std::error_code none;
        const fs::path path = f / file, stripped = f / fs::path(file).filename();
        for (const fs::path& p : {path, stripped})
          if (seen_.insert(p.string()).second && fs::is_regular_file(p, none)) bytes_ += fs::file_size(p, none);
      }
    });
  }
  std::uint64_t bytes() const { return bytes_; }

 private:
  void include(const std::string& file) {
    std::error_code none;
    const fs::path path = folder_ / file;
    if (!seen_.insert(path.string()).second || seen_.size() > 10'000 || !fs::is_regular_file(path, none)) return;
    try {
      const std::string text = model_file::load_file(path.string(), ".xml");
      model_file::Document document;
      Location location;
      std::string error;
      bytes_ += text.size();
      if (document.parse(text, location, error) && document.root()) add(*document.root());
    } catch (const Error&) {
      return;  // MuJoCo reports what is wrong with the file
    }
  }

  fs::path folder_;
  std::set<fs::path> folders_;
  std::set<std::string> seen_;
  std::uint64_t bytes_ = 0;
};

/// Returns the line number in a message of MuJoCo; 0 if there is none.
int line_in(const std::string& text) {
  static const std::regex pattern("[Ll]ine(?: number)? ?=? ?([0-9]{1,8})");
  std::smatch found;
  return std::regex_search(text, found, pattern) ? std::stoi(found[1]) : 0;
}

}  // namespace

bool Source::load(std::string bytes, const std::string& path, Problems& problems) {
  path_ = path;
  text_ = std::move(bytes);
  const model_file::DecodingProblems decoding = model_file::decode(text_, "MJCF", "mujoco");
  if (!decoding.error.text.empty()) {
    problems.error(decoding.error.location, decoding.error.text);
    return false;
  }
  if (!decoding.warning.text.empty()) problems.warning(decoding.warning.location, decoding.warning.text);
  Location location;
  std::string error;
  if (!document_.parse(text_, location, error)) {
    problems.error(location, error);
    return false;
  }
  const std::string root = document_.root() ? document_.root()->Name() : "";
  if (root != "mujoco") {
    problems.error(document_.root() ? model_file::location_of(*document_.root()) : Location{}, problem_of_root(root));
    return false;
  }
  find_names();
  return true;
}

void Source::find_names() {
  each_element(*document_.root(), [this](const Element& e) {
    has_includes_ = has_includes_ || std::string_view(e.Name()) == "include";
    if (std::string_view(e.Name()) == "hfield" && e.Attribute("elevation")) elevations_.insert(attribute(e, "name"));
    places_.try_emplace({e.Name(), attribute(e, "name")}, model_file::location_of(e));
  });
}

Location Source::location_of(const std::string& tag, const std::string& name) const {
  const auto found = name.empty() ? places_.end() : places_.find({tag, name});
  return found == places_.end() ? Location{} : found->second;
}

/// Sets the limits of memory and time. MuJoCo takes about 2 kB and 20 us for an element, for meshes what convex hulls
/// take, and at most 2 GB for the buffers of one simulation of the model.
void Source::allow_for_files() const {
  FileSizes files(folder());
  files.add(*const_cast<model_file::Document&>(document_).root());
  parser_process::allow(parser_process::allowance_for(files.bytes() + text_.size(), 200, 2));
  const std::size_t elements = document_.element_count();
  parser_process::allow({std::uint64_t(elements) * 20'000 + (std::uint64_t(2) << 30), double(elements) * 0.001});
}

Compiled Source::compile(Problems& problems, const std::string& more) const {
  allow_for_files();
  std::string text = text_;
  if (!more.empty()) {
    const std::size_t end = text.rfind("</mujoco");
    if (end == text.npos) {  // <mujoco/>
      const std::size_t slash = text.rfind("/>");
      text.replace(slash, 2, ">" + more + "</mujoco>");
    } else {
      text.insert(end, more);
    }
  }
  Compiled compiled = mjcf::compile(text, path_);
  while (!compiled.model && leave_out_newer(text, compiled.error, problems)) compiled = mjcf::compile(text, path_);
  if (!compiled.warning.empty()) problems.warning({}, "MuJoCo says: " + shortened(printable(compiled.warning), 500));
  if (!compiled.model) {
    std::string version = std::to_string(mj_version());
    version =
        version.size() == 3 ? concat(version.substr(0, 1), ".", version.substr(1, 1), ".", version.substr(2)) : version;
    problems.error(
        Location{has_includes_ ? 0 : line_in(compiled.error), 0},
        concat("MuJoCo ", version, " refuses the model: ", shortened(printable(compiled.error), 800),
               compiled.error.find("allocate memory") == compiled.error.npos
                   ? ""
                   : "; MURO_PARSER_MEMORY=8000 (MiB) allows more, a smaller <size nstack njmax> needs less"));
  }
  return compiled;
}

}  // namespace muro::mjcf
