// SPDX-License-Identifier: MIT
// The simplified dynamics (MuRoSimF, Section 3.2): one body whose centre of mass and inertia follow the joints.
#include <bit>
#include <functional>
#include <string>

#include "articulation.hpp"
#include "description.hpp"
#include "force_driven_joints.hpp"
#include "joint_properties.hpp"
#include "least_inertia.hpp"
#include "move.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/kinematic_joints/moving_mass.hpp"
#include "plugins/motion/common/motion/watched_motion.hpp"
#include "plugins/motion/common/multibody/consistent_inertia.hpp"
#include "plugins/motion/common/position_drive/settled_modes.hpp"
#include "robot_table.hpp"

namespace {

using namespace muro;
using namespace muro::simplified;
using lane::numbers;

class Simplified final : public WatchedMotion {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    fixed_ = p.text("base") == "fixed";
    max_acceleration_ = p.real("max_joint_acceleration");
    gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    table_.resize(c.items().size());
    for (std::uint32_t i = 0; i < table_.size(); ++i) {
      const RobotView& robot = *c.items()[i].robot;
      robots_[i].modes = drive_modes_of(c, robot, p);
      connect_robot(c, i);
      note_without_forces(c, robot, robots_[i].modes);
    }
    tell_of_robots_without_forces(c, without_forces_, stand_still_);
  }

  void start() override {
    table_.find_contributions();
    begin_watches();
  }
  void restored() override { begin_watches(); }

  void on_handover(std::uint32_t item) override {
    const Robot& r = robots_[item];
    begin_watch(item, r.wrenches());
    r.contact_role.take_over();
    if (r.force_driven >= 0) force_driven_[std::size_t(r.force_driven)].take_over();
    if (fixed_) std::fill_n(table_.layers[0][item].twist, 6, 0.0);
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  void bind_robots_by_name(Connector& c) override {
    for (std::uint32_t i = 0; i < table_.size(); ++i) {
      std::vector<DriveMode> modes = settled_modes(c, *c.items()[i].robot, c.parameters());
      if (modes == robots_[i].modes) continue;
      robots_[i].modes = std::move(modes);
      connect_robot(c, i);
    }
    for (ForceDrivenJoints& joints : force_driven_) joints.connect_by_name(c);
    for (std::uint32_t i = 0; i < table_.size(); ++i) {
      robots_[i].applied.connect_by_name(c, *c.items()[i].robot, robots_[i].wrenches());
      reports_applied_ = reports_applied_ || !robots_[i].applied.empty();
    }
  }

  MovedBase moved_base(std::uint32_t i) const override {
    return {fixed_ ? BaseMotion::kinematic : BaseMotion::by_forces, robots_[i].inertia,
            robots_[i].external.has_value()};
  }
  std::pair<Pose, Twist> state_of(std::uint32_t i) const override { return {table_.pose(i), table_.twist(i)}; }

  /// Moves neighbours of one kind eight at a time.
  void move(const Step& step, Range range) override {
    if (reports_applied_)
      for (std::uint32_t i = range.begin; i < range.end; ++i) robots_[i].applied.keep();
    const std::vector<RobotTable::Kind>& kinds = table_.kinds;
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      while (end < range.end && end < i + lane_width && kinds[end] == kinds[i]) ++end;
      const Model& model = models_[kinds[i].model];
      BatchParameters batch{
          .mass = &model.mass,
          .wrenches = int(kinds[i].wrenches),
          .other_contributions = table_.other_contributions.data() + robots_[i].first_other_contribution,
          .gravity = {gravity_.x(), gravity_.y(), gravity_.z()},
          .dt = step.dt};
      if (model.single_kernel) {
        model.set_joints(batch, 0);
        move_rigid(batch, i, end);
      } else {
        move_by_steps(batch, model, i, end);
      }
      for (std::uint32_t k = i; k < end; ++k) take_impacts(k, step);
    }
  }

  /// Connects the robot, and again when its joints turn out to have other modes.
  void connect_robot(Connector& c, std::uint32_t number) {
    const Item& item = c.items()[number];
    const RobotView& robot = *item.robot;
    const std::vector<DriveMode>& modes = robots_[number].modes;
    std::vector<Inertia> inertias = inertias_of(c, robot);
    for (Inertia& i : inertias) i = nearest_consistent_inertia(i).value_or(i);
    const std::vector<double> start = initial_joint_positions(c, robot);
    if (complete_inertia(c, robot, start, inertias, meshes_))
      c.host().log(LogLevel::info,
                   "motion.simplified: the inertia of " + quote(robot.name) +
                       " is less than a hundredth of that of a box of its size and mass, so that contacts could not "
                       "hold it; it is raised to that. Give its bodies an inertia (`inertial`) that fits them");
    CompositeBody composite(robot.links, inertias, start);
    Model model;
    model.rigid = composite.rigid();
    const bool forces = !fixed_ || has_moving_mass(c, robot);

    Robot r;
    r.name = robot.name;
    r.modes = modes;
    r.inertia = composite_inertia(robot.links, inertias, start);
    const Pose pose = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist twist = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    RobotState state;
    state.pose = numbers(c.variable(robot.base(), keys::pose, pose).get());
    state.twist = numbers(c.variable(robot.base(), keys::twist, fixed_ ? Twist{} : twist).get());
    const std::vector<JointProperties> properties =
        connect_joint_properties(c, robot, start, modes, forces && c.parameters().boolean("effort_limits"),
                                 joints_with_position_drives(c, robot, inertias, start, forces));
    std::vector<const double*> watched;
    for (const JointProperties& j : properties) watched.push_back(j.force_driven ? j.velocity : nullptr);
    watch_robot(c, number, watched);
    // When another motion of the robot reads the wrenches on links, they do not act on the base.
    const bool has_levels =
        forces && robot.links.size() > 1 && !c.constant_array(robot.base(), keys::motion_level_names).empty();
    const auto any = [&](bool JointProperties::*what) {
      return forces && std::any_of(properties.begin(), properties.end(), std::mem_fn(what));
    };
    const bool is_first = !robots_[number].contact_role;
    // The contact algorithm must know from the start which robots on a fixed base it moves.
    const bool is_pushed = !fixed_ || is_first || robots_[number].external.has_value();
    const bool feels_contact = is_pushed && (has_levels || any(&JointProperties::feels_contact));
    model.force_driven = has_levels || any(&JointProperties::force_driven);
    if (model.force_driven || !fixed_) model.mass = rigid_mass(robot, composite_inertia(robot.links, inertias, start));
    if (model.force_driven) {
      r.force_driven = std::int32_t(force_driven_.size());
      force_driven_.emplace_back(c, robot, properties, inertias, start,
                                 position_drives_of(c, robot, modes, c.parameters()),
                                 std::string(description.id) + (has_levels ? "." + std::to_string(item.level) : "") +
                                     (is_first ? "" : ".settled"),
                                 ForceDrivenJoints::Settings{fixed_, max_acceleration_, c.parameters().real("armature"),
                                                             feels_contact || !fixed_, feels_contact});
    }
    if (feels_contact || !fixed_) r.external = c.read_sum(robot.base(), keys::external_wrench);
    r.contact_role = ContactRole(c, robot.base(), contact_world_of(r.external.has_value()));
    table_.impacts[number] =
        feels_contact || fixed_ ? contact_geometry::ImpactInput{} : contact_geometry::ImpactInput(c, robot);
    const std::vector<RobotState> states = model.add_groups(robot, properties, max_acceleration_, state);
    for (std::size_t k = 0; k < table_.layers.size(); ++k)
      table_.layers[k][number] = k < states.size() ? states[k] : RobotState{};
    model.single_kernel = model.rigid && !model.force_driven && !fixed_ && model.groups.size() <= 1;
    if (!composite.rigid()) {
      r.articulation = std::int32_t(articulations_.size());
      std::vector<const double*> positions, velocities;
      for (const std::uint32_t link : composite.joints()) {
        positions.push_back(properties[link].position);
        velocities.push_back(properties[link].velocity);
      }
      articulations_.emplace_back(std::move(composite), std::move(positions), std::move(velocities));
    }
    table_.kinds[number] = {number_of(std::move(model), models_), 0};
    robots_[number] = std::move(r);
  }

  /// Returns for each link whether its joint has a PD drive in mode position. Joints without inertia have none and meet
  /// their targets.
  static std::vector<bool> joints_with_position_drives(const Connector& c, const RobotView& robot,
                                                       std::span<const Inertia> inertias, std::span<const double> start,
                                                       bool forces) {
    std::vector<bool> result(robot.links.size());
    if (!forces || c.parameters().text("position_drives") != "pd") return result;
    std::vector<std::uint32_t> joints;
    for (std::uint32_t i = 0; i < result.size(); ++i)
      if (robot.links[i].joint != JointKind::fixed && robot.links[i].mimic < 0) joints.push_back(i);
    DecoupledDynamics dynamics(robot.links, inertias, joints, c.parameters().text("base") == "fixed");
    dynamics.update({}, {}, start, Vec3::Zero());
    for (const DecoupledDynamics::Dof& dof : dynamics.dofs())
      result[dof.link] =
          dof.inertia + c.parameters().real("armature") + robot.links[dof.link].limits.armature > least_dof_inertia;
    return result;
  }

  /// Notes a robot whose joints no force can move, and whether some stand still because only forces would move them.
  void note_without_forces(const Connector& c, const RobotView& robot, const std::vector<DriveMode>& modes) {
    const auto moves = [](const Link& link) { return link.joint != JointKind::fixed; };
    if (!fixed_ || has_moving_mass(c, robot) || std::none_of(robot.links.begin(), robot.links.end(), moves)) return;
    without_forces_.emplace_back(robot.name);
    for (std::size_t i = 0; i < modes.size(); ++i)
      stand_still_ =
          stand_still_ || (moves(robot.links[i]) && (modes[i] == DriveMode::effort || modes[i] == DriveMode::passive));
  }

  void begin_watches() {
    for (std::uint32_t i = 0; i < table_.size(); ++i) begin_watch(i, robots_[i].wrenches());
  }

  void move_rigid(const BatchParameters& batch, std::uint32_t begin, std::uint32_t end) const {
    const unsigned broken = kernels_->move_rigid(batch, &table_.layers[0][begin], int(end - begin));
    if (broken != 0) fail(begin + std::uint32_t(std::countr_zero(broken)));
  }

  /// Moves joints, then bases.
  void move_by_steps(BatchParameters& batch, const Model& model, std::uint32_t begin, std::uint32_t end) {
    const auto articulation = [&](std::uint32_t i) -> Articulation& {
      return articulations_[std::size_t(robots_[i].articulation)];
    };
    if (!fixed_ && !model.rigid)
      for (std::uint32_t i = begin; i < end; ++i) articulation(i).begin_step();
    if (model.force_driven)
      for (std::uint32_t i = begin; i < end; ++i) move_force_driven_joints(i, batch.dt);
    for (std::size_t g = 0; g < model.groups.size(); ++g) {
      model.set_joints(batch, g);
      kernels_->move_joints(batch, &table_.layers[g][begin], int(end - begin));
    }
    batch.joint_count = 0;
    if (fixed_) return;
    if (model.rigid) return move_rigid(batch, begin, end);
    for (std::uint32_t i = begin; i < end; ++i) {
      const Wrench external = model.force_driven ? table_.totals[i] : robots_[i].external->value();
      if (!articulation(i).move_base(batch, table_.layers[0][i], external)) fail(i);
    }
  }

  void take_impacts(std::uint32_t i, const Step& step) const {
    const ImpactCorrection* const correction = table_.impacts[i].begin_step(step);
    if (!correction) return;
    const RigidMass& mass = models_[table_.kinds[i].model].mass;
    const RobotState& state = table_.layers[0][i];
    if (robots_[i].articulation >= 0)
      articulations_[std::size_t(robots_[i].articulation)].correct_path(state, mass.inverse_mass, *correction);
    else
      correct_path(state.pose, state.twist, mass, *correction);
  }

  void move_force_driven_joints(std::uint32_t i, double dt) {
    ForceDrivenJoints& joints = force_driven_[std::size_t(robots_[i].force_driven)];
    table_.totals[i] = joints.evaluate(table_.pose(i), table_.twist(i), gravity_, dt);
    if (!joints.move(dt)) fail(i);
  }

  [[noreturn]] void fail(std::uint32_t i) const {
    const Robot& r = robots_[i];
    const Wrench external = r.force_driven >= 0 ? table_.totals[i] : r.external ? r.external->value() : Wrench{};
    throw Error(watch::failure_of_numbers(r.name, table_.pose(i), table_.twist(i), external, r.inertia.mass));
  }

  mesh::Store meshes_;  ///< of collision shapes, for the size of robots
  bool fixed_ = false;
  std::vector<std::string> without_forces_;  ///< robots whose joints no force can move
  bool stand_still_ = false;                 ///< some of their joints are in modes that need forces
  bool reports_applied_ = false;             ///< a sensor reads the wrenches that act on a link
  double max_acceleration_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Model> models_;
  RobotTable table_;
  std::vector<Robot>& robots_ = table_.robots;
  std::vector<Articulation> articulations_;
  std::vector<ForceDrivenJoints> force_driven_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Simplified>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_simplified", .version = description.version, .licence = "MIT",
            .summary = "The simplified dynamics model", .algorithms = algorithms)
