// SPDX-License-Identifier: MIT
// The simplified dynamics (MuRoSimF, Section 3.2): one body whose centre of mass and inertia follow the joints.
#include <array>
#include <bit>
#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "applied_wrenches.hpp"
#include "articulation.hpp"
#include "description.hpp"
#include "force_driven_joints.hpp"
#include "joint_properties.hpp"
#include "least_inertia.hpp"
#include "model.hpp"
#include "move.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/accelerations.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/contact_geometry/impact_input.hpp"
#include "plugins/common/mesh/hull_vertices.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/kinematic_joints/moving_mass.hpp"
#include "plugins/motion/common/multibody/consistent_inertia.hpp"
#include "plugins/motion/common/position_drive/settled_modes.hpp"
#include "plugins/motion/common/watch/robot_watch.hpp"

namespace {

using namespace muro;
using namespace muro::simplified;
using lane::numbers;

class Simplified final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    fixed_ = p.text("base") == "fixed";
    max_acceleration_ = p.real("max_joint_acceleration");
    gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    const std::size_t count = c.items().size();
    robots_.resize(count), kinds_.resize(count), impacts_.resize(count), applied_wrenches_.resize(count);
    for (std::vector<RobotState>& layer : layers_) layer.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const RobotView& robot = *c.items()[i].robot;
      modes_.push_back(drive_modes_of(c, robot, p));
      watches_.emplace_back(c, robot, std::vector<const double*>{});
      connect_robot(c, i);
      note_without_forces(c, robot, modes_[i]);
    }
    tell_of_robots_without_forces(c, without_forces_, stand_still_);
  }

  void connect_by_name(Connector& c) override {
    for (std::uint32_t i = 0; i < robots_.size(); ++i) {
      std::vector<DriveMode> modes = settled_modes(c, *c.items()[i].robot, c.parameters());
      if (modes == modes_[i]) continue;
      modes_[i] = std::move(modes);
      connect_robot(c, i);
    }
    surroundings_.connect(c);
    for (watch::RobotWatch& watch : watches_) watch.connect_contacts(c);
    for (ForceDrivenJoints& joints : force_driven_) joints.connect_by_name(c);
    for (std::uint32_t i = 0; i < robots_.size(); ++i)
      accelerations_.connect_by_name(c, i, fixed_ ? BaseMotion::kinematic : BaseMotion::by_forces, robots_[i].inertia,
                                     robots_[i].external.has_value());
    for (std::uint32_t i = 0; i < robots_.size(); ++i) {
      applied_wrenches_[i].connect_by_name(c, *c.items()[i].robot, external_of(i));
      tells_applied_ = tells_applied_ || !applied_wrenches_[i].empty();
    }
  }

  void restored() override { begin_watches(); }

  void start() override {
    begin_watches();
    other_contributions_.clear();
    totals_.assign(robots_.size(), Wrench{});
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      Robot& r = robots_[i];
      RobotState& state = layers_[0][i];
      r.first_other_contribution = std::uint32_t(other_contributions_.size());
      kinds_[i].wrenches = 0;
      if (r.force_driven >= 0) {
        kinds_[i].wrenches = 1;
        state.wrench = numbers(&totals_[i]);
      } else if (r.external) {
        kinds_[i].wrenches = std::uint32_t(r.external->size());
        state.wrench = r.external->size() > 0 ? numbers(r.external->contribution(0)) : nullptr;
        for (std::uint64_t k = 1; k < r.external->size(); ++k)
          other_contributions_.push_back(numbers(r.external->contribution(k)));
      }
    }
  }

  void on_handover(std::uint32_t item) override {
    watches_[item].begin(external_of(item));
    *robots_[item].contact_world = contact_world_of(robots_[item].external.has_value());
    *robots_[item].twist_lag = 0;
    if (robots_[item].force_driven >= 0) force_driven_[std::size_t(robots_[item].force_driven)].take_over();
    if (fixed_) std::fill_n(layers_[0][item].twist, 6, 0.0);
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  /// Moves robots. Neighbours of one kind move eight at a time.
  void step(const Step& step, Range range) override {
    if (step.index % watch::RobotWatch::interval == 0) look_at(step, range);
    accelerations_.begin_step(range);
    if (tells_applied_)
      for (std::uint32_t i = range.begin; i < range.end; ++i) applied_wrenches_[i].keep();
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      while (end < range.end && end < i + lane_width && kinds_[end] == kinds_[i]) ++end;
      const Model& model = models_[kinds_[i].model];
      BatchParameters batch{.mass = &model.mass,
                            .wrenches = int(kinds_[i].wrenches),
                            .other_contributions = other_contributions_.data() + robots_[i].first_other_contribution,
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
    accelerations_.end_step(range, step.dt);
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  /// Common data of robots that are moved together.
  struct Kind {
    std::uint32_t model = 0;     ///< in models_
    std::uint32_t wrenches = 0;  ///< contributions to the external wrench
    bool operator==(const Kind&) const = default;
  };
  struct Robot {
    std::optional<SumIn<Wrench>> external;  ///< none: no wrench moves it
    Out<std::uint64_t> contact_world;
    Out<double> twist_lag;
    std::uint32_t first_other_contribution = 0;  ///< in other_contributions_
    std::int32_t articulation = -1;              ///< in articulations_; -1: no joint moves mass
    std::int32_t force_driven = -1;              ///< in force_driven_; -1: no force drives a joint
    std::string name;
    Inertia inertia;  ///< inertia of all its bodies at the start, in the frame of the base
  };

  /// Connects a robot whose joints have modes_. Called again when its joints turn out to have other modes.
  void connect_robot(Connector& c, std::uint32_t number) {
    const Item& item = c.items()[number];
    const RobotView& robot = *item.robot;
    const std::vector<DriveMode>& modes = modes_[number];
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
    watches_[number] = watch::RobotWatch(c, robot, watched);
    // When another motion of the robot reads the wrenches on links, they do not act on the base.
    const bool has_levels =
        forces && robot.links.size() > 1 && !c.constant_array(robot.base(), keys::motion_level_names).empty();
    const auto any = [&](bool JointProperties::*what) {
      return forces && std::any_of(properties.begin(), properties.end(), std::mem_fn(what));
    };
    const bool is_first = !robots_[number].contact_world;
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
    r.contact_world = c.variable(robot.base(), keys::contact_world, contact_world_of(r.external.has_value()));
    r.twist_lag = c.variable(robot.base(), keys::twist_lag, 0.0);
    impacts_[number] =
        feels_contact || fixed_ ? contact_geometry::ImpactInput{} : contact_geometry::ImpactInput(c, robot);
    const std::vector<RobotState> states = model.add_groups(robot, properties, max_acceleration_, state);
    for (std::size_t k = 0; k < layers_.size(); ++k) layers_[k][number] = k < states.size() ? states[k] : RobotState{};
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
    kinds_[number] = {number_of(std::move(model), models_), 0};
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

  const SumIn<Wrench>* external_of(std::uint32_t i) const {
    return robots_[i].external ? &*robots_[i].external : nullptr;
  }
  void begin_watches() {
    for (std::uint32_t i = 0; i < watches_.size(); ++i) watches_[i].begin(external_of(i));
  }
  /// Throws Error when the watch over one of the robots ends the run.
  void look_at(const Step& step, Range range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const RobotState& s = layers_[0][i];
      watches_[i].look(step, pose_of(s), twist_of(s), surroundings_);
    }
  }
  static Pose pose_of(const RobotState& s) { return {Vec3(s.pose[0], s.pose[1], s.pose[2]), Quat(s.pose + 3)}; }
  static Twist twist_of(const RobotState& s) {
    return {Vec3(s.twist[0], s.twist[1], s.twist[2]), Vec3(s.twist[3], s.twist[4], s.twist[5])};
  }

  void move_rigid(const BatchParameters& batch, std::uint32_t begin, std::uint32_t end) const {
    const unsigned broken = kernels_->move_rigid(batch, &layers_[0][begin], int(end - begin));
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
      kernels_->move_joints(batch, &layers_[g][begin], int(end - begin));
    }
    batch.joint_count = 0;
    if (fixed_) return;
    if (model.rigid) return move_rigid(batch, begin, end);
    for (std::uint32_t i = begin; i < end; ++i) {
      const Wrench external = model.force_driven ? totals_[i] : robots_[i].external->value();
      if (!articulation(i).move_base(batch, layers_[0][i], external)) fail(i);
    }
  }

  void take_impacts(std::uint32_t i, const Step& step) const {
    const ImpactCorrection* const correction = impacts_[i].begin_step(step);
    if (!correction) return;
    const RigidMass& mass = models_[kinds_[i].model].mass;
    const RobotState& state = layers_[0][i];
    if (robots_[i].articulation >= 0)
      articulations_[std::size_t(robots_[i].articulation)].correct_path(state, mass.inverse_mass, *correction);
    else
      correct_path(state.pose, state.twist, mass, *correction);
  }

  void move_force_driven_joints(std::uint32_t i, double dt) {
    ForceDrivenJoints& joints = force_driven_[std::size_t(robots_[i].force_driven)];
    const RobotState& s = layers_[0][i];
    totals_[i] = joints.evaluate(pose_of(s), twist_of(s), gravity_, dt);
    if (!joints.move(dt)) fail(i);
  }

  [[noreturn]] void fail(std::uint32_t i) const {
    const Robot& r = robots_[i];
    const Wrench external = r.force_driven >= 0 ? totals_[i] : r.external ? r.external->value() : Wrench{};
    const RobotState& s = layers_[0][i];
    throw Error(watch::failure_of_numbers(r.name, pose_of(s), twist_of(s), external, r.inertia.mass));
  }

  Accelerations accelerations_{mesh::hull_vertices};
  mesh::Store meshes_;  ///< meshes of collision shapes, for the size of robots
  bool fixed_ = false;
  std::vector<std::string> without_forces_;  ///< robots whose joints no force can move
  bool stand_still_ = false;                 ///< some of their joints stand still
  bool tells_applied_ = false;               ///< some of applied_wrenches_ are read
  double max_acceleration_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Model> models_;
  std::vector<std::vector<DriveMode>> modes_;      ///< modes of the joints of each robot, one per link
  std::vector<Kind> kinds_;                        ///< one per robot
  std::array<std::vector<RobotState>, 3> layers_;  ///< by group of joints; one per robot; the first also has the base
  std::vector<Robot> robots_;                      ///< other data, one per robot
  std::deque<watch::RobotWatch> watches_;          ///< one per robot
  watch::Surroundings surroundings_;
  std::vector<contact_geometry::ImpactInput> impacts_;  ///< one per robot
  std::vector<AppliedWrenches> applied_wrenches_;       ///< one per robot
  std::vector<const double*> other_contributions_;  ///< contributions to wrenches, all except the first of each robot
  std::vector<Wrench> totals_;  ///< sum of wrenches in this step, for robots with force-driven joints
  std::vector<Articulation> articulations_;
  std::vector<ForceDrivenJoints> force_driven_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Simplified>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_simplified", .version = description.version, .licence = "MIT",
            .summary = "The simplified dynamics model", .algorithms = algorithms)
