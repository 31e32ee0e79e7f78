// SPDX-License-Identifier: MIT
#include "core/world_model.hpp"

#include <algorithm>
#include <set>

namespace muro {

void WorldModel::gravity(const Vec3& acceleration) noexcept {
  if (!acceleration.allFinite()) return report(Severity::error, "a gravity that is not finite", 0, 0);
  gravity_ = acceleration;
}

void WorldModel::scenery(std::string_view name, const Pose& pose, std::span<const Shape> collisions,
                         std::span<const Shape> visuals) noexcept {
  scenery_.push_back(
      {std::string(name), pose, {collisions.begin(), collisions.end()}, {visuals.begin(), visuals.end()}});
}

RobotBuilder& WorldModel::model(std::string_view name, const Pose& pose) noexcept {
  return models_.emplace_back(Model{std::string(name), pose, {}}).tree;
}

TextId WorldModel::intern(std::string_view text) noexcept {
  const auto it = std::find(texts_.begin(), texts_.end(), text);
  if (it != texts_.end()) return TextId(it - texts_.begin());
  texts_.emplace_back(text);
  return TextId(texts_.size() - 1);
}

void WorldModel::report(Severity severity, std::string_view text, int line, int column) noexcept {
  problems_.push_back({severity, std::string(text), line, column});
}

void WorldModel::close() {
  std::set<std::string> names;
  const auto check = [&](const std::string& name, const Pose& pose, const char* what) {
    if (name.empty()) report(Severity::error, std::string(what) + " has no name", 0, 0);
    if (!names.insert(name).second)
      report(Severity::error, "two things of the world are named `" + name + "`; names are unique", 0, 0);
    if (!pose.position.allFinite() || !pose.orientation.coeffs().allFinite())
      report(Severity::error, std::string(what) + " `" + name + "` stands at no finite pose", 0, 0);
  };
  for (const Scenery& s : scenery_) check(s.name, s.pose, "scenery");
  for (Model& m : models_) {
    check(m.name, m.pose, "a model");
    m.tree.close();
  }
}

}  // namespace muro
