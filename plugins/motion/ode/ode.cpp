// SPDX-License-Identifier: MIT
// Multi-body dynamics by the Open Dynamics Engine (Smith, ode.org): bodies in maximal coordinates, joints and contacts
// as constraints.
#include "muro/plugin.hpp"
#include "ode_world.hpp"
#include "plugins/multibody/motion.hpp"
#include "plugins/multibody/parameters.hpp"

namespace {

using namespace muro;

constexpr std::string_view mesh_modes[] = {"convex", "exact"};
constexpr std::string_view solvers[] = {"quick", "exact"};
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
    text("solver", "quick", "iterative (dWorldQuickStep), or a direct method for small worlds (dWorldStep)")
        .one_of(solvers),
    integer("iterations", 50, "of the solver `quick`").between(1, 10000),
    real("erp", "1", 0.2, "part of an error of joints and contacts that a step takes back").between(0, 1),
    real("cfm", "s/kg", 1e-6, "softness of joints and contacts").between(0, 1),
    real("correcting_speed", "m/s", 1, "bodies that overlap are parted no faster").between(0, 1e9),
    real("bounce_speed", "m/s", 0.02, "impacts slower than this do not rebound").between(0, 1e9),
    text("meshes", "convex", "meshes of scenery collide as their convex hulls or as they are").one_of(mesh_modes),
    boolean("reactions", true,
            "whether efforts of drives and wrenches of contacts are found out; ODE is faster without"),
};
constexpr Use reads[] = {
    {"wrench.external", "of the base and every body with collision shapes"},
    {"gravity", "on the world object; 0 0 -9.81 when absent"},
    {"inertial", "of every body"},
    {"collision.shapes", "of every body in the scene"},
    {"joint.velocity.target", "of joints in mode velocity"},
    {"joint.position.target", "of joints in mode position"},
    {"joint.effort.target", "of joints in mode effort"},
    {"pose", "of bodies of other robots"},
    {"twist", "of bodies of other robots"},
    {"contact.world", "of other robots"},
    {"pose.initial", "of the base"},
    {"twist.initial", "of the base"},
    {"joint.position.initial", "of every joint"},
};
constexpr Use writes[] = {
    {"pose", "of the base"},
    {"twist", "of the base"},
    {"joint.position", "of every joint"},
    {"joint.velocity", "of every joint"},
    {"joint.effort", "of every joint: what its drive applies"},
    {"wrench.contact", "of every body with collision shapes"},
    {"contact.world", "that this world answers for contacts"},
    {"twist.lag", "0.5: semi-implicit Euler"},
};
constexpr Description ode_description{
    .id = "motion.ode",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Multi-body dynamics by the Open Dynamics Engine; robots of one world touch in it",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | restorable | world,
    .features = feature_forces | feature_joints | feature_velocity_targets | feature_position_targets |
                feature_effort_targets | feature_joint_limits | feature_joint_speed_limits |
                feature_joint_effort_limits | feature_joint_damping | feature_joint_friction | feature_mimic_joints |
                feature_link_dynamics | feature_gyroscopic | feature_contact | feature_friction | feature_restitution |
                feature_convex_meshes | feature_concave_meshes | feature_fixed_base | feature_self_collision,
};

class OdeMotion final : public multibody::Motion {
  const Description& description() const override { return ode_description; }
  // Iterations part bodies badly whose masses differ by more.
  multibody::InertiaFloor inertia_floor() const override {
    return settings_.exact ? multibody::InertiaFloor{} : multibody::InertiaFloor{1e-3, 0.01};
  }
  std::size_t memory_of(const multibody::RobotModel& model) const override { return ode::Robot::memory_of(model); }
  void configure(Connector& c) override {
    const Parameters& p = c.parameters();
    settings_.gravity = gravity();
    settings_.exact = p.text("solver") == "exact";
    settings_.iterations = int(p.integer("iterations"));
    settings_.erp = p.real("erp");
    settings_.cfm = p.real("cfm");
    settings_.correcting_speed = p.real("correcting_speed");
    settings_.bounce_speed = p.real("bounce_speed");
    settings_.reactions = p.boolean("reactions");
    ode::start_engine();
    auto meshes = std::make_shared<ode::Meshes>();
    meshes->load(c, p.text("meshes") == "exact");
    meshes_ = std::move(meshes);
  }
  std::unique_ptr<multibody::World> make_world() const override {
    return std::make_unique<ode::OdeWorld>(settings_, meshes_);
  }

  ode::Settings settings_;
  std::shared_ptr<const ode::Meshes> meshes_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<OdeMotion>(ode_description)};

}  // namespace

MURO_PLUGIN(.name = "motion_ode", .version = "1.0.0", .licence = "MIT",
            .summary = "Multi-body dynamics by the Open Dynamics Engine", .algorithms = algorithms)
