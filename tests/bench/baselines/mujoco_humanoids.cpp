// SPDX-License-Identifier: MIT
// MuJoCo: humanoids from a generated model, in one world, or each in a world of its own.
#include <mujoco/mujoco.h>

#include <sstream>
#include <stdexcept>

#include "tests/bench/baselines/humanoids.hpp"

namespace muro::bench {

namespace {

constexpr int iterations = 4;
/// Number of bits of MuJoCo's masks. Links of a robot share a bit and do not collide. Robots i and i + 30 share one
/// too, but are far from one another.
constexpr int groups = 30;

std::ostream& operator<<(std::ostream& out, const Vec3& v) { return out << v.x() << ' ' << v.y() << ' ' << v.z(); }
std::ostream& operator<<(std::ostream& out, const Quat& q) {
  return out << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z();
}

/// Writes the text of a model.
class HumanoidsMjcf {
 public:
  HumanoidsMjcf(const HumanoidScene& scene, const MujocoUse& use, std::size_t robots) : scene_(scene) {
    xml_.precision(15);
    actuators_.precision(15);
    xml_ << "<mujoco><option timestep='0.001' gravity='0 0 -9.81' solver='" << use.solver << "' iterations='"
         << iterations << "' tolerance='1e-5' cone='elliptic' jacobian='" << use.jacobian << "'/><size nconmax='"
         << 20 * robots + 100 << "' njmax='" << 60 * robots + 400 << "'/>"
         << "<compiler inertiafromgeom='false' angle='radian'/><default><geom friction='" << scene.friction
         << " 0.005 0.0001'/></default><worldbody><geom type='plane' size='0 0 1' contype='0' conaffinity='"
         << (1 << groups) - 1 << "'/>";
    for (std::size_t r = 0; r < robots; ++r) add(r, 0);
    xml_ << "</worldbody><actuator>" << actuators_.str() << "</actuator></mujoco>";
  }
  std::string text() const { return xml_.str(); }

 private:
  void add(std::size_t robot, std::size_t body) {
    const HumanoidBody& b = scene_.bodies[body];
    const Pose& pose = body == 0 ? scene_.starts[robot] : b.origin;
    xml_ << "<body pos='" << pose.position << "' quat='" << pose.orientation << "'>";
    if (body == 0)
      xml_ << "<freejoint/>";
    else
      xml_ << "<joint name='j" << robot << '_' << body << "' type='hinge' axis='" << b.axis << "' armature='"
           << Servo::armature << "'/>";
    const Inertia& i = b.inertia;
    xml_ << "<inertial pos='" << i.com << "' mass='" << i.mass << "' diaginertia='" << i.ixx << ' ' << i.iyy << ' '
         << i.izz << "'/>";
    for (const Shape& s : b.shapes) add(s, int(robot) % groups);
    if (body > 0)
      actuators_ << "<general joint='j" << robot << '_' << body << "' biastype='affine' gainprm='" << Servo::stiffness
                 << "' biasprm='0 " << -Servo::stiffness << ' ' << -Servo::damping
                 << "' forcelimited='true' forcerange='" << -b.effort << ' ' << b.effort << "'/>";
    for (std::size_t child = body + 1; child < scene_.bodies.size(); ++child)
      if (scene_.bodies[child].parent == int(body)) add(robot, child);
    xml_ << "</body>";
  }

  void add(const Shape& s, int group) {
    xml_ << "<geom pos='" << s.origin.position << "' quat='" << s.origin.orientation << "' contype='" << (1 << group)
         << "' conaffinity='" << (((1 << groups) - 1) & ~(1 << group)) << "' type='";
    if (s.kind == ShapeKind::box)
      xml_ << "box' size='" << Vec3(0.5 * s.size);
    else if (s.kind == ShapeKind::sphere)
      xml_ << "sphere' size='" << s.size.x();
    else
      xml_ << "capsule' size='" << s.size.x() << ' ' << 0.5 * s.size.z();
    xml_ << "'/>";
  }

  const HumanoidScene& scene_;
  std::ostringstream xml_, actuators_;
};

class MujocoHumanoids final : public Humanoids {
 public:
  MujocoHumanoids(const HumanoidScene& scene, const MujocoUse& use)
      : each_(use.world_each), hinges_(scene.hinges()), model_(compiled(scene, use)) {
    const mjModel& m = *model_;
    for (int b = 1; b < m.nbody; ++b)
      if (m.body_dofnum[b] == 6) trunks_.push_back(b);
    for (std::size_t r = 0; r < trunks_.size(); ++r)
      for (std::size_t h = 1; h <= hinges_; ++h) {
        std::ostringstream name;
        name << 'j' << r << '_' << h;
        const int joint = mj_name2id(&m, mjOBJ_JOINT, name.str().c_str());
        positions_.push_back(m.jnt_qposadr[joint]);
        for (int a = 0; a < m.nu; ++a)
          if (m.actuator_trnid[2 * a] == joint) actuators_.push_back(a);
      }
    for (std::size_t w = 0; w < (each_ ? scene.robots() : 1); ++w) {
      worlds_.emplace_back(mj_makeData(&m));
      if (!worlds_.back()) throw std::runtime_error("MuJoCo has no memory for the data of a world");
    }
    for (std::size_t r = 0; r < scene.robots(); ++r) {
      mjData& d = data(r);
      mjtNum* const free = d.qpos + m.jnt_qposadr[m.body_jntadr[trunks_[in_world(r)]]];
      const Pose& p = scene.starts[r];
      const double values[] = {p.position.x(),    p.position.y(),    p.position.z(),   p.orientation.w(),
                               p.orientation.x(), p.orientation.y(), p.orientation.z()};
      std::copy_n(values, 7, free);
      for (std::size_t h = 0; h < hinges_; ++h) d.qpos[positions_[in_world(r) * hinges_ + h]] = scene.positions[r][h];
      command(r, scene.positions[r]);
    }
    for (const auto& d : worlds_) mj_forward(&m, d.get());
  }

  void command(std::size_t robot, std::span<const double> targets) override {
    mjData& d = data(robot);
    for (std::size_t h = 0; h < hinges_; ++h) d.ctrl[actuators_[in_world(robot) * hinges_ + h]] = targets[h];
  }
  void run(int milliseconds) override {
    for (int i = 0; i < milliseconds; ++i)
      for (const auto& d : worlds_) mj_step(model_.get(), d.get());
  }
  Pose trunk(std::size_t robot) const override {
    const int body = trunks_[in_world(robot)];
    const mjtNum *p = data(robot).xpos + 3 * body, *q = data(robot).xquat + 4 * body;
    return {{p[0], p[1], p[2]}, Quat(q[0], q[1], q[2], q[3])};
  }
  double position(std::size_t robot, std::size_t hinge) const override {
    return data(robot).qpos[positions_[in_world(robot) * hinges_ + hinge]];
  }

 private:
  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  static std::unique_ptr<mjModel, Delete> compiled(const HumanoidScene& scene, const MujocoUse& use) {
    const std::string text = HumanoidsMjcf(scene, use, use.world_each ? 1 : scene.robots()).text();
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "humanoids.xml", int(text.size()));
    std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
    char error[1000] = "";
    std::unique_ptr<mjModel, Delete> model(mj_loadXML("humanoids.xml", files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
    return model;
  }
  std::size_t in_world(std::size_t robot) const { return each_ ? 0 : robot; }
  mjData& data(std::size_t robot) const { return *worlds_[each_ ? robot : 0]; }

  const bool each_;
  const std::size_t hinges_;
  std::unique_ptr<mjModel, Delete> model_;
  std::vector<std::unique_ptr<mjData, Delete>> worlds_;
  std::vector<int> trunks_, positions_, actuators_;  ///< bodies; entries of qpos and ctrl, of each robot of a world
};

}  // namespace

std::unique_ptr<Humanoids> mujoco_humanoids(const HumanoidScene& scene, const MujocoUse& use) {
  return std::make_unique<MujocoHumanoids>(scene, use);
}

}  // namespace muro::bench
