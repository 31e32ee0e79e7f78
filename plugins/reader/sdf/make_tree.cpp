// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "assembly.hpp"

namespace muro::sdf {

namespace {

class TreeMaker {
 public:
  TreeMaker(Assembly& a, Problems& problems) : a_(a), problems_(problems) {}

  void run(const ::sdf::Model& model) {
    is_static_ = model.Static();
    find_parents();
    const std::vector<int> roots = find_roots();
    a_.base = choose_base(model, roots);
    report_roots(roots);
    attach_unreached();
  }

 private:
  static bool is_in_tree(const Joint& joint) { return joint.definition->Type() != ::sdf::JointType::GEARBOX; }

  void find_parents() {
    for (std::size_t i = 0; i < a_.joints.size(); ++i) {
      Joint& joint = a_.joints[i];
      if (!is_in_tree(joint)) continue;
      if (joint.parent < 0) {
        world_joints_.push_back(int(i));
        continue;
      }
      Body& child = a_.bodies[std::size_t(joint.child)];
      if (child.parent_joint >= 0) {
        cut(joint, a_.joints[std::size_t(child.parent_joint)], child);
        continue;
      }
      child.parent_joint = int(i);
      a_.bodies[std::size_t(joint.parent)].child_joints.push_back(int(i));
    }
    connect_to_world();
  }

  void cut(Joint& joint, const Joint& other, const Body& child) {
    problems_.warning(
        joint.location,
        concat("joint ", quote(joint.name), " closes a chain and is left out: its child, ", "link ", quote(child.name),
               ", hangs on joint ", quote(other.name), " already, and what moves has one parent"));
    joint.left_out = true;
  }

  /// Handles joints with the world. They are reported, as the motion has to fix the robot. If one of them moves, or if
  /// there are several, a body that represents the world is added.
  void connect_to_world() {
    if (world_joints_.empty()) return;
    const bool moves = std::any_of(world_joints_.begin(), world_joints_.end(), [&](int i) {
      return a_.joints[std::size_t(i)].definition->Type() != ::sdf::JointType::FIXED;
    });
    const Joint& first = a_.joints[std::size_t(world_joints_.front())];
    problems_.note(first.location, concat("joint ", quote(first.name),
                                          " fixes the robot to the world: set `base: fixed` in the motion"));
    for (const int i : world_joints_) {
      Joint& joint = a_.joints[std::size_t(i)];
      Body& child = a_.bodies[std::size_t(joint.child)];
      if (child.parent_joint >= 0) {
        cut(joint, a_.joints[std::size_t(child.parent_joint)], child);
        continue;
      }
      if (!moves && world_joints_.size() == 1) return;
      if (world_ < 0) {
        world_ = int(a_.bodies.size());
        Body world;
        world.name = a_.unique("world", "_");
        world.location = joint.location;
        a_.bodies.push_back(std::move(world));
      }
      joint.parent = world_;
      a_.bodies[std::size_t(joint.child)].parent_joint = i;
      a_.bodies[std::size_t(world_)].child_joints.push_back(i);
    }
  }

  std::vector<int> find_roots() const {
    std::vector<int> roots;
    for (std::size_t i = 0; i < a_.bodies.size(); ++i)
      if (a_.bodies[i].parent_joint < 0) roots.push_back(int(i));
    return roots;
  }

  int choose_base(const ::sdf::Model& model, const std::vector<int>& roots) const {
    if (world_ >= 0) return world_;
    const ::sdf::Link* canonical = model.CanonicalLink();
    for (const int r : roots)
      if (a_.bodies[std::size_t(r)].link == canonical) return r;
    return roots.empty() ? 0 : roots.front();
  }

  void report_roots(const std::vector<int>& roots) {
    if (roots.size() < 2) return;
    std::vector<std::string> names;
    for (const int r : roots) names.push_back(a_.bodies[std::size_t(r)].name);
    std::erase(names, a_.bodies[std::size_t(a_.base)].name);
    const Body& second = a_.bodies[std::size_t(roots[0] == a_.base ? roots[1] : roots[0])];
    const bool several = names.size() > 1;
    problems_.report(is_static_ ? Severity::note : Severity::warning, second.location,
                     concat("no joint leads to ", several ? "the links " : "link ", quoted_list(names),
                            several ? "; they are" : "; it is", " fixed to the base, link ",
                            quote(a_.bodies[std::size_t(a_.base)].name),
                            is_static_ ? "" : ". What is to move freely is a model of its own"));
  }

  /// Attaches unreached bodies to the base, so that the whole model can be shown.
  void attach_unreached() {
    std::vector<bool> reached(a_.bodies.size(), false);
    const auto reach = [&](int from) {
      std::vector<int> open{from};
      while (!open.empty()) {
        const int b = open.back();
        open.pop_back();
        if (reached[std::size_t(b)]) continue;
        reached[std::size_t(b)] = true;
        for (const int j : a_.bodies[std::size_t(b)].child_joints) open.push_back(a_.joints[std::size_t(j)].child);
      }
    };
    // a base within a loop has a parent among its own descendants
    detach(a_.base);
    reach(a_.base);
    for (const bool loops : {false, true})
      for (std::size_t i = 0; i < a_.bodies.size(); ++i) {
        if (reached[i] || (!loops && a_.bodies[i].parent_joint >= 0)) continue;
        if (loops) leave_out_of_loop(a_.bodies[i].parent_joint);
        detach(int(i));
        a_.bodies[std::size_t(a_.base)].attached.push_back(int(i));
        reach(int(i));
      }
  }

  /// Removes the parent joint of a body.
  void detach(int body) {
    const int joint = std::exchange(a_.bodies[std::size_t(body)].parent_joint, -1);
    if (joint < 0) return;
    auto& joints = a_.bodies[std::size_t(a_.joints[std::size_t(joint)].parent)].child_joints;
    joints.erase(std::find(joints.begin(), joints.end(), joint));
    if (body == a_.base) leave_out_of_loop(joint);
  }

  void leave_out_of_loop(int number) {
    Joint& joint = a_.joints[std::size_t(number)];
    problems_.warning(joint.location, concat("joint ", quote(joint.name), " closes a loop and is left out: link ",
                                             quote(a_.bodies[std::size_t(joint.child)].name),
                                             ", to which it leads, would be its own ", "descendant"));
    joint.left_out = true;
  }

  Assembly& a_;
  Problems& problems_;
  std::vector<int> world_joints_;
  int world_ = -1;
  bool is_static_ = false;
};

}  // namespace

void make_tree(Assembly& assembly, const ::sdf::Model& model, Problems& problems) {
  TreeMaker(assembly, problems).run(model);
}

}  // namespace muro::sdf
