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
        report_two_parents(joint, a_.joints[std::size_t(child.parent_joint)], child);
        continue;
      }
      child.parent_joint = int(i);
      a_.bodies[std::size_t(joint.parent)].child_joints.push_back(int(i));
    }
    connect_to_world();
  }

  void report_two_parents(const Joint& joint, const Joint& other, const Body& child) {
    problems_.error(joint.location, concat("link ", quote(child.name), " is the child of two joints, ",
                                           quote(other.name), " and ", quote(joint.name),
                                           "; robots are trees, and closed chains are not simulated. Leave one out"));
  }

  /// Joints with the world: a fixed one is reported, for the motion has to know it; others need a body that stands for
  /// the world.
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
        report_two_parents(joint, a_.joints[std::size_t(child.parent_joint)], child);
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
    const Body& second = a_.bodies[std::size_t(roots[0] == a_.base ? roots[1] : roots[0])];
    problems_.error(second.location,
                    concat("no joint leads to ", roots.size(), " links: ", quoted_list(names),
                           "; exactly one is the base. Join the ",
                           "others to it, with fixed joints if they do not move, or make them models of their own"));
  }

  /// Bodies that cannot be reached from the base are attached to it, so that all of the model can be shown.
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
    // a base within a loop has a parent, which is among its own descendants
    detach(a_.base);
    reach(a_.base);
    for (const bool loops : {false, true})
      for (std::size_t i = 0; i < a_.bodies.size(); ++i) {
        if (reached[i] || (!loops && a_.bodies[i].parent_joint >= 0)) continue;
        if (loops) report_loop(int(i));
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
    if (body == a_.base) report_joint_in_loop(joint);
  }

  void report_loop(int body) { report_joint_in_loop(a_.bodies[std::size_t(body)].parent_joint); }

  void report_joint_in_loop(int number) {
    const Joint& joint = a_.joints[std::size_t(number)];
    problems_.error(joint.location,
                    concat("joint ", quote(joint.name), " closes a loop of joints: link ",
                           quote(a_.bodies[std::size_t(joint.child)].name),
                           " is its own descendant; robots are trees, and closed chains are not simulated"));
  }

  Assembly& a_;
  Problems& problems_;
  std::vector<int> world_joints_;
  int world_ = -1;
};

}  // namespace

void make_tree(Assembly& assembly, const ::sdf::Model& model, Problems& problems) {
  TreeMaker(assembly, problems).run(model);
}

}  // namespace muro::sdf
