// SPDX-License-Identifier: MIT
#include "model_world.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "muro/base/number_text.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::mujoco {

using multibody::MotionType;

namespace {

/// Largest number of contacts to which buffers may grow.
constexpr int most_contacts = 1 << 16;

/// All bits of contype and conaffinity: bodies from outside the file touch every geom of the file that touches
/// anything.
constexpr int every_bit = 0x7fffffff;

}  // namespace

ModelWorld::ModelWorld(const ModelSource& source, const MujocoMeshes& meshes, Host& host)
    : source_(source), host_(host), mjcf_(meshes, Mjcf::Contacts::of_each_geom) {}

void ModelWorld::add_static_body(const multibody::ExternalBody& body) { static_bodies_.push_back({&body, owners_++}); }

void ModelWorld::add_kinematic_body(const multibody::ExternalBody& body, const multibody::ExternalBodyState& state) {
  kinematic_bodies_.push_back({&body, &state, owners_});
  mjcf_.add_kinematic_body(body, owners_++);
}

void ModelWorld::add_robot(const multibody::RobotModel& model, multibody::RobotState& state) {
  robots_.emplace_back(model, state, source_.robot(model.name));
}

void ModelWorld::complete() {
  const CompiledFile alone = compile_file(source_.path(), "");
  if (alone.model->nbody != source_.bodies())
    throw Error(source_.path() + " has changed since the robots were read; start again");
  const auto in_file = [&](const StaticBody& s) {
    return source_.in_world() &&
           std::find(alone.scenery.begin(), alone.scenery.end(), s.body->name) != alone.scenery.end();
  };
  for (const StaticBody& s : static_bodies_)
    if (!in_file(s)) mjcf_.add_static_body(*s.body, s.owner);
  file_ = compile_file(source_.path(), mjcf_.elements());
  mjcf_.fill_height_fields(*file_.model);
  data_ = make_data(*file_.model);
  find_robots();
  leave_out_other_parts();
  find_scenery();
  find_kinematic_bodies();
}

void ModelWorld::find_robots() {
  mjModel& m = *file_.model;
  robot_of_body_.assign(std::size_t(m.nbody), -1);
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i].find_indices(m);
    for (int b = 1; b < m.nbody; ++b)
      if (m.body_rootid[b] == robots_[i].root()) robot_of_body_[std::size_t(b)] = std::int32_t(i);
  }
}

/// Disables trees that are no robots of this world: they stand still and touch nothing. Also disables bodies at rest in
/// a file that is not the world of the scene.
void ModelWorld::leave_out_other_parts() {
  mjModel& m = *file_.model;
  std::vector<bool> is_left_out(std::size_t(m.ngeom)), is_held(std::size_t(m.nbody));
  for (int j = 0; j < m.njnt; ++j) {
    if (robot_of_body_[std::size_t(m.jnt_bodyid[j])] >= 0) continue;
    held_joints_.push_back(j);
    is_held[std::size_t(m.body_rootid[m.jnt_bodyid[j]])] = true;
  }
  for (int g = 0; g < m.ngeom; ++g) {
    const int body = m.geom_bodyid[g], root = m.body_rootid[body];
    if (robot_of_body_[std::size_t(body)] >= 0 || body >= source_.bodies()) continue;
    const bool added = body == 0 && g >= m.body_geomadr[0] + source_.world_geoms();
    if (added || (source_.in_world() && !is_held[std::size_t(root)])) continue;
    is_left_out[std::size_t(g)] = true;
    m.geom_contype[g] = m.geom_conaffinity[g] = 0;
  }
  int kept = 0;
  for (int p = 0; p < m.npair; ++p) {
    if (is_left_out[std::size_t(m.pair_geom1[p])] || is_left_out[std::size_t(m.pair_geom2[p])]) continue;
    m.pair_dim[kept] = m.pair_dim[p];
    m.pair_geom1[kept] = m.pair_geom1[p];
    m.pair_geom2[kept] = m.pair_geom2[p];
    m.pair_signature[kept] = m.pair_signature[p];
    std::copy_n(m.pair_solref + mjNREF * p, mjNREF, m.pair_solref + mjNREF * kept);
    std::copy_n(m.pair_solimp + mjNIMP * p, mjNIMP, m.pair_solimp + mjNIMP * kept);
    std::copy_n(m.pair_friction + 5 * p, 5, m.pair_friction + 5 * kept);
    m.pair_margin[kept] = m.pair_margin[p];
    m.pair_gap[kept] = m.pair_gap[p];
    ++kept;
  }
  m.npair = kept;
  const auto holds_left_out = [&](int equality, const int* ids) {
    const int id = ids[equality];
    if (id < 0) return false;
    switch (m.eq_type[equality]) {
      case mjEQ_CONNECT:
      case mjEQ_WELD:
        return bool(is_held[std::size_t(m.body_rootid[id])]);
      case mjEQ_JOINT:
        return bool(is_held[std::size_t(m.body_rootid[m.jnt_bodyid[id]])]);
      default:
        return false;
    }
  };
  for (int e = 0; e < m.neq; ++e)
    if (holds_left_out(e, m.eq_obj1id) || holds_left_out(e, m.eq_obj2id)) m.eq_active[e] = 0;
}

void ModelWorld::find_scenery() {
  const mjModel& m = *file_.model;
  obstacles_.assign(std::size_t(m.ngeom), nullptr);
  objects_.assign(std::size_t(m.ngeom), no_object);
  std::map<std::string_view, const StaticBody*> by_name;
  for (const StaticBody& s : static_bodies_) {
    by_name[s.body->name] = &s;
    const std::string name = Mjcf::body_name(s.body->name, s.owner, 0);
    for (std::size_t k = 0; k < s.body->shapes.size(); ++k)
      if (const int geom = mj_name2id(&m, mjOBJ_GEOM, Mjcf::geom_name(name, k).c_str()); geom >= 0)
        set_obstacle(geom, s);
  }
  for (int g = 0; source_.in_world() && g < m.ngeom; ++g)
    if (const auto found = by_name.find(file_.scenery[std::size_t(g)]);
        found != by_name.end() && !obstacles_[std::size_t(g)])
      set_obstacle(g, *found->second);
  for (int g = 0; g < m.ngeom; ++g)
    if (const std::int32_t robot = robot_of_body_[std::size_t(m.geom_bodyid[g])]; robot >= 0)
      objects_[std::size_t(g)] = robots_[std::size_t(robot)].object_of(m.geom_bodyid[g]);
}

void ModelWorld::set_obstacle(int geom, const StaticBody& body) {
  obstacles_[std::size_t(geom)] = &body.body->name;
  objects_[std::size_t(geom)] = body.body->shapes.front().object;
}

void ModelWorld::find_kinematic_bodies() {
  const mjModel& m = *file_.model;
  for (KinematicBody& k : kinematic_bodies_) {
    k.index = mj_name2id(&m, mjOBJ_BODY, Mjcf::body_name(k.body->name, k.owner, 0).c_str());
    if (k.index < 0 || m.body_mocapid[k.index] < 0)
      throw Error(quote(k.body->name) + " cannot stand in " + source_.path() + ", whose compiler changes it");
    k.mocap = m.body_mocapid[k.index];
    std::fill_n(objects_.begin() + m.body_geomadr[k.index], m.body_geomnum[k.index], k.body->shapes.front().object);
  }
}

void ModelWorld::set_time_step(double dt) {
  if (dt_ == 0 && std::abs(dt - source_.time_step()) > 1e-9 * dt)
    host_.log(LogLevel::warning, "motion.mujoco: steps take " + number_text(dt) + " s, those of " + source_.path() +
                                     " take " + number_text(source_.time_step()) + "; `rate: " +
                                     std::to_string(std::lround(1 / source_.time_step())) + "` has the file's");
  dt_ = dt;
  file_.model->opt.timestep = dt;
}

void ModelWorld::import(KinematicBody& k) {
  mjModel& m = *file_.model;
  const bool enabled = k.state->motion_type == MotionType::kinematic;
  if (enabled != k.enabled) {
    k.enabled = enabled;
    const int first = m.body_geomadr[k.index], count = m.body_geomnum[k.index];
    std::fill_n(m.geom_contype + first, count, enabled ? every_bit : 0);
    std::fill_n(m.geom_conaffinity + first, count, enabled ? every_bit : 0);
  }
  const Quat& q = k.state->pose.orientation;
  const mjtNum orientation[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy_n(k.state->pose.position.data(), 3, data_->mocap_pos + 3 * k.mocap);
  std::copy_n(orientation, 4, data_->mocap_quat + 4 * k.mocap);
}

/// Advances the world. A step without enough memory is repeated: its start is in the states.
void ModelWorld::advance(double dt) {
  if (dt != dt_) set_time_step(dt);
  while (!step()) {
    mjModel& m = *file_.model;
    m.nconmax *= 2;
    m.njmax *= 2;
    m.nstack = m.nstack < (1 << 28) ? 2 * m.nstack : m.nstack;
    data_.reset();
    data_ = make_data(m);
  }
  for (ModelRobot& r : robots_) r.export_state(*data_);
  report_contacts();
}

/// Makes a step. Returns false when there was no room for all contacts.
bool ModelWorld::step() {
  mjModel& m = *file_.model;
  mjData& d = *data_;
  for (KinematicBody& k : kinematic_bodies_) import(k);
  for (ModelRobot& r : robots_) r.import(m, d);
  for (const int j : held_joints_) {
    const int type = m.jnt_type[j], positions = type == mjJNT_FREE ? 7 : type == mjJNT_BALL ? 4 : 1;
    const int velocities = type == mjJNT_FREE ? 6 : type == mjJNT_BALL ? 3 : 1;
    std::copy_n(m.qpos0 + m.jnt_qposadr[j], positions, d.qpos + m.jnt_qposadr[j]);
    std::fill_n(d.qvel + m.jnt_dofadr[j], velocities, 0.0);
    std::fill_n(d.qacc_warmstart + m.jnt_dofadr[j], velocities, 0.0);
  }
  for (mjWarningStat& warning : d.warning) warning = {};
  try {
    mj_step(&m, &d);
  } catch (const LibraryError& e) {
    if (e.text.find("tack overflow") == std::string::npos || m.nstack >= (1 << 28)) throw Error("MuJoCo: " + e.text);
    return false;
  }
  for (const int bad : {mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
    if (d.warning[bad].number > 0)
      throw Error("MuJoCo: " + std::string(mju_warningText(bad, std::size_t(d.warning[bad].lastinfo))));
  const bool full = d.warning[mjWARN_CONTACTFULL].number > 0 || d.warning[mjWARN_CNSTRFULL].number > 0;
  return !full || m.nconmax >= most_contacts;
}

/// Reports a contact to each of its robots that the world moves; once if both bodies are of one robot. `force` and
/// `torque`: on the second body, to which MuJoCo's normal points.
void ModelWorld::tell_contact(const mjContact& contact, const std::int32_t (&owners)[2], const Vec3& force,
                              const Vec3& torque) const {
  for (int side = 0; side < 2; ++side) {
    if (owners[side] < 0) continue;
    multibody::RobotState& state = robots_[std::size_t(owners[side])].state();
    if (state.motion_type != MotionType::dynamic) continue;
    const double sign = side == 0 ? -1 : 1;
    const int geoms[] = {contact.geom1, contact.geom2};
    if (state.tells_contacts)
      state.contacts.push_back({objects_[std::size_t(geoms[side])],
                                objects_[std::size_t(geoms[1 - side])],
                                vector_of(contact.pos),
                                sign * vector_of(contact.frame),
                                -contact.dist,
                                {sign * force, sign * torque}});
    if (owners[0] == owners[1]) return;
  }
}

/// Reports the contacts at the beginning of the step.
void ModelWorld::report_contacts() {
  const mjModel& m = *file_.model;
  const mjData& d = *data_;
  for (int i = 0; i < d.ncon; ++i) {
    const mjContact& contact = d.contact[i];
    const int bodies[] = {m.geom_bodyid[contact.geom1], m.geom_bodyid[contact.geom2]};
    const std::int32_t owners[] = {robot_of_body_[std::size_t(bodies[0])], robot_of_body_[std::size_t(bodies[1])]};
    for (int side = 0; side < 2; ++side) {
      const std::string* const obstacle = obstacles_[std::size_t(side == 0 ? contact.geom2 : contact.geom1)];
      if (owners[side] >= 0 && obstacle && contact.dist < 0)
        robots_[std::size_t(owners[side])].add_overlap(bodies[side], -contact.dist, *obstacle);
    }
    if (contact.efc_address < 0) continue;
    mjtNum local[6];
    mj_contactForce(&m, &d, i, local);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> frame(contact.frame);
    const Vec3 force = frame.transpose() * vector_of(local), torque = frame.transpose() * vector_of(local + 3);
    tell_contact(contact, owners, force, torque);
    for (int side = 0; side < 2; ++side) {
      const double sign = side == 0 ? -1 : 1;
      if (owners[side] >= 0)
        robots_[std::size_t(owners[side])].add_contact(d, bodies[side], sign * force, sign * torque,
                                                       vector_of(contact.pos));
    }
  }
}

}  // namespace muro::mujoco
