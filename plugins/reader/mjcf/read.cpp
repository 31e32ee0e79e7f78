// SPDX-License-Identifier: MIT
#include "read.hpp"

#include <filesystem>

#include "left_out.hpp"
#include "muro/toolkit/pair_surface.hpp"
#include "plugins/common/model_file/text_file.hpp"
#include "plugins/common/text/quote.hpp"
#include "robot.hpp"

namespace muro::mjcf {

namespace {

Vec3 gravity_of(const mjModel& m) {
  return (m.opt.disableflags & mjDSBL_GRAVITY) != 0 ? Vec3(Vec3::Zero()) : vector_of(m.opt.gravity);
}

/// An object of a world that does not move: a geom of the world's body, or a child of the world's body without joints,
/// with all its descendants.
struct SceneryObject {
  std::string name;
  std::vector<int> geoms;
};
std::vector<SceneryObject> scenery_of(const mjModel& m, Names& names) {
  std::vector<SceneryObject> found;
  for (int g = 0; g < m.body_geomnum[0]; ++g) {
    const int geom = m.body_geomadr[0] + g;
    const std::string name = name_of(m, m.name_geomadr, geom);
    found.push_back({names.unique(name.empty() ? concat("geom_", g + 1) : name), {geom}});
  }
  for (const int top : top_bodies(m)) {
    if (can_move(m, top)) continue;
    SceneryObject object{names.unique(body_name(m, top)), {}};
    for (const int b : subtree(m, top))
      for (int g = m.body_geomadr[b]; g < m.body_geomadr[b] + m.body_geomnum[b]; ++g) object.geoms.push_back(g);
    if (!object.geoms.empty()) found.push_back(std::move(object));
  }
  return found;
}

/// Reports the parts of a file that do not belong to the robot that was taken.
void tell_rest(const mjModel& m, int taken, const Source& source, Shapes& shapes, Problems& problems) {
  std::vector<std::string> rest;
  int first = 0;
  for (int g = 0; g < m.body_geomnum[0]; ++g) rest.push_back(shapes.name_of_geom(m.body_geomadr[0] + g));
  for (const int b : top_bodies(m)) {
    if (b == taken) continue;
    rest.push_back(body_name(m, b));
    if (first == 0) first = b;
  }
  if (rest.empty()) return;
  problems.note(first > 0 ? source.location_of("body", name_of(m, m.name_bodyadr, first)) : Location{},
                concat("the robot is body ", quote(body_name(m, taken)), " with what hangs on it; ", quoted_list(rest),
                       " of <worldbody> ", rest.size() == 1 ? "is" : "are",
                       " left out: `world: {file: ...}` reads all of a file"));
}

int robot_in(const mjModel& m) {
  const std::vector<int> tops = top_bodies(m);
  for (const int b : tops)
    if (can_move(m, b)) return b;
  return tops.empty() ? 0 : tops.front();
}

class WorldMaker {
 public:
  WorldMaker(const Compiled& compiled, const Source& source, const Drives& drives, WorldBuilder& builder,
             Problems& problems)
      : m_(*compiled.model),
        source_(source),
        drives_(drives),
        builder_(builder),
        problems_(problems),
        shapes_(compiled, source) {}

  void run() {
    builder_.gravity(gravity_of(m_));
    builder_.friction_rule(std::uint32_t(FrictionRule::max));
    for (const SceneryObject& object : scenery_of(m_, names_)) add_scenery(object);
    for (const int top : top_bodies(m_))
      if (can_move(m_, top)) add_model(top);
    shapes_.report_left_out(problems_);
  }

 private:
  void add_scenery(const SceneryObject& object) {
    const int body = m_.geom_bodyid[object.geoms.front()], root = m_.body_rootid[body];
    const bool in_world = body == 0;
    const Pose pose = in_world ? pose_of(m_.geom_pos + 3 * object.geoms[0], m_.geom_quat + 4 * object.geoms[0])
                               : pose_in_world(m_, root);
    Solid solid;
    for (const int g : object.geoms)
      shapes_.add(
          g, in_world ? Pose{} : pose.inverse() * pose_in_world(m_, m_.geom_bodyid[g]),
          [this](std::string_view text) { return builder_.intern(text); }, solid);
    if (in_world)
      for (std::vector<Shape>* shapes : {&solid.collisions, &solid.visuals})
        for (Shape& s : *shapes) s.origin = pose.inverse() * s.origin;
    if (!solid.collisions.empty() || !solid.visuals.empty())
      builder_.scenery(object.name, pose, solid.collisions, solid.visuals);
  }

  void add_model(int top) {
    // problems go to the robot's builder: a model that is not used as a robot may be invalid
    RobotBuilder& robot = builder_.model(names_.unique(body_name(m_, top)), base_pose(m_, top));
    Problems own = Problems::reported_to(robot);
    build_robot({m_, source_, drives_, true}, top, shapes_, robot, own);
  }

  const mjModel& m_;
  const Source& source_;
  const Drives& drives_;
  WorldBuilder& builder_;
  Problems& problems_;
  Shapes shapes_;
  Names names_;
};

}  // namespace

void read_text(std::string bytes, const std::string& path, RobotBuilder& builder) {
  Problems problems = Problems::reported_to(builder);
  Source source;
  if (!source.load(std::move(bytes), path, problems)) return;
  const Compiled compiled = source.compile(problems);
  if (!compiled.model) return;
  const mjModel& m = *compiled.model;
  const int top = robot_in(m);
  if (top == 0)
    return problems.error({},
                          "the file has no <body>; if it is scenery, name it as the scenario's `world: {file: ...}`");
  const Drives drives = drives_of(m);
  Shapes shapes(compiled, source);
  build_robot({m, source, drives, false}, top, shapes, builder, problems);
  shapes.report_left_out(problems);
  tell_rest(m, top, source, shapes, problems);
  report_left_out(m, source, drives, problems);
}

void read_world_text(std::string bytes, const std::string& path, WorldBuilder& builder) {
  Problems problems = Problems::reported_to(builder);
  Source source;
  if (!source.load(std::move(bytes), path, problems)) return;
  const Compiled compiled = source.compile(problems);
  if (!compiled.model) return;
  const Drives drives = drives_of(*compiled.model);
  WorldMaker(compiled, source, drives, builder, problems).run();
  report_left_out(*compiled.model, source, drives, problems);
}

void read_file(const std::string& path, RobotBuilder& builder) {
  read_text(model_file::load_file(path, "MJCF"), std::filesystem::absolute(path).lexically_normal().string(), builder);
}

void read_world_file(const std::string& path, WorldBuilder& builder) {
  read_world_text(model_file::load_file(path, "MJCF"), std::filesystem::absolute(path).lexically_normal().string(),
                  builder);
}

void write_compiled(const std::string& path, const std::string& more, parser_process::Writer& out) {
  std::string error;
  Problems problems([&error](Severity severity, std::string_view text, int, int) {
    if (severity == Severity::error && error.empty()) error = text;
  });
  Source source;
  Compiled compiled;
  if (source.load(model_file::load_file(path, "MJCF"), path, problems)) compiled = source.compile(problems, more);
  if (!compiled.model) throw Error(concat(path, ": ", error));
  const mjModel& m = *compiled.model;
  std::vector<char> bytes(std::size_t(mj_sizeModel(&m)));
  mj_saveModel(&m, nullptr, bytes.data(), int(bytes.size()));
  out.list(std::span<const char>(bytes));
  const Drives drives = drives_of(m);
  for (const Drive& d : drives.of_joint) {
    out.value(d.mode);
    out.value(d.actuator);
  }
  Names names;
  std::vector<std::string> scenery(std::size_t(m.ngeom));
  for (const SceneryObject& object : scenery_of(m, names))
    for (const int g : object.geoms) scenery[std::size_t(g)] = object.name;
  for (const std::string& name : scenery) out.text(name);
}

}  // namespace muro::mjcf
