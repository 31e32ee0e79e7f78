// SPDX-License-Identifier: MIT
#include "host/scenario/unreadable_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/names.hpp"

namespace muro::host {

bool UnreadableMeshes::is_lost(const Shape& shape, const TextTable& texts, const std::string& file,
                               const std::string& link) {
  if (shape.kind != ShapeKind::mesh) return false;
  const std::string mesh(texts[shape.mesh]);
  if (!meshes_.is_broken(mesh)) return false;
  auto found =
      std::find_if(lost_.begin(), lost_.end(), [&](const Lost& l) { return l.mesh == mesh && l.file == file; });
  if (found == lost_.end()) found = lost_.insert(lost_.end(), Lost{file, mesh, {}});
  std::vector<std::string>& links = found->links;
  if (std::find(links.begin(), links.end(), link) == links.end()) links.push_back(link);
  return true;
}

void UnreadableMeshes::leave_out(RobotTree& tree, const std::string& file, const std::string& scope) {
  tree.remove_collision_shapes(
      [&](const std::string& link, const Shape& shape) { return is_lost(shape, tree.texts(), file, scope + link); });
}

void UnreadableMeshes::leave_out(std::vector<Shape>& shapes, const TextTable& texts, const std::string& file,
                                 const std::string& name) {
  std::erase_if(shapes, [&](const Shape& shape) { return is_lost(shape, texts, file, name); });
}

void UnreadableMeshes::tell() const {
  constexpr std::size_t most = 4;  // most links in a message
  for (const Lost& l : lost_) {
    const std::size_t shown = std::min(most, l.links.size()), others = l.links.size() - shown;
    std::string links = comma_separated({l.links.begin(), l.links.begin() + std::ptrdiff_t(shown)});
    if (others > 0) links += fmt::format(" and {} more", others);
    const std::string text = fmt::format("{}; it is left out, so that nothing touches {} {} there",
                                         meshes_.problem_of(l.mesh), l.links.size() > 1 ? "links" : "link", links);
    out_.note(l.file, {Severity::lost_collision, text});
  }
}

}  // namespace muro::host
