// SPDX-License-Identifier: MIT
#include "build.hpp"

#include "bodies.hpp"
#include "joints.hpp"
#include "muro/vocabulary.hpp"

namespace muro::sdf {

namespace {

class TreeBuilder {
 public:
  TreeBuilder(Assembly& assembly, const Sources& sources, RobotBuilder& builder, Problems& problems)
      : a_(assembly),
        sources_(sources),
        builder_(builder),
        problems_(problems),
        joints_(assembly, sources, builder, problems) {}

  void run() {
    builder_.base(body(a_.base).name);
    fill(a_.base);
    // An own stack: a chain of links may be longer than the call stack is deep.
    std::vector<Task> open;
    push_children(open, a_.base);
    while (!open.empty()) {
      const Task task = open.back();
      open.pop_back();
      switch (task.kind) {
        case Task::open_fork:
          builder_.fork();
          break;
        case Task::close_branch:
          builder_.end();
          break;
        case Task::add:
          push_children(open, add(task));
          break;
      }
    }
    if (mass_ == 0 && !problems_.found_error())
      problems_.warning(body(a_.base).at, "no link has a mass; only motion without forces can move the robot");
  }

 private:
  struct Task {
    enum { open_fork, close_branch, add } kind;
    int bond = -1;               ///< or none:
    int holder = -1, held = -1;  ///< a body that is held by another
  };

  const Body& body(int i) const { return a_.bodies[std::size_t(i)]; }

  /// n children make n - 1 forks, each nested in the second branch of the one before.
  void push_children(std::vector<Task>& open, int parent) const {
    std::vector<Task> children, tasks;
    for (const int j : body(parent).child_joints) children.push_back({Task::add, j});
    for (const int b : body(parent).attached) children.push_back({Task::add, -1, parent, b});
    for (std::size_t i = 0; i < children.size(); ++i) {
      const bool last = i + 1 == children.size();
      if (!last) tasks.push_back({Task::open_fork});
      tasks.push_back(children[i]);
      if (!last) tasks.push_back({Task::close_branch});
    }
    for (std::size_t i = 1; i < children.size(); ++i) tasks.push_back({Task::close_branch});
    open.insert(open.end(), tasks.rbegin(), tasks.rend());
  }

  /// Returns the body.
  int add(const Task& task) {
    int child = task.held;
    if (task.bond >= 0) {
      joints_.add(task.bond);
      child = a_.bonds[std::size_t(task.bond)].child;
    } else {
      joints_.place(body(task.holder).pose.inverse() * body(child).pose);
    }
    builder_.body(body(child).name);
    fill(child);
    return child;
  }

  void fill(int i) {
    const Body& b = body(i);
    if (!b.link) return;
    const Solid solid = solid_of(
        *b.link, b.name, true, sources_, [this](std::string_view text) { return builder_.intern(text); }, problems_);
    mass_ += solid.inertial.mass;
    if (solid.inertial.mass > 0) builder_.set(keys::inertial, solid.inertial);
    if (!solid.collisions.empty()) builder_.set_array<Shape>(keys::collision_shapes, solid.collisions);
    if (!solid.visuals.empty()) builder_.set_array<Shape>(keys::visual_shapes, solid.visuals);
  }

  Assembly& a_;
  const Sources& sources_;
  RobotBuilder& builder_;
  Problems& problems_;
  Joints joints_;
  double mass_ = 0;
};

}  // namespace

void build(Assembly& assembly, const Sources& sources, RobotBuilder& builder, Problems& problems) {
  TreeBuilder(assembly, sources, builder, problems).run();
}

}  // namespace muro::sdf
