// SPDX-License-Identifier: MIT
// Multi-body dynamics by the Open Dynamics Engine (Smith, ode.org): bodies in maximal coordinates, joints and contacts
// as constraints.
#include "muro/plugin.hpp"
#include "ode_world.hpp"
#include "plugins/common/multibody/engine_description.hpp"
#include "plugins/common/multibody/engine_parameters.hpp"
#include "plugins/common/multibody/motion.hpp"

namespace {

using namespace muro;

constexpr std::string_view solvers[] = {"auto", "quick", "exact"};
constexpr Parameter own_parameters[] = {
    text("solver", "auto",
         "iterative (dWorldQuickStep), or direct (dWorldStep), whose cost grows with the cube of the rows of a robot; "
         "auto: exact where a robot has joints on joints, and none has more than 24")
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
constexpr auto parameters = multibody::with_common_parameters(own_parameters);
constexpr Description ode_description = multibody::engine_description(
    "motion.ode", "1.0.0", "Multi-body dynamics by the Open Dynamics Engine; robots of one world touch in it",
    parameters, feature_concave_meshes);

/// Iterations carry forces from joint to joint, and need many where masses differ or much hangs on little.
bool need_exact_solver(std::span<const Item> items) {
  constexpr int max_joints = 24;
  bool chains = false;
  for (const Item& item : items) {
    const std::span<const Link> links = item.robot->links;
    std::vector<int> joints_before(links.size());
    int joints = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Link& link = links[i];
      const int moves = link.joint == JointKind::fixed ? 0 : 1;
      joints_before[i] = (link.parent >= 0 ? joints_before[std::size_t(link.parent)] : 0) + moves;
      chains = chains || joints_before[i] > 1;
      joints += moves;
    }
    if (joints > max_joints) return false;
  }
  return chains;
}

class OdeMotion final : public multibody::Motion {
  const Description& description() const override { return ode_description; }
  // Iterations part bodies badly whose masses differ by more.
  multibody::MinInertia min_inertia() const override {
    return settings_.exact ? multibody::MinInertia{} : multibody::MinInertia{1e-3, 0.01};
  }
  std::size_t memory_of(const multibody::RobotModel& model) const override { return ode::OdeRobot::memory_of(model); }
  void configure(Connector& c) override {
    const Parameters& p = c.parameters();
    settings_.gravity = gravity();
    const std::string_view solver = p.text("solver");
    settings_.exact = solver == "exact" || (solver == "auto" && need_exact_solver(c.items()));
    settings_.iterations = int(p.integer("iterations"));
    settings_.erp = p.real("erp");
    settings_.cfm = p.real("cfm");
    settings_.correcting_speed = p.real(multibody::correcting_speed.name);
    settings_.bounce_speed = p.real(multibody::bounce_speed.name);
    settings_.reactions = p.boolean("reactions");
    ode::start_library();
    auto meshes = std::make_shared<ode::OdeMeshes>();
    meshes->load(
        c, p.text(multibody::scenery_meshes.name) == "exact",
        [](const mesh::Hull& hull) { return std::make_unique<ode::TriangleMesh>(mesh::surface_of(hull)); },
        [](const mesh::Mesh& mesh) { return std::make_unique<ode::TriangleMesh>(mesh); });
    meshes_ = std::move(meshes);
  }
  std::unique_ptr<multibody::World> make_world() const override {
    return std::make_unique<ode::OdeWorld>(settings_, meshes_);
  }

  ode::OdeSettings settings_;
  std::shared_ptr<const ode::OdeMeshes> meshes_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<OdeMotion>(ode_description)};

}  // namespace

MURO_PLUGIN(.name = "motion_ode", .version = ode_description.version, .licence = "MIT",
            .summary = "Multi-body dynamics by the Open Dynamics Engine", .algorithms = algorithms)
