// SPDX-License-Identifier: MIT
// Multi-body dynamics by MuJoCo (Todorov, Erez and Tassa, IROS 2012): bodies in reduced coordinates, contacts and
// drives as soft constraints of a convex problem.
#include <algorithm>

#include "model_world.hpp"
#include "mujoco_world.hpp"
#include "muro/plugin.hpp"
#include "plugins/motion/common/multibody/engine_description.hpp"
#include "plugins/motion/common/multibody/engine_parameters.hpp"
#include "plugins/motion/common/multibody/world_motion.hpp"

namespace {

using namespace muro;

constexpr std::string_view solvers[] = {"pgs", "cg", "newton"};  // in the order of mjtSolver
constexpr std::string_view origins_of_settings[] = {"muro", "model"};
constexpr Parameter own_parameters[] = {
    text(
        "settings", "muro",
        "whose options, contact parameters, friction rule and actuators count: those stated here, or those of the MJCF "
        "file that the robots were read from")
        .one_of(origins_of_settings),
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
    multibody::correcting_speed,
    multibody::bounce_speed,
    multibody::attitude,
    boolean("several_contacts", true, "cylinders, capsules and meshes touch in several points where they lie flat"),
};
constexpr auto parameters = joined(multibody::common_parameters, own_parameters);
constexpr Description mujoco_description = multibody::engine_description(
    "motion.mujoco", "1.0.0", "Multi-body dynamics by MuJoCo; robots of one world touch in it", parameters,
    feature_armature | feature_rolling_resistance | feature_spinning_resistance | feature_heightmaps);

class MujocoMotion final : public multibody::WorldMotion {
  const Description& description() const override { return mujoco_description; }
  multibody::MinInertia min_inertia() const override { return {}; }
  bool has_own_inertias() const override { return source_.is_used(); }
  std::size_t memory_of(const multibody::RobotModel& model) const override {
    return source_.is_used() ? mujoco::ModelRobot::memory_of(model, source_.robot(model.name))
                             : mujoco::MujocoRobot::memory_of(model);
  }
  void configure(Connector& c) override {
    const Parameters& p = c.parameters();
    settings_.gravity = gravity();
    settings_.friction_rule = friction_rule();
    warnings_ = std::make_shared<mujoco::WarningLog>(c.host());
    host_ = &c.host();
    if (p.text("settings") == "model") source_.connect(c);
    settings_.solver = int(std::find(std::begin(solvers), std::end(solvers), p.text("solver")) - std::begin(solvers));
    settings_.iterations = int(p.integer("iterations"));
    settings_.tolerance = p.real("tolerance");
    settings_.time_constant = p.real("time_constant");
    settings_.impedance = p.real("impedance");
    settings_.friction_ratio = p.real("friction_ratio");
    settings_.refinements = int(p.integer("refinements"));
    settings_.correcting_speed = p.real(multibody::correcting_speed.name);
    settings_.bounce_speed = p.real(multibody::bounce_speed.name);
    settings_.exact_attitude = p.text(multibody::attitude.name) == "exact";
    settings_.several_contacts = p.boolean("several_contacts");
    meshes_.load(
        c, false, [](const mesh::Hull& hull) { return hull.vertices; },
        [](const mesh::Mesh& mesh) { return mesh.vertices; });
  }
  std::unique_ptr<multibody::World> make_world() const override {
    if (source_.is_used()) return std::make_unique<mujoco::ModelWorld>(source_, meshes_, *host_);
    return std::make_unique<mujoco::MujocoWorld>(settings_, meshes_, warnings_);
  }
  std::string_view advice() const override { return "a higher rate or `substeps`"; }

  mujoco::MujocoSettings settings_;
  mujoco::ModelSource source_;
  Host* host_ = nullptr;
  mujoco::MujocoMeshes meshes_;
  std::shared_ptr<mujoco::WarningLog> warnings_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<MujocoMotion>(mujoco_description)};

}  // namespace

MURO_PLUGIN(.name = "motion_mujoco", .version = mujoco_description.version, .licence = "MIT",
            .summary = "Multi-body dynamics by MuJoCo", .algorithms = algorithms)
