// SPDX-License-Identifier: MIT
#include "host/scenario/world_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "host/names.hpp"
#include "muro/base/bounds.hpp"
#include "muro/scene.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Scenery that is not higher than this (m) counts as ground, on which robots may stand.
constexpr double floor_height = 0.01;

std::vector<Shape> shapes_of(const RobotTree::Component& component, const KeyInfo& key) {
  std::vector<Shape> shapes;
  for (const RobotTree::Constant& c : component.constants) {
    if (c.key.name != key.name) continue;
    shapes.resize(c.count);
    std::memcpy(static_cast<void*>(shapes.data()), c.data.data(), c.count * sizeof(Shape));
  }
  return shapes;
}

}  // namespace

void WorldFileContents::read() {
  if (!scenario_.world_file) return;
  const WorldFile& file = *scenario_.world_file;
  problems_.collect(file.location.text() + ": ", [&] { world_ = simulation_.read_world(file.path); });
  if (world_) note(world_->problems(), false);
}

void WorldFileContents::note(const std::vector<RobotTree::Problem>& problems, bool errors_too) {
  for (const RobotTree::Problem& p : problems)
    if (p.severity != Severity::error || errors_too) out_.note(scenario_.world_file->path, p);
}

Vec3 WorldFileContents::gravity() const {
  if (scenario_.gravity) return *scenario_.gravity;
  return world_ && world_->gravity() ? *world_->gravity() : Vec3(0, 0, -9.81);
}

FrictionRule WorldFileContents::friction_rule() const {
  if (scenario_.friction_rule) return *scenario_.friction_rule;
  return world_ ? world_->friction_rule().value_or(FrictionRule::min) : FrictionRule::min;
}

const WorldModel::Model* WorldFileContents::find(const std::string& name) const {
  if (!world_) return nullptr;
  const auto& models = world_->models();
  const auto found =
      std::find_if(models.begin(), models.end(), [&](const WorldModel::Model& m) { return m.name == name; });
  return found == models.end() ? nullptr : &*found;
}

RobotTree WorldFileContents::model(const RobotTemplate& t) const {
  if (!scenario_.world_file)
    throw SetupError("`model: world` takes a model of the world file, but there is no `world: {file: ...}`");
  const std::string& path = scenario_.world_file->path;
  if (!world_) throw SetupError(std::vector<std::string>{});  // read() has reported the reason
  const WorldModel::Model* found = find(t.name);
  if (!found) {
    std::vector<std::string> names;
    for (const WorldModel::Model& m : world_->models()) names.push_back(m.name);
    throw SetupError(
        fmt::format("the world file {} has no movable model of this name{}", path,
                    names.empty() ? "; all of its models are static" : suggestion(t.name, names, "it has")));
  }
  std::vector<std::string> errors;
  for (const RobotTree::Problem& p : found->tree.problems())
    if (p.severity == Severity::error)
      errors.push_back(fmt::format("world {}: {}", Location{path, p.line, p.column}.text(), p.text));
  if (!errors.empty()) throw SetupError(errors);
  return found->tree;
}

const Pose& WorldFileContents::pose(const RobotTemplate& t) const { return find(t.name)->pose; }

void WorldFileContents::add_scenery(Occupancy& occupied) {
  if (!world_) return;
  for (const WorldModel::Scenery& s : world_->scenery())
    add(s.name, s.pose, s.collisions, s.visuals, world_->texts(), occupied);
  for (const WorldModel::Model& m : world_->models()) {
    const bool used = std::any_of(scenario_.robots.begin(), scenario_.robots.end(),
                                  [&](const RobotTemplate& t) { return t.from_world && t.name == m.name; });
    note(m.tree.problems(), !used);
    if (!used) add_static(m, occupied);
  }
}

/// Adds all links of a model as scenery, with its joints at 0.
void WorldFileContents::add_static(const WorldModel::Model& model, Occupancy& occupied) {
  const RobotTree& tree = model.tree;
  out_.notes.push_back(
      fmt::format("{}: note: model `{}` is static, because the scenario does not name it; write `robots: "
                  "{{{}: {{model: world, ...}}}}` to move it",
                  scenario_.world_file->path, model.name, model.name));
  std::vector<Pose> poses;
  for (const RobotTree::FlatLink& f : tree.links()) {
    poses.push_back(f.link.parent < 0 ? model.pose : poses[std::size_t(f.link.parent)] * f.link.origin);
    const RobotTree::Component& component = tree.components()[std::size_t(f.body)];
    std::vector<Shape> collisions = shapes_of(component, keys::collision_shapes);
    std::vector<Shape> visuals = shapes_of(component, keys::visual_shapes);
    if (!collisions.empty() || !visuals.empty())
      add(model.name + "." + component.name, poses.back(), std::move(collisions), std::move(visuals), tree.texts(),
          occupied);
  }
}

void WorldFileContents::add(const std::string& name, const Pose& pose, std::vector<Shape> collisions,
                            std::vector<Shape> visuals, const TextTable& texts, Occupancy& occupied) {
  unreadable_meshes_.leave_out(collisions, texts, scenario_.world_file->path, name);
  World& world = simulation_.world();
  for (std::vector<Shape>* shapes : {&collisions, &visuals})
    for (Shape& s : *shapes)
      for (TextId* text : {&s.mesh, &s.texture})
        if (*text != no_text) *text = world.intern(texts[*text]);
  problems_.collect(scenario_.world_file->location.text() + ": world " + scenario_.world_file->path + ": ",
                    [&] { world.add_scenery(name, pose, collisions, visuals); });
  const bool any_random = std::any_of(scenario_.robots.begin(), scenario_.robots.end(), [](const RobotTemplate& t) {
    return t.placement.kind == Placement::Kind::random;
  });
  if (!any_random) return;  // nothing uses the occupied places
  for (const Shape& s : collisions) {
    if (s.kind == ShapeKind::plane || s.kind == ShapeKind::heightmap) continue;
    const std::string mesh = s.kind == ShapeKind::mesh ? std::string(world.text(s.mesh)) : "";
    const Aabb box = meshes_.bounds_of(s, mesh, pose * s.origin);
    if (box.high.z() <= floor_height) continue;
    const Vec3 half = 0.5 * (box.high - box.low);
    occupied.add(Obstacle{{0.5 * (box.low + box.high), Quat::Identity()}, half.x(), half.y()});
  }
}

}  // namespace muro::host
