// SPDX-License-Identifier: MIT
#include "core/world_model.hpp"

#include <algorithm>
#include <set>

#include "muro/base/limits.hpp"

namespace muro {

void WorldModel::gravity(const Vec3& acceleration) noexcept {
  if (!limits::within(limits::gravity, acceleration))
    return report(Severity::error, "a gravity with a component that is not from -1e4 to 1e4 m/s^2", 0, 0);
  gravity_ = acceleration;
}

void WorldModel::friction_rule(std::uint32_t rule) noexcept {
  if (rule > std::uint32_t(FrictionRule::max))
    return report(Severity::error, "a friction rule that is none of 0 (min), 1 (mean), 2 (product), 3 (max)", 0, 0);
  friction_rule_ = static_cast<FrictionRule>(rule);
}

void WorldModel::scenery(std::string_view name, const Pose& pose, const Rows<Shape>& collisions,
                         const Rows<Shape>& visuals) noexcept {
  Scenery& s = scenery_.emplace_back(Scenery{std::string(name), pose, {}, {}});
  for (std::size_t i = 0; i < collisions.size(); ++i) s.collisions.push_back(collisions.known(i));
  for (std::size_t i = 0; i < visuals.size(); ++i) s.visuals.push_back(visuals.known(i));
}

RobotBuilder& WorldModel::model(std::string_view name, const Pose& pose) noexcept {
  return models_.emplace_back(Model{std::string(name), pose, {}}).tree;
}

void* WorldModel::find_extension(const ExtensionId& id) noexcept {
  return id == PackageFolders::id() ? static_cast<PackageFolders*>(this) : nullptr;
}

TextId WorldModel::intern(std::string_view text) noexcept { return texts_.intern(text); }

void WorldModel::report(Severity severity, std::string_view text, int line, int column) noexcept {
  problems_.push_back({severity, std::string(text), line, column});
}

void WorldModel::close() {
  std::set<std::string> names;
  const auto check = [&](const std::string& name, const Pose& pose, const char* what) {
    if (name.empty()) report(Severity::error, std::string(what) + " has no name", 0, 0);
    if (!names.insert(name).second)
      report(Severity::error, "two things of the world are named `" + name + "`; names are unique", 0, 0);
    if (const std::string problem = limits::problem_of(pose); !problem.empty())
      report(Severity::error, std::string(what) + " `" + name + "` " + problem, 0, 0);
  };
  for (const Scenery& s : scenery_) check(s.name, s.pose, "scenery");
  for (Model& m : models_) {
    check(m.name, m.pose, "a model");
    m.tree.close();
  }
}

}  // namespace muro
