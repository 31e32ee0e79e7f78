// SPDX-License-Identifier: MIT
// The simplified dynamics (MuRoSimF, Section 3.2): one body whose centre of mass and inertia follow the joints.
#include <Eigen/Eigenvalues>
#include <bit>
#include <string>

#include "articulation.hpp"
#include "move.hpp"
#include "muro/composite.hpp"
#include "muro/lane/numbers.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;
using namespace muro::simplified;
using lane::numbers, lane::numbers_between;

constexpr std::string_view modes[] = {"velocity", "position", "acceleration"};
constexpr Parameter parameters[] = {
    text("joints", "velocity", "which target the joints follow").one_of(modes),
    real("max_joint_acceleration", "rad/s^2 or m/s^2", 100, "of every joint").between(1e-6, 1e9),
};
constexpr Use reads[] = {
    {"wrench.external", "sum of all contributions"},
    {"gravity", "on the world object; 0 0 -9.81 when absent"},
    {"inertial", "of every body"},
    {"joint.velocity.target", "joints: velocity"},
    {"joint.position.target", "joints: position"},
    {"joint.acceleration.target", "joints: acceleration"},
    {"pose.initial", "of the base"},
    {"twist.initial", "of the base"},
    {"joint.position.initial", "of every joint"},
};
constexpr Use writes[] = {{"pose", "of the base"},
                          {"twist", "of the base"},
                          {"joint.position", "of every joint"},
                          {"joint.velocity", "of every joint"}};
constexpr Description description{
    .id = "motion.simplified",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary =
        "One rigid body under external wrenches whose centre of mass and inertia follow the joints; "
        "joints follow their targets",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | batched | allocation_free | restorable,
};

class Simplified final : public Algorithm {
 public:
  void connect(Connector& c) override {
    const std::string_view mode = c.parameters().text("joints");
    mode_ = mode == "velocity" ? Mode::velocity : mode == "position" ? Mode::position : Mode::acceleration;
    gravity_ = c.constant(world_object, keys::gravity).value_or(Vec3(0, 0, -9.81));
    for (const Item& item : c.items()) connect_robot(c, *item.robot);
  }

  void start() override {
    further_.clear();
    for (std::size_t i = 0; i < robots_.size(); ++i) {
      const SumIn<Wrench>& external = robots_[i].external;
      kinds_[i].wrenches = std::uint32_t(external.size());
      states_[i].wrench = external.size() > 0 ? numbers(external.part(0)) : nullptr;
      robots_[i].first_further = std::uint32_t(further_.size());
      for (std::uint64_t k = 1; k < external.size(); ++k) further_.push_back(numbers(external.part(k)));
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::Over::items, Phase::Reach::own}};
    return phases;
  }

  /// Neighbours of one kind go eight at a time.
  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      while (end < range.end && end < i + lane_width && kinds_[end] == kinds_[i]) ++end;
      const Model& model = models_[kinds_[i].model];
      const Work work{.mode = mode_,
                      .joints = model.joints.data(),
                      .joint_count = int(model.joints.size()),
                      .mass = &model.mass,
                      .wrenches = int(kinds_[i].wrenches),
                      .further = further_.data() + robots_[i].first_further,
                      .gravity = {gravity_.x(), gravity_.y(), gravity_.z()},
                      .dt = step.dt};
      model.rigid ? move_rigid(work, i, end) : move_articulated(work, i, end);
    }
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  /// Robots with the same masses and joints, whose joints lie in memory in the same way.
  struct Model {
    RigidMass mass;
    std::vector<Joint> joints;
    bool rigid = true;
    bool operator==(const Model&) const = default;
  };
  /// What robots that are moved together have in common.
  struct Kind {
    std::uint32_t model = 0;     ///< in models_
    std::uint32_t wrenches = 0;  ///< contributions to the external wrench
    bool operator==(const Kind&) const = default;
  };
  struct Robot {
    SumIn<Wrench> external;
    std::uint32_t first_further = 0;  ///< in further_
    std::int32_t articulation = -1;   ///< in articulations_; -1: no joint moves mass
    std::string name;
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const std::vector<Inertia> inertias = inertias_of(c, robot);
    const std::vector<double> start = initial_joint_positions(c, robot);
    MovingMass moving(robot.frames, inertias, start);
    const Inertia whole = composite_inertia(robot.frames, inertias, start);
    check_mass(robot, whole);

    Robot r;
    r.name = robot.name;
    r.external = c.read_sum(robot.base(), keys::external_wrench);
    const Pose pose = c.constant(robot.base(), keys::initial_pose).value_or(Pose{});
    const Twist twist = c.constant(robot.base(), keys::initial_twist).value_or(Twist{});
    RobotState state;
    state.pose = numbers(c.variable(robot.base(), keys::pose, pose).get());
    state.twist = numbers(c.variable(robot.base(), keys::twist, twist).get());
    Model model;
    model.rigid = moving.rigid();
    model.mass.inverse_mass = 1 / whole.mass;
    std::copy_n(whole.com.data(), 3, model.mass.com);
    const Mat3 inertia = whole.tensor(), inverse = inertia.inverse();
    std::copy_n(inertia.data(), 9, model.mass.inertia);
    std::copy_n(inverse.data(), 9, model.mass.inverse);
    const std::vector<Place> places = connect_joints(c, robot, start);
    model.joints = joints_of(c, robot, places, state);
    if (!moving.rigid()) {
      r.articulation = std::int32_t(articulations_.size());
      std::vector<const double*> positions, velocities;
      for (const std::uint32_t frame : moving.joints()) {
        positions.push_back(places[frame].position);
        velocities.push_back(places[frame].velocity);
      }
      articulations_.emplace_back(std::move(moving), std::move(positions), std::move(velocities));
    }
    kinds_.push_back({model_number(std::move(model)), 0});
    states_.push_back(state);
    robots_.push_back(std::move(r));
  }

  static void check_mass(const RobotView& robot, const Inertia& whole) {
    const std::string name = "`" + std::string(robot.name) + "`";
    if (!(whole.mass > 0))
      throw Error(name + " has no mass; give its bodies mass and inertia (`inertial`), or move it with motion.point");
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(whole.tensor());
    if (!(principal.eigenvalues().minCoeff() > 1e-12 * principal.eigenvalues().maxCoeff()))
      throw Error(name + ": the inertia of all its bodies together has the principal moments " +
                  std::to_string(principal.eigenvalues()[0]) + ", " + std::to_string(principal.eigenvalues()[1]) +
                  ", " + std::to_string(principal.eigenvalues()[2]) +
                  " kg m^2; all must be positive: give its bodies an inertia (`inertial`) that fits their mass");
  }

  /// Where the state of a joint lies; null where there is none.
  struct Place {
    double* position = nullptr;
    double* velocity = nullptr;
    const double* target = nullptr;
  };

  /// One a frame.
  std::vector<Place> connect_joints(Connector& c, const RobotView& robot, const std::vector<double>& start) const {
    std::vector<Place> places(robot.frames.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Frame& f = robot.frames[i];
      if (f.joint == JointKind::fixed) continue;
      if (start[i] < f.limits.lower || start[i] > f.limits.upper)
        throw Error("joint `" + std::string(c.object_name(f.joint_object)) + "` starts at " + std::to_string(start[i]) +
                    ", outside of its limits " + std::to_string(f.limits.lower) + " to " +
                    std::to_string(f.limits.upper) + "; set `joint.position.initial` to a value between them");
      places[i].position = c.variable(f.joint_object, keys::joint_position, start[i]).get();
      places[i].velocity = c.variable(f.joint_object, keys::joint_velocity, 0.0).get();
      if (f.mimic >= 0) continue;
      places[i].target = (mode_ == Mode::velocity   ? c.input(f.joint_object, keys::joint_velocity_target, 0.0)
                          : mode_ == Mode::position ? c.input(f.joint_object, keys::joint_position_target, start[i])
                                                    : c.input(f.joint_object, keys::joint_acceleration_target, 0.0))
                             .get();
    }
    return places;
  }

  /// The joints as kernels see them; sets the places of the first one in `state`.
  static std::vector<Joint> joints_of(const Connector& c, const RobotView& robot, const std::vector<Place>& places,
                                      RobotState& state) {
    std::vector<Joint> joints;
    std::vector<int> number(places.size(), -1);
    for (std::size_t i = 0, count = 0; i < places.size(); ++i)
      if (places[i].position) number[i] = int(count++);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Frame& f = robot.frames[i];
      const Place& p = places[i];
      if (!p.position) continue;
      if (!state.positions) state.positions = p.position, state.velocities = p.velocity;
      if (!state.targets) state.targets = p.target;
      Joint j;
      j.range = {f.limits.lower, f.limits.upper, f.limits.velocity, c.parameters().real("max_joint_acceleration")};
      j.position = numbers_between(state.positions, p.position);
      j.velocity = numbers_between(state.velocities, p.velocity);
      if (p.target) j.target = numbers_between(state.targets, p.target);
      if (f.mimic >= 0) {
        j.leader = number[std::size_t(f.mimic)];
        j.multiplier = f.mimic_multiplier;
        j.offset = f.mimic_offset;
      }
      joints.push_back(j);
    }
    for (std::size_t k = 0; k + 4 <= joints.size(); ++k) {
      joints[k].four = true;
      for (std::ptrdiff_t n = 0; n < 4; ++n) {
        const Joint &first = joints[k], &j = joints[k + std::size_t(n)];
        joints[k].four = first.four && j.leader < 0 && j.position == first.position + n &&
                         j.velocity == first.velocity + n && j.target == first.target + n;
      }
    }
    return joints;
  }

  std::uint32_t model_number(Model model) {
    const auto known = std::find(models_.rbegin(), models_.rend(), model);  // mostly the last one
    if (known != models_.rend()) return std::uint32_t(models_.rend() - known) - 1;
    models_.push_back(std::move(model));
    return std::uint32_t(models_.size() - 1);
  }

  void move_rigid(const Work& work, std::uint32_t begin, std::uint32_t end) const {
    const unsigned broken = kernels_->move_rigid(work, &states_[begin], int(end - begin));
    if (broken != 0) fail(robots_[begin + std::uint32_t(std::countr_zero(broken))]);
  }

  void move_articulated(const Work& work, std::uint32_t begin, std::uint32_t end) {
    const auto articulation = [&](std::uint32_t i) -> Articulation& {
      return articulations_[std::size_t(robots_[i].articulation)];
    };
    for (std::uint32_t i = begin; i < end; ++i) articulation(i).begin_step();
    kernels_->move_joints(work, &states_[begin], int(end - begin));
    for (std::uint32_t i = begin; i < end; ++i)
      if (!articulation(i).move_base(work, states_[i], robots_[i].external.value())) fail(robots_[i]);
  }

  [[noreturn]] static void fail(const Robot& r) {
    const Wrench external = r.external.value();
    const bool bad_input = !std::isfinite(external.force.sum() + external.torque.sum());
    throw Error("the motion of `" + r.name + "` is no longer finite" +
                (bad_input
                     ? ": the sum of its external wrenches is not; look at what adds to `wrench.external`"
                     : ": forces grow from step to step; raise the rate, or lower the stiffness of what acts on it "
                       "(contact.penalty: frequency)"));
  }

  Mode mode_ = Mode::velocity;
  Vec3 gravity_ = Vec3::Zero();
  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Model> models_;
  std::vector<Kind> kinds_;             ///< one a robot
  std::vector<RobotState> states_;      ///< one a robot
  std::vector<Robot> robots_;           ///< the rest of them
  std::vector<const double*> further_;  ///< contributions to wrenches, but the first of each robot
  std::vector<Articulation> articulations_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Simplified>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_simplified", .version = "1.0.0", .licence = "MIT",
            .summary = "The simplified dynamics model", .algorithms = algorithms)
