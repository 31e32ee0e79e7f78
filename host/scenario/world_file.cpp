// SPDX-License-Identifier: MIT
#include "host/scenario/world_file.hpp"

#include <algorithm>
#include <cstring>

#include "muro/scene.hpp"
#include "muro/toolkit/did_you_mean.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// What reaches no higher than this (m) lies on the ground, and robots may stand on it.
constexpr double floor_height = 0.01;

std::vector<Shape> shapes_of(const RobotTree::Part& part, const KeyInfo& key) {
  std::vector<Shape> shapes;
  for (const RobotTree::Constant& c : part.constants) {
    if (c.key.name != key.name) continue;
    shapes.resize(c.count);
    std::memcpy(static_cast<void*>(shapes.data()), c.data.data(), c.count * sizeof(Shape));
  }
  return shapes;
}

}  // namespace

void WorldFileParts::read() {
  if (!scenario_.world_file) return;
  const WorldFile& file = *scenario_.world_file;
  problems_.collect(file.location.text() + ": ", [&] { world_ = simulation_.read_world(file.path); });
  if (world_) note(world_->problems(), file.path, false);
}

void WorldFileParts::note(const std::vector<RobotTree::Problem>& problems, const std::string& prefix, bool demote) {
  for (const RobotTree::Problem& p : problems) {
    if (p.severity == Severity::error && !demote) continue;
    notes_.push_back(prefix + (p.line > 0 ? ":" + std::to_string(p.line) + ":" + std::to_string(p.column) : "") + ": " +
                     (p.severity == Severity::note ? "note: " : "warning: ") + p.text);
  }
}

Vec3 WorldFileParts::gravity() const {
  if (scenario_.gravity) return *scenario_.gravity;
  return world_ && world_->gravity() ? *world_->gravity() : Vec3(0, 0, -9.81);
}

const WorldModel::Model* WorldFileParts::find(const std::string& name) const {
  if (!world_) return nullptr;
  const auto& models = world_->models();
  const auto found =
      std::find_if(models.begin(), models.end(), [&](const WorldModel::Model& m) { return m.name == name; });
  return found == models.end() ? nullptr : &*found;
}

RobotTree WorldFileParts::model(const RobotTemplate& t) const {
  if (!scenario_.world_file)
    throw SetupError("`model: world` takes a model of the world file, but there is no `world: {file: ...}`");
  const std::string& path = scenario_.world_file->path;
  if (!world_) throw SetupError(std::vector<std::string>{});  // read() has told why
  const WorldModel::Model* found = find(t.name);
  if (!found) {
    std::vector<std::string> names;
    for (const WorldModel::Model& m : world_->models()) names.push_back(m.name);
    throw SetupError("the world file " + path + " has no movable model of this name" + did_you_mean(t.name, names) +
                     (names.empty() ? "; all of its models are static" : "; it has: " + listed(names)));
  }
  std::vector<std::string> errors;
  for (const RobotTree::Problem& p : found->tree.problems())
    if (p.severity == Severity::error)
      errors.push_back("world " + path +
                       (p.line > 0 ? ":" + std::to_string(p.line) + ":" + std::to_string(p.column) : "") + ": " +
                       p.text);
  if (!errors.empty()) throw SetupError(errors);
  return found->tree;
}

const Pose& WorldFileParts::pose(const RobotTemplate& t) const { return find(t.name)->pose; }

void WorldFileParts::add_scenery(std::vector<Obstacle>& obstacles) {
  if (!world_) return;
  for (const WorldModel::Scenery& s : world_->scenery())
    add(s.name, s.pose, s.collisions, s.visuals, world_->texts(), obstacles);
  for (const WorldModel::Model& m : world_->models()) {
    const bool used = std::any_of(scenario_.robots.begin(), scenario_.robots.end(),
                                  [&](const RobotTemplate& t) { return t.from_world && t.name == m.name; });
    note(m.tree.problems(), scenario_.world_file->path, !used);
    if (!used) stand_still(m, obstacles);
  }
}

/// All of its bodies as scenery, joints at 0.
void WorldFileParts::stand_still(const WorldModel::Model& model, std::vector<Obstacle>& obstacles) {
  const RobotTree& tree = model.tree;
  notes_.push_back(scenario_.world_file->path + ": note: model `" + model.name +
                   "` stands still, as the scenario does not name it; write `robots: {" + model.name +
                   ": {model: world, ...}}` to move it");
  std::vector<Pose> poses;
  for (const RobotTree::FlatLink& f : tree.links()) {
    poses.push_back(f.link.parent < 0 ? model.pose : poses[std::size_t(f.link.parent)] * f.link.origin);
    const RobotTree::Part& part = tree.parts()[std::size_t(f.part)];
    std::vector<Shape> collisions = shapes_of(part, keys::collision_shapes);
    std::vector<Shape> visuals = shapes_of(part, keys::visual_shapes);
    if (!collisions.empty() || !visuals.empty())
      add(model.name + "." + part.name, poses.back(), std::move(collisions), std::move(visuals), tree.texts(),
          obstacles);
  }
}

void WorldFileParts::add(const std::string& name, const Pose& pose, std::vector<Shape> collisions,
                         std::vector<Shape> visuals, const std::vector<std::string>& texts,
                         std::vector<Obstacle>& obstacles) {
  World& world = simulation_.world();
  for (std::vector<Shape>* shapes : {&collisions, &visuals})
    for (Shape& s : *shapes)
      for (TextId* text : {&s.mesh, &s.texture})
        if (*text != no_text) *text = world.intern(texts[std::size_t(*text)]);
  problems_.collect(scenario_.world_file->location.text() + ": world " + scenario_.world_file->path + ": ",
                    [&] { world.add_scenery(name, pose, collisions, visuals); });
  for (const Shape& s : collisions) {
    if (s.kind == ShapeKind::plane) continue;
    const Aabb box = bounds_of(s, pose * s.origin);
    if (box.high.z() <= floor_height) continue;
    const Vec3 half = 0.5 * (box.high - box.low);
    obstacles.push_back({{0.5 * (box.low + box.high), Quat::Identity()}, half.x(), half.y()});
  }
}

}  // namespace muro::host
