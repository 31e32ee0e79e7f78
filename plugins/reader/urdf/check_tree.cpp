// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "model.hpp"

namespace muro::urdf {

void check_tree(ModelInfo& model, Problems& problems) {
  for (const std::string& name : model.joint_order) {
    const JointInfo& joint = model.joints.at(name);
    if (joint.parent.empty() || joint.child.empty()) continue;
    LinkInfo& child = model.links.at(joint.child);
    if (!child.parent_joint.empty()) {
      problems.error(joint.location,
                     concat("link ", quote(joint.child), " is the child of two joints, ", quote(child.parent_joint),
                            " and ", quote(name), "; URDF describes trees, not closed chains"));
      continue;
    }
    child.parent_joint = name;
    model.links.at(joint.parent).child_joints.push_back(name);
  }
  // a joint without its links would make roots of links that are none
  if (problems.found_error()) return;

  std::vector<std::string> roots;
  for (const auto& [name, link] : model.links)
    if (link.parent_joint.empty()) roots.push_back(name);
  if (roots.size() > 1) {
    // in the order of the file
    std::sort(roots.begin(), roots.end(), [&](const std::string& a, const std::string& b) {
      const Location &p = model.links.at(a).location, &q = model.links.at(b).location;
      return std::pair(p.line, p.column) < std::pair(q.line, q.column);
    });
    problems.error(model.links.at(roots[1]).location,
                   concat("the robot has ", roots.size(), " links without a parent: ", quoted_list(roots),
                          "; exactly one is the root. Join the others to it, with fixed joints if they do not move"));
    return;
  }

  std::set<std::string> reached;
  std::vector<std::string> open = roots;
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    reached.insert(name);
    for (const std::string& joint : model.links.at(name).child_joints) open.push_back(model.joints.at(joint).child);
  }
  std::vector<std::string> loop;
  for (const auto& [name, link] : model.links)
    if (!reached.count(name)) loop.push_back(name);
  if (!loop.empty())
    problems.error(
        model.links.at(loop.front()).location,
        concat("links ", quoted_list(loop), " hang on each other in a loop",
               roots.empty() ? " and there is no root" : "", "; the root is the one link that is no joint's child"));
  else
    model.root = roots.front();
}

}  // namespace muro::urdf
