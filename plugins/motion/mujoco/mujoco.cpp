// SPDX-License-Identifier: MIT
// Multi-body dynamics by MuJoCo (Todorov, Erez and Tassa, IROS 2012): bodies in reduced coordinates, contacts and
// drives as soft constraints of a convex problem.
#include <algorithm>

#include "mujoco_world.hpp"
#include "muro/plugin.hpp"
#include "plugins/common/multibody/description.hpp"
#include "plugins/common/multibody/motion.hpp"
#include "plugins/common/multibody/parameters.hpp"

namespace {

using namespace muro;

constexpr std::string_view solvers[] = {"pgs", "cg", "newton"};  // in the order of mjtSolver
constexpr Parameter parameters[] = {
    multibody::world_name,
    multibody::base_mode,
    multibody::joint_mode,
    velocity_joints,
    position_joints,
    effort_joints,
    passive_joints,
    multibody::self_collision,
    multibody::position_gain,
    multibody::substeps,
    text("solver", "newton",
         "projected Gauss-Seidel, conjugate gradients, or Newton's method: exact in a few iterations")
        .one_of(solvers),
    integer("iterations", 100, "at most, of the solver; it ends earlier when it has converged").between(1, 10000),
    real("tolerance", "1", 1e-8, "improvement by an iteration below which the solver has converged").between(0, 1),
    real("time_constant", "s", 0.02, "in which overlap of bodies decays; at least two steps of the engine")
        .between(0, 10),
    real("impedance", "1", 0.95, "part of what a contact asks for that it gets; less is softer").between(1e-4, 0.9999),
    real("friction_ratio", "1", 500, "by how much contacts are harder along the surfaces than across").between(1, 1e4),
    integer("refinements", 2, "solutions of a step beyond the first, where bodies begin or cease to slide; 0: one")
        .between(0, 100),
    multibody::bounce_speed,
    boolean("several_contacts", true, "cylinders, capsules and meshes touch in several points where they lie flat"),
};
constexpr Description mujoco_description{
    .id = "motion.mujoco",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Multi-body dynamics by MuJoCo; robots of one world touch in it",
    .parameters = parameters,
    .reads = multibody::reads,
    .writes = multibody::writes,
    .capabilities = multibody::promises,
    .features = multibody::features,
};

class MujocoMotion final : public multibody::Motion {
  const Description& description() const override { return mujoco_description; }
  multibody::InertiaFloor inertia_floor() const override { return {}; }
  std::size_t memory_of(const multibody::RobotModel& model) const override { return mujoco::Robot::memory_of(model); }
  void configure(Connector& c) override {
    const Parameters& p = c.parameters();
    settings_.gravity = gravity();
    settings_.solver = int(std::find(std::begin(solvers), std::end(solvers), p.text("solver")) - std::begin(solvers));
    settings_.iterations = int(p.integer("iterations"));
    settings_.tolerance = p.real("tolerance");
    settings_.time_constant = p.real("time_constant");
    settings_.impedance = p.real("impedance");
    settings_.friction_ratio = p.real("friction_ratio");
    settings_.refinements = int(p.integer("refinements"));
    settings_.bounce_speed = p.real(multibody::bounce_speed.name);
    settings_.several_contacts = p.boolean("several_contacts");
    meshes_.load(c);
  }
  std::unique_ptr<multibody::World> make_world() const override {
    return std::make_unique<mujoco::MujocoWorld>(settings_, meshes_);
  }

  mujoco::Settings settings_;
  mujoco::Meshes meshes_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<MujocoMotion>(mujoco_description)};

}  // namespace

MURO_PLUGIN(.name = "motion_mujoco", .version = "1.0.0", .licence = "MIT", .summary = "Multi-body dynamics by MuJoCo",
            .algorithms = algorithms)
