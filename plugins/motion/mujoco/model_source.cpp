// SPDX-License-Identifier: MIT
#include "model_source.hpp"

#include <algorithm>

#include "muro/base/number_text.hpp"
#include "plugins/common/parser_process/ask.hpp"
#include "plugins/common/parser_process/builder_calls/model_constants.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::mujoco {

namespace {

namespace mc = model_constants;

/// Loads a model that MuJoCo has written to memory.
Model model_in(std::span<const char> bytes) {
  catch_errors();
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* name = "muro.mjb";
  Model model;
  if (mj_makeEmptyFileVFS(files.get(), name, int(bytes.size())) == 0) {
    std::copy(bytes.begin(), bytes.end(), static_cast<char*>(files->filedata[0]));
    try {
      model.reset(mj_loadModel(name, files.get()));
    } catch (const LibraryError&) {
      model.reset();
    }
  }
  mj_deleteVFS(files.get());
  if (!model) throw Error("MuJoCo has no memory for a compiled model of " + std::to_string(bytes.size()) + " bytes");
  return model;
}

/// Returns the root of the body on which an actuator of `m` acts; 0 when it is not known.
int root_of_actuator(const mjModel& m, int actuator) {
  const auto root_of_site = [&m](int site) { return m.body_rootid[m.site_bodyid[site]]; };
  const int id = m.actuator_trnid[2 * actuator];
  switch (m.actuator_trntype[actuator]) {
    case mjTRN_JOINT:
    case mjTRN_JOINTINPARENT:
      return m.body_rootid[m.jnt_bodyid[id]];
    case mjTRN_SLIDERCRANK:
    case mjTRN_SITE:
      return root_of_site(id);
    case mjTRN_TENDON: {
      const int first = m.tendon_adr[id], object = m.wrap_objid[first];
      if (m.wrap_type[first] == mjWRAP_JOINT) return m.body_rootid[m.jnt_bodyid[object]];
      return m.wrap_type[first] == mjWRAP_SITE ? root_of_site(object) : 0;
    }
    default:
      return 0;
  }
}

int number_of(const Connector& c, ObjectId object, const Key<std::uint32_t>& key, int count, const std::string& path) {
  if (object == no_object) return ModelRobotSource::none;
  const auto number = c.constant(object, key);
  if (!number) return ModelRobotSource::none;
  if (*number >= std::uint32_t(count)) throw Error(path + " has changed since the robots were read; start again");
  return int(*number);
}

In<double> connect_target(Connector& c, ObjectId joint, DriveMode mode) {
  switch (mode) {
    case DriveMode::position:
      return c.input(joint, keys::joint_position_target, c.constant(joint, keys::initial_joint_position).value_or(0.0));
    case DriveMode::velocity:
      return c.input(joint, keys::joint_velocity_target, 0.0);
    case DriveMode::effort:
      return c.input(joint, keys::joint_effort_target, 0.0);
    default:
      return {};
  }
}

}  // namespace

CompiledFile compile_file(const std::string& path, const std::string& more) {
  parser_process::Writer request;
  request.text(path);
  request.text(more);
  const parser_process::Answer answer =
      parser_process::ask({.service = "mjcf compiled",
                           .subject = "model " + path,
                           .needs = "libmujoco-dev and libtinyxml2-dev",
                           .advice = "look for what is unusual in the file and in those that it names"},
                          request.bytes());
  parser_process::Reader reader = answer.reader();
  CompiledFile file;
  file.model = model_in(reader.list<char>());
  for (int j = 0; j < file.model->njnt; ++j) {
    const auto mode = reader.value<DriveMode>();
    const int actuator = reader.value<int>();
    if (mode > DriveMode::passive || actuator >= file.model->nu) throw Error(path + " cannot be compiled");
    file.drives.push_back({mode, actuator});
  }
  for (int g = 0; g < file.model->ngeom; ++g) file.scenery.push_back(reader.text());
  return file;
}

void ModelSource::connect(Connector& c) {
  for (const Item& item : c.items()) {
    const std::string name(item.robot->name);
    const auto path = c.constant(item.robot->base(), mc::mjcf_file);
    if (!path)
      throw Error(quote(name) +
                  " was not read from an MJCF file, so that there is no model whose settings it could have; leave "
                  "`settings` out, or give the robot another `world`");
    const bool in_world = c.constant(item.robot->base(), mc::mjcf_in_world).value_or(0) != 0;
    if (path_.empty()) {
      path_ = c.text(*path);
      in_world_ = in_world;
    } else if (path_ != c.text(*path) || in_world != in_world_ || !in_world) {
      throw Error(
          quote(c.items()[0].robot->name) + " and " + quote(name) +
          " are in one world with `settings: model`, which is one MJCF file; give each another `world`, or write "
          "both into a file that the scenario names as `world: {file: ...}`");
    }
  }
  const CompiledFile file = compile_file(path_, "");
  bodies_ = file.model->nbody;
  world_geoms_ = file.model->body_geomnum[0];
  time_step_ = file.model->opt.timestep;
  check_gravity(c, *file.model);
  for (std::uint32_t i = 0; i < c.items().size(); ++i) {
    ModelRobotSource robot = robot_of(c, c.items()[i], c.parameters_of(i), file);
    for (const auto& [other, known] : robots_)
      if (known.root == robot.root)
        throw Error(quote(other) + " and " + quote(c.items()[i].robot->name) + " are the same body of " + path_ +
                    "; give one of them another `world`");
    robots_[std::string(c.items()[i].robot->name)] = std::move(robot);
  }
}

ModelRobotSource ModelSource::robot_of(Connector& c, const Item& item, const Parameters& p, const CompiledFile& file) {
  const mjModel& m = *file.model;
  ModelRobotSource robot;
  for (const Link& link : item.robot->links) {
    const int body = number_of(c, link.object, mc::mjcf_body, m.nbody, path_);
    const int joint = number_of(c, link.joint_object, mc::mjcf_joint, m.njnt, path_);
    robot.bodies.push_back(body);
    robot.joints.push_back(joint);
    robot.drives.push_back(joint < 0 ? ModelDrive{} : file.drives[std::size_t(joint)]);
    robot.targets.push_back(connect_target(c, link.joint_object, robot.drives.back().mode));
    if (body > 0) robot.root = m.body_rootid[body];
  }
  const int root = robot.root;
  robot.is_free = m.body_jntnum[root] == 1 && m.jnt_type[m.body_jntadr[root]] == mjJNT_FREE;
  if (robot.is_free == (p.text("base") == "fixed"))
    throw Error(quote(item.robot->name) + (robot.is_free
                                               ? " moves freely in its MJCF file: `base: fixed` does not go "
                                                 "with `settings: model`; remove the <freejoint> there"
                                               : " is held by the world in its MJCF file; set `base: fixed`"));
  for (int a = 0; a < m.na; ++a) {
    const int owner = root_of_actuator(m, m.nu - m.na + a);
    if (owner == root || (robots_.empty() && owner == 0)) robot.activations.push_back(a);
  }
  return robot;
}

void ModelSource::check_gravity(const Connector& c, const mjModel& m) const {
  const Vec3 here = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
  const Vec3 there = (m.opt.disableflags & mjDSBL_GRAVITY) != 0 ? Vec3(Vec3::Zero()) : vector_of(m.opt.gravity);
  if ((here - there).norm() < 1e-9) return;
  const auto text = [](const Vec3& v) {
    return number_text(v.x()) + " " + number_text(v.y()) + " " + number_text(v.z());
  };
  c.host().log(LogLevel::warning, "motion.mujoco: the gravity of " + path_ + " is " + text(there) +
                                      ", that of the world " + text(here) +
                                      " m/s^2; with `settings: model` the file's counts");
}

}  // namespace muro::mujoco
