// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "muro/robot_builder.hpp"

namespace muro::model_file {

/// Builds the children of the base, depth first. n children make n - 1 forks, each nested in the second branch of the
/// fork before. `add` builds one child, with what leads to it, and returns its children in order.
template <class Child, class Add>
void build_tree(RobotBuilder& builder, const std::vector<Child>& children_of_base, Add add) {
  struct Task {
    enum { open_fork, close_branch, add_child } kind;
    std::optional<Child> child = std::nullopt;
  };
  // An explicit stack, because a chain of links may be longer than the call stack is deep.
  std::vector<Task> stack;
  const auto push = [&stack](const std::vector<Child>& children) {
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const bool last = i + 1 == children.size();
      if (!last) tasks.push_back({Task::open_fork});
      tasks.push_back({Task::add_child, children[i]});
      if (!last) tasks.push_back({Task::close_branch});
    }
    for (std::size_t i = 1; i < children.size(); ++i) tasks.push_back({Task::close_branch});
    stack.insert(stack.end(), tasks.rbegin(), tasks.rend());
  };
  push(children_of_base);
  while (!stack.empty()) {
    const Task task = stack.back();
    stack.pop_back();
    switch (task.kind) {
      case Task::open_fork:
        builder.fork();
        break;
      case Task::close_branch:
        builder.end();
        break;
      case Task::add_child:
        push(add(*task.child));
        break;
    }
  }
}

}  // namespace muro::model_file
