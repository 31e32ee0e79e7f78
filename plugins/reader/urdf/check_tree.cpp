// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>

#include "model.hpp"

namespace muro::urdf {

namespace {

class TreeCheck {
 public:
  TreeCheck(Element& robot, ModelInfo& model, Problems& problems) : robot_(robot), model_(model), problems_(problems) {
    for (const auto& [name, link] : model.links) in_file_.push_back(name);
    std::sort(in_file_.begin(), in_file_.end(), [&](const std::string& a, const std::string& b) {
      const Location &p = model.links.at(a).location, &q = model.links.at(b).location;
      return std::pair(p.line, p.column) < std::pair(q.line, q.column);
    });
  }

  void run() {
    connect();
    std::vector<std::string> roots = find_roots();
    open_loops(roots);
    choose_root(roots);
    attach(roots);
    std::erase_if(model_.joint_order, [&](const std::string& name) { return model_.joints.count(name) == 0; });
  }

 private:
  /// Connects links by joints. Only the first joint that leads to a link counts.
  void connect() {
    for (const std::string& name : model_.joint_order) {
      const JointInfo& joint = model_.joints.at(name);
      LinkInfo& child = model_.links.at(joint.child);
      if (child.parent_joint.empty()) {
        child.parent_joint = name;
        model_.links.at(joint.parent).child_joints.push_back(name);
        continue;
      }
      problems_.warning(
          joint.location,
          concat("joint ", quote(name), " closes a chain and is left out: its child, link ", quote(joint.child),
                 ", hangs on joint ", quote(child.parent_joint), " already, and what moves has one parent"));
      remove(*joint.xml);
      model_.joints.erase(name);
    }
  }

  std::vector<std::string> find_roots() const {
    std::vector<std::string> roots;
    for (const std::string& name : in_file_)
      if (model_.links.at(name).parent_joint.empty()) roots.push_back(name);
    return roots;
  }

  /// Returns the number of links in the tree of `root` that have not been reached before, and marks them.
  std::size_t reach(const std::string& root) {
    std::size_t count = 0;
    std::vector<std::string> open{root};
    while (!open.empty()) {
      const std::string name = std::move(open.back());
      open.pop_back();
      if (!reached_.insert(name).second) continue;
      ++count;
      for (const std::string& joint : model_.links.at(name).child_joints) open.push_back(model_.joints.at(joint).child);
    }
    return count;
  }

  /// Cuts loops that no root leads to: the first link of each loop becomes a root.
  void open_loops(std::vector<std::string>& roots) {
    for (const std::string& root : roots) sizes_[root] = reach(root);
    for (const std::string& name : in_file_) {
      if (reached_.count(name) != 0) continue;
      LinkInfo& link = model_.links.at(name);
      const JointInfo& joint = model_.joints.at(link.parent_joint);
      problems_.warning(joint.location,
                        concat("joint ", quote(link.parent_joint), " closes a loop and is left out: link ", quote(name),
                               ", to which it leads, would be its own descendant"));
      std::erase(model_.links.at(joint.parent).child_joints, link.parent_joint);
      remove(*joint.xml);
      model_.joints.erase(link.parent_joint);
      link.parent_joint.clear();
      sizes_[name] = reach(name);
      roots.push_back(name);
    }
  }

  /// Chooses the root with the largest tree.
  void choose_root(const std::vector<std::string>& roots) {
    model_.root = *std::max_element(roots.begin(), roots.end(), [&](const std::string& a, const std::string& b) {
      return sizes_.at(a) < sizes_.at(b);
    });
  }

  void attach(const std::vector<std::string>& roots) {
    if (roots.size() < 2) return;
    std::vector<std::string> others;
    for (const std::string& root : roots)
      if (root != model_.root) others.push_back(root);
    for (const std::string& link : others) {
      std::string name = link + "_attached";
      while (model_.joints.count(name) != 0) name += "_";
      Element* joint = robot_.InsertNewChildElement("joint");
      joint->SetAttribute("name", name.c_str());
      joint->SetAttribute("type", "fixed");
      joint->InsertNewChildElement("parent")->SetAttribute("link", model_.root.c_str());
      joint->InsertNewChildElement("child")->SetAttribute("link", link.c_str());
      LinkInfo& child = model_.links.at(link);
      child.parent_joint = name;
      model_.links.at(model_.root).child_joints.push_back(name);
      model_.joint_order.push_back(name);
      model_.joints[name] = {
          .location = child.location, .xml = joint, .type = "fixed", .parent = model_.root, .child = link};
    }
    problems_.warning(model_.links.at(others.front()).location,
                      concat("no joint leads to ", others.size() > 1 ? "the links " : "link ", quoted_list(others),
                             others.size() > 1 ? "; each is" : "; it is", " fixed to the origin of the root, link ",
                             quote(model_.root), ", on which most others hang. Join them to it where they belong"));
  }

  Element& robot_;
  ModelInfo& model_;
  Problems& problems_;
  std::vector<std::string> in_file_;  ///< links, in the order of the file
  std::set<std::string> reached_;
  std::map<std::string, std::size_t> sizes_;  ///< sizes of the trees by their roots
};

}  // namespace

void check_tree(Element& robot, ModelInfo& model, Problems& problems) {
  if (!model.links.empty()) TreeCheck(robot, model, problems).run();
}

}  // namespace muro::urdf
