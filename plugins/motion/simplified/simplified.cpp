// SPDX-License-Identifier: MIT
// The simplified dynamics (MuRoSimF, Section 3.2): one body whose centre of mass and inertia follow the joints.
#include <Eigen/Eigenvalues>
#include <bit>
#include <string>

#include "joint_motion.hpp"
#include "moving_mass.hpp"
#include "muro/composite.hpp"
#include "muro/plugin.hpp"
#include "rigid.hpp"
#include "rigid_body.hpp"

namespace {

using namespace muro;
using namespace muro::simplified;
using namespace muro::simplified::integrator;

enum class Mode { velocity, position, acceleration };

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
    rigid_.clear();
    for (const Robot& r : robots_)
      rigid_.push_back({r.pose->position.data(), r.twist->linear.data(), nullptr, wheels_.data() + r.first_wheel});
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::Over::items, Phase::Reach::own}};
    return phases;
  }

  /// Neighbours of one rigid model go eight at a time.
  void step(const Step& step, Range range) override {
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      const Robot& first = robots_[i];
      end = i + 1;
      if (first.articulation >= 0) {
        move_articulated(first, step.dt);
        continue;
      }
      while (end < range.end && end < i + lane_width && robots_[end].model == first.model) ++end;
      move_rigid(i, end, step.dt);
    }
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  struct Robot {
    Out<Pose> pose;
    Out<Twist> twist;
    SumIn<Wrench> external;
    std::uint32_t model = 0;                       ///< in models_
    std::uint32_t first_wheel = 0;                 ///< in wheels_
    std::uint32_t first_joint = 0, end_joint = 0;  ///< in joints_
    std::int32_t articulation = -1;                ///< in articulations_; -1: no joint moves mass
    std::string name;
  };
  /// What the kernels need of a robot whose joints move no mass; of any other the mass alone.
  struct Model {
    RigidModel body;
    std::vector<WheelLimits> wheels;
    bool operator==(const Model&) const = default;
  };
  /// Any joint but a wheel.
  struct Joint {
    Out<double> position, velocity;
    In<double> target;
    JointRange range;
    std::int32_t leader = -1;  ///< in joints_; -1: follows its own target
    double multiplier = 1, offset = 0;
  };
  /// A robot whose joints move its masses, with the mass state of the joint state that `positions` and `velocities`
  /// name.
  struct Articulation {
    MovingMass mass;
    std::vector<std::uint32_t> joints;  ///< in joints_, in the order of mass.joints()
    std::vector<double> positions, velocities;
    MassState state{};
    Mat3 inverse = Mat3::Zero();
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    const std::vector<Inertia> inertias = inertias_of(c, robot);
    const std::vector<double> start = initial_joint_positions(c, robot);
    MovingMass moving(robot.frames, inertias, start);
    const Inertia whole = composite_inertia(robot.frames, inertias, start);
    check_mass(robot, whole);

    Robot r;
    r.name = robot.name;
    r.pose = c.variable(robot.base(), keys::pose, c.constant(robot.base(), keys::initial_pose).value_or(Pose{}));
    r.twist = c.variable(robot.base(), keys::twist, c.constant(robot.base(), keys::initial_twist).value_or(Twist{}));
    r.external = c.read_sum(robot.base(), keys::external_wrench);
    Model model;
    model.body.inverse_mass = 1 / whole.mass;
    std::copy_n(whole.com.data(), 3, model.body.com);
    const Mat3 inverse = whole.tensor().inverse();
    std::copy_n(whole.tensor().data(), 9, model.body.inertia);
    std::copy_n(inverse.data(), 9, model.body.inverse);
    const std::vector<std::int32_t> joint_of = connect_joints(c, robot, start, moving.rigid(), r, model);
    r.model = model_number(std::move(model));
    if (!moving.rigid()) {
      r.articulation = std::int32_t(articulations_.size());
      Articulation a{.mass = std::move(moving), .joints = {}, .positions = {}, .velocities = {}};
      for (const std::uint32_t frame : a.mass.joints()) a.joints.push_back(std::uint32_t(joint_of[frame]));
      a.positions.assign(a.joints.size(), std::numeric_limits<double>::quiet_NaN());
      a.velocities = a.positions;
      articulations_.push_back(std::move(a));
    }
    robots_.push_back(std::move(r));
  }

  std::uint32_t model_number(Model model) {
    const auto known = std::find(models_.begin(), models_.end(), model);
    if (known != models_.end()) return std::uint32_t(known - models_.begin());
    models_.push_back(std::move(model));
    return std::uint32_t(models_.size() - 1);
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

  /// Whether a joint follows a velocity, free of everything else.
  bool is_wheel(const RobotView& robot, std::size_t frame) const {
    const Frame& f = robot.frames[frame];
    const bool leads = std::any_of(robot.frames.begin(), robot.frames.end(),
                                   [&](const Frame& g) { return g.mimic == std::int32_t(frame); });
    return mode_ == Mode::velocity && f.mimic < 0 && !leads && std::isinf(f.limits.lower) && std::isinf(f.limits.upper);
  }

  /// Returns the joint's place in joints_ by frame. Wheels of a rigid robot go to wheels_ instead.
  std::vector<std::int32_t> connect_joints(Connector& c, const RobotView& robot, const std::vector<double>& start,
                                           bool rigid, Robot& r, Model& model) {
    std::vector<std::int32_t> place(robot.frames.size(), -1);
    r.first_wheel = std::uint32_t(wheels_.size());
    r.first_joint = r.end_joint = std::uint32_t(joints_.size());
    for (std::size_t i = 0; i < place.size(); ++i)
      if (robot.frames[i].joint != JointKind::fixed && !(rigid && is_wheel(robot, i)))
        place[i] = std::int32_t(r.end_joint++);
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Frame& f = robot.frames[i];
      if (f.joint == JointKind::fixed) continue;
      if (start[i] < f.limits.lower || start[i] > f.limits.upper)
        throw Error("joint `" + std::string(c.object_name(f.joint_object)) + "` starts at " + std::to_string(start[i]) +
                    ", outside of its limits " + std::to_string(f.limits.lower) + " to " +
                    std::to_string(f.limits.upper) + "; set `joint.position.initial` to a value between them");
      Joint j;
      j.position = c.variable(f.joint_object, keys::joint_position, start[i]);
      j.velocity = c.variable(f.joint_object, keys::joint_velocity, 0.0);
      j.range = {f.limits.lower, f.limits.upper, f.limits.velocity, c.parameters().real("max_joint_acceleration")};
      if (f.mimic >= 0) {
        j.leader = place[std::size_t(f.mimic)];
        j.multiplier = f.mimic_multiplier;
        j.offset = f.mimic_offset;
      } else {
        j.target = mode_ == Mode::velocity   ? c.input(f.joint_object, keys::joint_velocity_target, 0.0)
                   : mode_ == Mode::position ? c.input(f.joint_object, keys::joint_position_target, start[i])
                                             : c.input(f.joint_object, keys::joint_acceleration_target, 0.0);
      }
      if (place[i] >= 0) {
        joints_.push_back(j);
      } else {
        wheels_.push_back({j.position.get(), j.velocity.get(), j.target.get()});
        model.wheels.push_back({j.range.speed, j.range.acceleration});
      }
    }
    return place;
  }

  void move_joints(const Robot& r, double dt) {
    for (std::uint32_t i = r.first_joint; i < r.end_joint; ++i) {
      const Joint& j = joints_[i];
      if (j.leader >= 0) continue;
      JointState state{*j.position, *j.velocity};
      switch (mode_) {
        case Mode::velocity:
          follow_velocity(state, *j.target, j.range, dt);
          break;
        case Mode::position:
          follow_position(state, *j.target, j.range, dt);
          break;
        case Mode::acceleration:
          follow_acceleration(state, *j.target, j.range, dt);
          break;
      }
      *j.position = state.position;
      *j.velocity = state.velocity;
    }
    for (std::uint32_t i = r.first_joint; i < r.end_joint; ++i) {
      const Joint& j = joints_[i];
      if (j.leader < 0) continue;
      const Joint& leader = joints_[std::size_t(j.leader)];  // follows nobody itself
      *j.position = j.offset + j.multiplier * *leader.position;
      *j.velocity = j.multiplier * *leader.velocity;
    }
  }

  /// Robots `begin` to `end` - 1, of one model.
  void move_rigid(std::uint32_t begin, std::uint32_t end, double dt) {
    const Model& model = models_[robots_[begin].model];
    const RigidWork work{&model.body,
                         model.wheels.data(),
                         std::uint32_t(model.wheels.size()),
                         {gravity_.x(), gravity_.y(), gravity_.z()},
                         dt};
    Wrench external[lane_width];
    RigidRobot robots[lane_width];
    for (std::uint32_t i = begin; i < end; ++i) {
      move_joints(robots_[i], dt);
      external[i - begin] = robots_[i].external.value();
      robots[i - begin] = rigid_[i];
      robots[i - begin].wrench = external[i - begin].force.data();
    }
    unsigned broken = 0;
    if (end - begin == lane_width)
      broken = kernels_->move_eight(work, robots);
    else
      for (std::uint32_t i = begin; i < end; ++i)
        broken |= kernels_->move_one(work, robots + (i - begin)) << (i - begin);
    if (broken != 0) {
      const auto first = std::uint32_t(std::countr_zero(broken));
      fail(robots_[begin + first], external[first]);
    }
  }

  void move_articulated(const Robot& r, double dt) {
    Articulation& a = articulations_[std::size_t(r.articulation)];
    update(a);
    const MassState before = a.state;
    const Mat3 inverse_before = a.inverse;
    move_joints(r, dt);
    update(a);
    move_base(r, before, a.state, 0.5 * (inverse_before + a.inverse), a.inverse, dt);
  }

  /// Brings `state` up to the present joint state, if it is of another one.
  void update(Articulation& a) const {
    bool same = true;
    for (std::size_t k = 0; k < a.joints.size(); ++k) {
      const Joint& j = joints_[a.joints[k]];
      same = same && a.positions[k] == *j.position && a.velocities[k] == *j.velocity;
      a.positions[k] = *j.position;
      a.velocities[k] = *j.velocity;
    }
    if (same) return;
    a.state = a.mass.state(a.positions, a.velocities);
    a.inverse = a.state.tensor.inverse();
  }

  static V3<double> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
  static M3<double> plain(const Mat3& m) {
    return {plain(Vec3(m.col(0))), plain(Vec3(m.col(1))), plain(Vec3(m.col(2)))};
  }
  static Mass<double> plain(const MassState& m) { return {plain(m.com), plain(m.com_velocity), plain(m.tensor)}; }

  void move_base(const Robot& r, const MassState& before, const MassState& after, const Mat3& inverse_half,
                 const Mat3& inverse_end, double dt) const {
    const Wrench external = r.external.value();
    const Quat& q = r.pose->orientation;
    lane::PoseOf<double> pose{plain(r.pose->position), {q.x(), q.y(), q.z(), q.w()}};
    lane::TwistOf<double> twist{plain(r.twist->linear), plain(r.twist->angular)};
    integrator::move_base<true>(pose, twist, plain(external.force), plain(external.torque), plain(before), plain(after),
                                plain(inverse_half), plain(inverse_end), models_[r.model].body.inverse_mass,
                                plain(gravity_), dt);
    const auto& [x, turn] = pose;
    *r.pose = {{x.x, x.y, x.z}, Quat(turn.w, turn.x, turn.y, turn.z)};
    *r.twist = {{twist.linear.x, twist.linear.y, twist.linear.z}, {twist.angular.x, twist.angular.y, twist.angular.z}};
    if (!std::isfinite(r.pose->position.sum() + r.twist->linear.sum() + r.twist->angular.sum())) fail(r, external);
  }

  [[noreturn]] static void fail(const Robot& r, const Wrench& external) {
    const bool bad_input = !std::isfinite(external.force.sum() + external.torque.sum());
    throw Error("the motion of `" + r.name + "` is no longer finite" +
                (bad_input
                     ? ": the sum of its external wrenches is not; look at what adds to `wrench.external`"
                     : ": forces grow from step to step; raise the rate, or lower the stiffness of what acts on it "
                       "(contact.penalty: frequency)"));
  }

  Mode mode_ = Mode::velocity;
  Vec3 gravity_ = Vec3::Zero();
  const RigidKernels* kernels_ = &rigid_kernels_for(lane::best_isa());
  std::vector<Robot> robots_;
  std::vector<Model> models_;
  std::vector<Wheel> wheels_;
  std::vector<RigidRobot> rigid_;  ///< one a robot
  std::vector<Joint> joints_;
  std::vector<Articulation> articulations_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Simplified>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_simplified", .version = "1.0.0", .licence = "MIT",
            .summary = "The simplified dynamics model", .algorithms = algorithms)
