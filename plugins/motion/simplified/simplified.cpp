// SPDX-License-Identifier: MIT
// The simplified dynamics (MuRoSimF, Section 3.2): one body whose centre of mass and inertia follow the joints.
#include <Eigen/Eigenvalues>
#include <array>
#include <bit>
#include <deque>
#include <optional>
#include <string>

#include "articulation.hpp"
#include "force_driven_joints.hpp"
#include "joint_properties.hpp"
#include "least_inertia.hpp"
#include "move.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/multibody/consistent_inertia.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/common/watch/parameters.hpp"
#include "robot_watch.hpp"

namespace {

using namespace muro;
using namespace muro::simplified;
using lane::numbers;

constexpr std::string_view modes[] = {"velocity", "position", "acceleration", "effort", "passive"};
constexpr std::string_view bases[] = {"free", "fixed"};
constexpr Parameter parameters[] = {
    text("joints", "velocity", "which target the joints follow that the lists below do not name").one_of(modes),
    velocity_joints,
    position_joints,
    effort_joints,
    passive_joints,
    real("max_joint_acceleration", "rad/s^2 or m/s^2", 100, "of every joint that follows a target other than an effort")
        .between(1e-6, 1e9),
    boolean("effort_limits", false, "drives that follow targets are no stronger than the model says, and give way"),
    real("armature", "kg m^2 or kg", 0, "inertia of each drive, felt by joints that forces move").between(0, 1e6),
    text("base", "free", "free to move, or fixed to the world where it starts").one_of(bases),
    watch::watch,
    watch::watch_speed,
    watch::watch_depth,
};
constexpr PropertyUse reads[] = {
    {"wrench.external", "of the base; of each body with a shape, too, where forces move joints: sums"},
    {"contacts", "of the robot, where a contact algorithm reads them: how deep it is in scenery"},
    {"gravity", "on the world object; 0 0 -9.81 when absent"},
    {"inertial", "of every body"},
    {"joint.velocity.target", "of joints in mode velocity"},
    {"joint.position.target", "of joints in mode position"},
    {"joint.acceleration.target", "of joints in mode acceleration"},
    {"joint.effort.target", "of joints in mode effort"},
    {"pose.initial", "of the base"},
    {"twist.initial", "of the base"},
    {"joint.position.initial", "of every joint"},
    {"contact.impact", "on the base: where impacts were within the last step"},
    {"contact.impact.time", "on the base: when they were"},
};
constexpr PropertyUse writes[] = {{"pose", "of the base"},
                                  {"twist", "of the base"},
                                  {"joint.position", "of every joint"},
                                  {"joint.velocity", "of every joint"},
                                  {"joint.effort", "of joints that forces move: what the drive applies"},
                                  {"contact.world", "that the contact algorithm answers for all contacts"},
                                  {"twist.lag", "0: pose and twist are those of one instant"},
                                  {"contact.impact.step", "of a base that impacts push: length of a step"}};
constexpr Description description{
    .id = "motion.simplified",
    .kind = Kind::motion,
    .version = "1.1.0",
    .summary =
        "One rigid body under external wrenches whose centre of mass and inertia follow the joints; "
        "joints follow their targets, or forces",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_forces | feature_joints | feature_velocity_targets | feature_position_targets |
                feature_acceleration_targets | feature_effort_targets | feature_joint_limits |
                feature_joint_speed_limits | feature_joint_effort_limits | feature_joint_damping |
                feature_joint_friction | feature_mimic_joints | feature_gyroscopic | feature_contact |
                feature_friction | feature_restitution | feature_fixed_base,
};

class Simplified final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const Parameters& p = c.parameters();
    fixed_ = p.text("base") == "fixed";
    max_acceleration_ = p.real("max_joint_acceleration");
    gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    for (const Item& item : c.items()) connect_robot(c, *item.robot);
  }

  void connect_by_name(Connector& c) override {
    scenery_ = scenery_names(c);
    for (RobotWatch& watch : watches_) watch.connect_contacts(c);
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
    if (fixed_) std::fill_n(layers_[0][item].twist, 6, 0.0);
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  /// Neighbours of one kind go eight at a time.
  void step(const Step& step, Range range) override {
    if (step.index % RobotWatch::interval == 0) look_at(range);
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      while (end < range.end && end < i + lane_width && kinds_[end] == kinds_[i]) ++end;
      const Model& model = models_[kinds_[i].model];
      BatchParameters batch{.mass = &model.mass,
                            .wrenches = int(kinds_[i].wrenches),
                            .other_contributions = other_contributions_.data() + robots_[i].first_other_contribution,
                            .gravity = {gravity_.x(), gravity_.y(), gravity_.z()},
                            .dt = step.dt};
      if (model.single_kernel) {
        set_joints(batch, model, 0);
        move_rigid(batch, i, end);
      } else {
        move_by_steps(batch, model, i, end);
      }
      for (std::uint32_t k = i; k < end; ++k) take_impacts(k, step);
    }
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  /// Robots with the same masses and joints, whose joints lie in memory in the same way.
  struct Model {
    RigidMass mass;
    /// Joints that kernels move; those of one mode.
    struct Group {
      Mode mode = Mode::velocity;
      std::vector<Joint> joints;
      bool operator==(const Group&) const = default;
    };
    std::vector<Group> groups;
    bool rigid = true;          ///< no joint moves mass
    bool force_driven = false;  ///< forces drive joints
    bool single_kernel = true;  ///< one call of a kernel moves it
    bool operator==(const Model&) const = default;
  };
  /// What robots that are moved together have in common.
  struct Kind {
    std::uint32_t model = 0;     ///< in models_
    std::uint32_t wrenches = 0;  ///< contributions to the external wrench
    bool operator==(const Kind&) const = default;
  };
  /// Of a robot whose impacts act at their instant; none for others.
  struct ImpactInput {
    In<std::int64_t> time;
    In<ImpactCorrection> correction;
    Out<double> step;
  };
  struct Robot {
    std::optional<SumIn<Wrench>> external;  ///< none: no wrench moves it
    Out<std::uint64_t> contact_world;
    Out<double> twist_lag;
    std::uint32_t first_other_contribution = 0;  ///< in other_contributions_
    std::int32_t articulation = -1;              ///< in articulations_; -1: no joint moves mass
    std::int32_t force_driven = -1;              ///< in force_driven_; -1: no force drives a joint
    std::string name;
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    std::vector<Inertia> inertias = inertias_of(c, robot);
    for (Inertia& i : inertias) i = nearest_consistent_inertia(i).value_or(i);
    const std::vector<double> start = initial_joint_positions(c, robot);
    if (complete_inertia(c, robot, start, inertias))
      c.host().log(LogLevel::info,
                   "motion.simplified: the inertia of " + quote(robot.name) +
                       " is less than a hundredth of that of a box of its size and mass, so that contacts could not "
                       "hold it; it is raised to that. Give its bodies an inertia (`inertial`) that fits them");
    CompositeBody composite(robot.links, inertias, start);
    const Inertia total = composite_inertia(robot.links, inertias, start);
    check_mass(robot, total);

    Robot r;
    r.name = robot.name;
    const Pose pose = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist twist = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    RobotState state;
    state.pose = numbers(c.variable(robot.base(), keys::pose, pose).get());
    state.twist = numbers(c.variable(robot.base(), keys::twist, fixed_ ? Twist{} : twist).get());
    Model model;
    model.rigid = composite.rigid();
    model.mass.inverse_mass = 1 / total.mass;
    std::copy_n(total.com.data(), 3, model.mass.com);
    const Mat3 inertia = total.tensor(), inverse = inertia.inverse();
    std::copy_n(inertia.data(), 9, model.mass.inertia);
    std::copy_n(inverse.data(), 9, model.mass.inverse);
    const std::vector<JointProperties> properties =
        connect_joint_properties(c, robot, start, c.parameters().boolean("effort_limits"));
    watches_.emplace_back(c, robot, properties);
    // Where another motion of the robot asks for the wrenches on links, they do not act on the base.
    const bool has_levels = robot.links.size() > 1 && !c.constant_array(robot.base(), keys::motion_level_names).empty();
    model.force_driven = has_levels || std::any_of(properties.begin(), properties.end(),
                                                   [](const JointProperties& p) { return p.force_driven; });
    if (model.force_driven) {
      r.force_driven = std::int32_t(force_driven_.size());
      force_driven_.emplace_back(
          c, robot, properties, inertias, start,
          ForceDrivenJoints::Settings{fixed_, max_acceleration_, c.parameters().real("armature")});
    }
    if (model.force_driven || !fixed_) r.external = c.read_sum(robot.base(), keys::external_wrench);
    r.contact_world = c.variable(robot.base(), keys::contact_world, contact_world_of(r.external.has_value()));
    r.twist_lag = c.variable(robot.base(), keys::twist_lag, 0.0);
    ImpactInput impacts;
    if (!model.force_driven && !fixed_)
      impacts = {c.input(robot.base(), keys::impact_time, std::int64_t{0}),
                 c.input(robot.base(), keys::impact, ImpactCorrection{}),
                 c.variable(robot.base(), keys::impact_step, 0.0)};
    impacts_.push_back(impacts);
    connect_groups(robot, properties, model, state);
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
    kinds_.push_back({model_number(std::move(model)), 0});
    robots_.push_back(std::move(r));
  }

  /// The groups of the model, and a layer of states for each; `state`: of the base.
  void connect_groups(const RobotView& robot, const std::vector<JointProperties>& properties, Model& model,
                      const RobotState& state) {
    std::vector<RobotState> states;
    for (const Mode mode : {Mode::velocity, Mode::position, Mode::acceleration}) {
      RobotState of_group = states.empty() ? state : RobotState{};
      std::vector<Joint> joints = kernel_joints(robot, properties, mode, max_acceleration_, of_group);
      if (joints.empty()) continue;
      model.groups.push_back({mode, std::move(joints)});
      states.push_back(of_group);
    }
    if (states.empty()) states.push_back(state);
    for (std::size_t k = 0; k < layers_.size(); ++k) {
      layers_[k].resize(robots_.size() + 1);
      if (k < states.size()) layers_[k].back() = states[k];
    }
  }

  static void check_mass(const RobotView& robot, const Inertia& total) {
    const std::string name = quote(robot.name);
    if (!(total.mass > 0))
      throw Error(name + " has no mass; give its bodies mass and inertia (`inertial`), or move it with motion.point");
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(total.tensor());
    if (!(principal.eigenvalues().minCoeff() > 1e-12 * principal.eigenvalues().maxCoeff()))
      throw Error(name + ": the inertia of all its bodies together has the principal moments " +
                  std::to_string(principal.eigenvalues()[0]) + ", " + std::to_string(principal.eigenvalues()[1]) +
                  ", " + std::to_string(principal.eigenvalues()[2]) +
                  " kg m^2; all must be positive: give its bodies an inertia (`inertial`) that fits their mass");
  }

  std::uint32_t model_number(Model model) {
    const auto known = std::find(models_.rbegin(), models_.rend(), model);  // mostly the last one
    if (known != models_.rend()) return std::uint32_t(models_.rend() - known) - 1;
    models_.push_back(std::move(model));
    return std::uint32_t(models_.size() - 1);
  }

  const SumIn<Wrench>* external_of(std::uint32_t i) const {
    return robots_[i].external ? &*robots_[i].external : nullptr;
  }
  void begin_watches() {
    for (std::uint32_t i = 0; i < watches_.size(); ++i) watches_[i].begin(external_of(i));
  }
  /// Throws Error when the watch over one of the robots ends the run.
  void look_at(Range range) {
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const RobotState& s = layers_[0][i];
      const std::string problem = watches_[i].problem(pose_of(s), twist_of(s), scenery_);
      if (!problem.empty()) throw Error(problem);
    }
  }
  static Pose pose_of(const RobotState& s) { return {Vec3(s.pose[0], s.pose[1], s.pose[2]), Quat(s.pose + 3)}; }
  static Twist twist_of(const RobotState& s) {
    return {Vec3(s.twist[0], s.twist[1], s.twist[2]), Vec3(s.twist[3], s.twist[4], s.twist[5])};
  }

  static void set_joints(BatchParameters& batch, const Model& model, std::size_t group) {
    if (group >= model.groups.size()) return;
    const Model::Group& g = model.groups[group];
    batch.mode = g.mode;
    batch.joints = g.joints.data();
    batch.joint_count = int(g.joints.size());
  }

  void move_rigid(const BatchParameters& batch, std::uint32_t begin, std::uint32_t end) const {
    const unsigned broken = kernels_->move_rigid(batch, &layers_[0][begin], int(end - begin));
    if (broken != 0) fail(begin + std::uint32_t(std::countr_zero(broken)));
  }

  /// Joints, then bases.
  void move_by_steps(BatchParameters& batch, const Model& model, std::uint32_t begin, std::uint32_t end) {
    const auto articulation = [&](std::uint32_t i) -> Articulation& {
      return articulations_[std::size_t(robots_[i].articulation)];
    };
    if (!fixed_ && !model.rigid)
      for (std::uint32_t i = begin; i < end; ++i) articulation(i).begin_step();
    if (model.force_driven)
      for (std::uint32_t i = begin; i < end; ++i) move_force_driven_joints(i, batch.dt);
    for (std::size_t g = 0; g < model.groups.size(); ++g) {
      set_joints(batch, model, g);
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
    const ImpactInput& in = impacts_[i];
    if (!in.time) return;
    if (*in.step != step.dt) *in.step = step.dt;
    if (*in.time != step.time || in.correction->path.isZero(0)) return;
    const RigidMass& mass = models_[kinds_[i].model].mass;
    const RobotState& state = layers_[0][i];
    if (robots_[i].articulation >= 0)
      articulations_[std::size_t(robots_[i].articulation)].correct_path(state, mass.inverse_mass, *in.correction);
    else
      correct_path(state.pose, state.twist, mass, *in.correction);
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
    const bool bad_input = !std::isfinite(external.force.sum() + external.torque.sum());
    throw Error("the motion of `" + r.name + "` is no longer finite" +
                (bad_input
                     ? ": the sum of its external wrenches is not; look at what adds to `wrench.external`"
                     : ": forces grow from step to step; raise the rate, or lower the stiffness of what acts on it "
                       "(contact.penalty: frequency)"));
  }

  bool fixed_ = false;
  double max_acceleration_ = 0;
  Vec3 gravity_ = Vec3::Zero();
  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Model> models_;
  std::vector<Kind> kinds_;                        ///< one per robot
  std::array<std::vector<RobotState>, 3> layers_;  ///< by group of joints; one per robot. The first has the base, too
  std::vector<Robot> robots_;                      ///< the rest of them
  std::deque<RobotWatch> watches_;                 ///< likewise
  SceneryNames scenery_;
  std::vector<ImpactInput> impacts_;                ///< one per robot
  std::vector<const double*> other_contributions_;  ///< contributions to wrenches, all but the first of each robot
  std::vector<Wrench> totals_;  ///< of robots with force-driven joints: what acts on them in this step
  std::vector<Articulation> articulations_;
  std::vector<ForceDrivenJoints> force_driven_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Simplified>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_simplified", .version = description.version, .licence = "MIT",
            .summary = "The simplified dynamics model", .algorithms = algorithms)
