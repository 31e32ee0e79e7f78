// SPDX-License-Identifier: MIT
// Multi-body dynamics by the Open Dynamics Engine (Smith, ode.org): bodies in maximal coordinates, joints and contacts
// as constraints.
#include "muro/plugin.hpp"
#include "ode_world.hpp"
#include "plugins/common/multibody/description.hpp"
#include "plugins/common/multibody/motion.hpp"
#include "plugins/common/multibody/parameters.hpp"

namespace {

using namespace muro;

constexpr std::string_view solvers[] = {"auto", "quick", "exact"};
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
    text("solver", "auto",
         "iterative (dWorldQuickStep), or direct (dWorldStep), whose cost grows with the cube of the rows of a robot; "
         "auto: "
         "exact where a robot has joints on joints, and none has more than 24")
        .one_of(solvers),
    integer("iterations", 50, "of the solver `quick`").between(1, 10000),
    real("erp", "1", 0.2, "part of an error of joints and contacts that a step takes back").between(0, 1),
    real("cfm", "s/kg", 1e-6, "softness of joints and contacts").between(0, 1),
    multibody::correcting_speed,
    multibody::bounce_speed,
    multibody::scenery_meshes,
    boolean("reactions", true,
            "whether efforts of drives and wrenches of contacts are found out; ODE is faster without"),
};
constexpr Description ode_description{
    .id = "motion.ode",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Multi-body dynamics by the Open Dynamics Engine; robots of one world touch in it",
    .parameters = parameters,
    .reads = multibody::reads,
    .writes = multibody::writes,
    .capabilities = multibody::promises,
    .features = multibody::features | feature_concave_meshes,
};

/// Iterations carry forces from joint to joint, and need many where masses differ or much hangs on little.
bool are_better_solved_exactly(std::span<const Item> items) {
  constexpr int most_joints = 24;
  bool chains = false;
  for (const Item& item : items) {
    const auto& frames = item.robot->links;
    std::vector<int> joints_before(frames.size());
    int joints = 0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Link& f = frames[i];
      const int moves = f.joint == JointKind::fixed ? 0 : 1;
      joints_before[i] = (f.parent >= 0 ? joints_before[std::size_t(f.parent)] : 0) + moves;
      chains = chains || joints_before[i] > 1;
      joints += moves;
    }
    if (joints > most_joints) return false;
  }
  return chains;
}

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
    const std::string_view solver = p.text("solver");
    settings_.exact = solver == "exact" || (solver == "auto" && are_better_solved_exactly(c.items()));
    settings_.iterations = int(p.integer("iterations"));
    settings_.erp = p.real("erp");
    settings_.cfm = p.real("cfm");
    settings_.correcting_speed = p.real(multibody::correcting_speed.name);
    settings_.bounce_speed = p.real(multibody::bounce_speed.name);
    settings_.reactions = p.boolean("reactions");
    ode::start_engine();
    auto meshes = std::make_shared<ode::Meshes>();
    meshes->load(c, p.text(multibody::scenery_meshes.name) == "exact");
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
