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
    hang_on_joints();
    const std::vector<int> roots = find_roots();
    a_.base = choose_base(model, roots);
    tell_roots(roots);
    hold_the_rest();
  }

 private:
  static bool leads(const Bond& b) { return b.joint->Type() != ::sdf::JointType::GEARBOX; }

  void hang_on_joints() {
    for (std::size_t i = 0; i < a_.bonds.size(); ++i) {
      Bond& bond = a_.bonds[i];
      if (!leads(bond)) continue;
      if (bond.parent < 0) {
        holds_.push_back(int(i));
        continue;
      }
      Body& child = a_.bodies[std::size_t(bond.child)];
      if (child.parent_joint >= 0) {
        two_parents(bond, a_.bonds[std::size_t(child.parent_joint)], child);
        continue;
      }
      child.parent_joint = int(i);
      a_.bodies[std::size_t(bond.parent)].child_joints.push_back(int(i));
    }
    hold_on_world();
  }

  void two_parents(const Bond& bond, const Bond& other, const Body& child) {
    problems_.error(bond.at,
                    say("link ", cited(child.name), " is the child of two joints, ", cited(other.name), " and ",
                        cited(bond.name), "; robots are trees, and closed chains are not simulated. Leave one out"));
  }

  /// Joints on the world: fixed ones say what the motion has to know, others need a body that stands for the world.
  void hold_on_world() {
    if (holds_.empty()) return;
    const bool moves = std::any_of(holds_.begin(), holds_.end(), [&](int i) {
      return a_.bonds[std::size_t(i)].joint->Type() != ::sdf::JointType::FIXED;
    });
    const Bond& first = a_.bonds[std::size_t(holds_.front())];
    problems_.note(first.at,
                   say("joint ", cited(first.name), " fixes the robot to the world: set `base: fixed` in the motion"));
    for (const int i : holds_) {
      Bond& bond = a_.bonds[std::size_t(i)];
      Body& child = a_.bodies[std::size_t(bond.child)];
      if (child.parent_joint >= 0) {
        two_parents(bond, a_.bonds[std::size_t(child.parent_joint)], child);
        continue;
      }
      if (!moves && holds_.size() == 1) return;
      if (world_ < 0) {
        world_ = int(a_.bodies.size());
        Body world;
        world.name = a_.unique("world", "_");
        world.at = bond.at;
        a_.bodies.push_back(std::move(world));
      }
      bond.parent = world_;
      a_.bodies[std::size_t(bond.child)].parent_joint = i;
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

  void tell_roots(const std::vector<int>& roots) {
    if (roots.size() < 2) return;
    std::vector<std::string> names;
    for (const int r : roots) names.push_back(a_.bodies[std::size_t(r)].name);
    const Body& second = a_.bodies[std::size_t(roots[0] == a_.base ? roots[1] : roots[0])];
    problems_.error(
        second.at,
        say("no joint leads to ", roots.size(), " links: ", listed(names), "; exactly one is the base. Join the ",
            "others to it, with fixed joints if they do not move, or make them models of their own"));
  }

  /// Bodies that cannot be reached from the base are held by it, so that all of the model can be shown.
  void hold_the_rest() {
    std::vector<bool> reached(a_.bodies.size(), false);
    const auto reach = [&](int from) {
      std::vector<int> open{from};
      while (!open.empty()) {
        const int b = open.back();
        open.pop_back();
        if (reached[std::size_t(b)]) continue;
        reached[std::size_t(b)] = true;
        for (const int j : a_.bodies[std::size_t(b)].child_joints) open.push_back(a_.bonds[std::size_t(j)].child);
      }
    };
    // a base within a loop has a parent, which hangs on it in turn
    cut(a_.base);
    reach(a_.base);
    for (const bool loops : {false, true})
      for (std::size_t i = 0; i < a_.bodies.size(); ++i) {
        if (reached[i] || (!loops && a_.bodies[i].parent_joint >= 0)) continue;
        if (loops) tell_loop(int(i));
        cut(int(i));
        a_.bodies[std::size_t(a_.base)].attached.push_back(int(i));
        reach(int(i));
      }
  }

  /// Takes away the joint by which a body hangs.
  void cut(int body) {
    const int joint = std::exchange(a_.bodies[std::size_t(body)].parent_joint, -1);
    if (joint < 0) return;
    auto& joints = a_.bodies[std::size_t(a_.bonds[std::size_t(joint)].parent)].child_joints;
    joints.erase(std::find(joints.begin(), joints.end(), joint));
    if (body == a_.base) tell_joint_in_loop(joint);
  }

  void tell_loop(int body) { tell_joint_in_loop(a_.bodies[std::size_t(body)].parent_joint); }

  void tell_joint_in_loop(int joint) {
    const Bond& bond = a_.bonds[std::size_t(joint)];
    problems_.error(bond.at, say("joint ", cited(bond.name), " closes a loop of joints: link ",
                                 cited(a_.bodies[std::size_t(bond.child)].name),
                                 " hangs on itself; robots are trees, and closed chains are not simulated"));
  }

  Assembly& a_;
  Problems& problems_;
  std::vector<int> holds_;
  int world_ = -1;
};

}  // namespace

void make_tree(Assembly& assembly, const ::sdf::Model& model, Problems& problems) {
  TreeMaker(assembly, problems).run(model);
}

}  // namespace muro::sdf
