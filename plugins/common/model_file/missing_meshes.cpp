// SPDX-License-Identifier: MIT
#include "missing_meshes.hpp"

#include <algorithm>

namespace muro::model_file {

namespace {

constexpr std::size_t most_shown = 4;  // names, and lines for each name

/// Returns " (also in lines 4, 9)", or nothing.
std::string other_lines(const std::vector<FileLocation>& places) {
  if (places.size() < 2) return {};
  std::string text;
  for (std::size_t i = 1; i < std::min(places.size(), most_shown + 1); ++i)
    text += concat(i > 1 ? ", " : "", places[i].line);
  if (places.size() > most_shown + 1) text += concat(" and ", places.size() - most_shown - 1, " more");
  return concat(places.size() > 2 ? " (also in lines " : " (also in line ", text, ")");
}

}  // namespace

void MissingMeshes::add(const std::string& name, const FileLocation& at, const MeshPath& missing, bool to_touch) {
  auto group = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) {
    return g.missing.package == missing.package && g.missing.has_package == missing.has_package;
  });
  if (group == groups_.end()) group = groups_.insert(groups_.end(), Group{.missing = missing, .meshes = {}});
  group->to_touch = group->to_touch || to_touch;
  const auto mesh =
      std::find_if(group->meshes.begin(), group->meshes.end(), [&](const Mesh& m) { return m.name == name; });
  if (mesh == group->meshes.end())
    group->meshes.push_back({name, {at}});
  else
    mesh->places.push_back(at);
}

void MissingMeshes::report(Problems& problems) const {
  for (Group group : groups_) {
    for (Mesh& mesh : group.meshes) std::sort(mesh.places.begin(), mesh.places.end());
    std::sort(group.meshes.begin(), group.meshes.end(),
              [](const Mesh& a, const Mesh& b) { return a.places.front() < b.places.front(); });
    const auto& [name, places] = group.meshes.front();
    const std::size_t others = group.meshes.size() - 1;
    std::string text = concat(others ? "meshes " : "mesh ", quote(name), other_lines(places));
    for (std::size_t i = 1; i <= std::min(others, most_shown); ++i) {
      const Mesh& m = group.meshes[i];
      text += concat(", ", quote(m.name), " in line ", m.places.front().line, other_lines(m.places));
    }
    if (others > most_shown) text += concat(" and ", others - most_shown, " others");
    text += others ? " are not found and left out" : " is not found and left out";
    if (group.to_touch) text += ", so that nothing touches the links there";
    text += concat("; looked for ", searched_places(group.missing), "; ", advice_for_missing(name, group.missing));
    problems.report(group.to_touch ? Severity::lost_collision : Severity::warning, places.front(), text);
  }
}

}  // namespace muro::model_file
