// SPDX-License-Identifier: MIT
#include "host/scenario/materials.hpp"

#include <fmt/format.h>

#include "host/names.hpp"
#include "host/scenario/map_reader.hpp"
#include "host/scenario/shape_reader.hpp"

namespace muro::host {

std::vector<MaterialChange> read_materials(const Node& materials, const std::string& what, Problems& problems) {
  std::vector<MaterialChange> all;
  for (std::size_t i = 0; i < materials.map.size(); ++i) {
    const auto& [name, node] = materials.map[i];
    MapReader map(node, fmt::format("material `{}` of {}", name, what), problems);
    MaterialChange change{{name, materials.key_locations[i]}, {}};
    change.material.color = read_color(map);
    if (map.has("texture")) change.material.texture = file_of(map, "texture", problems);
    map.reject_unknown_keys();
    if (node.kind == Node::Kind::map && node.map.empty())
      problems.add(node.location, map.what() + " needs `color: [r, g, b]` or `texture: FILE`");
    all.push_back(std::move(change));
  }
  return all;
}

void set_materials(RobotTree& tree, const std::string& name, const std::vector<MaterialChange>& changes,
                   Problems& problems) {
  for (const MaterialChange& change : changes) {
    if (tree.set_material(change.name.text, change.material)) continue;
    const std::vector<std::string> names = tree.material_names();
    problems.add(change.name.location,
                 fmt::format("`materials` of robot `{}` names `{}`, and its model has {}", name, change.name.text,
                             names.empty() ? "no materials with names"
                                           : "no such material" + suggestion(change.name.text, names, "it has")));
  }
}

}  // namespace muro::host
