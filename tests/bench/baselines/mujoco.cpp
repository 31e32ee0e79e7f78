// SPDX-License-Identifier: MIT
// MuJoCo: a generated model of the city and its vehicles, each a free chassis with four driven hinges. Memory grows
// with the square of the number of vehicles and is at most 2 GB (2.2), so the vehicles are in several worlds.
#include <mujoco/mujoco.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "tests/bench/baselines/team.hpp"

namespace muro::bench {

namespace {

std::ostream& operator<<(std::ostream& out, const Vec3& v) { return out << v.x() << ' ' << v.y() << ' ' << v.z(); }

/// The city and vehicles `first` to `first + n` - 1. Wheels collide as balls.
std::string model_of(const City& city, SolverSettings settings, int first, int n) {
  std::ostringstream xml, actuators;
  xml.precision(12);
  xml << "<mujoco><option timestep='" << 1e-3 / settings.steps << "' gravity='0 0 -9.81' solver='CG' iterations='"
      << settings.iterations << "' tolerance='1e-5' cone='elliptic' jacobian='sparse'/>"
      << "<size nconmax='" << 6 * n + 100 << "' njmax='" << 20 * n + 400 << "'/>"
      << "<compiler inertiafromgeom='false' angle='radian'/><worldbody>"
      << "<geom type='plane' size='0 0 1' friction='0.8'/>";
  // the broad phase finds scenery faster in bodies of its own than in the world's body, except with one vehicle
  for (const Block& b : city.blocks()) {
    const Vec3 half = 0.5 * b.lengths;
    if (n > 1)
      xml << "<body pos='" << b.centre << "'><geom type='box' size='" << half << "' friction='0.8'/></body>";
    else
      xml << "<geom type='box' pos='" << b.centre << "' size='" << half << "' friction='0.8'/>";
  }
  const auto inertial = [&](const Inertia& i) {
    xml << "<inertial pos='0 0 0' mass='" << i.mass << "' diaginertia='" << i.ixx << ' ' << i.iyy << ' ' << i.izz
        << "'/>";
  };
  for (int v = first; v < first + n; ++v) {
    const Pose& p = city.starts()[std::size_t(v)];
    const Quat& q = p.orientation;
    xml << "<body pos='" << p.position << "' quat='" << q.w() << ' ' << q.x() << ' ' << q.y() << ' ' << q.z()
        << "'><freejoint/>";
    inertial(Rover::chassis());
    xml << "<geom type='box' size='" << Vec3(0.5 * Rover::length, 0.5 * Rover::width, 0.5 * Rover::height)
        << "' friction='0.8'/>";
    for (int w = 0; w < 4; ++w) {
      xml << "<body pos='" << Rover::wheel_centre(w) << "'><joint name='j" << v << '_' << w
          << "' type='hinge' axis='0 1 0'/>";
      inertial(Rover::wheel());
      xml << "<geom type='sphere' size='" << Rover::wheel_radius << "' friction='0.8'/></body>";
      actuators << "<velocity joint='j" << v << '_' << w << "' kv='0.1' forcelimited='true' forcerange='"
                << -Rover::max_torque << ' ' << Rover::max_torque << "'/>";
    }
    xml << "</body>";
  }
  xml << "</worldbody><actuator>" << actuators.str() << "</actuator></mujoco>";
  return xml.str();
}

class MujocoVehicles final : public Team {
 public:
  MujocoVehicles(const City& city, SolverSettings settings) : steps_(settings.steps) {
    for (int v = 0; v < city.vehicles(); v += max_vehicles)
      worlds_.emplace_back(city, settings, v, std::min(max_vehicles, city.vehicles() - v));
  }

  void command(int vehicle, WheelSpeeds speeds) override {
    mjtNum* ctrl = worlds_[std::size_t(vehicle / max_vehicles)].data->ctrl + 4 * (vehicle % max_vehicles);
    for (int w = 0; w < 4; ++w) ctrl[w] = Rover::is_left(w) ? speeds.left : speeds.right;
  }
  void run(int milliseconds) override {
    for (int i = 0; i < milliseconds * steps_; ++i)
      for (const World& w : worlds_) mj_step(w.model.get(), w.data.get());
  }
  Pose pose(int vehicle) const override {
    const World& w = worlds_[std::size_t(vehicle / max_vehicles)];
    const int body = w.bodies[std::size_t(vehicle % max_vehicles)];
    const mjtNum *p = w.data->xpos + 3 * body, *q = w.data->xquat + 4 * body;
    return {{p[0], p[1], p[2]}, Quat(q[0], q[1], q[2], q[3])};
  }

 private:
  const int steps_;                         ///< in a millisecond
  static constexpr int max_vehicles = 100;  ///< in a world

  struct Delete {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  struct World {
    World(const City& city, SolverSettings settings, int first, int n) {
      const std::string text = model_of(city, settings, first, n);
      const auto files = std::make_unique<mjVFS>();
      mj_defaultVFS(files.get());
      mj_makeEmptyFileVFS(files.get(), "city.xml", int(text.size()));
      std::copy(text.begin(), text.end(), static_cast<char*>(files->filedata[0]));
      char error[1000] = "";
      model.reset(mj_loadXML("city.xml", files.get(), error, sizeof error));
      mj_deleteVFS(files.get());
      if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
      data.reset(mj_makeData(model.get()));
      for (int b = 0; b < model->nbody; ++b)
        if (model->body_dofnum[b] == 6) bodies.push_back(b);
    }
    std::unique_ptr<mjModel, Delete> model;
    std::unique_ptr<mjData, Delete> data;
    std::vector<int> bodies;  ///< chassis
  };
  std::vector<World> worlds_;
};

}  // namespace

std::unique_ptr<Team> mujoco_vehicles(const City& city, SolverSettings settings) {
  return std::make_unique<MujocoVehicles>(city, settings);
}

}  // namespace muro::bench
