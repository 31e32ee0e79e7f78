// SPDX-License-Identifier: MIT
// Multi-body dynamics by the Open Dynamics Engine (Smith, ode.org): bodies in maximal coordinates, joints and contacts
// as constraints.
#include <algorithm>
#include <charconv>

#include "geoms.hpp"
#include "muro/plugin.hpp"
#include "ode_world.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/multibody/engine_description.hpp"
#include "plugins/motion/common/multibody/engine_parameters.hpp"
#include "plugins/motion/common/multibody/world_motion.hpp"
#include "quick_convergence.hpp"

namespace {

using namespace muro;

constexpr std::string_view solvers[] = {"auto", "quick", "exact"};
constexpr Parameter own_parameters[] = {
    text("solver", "auto",
         "iterative (dWorldQuickStep), or direct (dWorldStep), whose cost grows with the cube of the rows of a robot; "
         "auto: exact where a robot has joints on joints or limbs, or the iterations do not hold them, as found at the "
         "start")
        .one_of(solvers),
    integer("iterations", 50, "of the solver `quick`").between(1, 10000),
    real("erp", "1", 0.2, "part of an error of joints and contacts that a step takes back").between(0, 1),
    real("softness", "1", 1e-4, "of joints and contacts, as part of the inverse effective mass of each").between(0, 1),
    real("cfm", "s/kg", 0, "softness of joints and contacts beyond that, alike for all masses").between(0, 1),
    multibody::correcting_speed,
    multibody::bounce_speed,
    multibody::scenery_meshes,
    multibody::attitude,
    boolean("reactions", true,
            "whether efforts of drives and wrenches of contacts are found out; ODE is faster without"),
};
constexpr auto parameters = joined(multibody::common_parameters, own_parameters);
constexpr Description ode_description = multibody::engine_description(
    "motion.ode", "1.0.0", "Multi-body dynamics by the Open Dynamics Engine; robots of one world touch in it",
    parameters,
    feature_armature | feature_concave_meshes | feature_rolling_resistance | feature_spinning_resistance |
        feature_heightmaps);

/// Least inertia for iterative solvers: they separate bodies badly when their masses differ by more.
const multibody::MinInertia quick_inertia{1e-3, 0.01};
/// Largest part of the speeds at joints that may remain after the iterations.
constexpr double most_unsolved = 1e-3;

/// Largest number of joints without a note on the cost of the exact solver, which grows with the cube of the rows.
constexpr std::size_t many_joints = 24;

/// Whether a link on the base moves the bodies that it touches, like a finger and unlike a wheel: it slides, or its
/// centre of mass is off its axis.
bool is_limb(const multibody::RigidBody& body) {
  if (body.parent < 0) return false;
  if (body.joint != JointKind::revolute) return true;
  const Inertia& i = body.inertia;
  const double off_axis = (i.com - body.axis * body.axis.dot(i.com)).squaredNorm() * i.mass,
               about_axis = body.axis.dot(Vec3(i.tensor() * body.axis));
  return off_axis > 0.25 * about_axis;
}

/// Returns the reason why the iterative solver does not suit a robot, or an empty text.
std::string objection_to_quick(const Connector& c, std::uint32_t item, int iterations) {
  const RobotView& robot = *c.items()[item].robot;
  const std::vector<DriveMode> modes = drive_modes_of(c, robot, c.parameters_of(item));
  multibody::RobotModel model = multibody::model_of(c, robot, modes, quick_inertia);
  model.fixed_base = c.parameters_of(item).text(multibody::base_mode.name) == "fixed";
  const double unsolved = ode::unsolved_part(model, iterations);
  const bool chains =
      std::any_of(model.bodies.begin(), model.bodies.end(), [](const auto& body) { return body.parent > 0; });
  const bool limbs = std::any_of(model.bodies.begin(), model.bodies.end(), is_limb);
  if (unsolved <= most_unsolved && !chains && !limbs) return {};
  char share[32];
  const char* const end = std::to_chars(share, share + sizeof share, unsolved, std::chars_format::general, 2).ptr;
  std::string text = quote(robot.name);
  text.append(chains  ? " has joints on joints, and "
              : limbs ? " has limbs, which can grip: what they hold creeps with iterations, and "
                      : ": ")
      .append(std::to_string(iterations));
  text.append(" iterations leave ").append(share, std::size_t(end - share)).append(" of what parts its joints");
  if (model.bodies.size() > many_joints + 1)
    text.append("; with ")
        .append(std::to_string(model.bodies.size() - 1))
        .append(" joints, motion.mujoco and motion.bullet take less time");
  return text;
}

class OdeMotion final : public multibody::WorldMotion {
  const Description& description() const override { return ode_description; }
  // Iterations separate bodies badly when their masses differ by more.
  multibody::MinInertia min_inertia() const override {
    multibody::MinInertia least = settings_.exact ? multibody::MinInertia{} : quick_inertia;
    if (settings_.exact) least.box_of = [this](const Shape& s) { return ode::box_around(s, *meshes_); };
    return least;
  }
  bool couples_mimics() const override { return false; }
  std::size_t memory_of(const multibody::RobotModel& model) const override {
    return ode::OdeRobot::memory_of(model, settings_.exact);
  }
  void configure(Connector& c) override {
    const Parameters& p = c.parameters();
    settings_.gravity = gravity();
    settings_.friction_rule = friction_rule();
    settings_.iterations = int(p.integer("iterations"));
    settings_.exact = needs_exact_solver(c);
    settings_.erp = p.real("erp");
    settings_.softness = p.real("softness");
    settings_.cfm = p.real("cfm");
    settings_.exact_attitude = p.text(multibody::attitude.name) == "exact";
    settings_.correcting_speed = p.real(multibody::correcting_speed.name);
    settings_.bounce_speed = p.real(multibody::bounce_speed.name);
    settings_.reactions = p.boolean("reactions");
    ode::start_library();
    messages_ = std::make_shared<ode::MessageLog>(c.host(), ode_description.id);
    const ode::ErrorTrap trap(*messages_);
    auto meshes = std::make_shared<ode::OdeMeshes>();
    meshes->load(
        c, p.text(multibody::scenery_meshes.name) == "exact",
        [](const mesh::Hull& hull) { return std::make_unique<ode::TriangleMesh>(mesh::surface_of(hull)); },
        [](const mesh::Mesh& mesh) { return std::make_unique<ode::TriangleMesh>(mesh); });
    meshes_ = std::move(meshes);
  }
  bool needs_exact_solver(const Connector& c) const {
    const std::string_view solver = c.parameters().text("solver");
    if (solver != "auto") return solver == "exact";
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      if (multibody::KinematicRobot::is_one(c, *c.items()[i].robot, c.parameters_of(i))) continue;
      const std::string objection = objection_to_quick(c, i, settings_.iterations);
      if (objection.empty()) continue;
      std::string text(ode_description.id);
      text.append(": `solver: auto` is `exact` here: ").append(objection);
      c.host().log(LogLevel::info, text);
      return true;
    }
    return false;
  }
  std::unique_ptr<multibody::World> make_world() const override {
    return std::make_unique<ode::OdeWorld>(settings_, meshes_, messages_);
  }
  std::string_view advice() const override {
    return settings_.exact ? "a higher rate or `substeps`" : "`solver: exact`, a higher rate or `substeps`";
  }

  ode::OdeSettings settings_;
  std::shared_ptr<const ode::OdeMeshes> meshes_;
  std::shared_ptr<ode::MessageLog> messages_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<OdeMotion>(ode_description)};

}  // namespace

MURO_PLUGIN(.name = "motion_ode", .version = ode_description.version, .licence = "MIT",
            .summary = "Multi-body dynamics by the Open Dynamics Engine", .algorithms = algorithms)
