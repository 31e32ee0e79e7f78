// SPDX-License-Identifier: MIT
#include "newer.hpp"

#include <algorithm>
#include <cctype>
#include <regex>
#include <vector>

#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

using model_file::concat;

/// Attributes of newer versions (MuJoCo documentation, changelog), and what is lost without them.
struct NewerAttribute {
  std::string_view element, attribute, loss;
};
constexpr NewerAttribute newer_attributes[] = {
    {"body", "gravcomp", "gravity pulls at the body in full"},
    {"body", "sleep", ""},
    {"camera", "focal", ""},
    {"camera", "focalpixel", ""},
    {"camera", "orthographic", ""},
    {"camera", "output", ""},
    {"camera", "principal", ""},
    {"camera", "principalpixel", ""},
    {"camera", "projection", ""},
    {"camera", "resolution", ""},
    {"camera", "sensorsize", ""},
    {"compiler", "alignfree", ""},
    {"compiler", "saveinertial", ""},
    {"fixed", "actuatorfrclimited", "actuators of the tendon are as strong as they are"},
    {"fixed", "actuatorfrcrange", "actuators of the tendon are as strong as they are"},
    {"hfield", "elevation", "the height field is flat; save its values as a grey picture and name it as `file`"},
    {"fixed", "armature", "the tendon has no inertia"},
    {"flag", "autoreset", ""},
    {"flag", "eulerdamp", ""},
    {"flag", "island", ""},
    {"flag", "midphase", ""},
    {"flag", "nativeccd", ""},
    {"flag", "sleep", ""},
    {"freejoint", "align", ""},
    {"general", "actearly", "activations act a step later"},
    {"global", "bvactive", ""},
    {"global", "cameraid", ""},
    {"global", "ellipsoidinertia", ""},
    {"global", "orthographic", ""},
    {"intvelocity", "inheritrange", ""},
    {"joint", "actuatorfrclimited", "actuators of the joint are as strong as they are"},
    {"joint", "actuatorfrcrange", "actuators of the joint are as strong as they are"},
    {"joint", "actuatorgravcomp", ""},
    {"light", "bulbradius", ""},
    {"light", "intensity", ""},
    {"light", "range", ""},
    {"light", "texture", ""},
    {"light", "type", ""},
    {"material", "metallic", ""},
    {"material", "roughness", ""},
    {"mesh", "content_type", ""},
    {"mesh", "inertia", "masses follow from the volume that its triangles enclose"},
    {"mesh", "maxhullvert", ""},
    {"motor", "actearly", ""},
    {"option", "actuatorgroupdisable", "all actuators act"},
    {"option", "ccd_iterations", ""},
    {"option", "ccd_tolerance", ""},
    {"option", "ls_iterations", ""},
    {"option", "ls_tolerance", ""},
    {"option", "sdf_initpoints", ""},
    {"option", "sdf_iterations", ""},
    {"position", "dampratio", "the servo has no damping"},
    {"position", "inheritrange", "the servo's control has no range of its own"},
    {"position", "kv", "the servo has no damping"},
    {"position", "timeconst", "the servo follows at once"},
    {"rgba", "bv", ""},
    {"rgba", "bvactive", ""},
    {"size", "memory", ""},
    {"spatial", "actuatorfrclimited", "actuators of the tendon are as strong as they are"},
    {"spatial", "actuatorfrcrange", "actuators of the tendon are as strong as they are"},
    {"spatial", "armature", "the tendon has no inertia"},
    {"texture", "colorspace", ""},
    {"texture", "content_type", ""},
};

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// A stretch of a text.
struct Stretch {
  std::size_t begin, end;
};

/// Finds `attribute`="..." in the start tags of `element`: with its name, or the quoted value only.
std::vector<Stretch> find(const std::string& text, const std::string& element, const std::string& attribute,
                          bool value_alone) {
  std::vector<Stretch> found;
  for (std::size_t at = 0; (at = text.find('<', at)) != text.npos;) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = std::min(text.find("-->", at), text.size());
      continue;
    }
    if (text.compare(++at, element.size(), element) != 0 || at + element.size() >= text.size() ||
        !is_blank(text[at + element.size()]))
      continue;
    at += element.size();
    while (at < text.size() && text[at] != '>') {
      while (at < text.size() && (is_blank(text[at]) || text[at] == '/')) ++at;
      const std::size_t name = at;
      while (at < text.size() && !is_blank(text[at]) && text[at] != '=' && text[at] != '>') ++at;
      const bool wanted = text.compare(name, at - name, attribute) == 0;
      const std::size_t open = text.find_first_of("\"'>", at);
      if (open == text.npos || text[open] == '>') break;
      const std::size_t close = text.find(text[open], open + 1);
      if (close == text.npos) return found;
      at = close + 1;
      if (wanted) found.push_back(value_alone ? Stretch{open, at} : Stretch{name, at});
    }
  }
  return found;
}

int line_at(const std::string& text, std::size_t at) {
  return 1 + int(std::count(text.begin(), text.begin() + std::ptrdiff_t(at), '\n'));
}

bool leave_out(std::string& text, const NewerAttribute& newer, model_file::Problems& problems) {
  const std::vector<Stretch> places = find(text, std::string(newer.element), std::string(newer.attribute), false);
  if (places.empty()) return false;
  const int line = line_at(text, places.front().begin);
  for (const Stretch& s : places)
    for (std::size_t i = s.begin; i < s.end; ++i)
      if (!is_blank(text[i])) text[i] = ' ';
  const std::string what = concat("attribute ", quote(newer.attribute), " of <", newer.element,
                                  "> is left out, since the MuJoCo that muro is built with is older");
  if (newer.loss.empty())
    problems.note({model_file::Location{line, 0}}, what);
  else
    problems.warning({model_file::Location{line, 0}}, concat(what, ": ", newer.loss));
  return true;
}

/// Replaces the integrator `implicitfast` by `implicit`, which has more terms.
bool replace_integrator(std::string& text, model_file::Problems& problems) {
  for (const Stretch& s : find(text, "option", "integrator", true)) {
    constexpr std::string_view newer = "implicitfast", known = "implicit";
    if (std::string_view(text).substr(s.begin + 1, s.end - s.begin - 2) != newer) continue;
    problems.note({model_file::Location{line_at(text, s.begin), 0}},
                  "the integrator `implicitfast` is taken as `implicit`, since the MuJoCo that muro is built with is "
                  "older");
    const std::string quoted = text[s.begin] + std::string(known) + text[s.begin];
    text.replace(s.begin, s.end - s.begin, quoted + std::string(newer.size() - known.size(), ' '));
    return true;
  }
  return false;
}

/// Makes each `range` without `limited` a limit, as newer versions do, unless the file sets `autolimits`.
bool limit_ranges(std::string& text, model_file::Problems& problems) {
  if (text.find("autolimits") != text.npos) return false;
  const std::size_t root = text.find("<mujoco"), end = root == text.npos ? root : text.find('>', root);
  if (end == text.npos || text[end - 1] == '/') return false;
  text.insert(end + 1, "<compiler autolimits=\"true\"/>");
  problems.note({model_file::Location{line_at(text, root), 0}},
                "a `range` without `limited` is a limit, as in MuJoCo from version 3 on; `<compiler "
                "autolimits=\"true\"/>` in the file says so for all versions");
  return true;
}

}  // namespace

bool leave_out_newer(std::string& text, const std::string& error, model_file::Problems& problems) {
  static const std::regex unknown("unrecognized attribute: '([a-z_]+)'.*Element '([a-z]+)'");
  std::smatch parts;
  if (error.find("autolimits") != error.npos) return limit_ranges(text, problems);
  if (!std::regex_search(error, parts, unknown))
    return error.find("invalid keyword: 'implicitfast'") != error.npos && replace_integrator(text, problems);
  const auto known = std::find_if(
      std::begin(newer_attributes), std::end(newer_attributes),
      [&](const NewerAttribute& a) { return a.element == parts[2].str() && a.attribute == parts[1].str(); });
  return known != std::end(newer_attributes) && leave_out(text, *known, problems);
}

}  // namespace muro::mjcf
