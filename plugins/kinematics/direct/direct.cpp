// SPDX-License-Identifier: MIT
// Poses and twists of all bodies of a robot from its base and its joints.
#include "chain.hpp"
#include "muro/plugin.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/toolkit/mass_properties.hpp"

namespace {

using namespace muro;
using namespace muro::kinematics;
using lane::numbers, lane::numbers_between;

constexpr PropertyUse reads[] = {
    {"pose", "of the base"},
    {"twist", "of the base"},
    {"joint.position", "of every joint; where nothing moves it, its initial position"},
    {"joint.velocity", "of every joint; where nothing moves it, 0"},
    {"joint.position.initial", "of every joint, optional"},
};
constexpr PropertyUse writes[] = {
    {"pose", "of every body but the base"},
    {"twist", "of every body but the base"},
    {"joint.position", "of mimic joints that the motion model leaves alone"},
    {"joint.velocity", "of mimic joints that the motion model leaves alone"},
};
constexpr Description description{
    .id = "kinematics.direct",
    .kind = Kind::kinematics,
    .version = "1.0.0",
    .summary = "Poses and twists of all bodies of a robot from its base and joints",
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
};

class Direct final : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it places the bodies of robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::IndexSpace::items, Phase::Scope::own_robot}};
    return phases;
  }

  /// Neighbours alike go eight at a time.
  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      const std::uint32_t model = robots_[i].model;
      for (; end < range.end && end < i + lane_width && robots_[end].model == model; ++end) follow(robots_[end]);
      const Model& m = models_[model];
      kernels_->place(m.chain.links.data(), m.spots.data(), int(m.spots.size()), &states_[i], int(end - i));
    }
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  /// Robots with the same structure, whose state lies in memory in the same way.
  struct Model {
    Chain chain;
    std::vector<Spot> spots;  ///< one a link
    bool operator==(const Model&) const = default;
  };
  struct Robot {
    std::uint32_t model = 0;                             ///< in models_
    std::uint32_t first_follower = 0, end_follower = 0;  ///< in followers_
  };
  /// A mimic joint that nothing else moves.
  struct Follower {
    In<double> leader_position, leader_velocity;
    Out<double> position, velocity;
    double multiplier = 1, offset = 0;
  };

  /// Where the state of one link lies; null where there is no joint.
  struct Place {
    double* pose = nullptr;
    double* twist = nullptr;
    const double* position = nullptr;
    const double* velocity = nullptr;
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    Robot r;
    r.first_follower = std::uint32_t(followers_.size());
    const std::vector<double> start = initial_joint_positions(c, robot);
    std::vector<Place> places;
    for (std::size_t i = 1; i < robot.links.size(); ++i) {
      const Link& f = robot.links[i];
      Place p;
      p.pose = numbers(c.derived(f.object, keys::pose).get());
      p.twist = numbers(c.derived(f.object, keys::twist).get());
      if (f.joint != JointKind::fixed) connect_joint(c, robot, i, start, p);
      places.push_back(p);
    }
    r.end_follower = std::uint32_t(followers_.size());

    RobotState state;
    state.base_pose = numbers(c.read(robot.base(), keys::pose).get());
    state.base_twist = numbers(c.read(robot.base(), keys::twist).get());
    Model model{kinematics::chain_of(robot.links), {}};
    for (const Place& p : places) {
      if (!state.poses) state.poses = p.pose, state.twists = p.twist;
      if (!state.positions) state.positions = p.position, state.velocities = p.velocity;
      model.spots.push_back({numbers_between(state.poses, p.pose), numbers_between(state.twists, p.twist),
                             p.position ? numbers_between(state.positions, p.position) : 0,
                             p.velocity ? numbers_between(state.velocities, p.velocity) : 0});
    }
    r.model = model_number(std::move(model));
    robots_.push_back(r);
    states_.push_back(state);
  }

  void follow(const Robot& r) const {
    for (std::uint32_t k = r.first_follower; k < r.end_follower; ++k) {
      const Follower& f = followers_[k];
      *f.position = f.offset + f.multiplier * *f.leader_position;
      *f.velocity = f.multiplier * *f.leader_velocity;
    }
  }

  void connect_joint(Connector& c, const RobotView& robot, std::size_t i, const std::vector<double>& start, Place& p) {
    const Link& f = robot.links[i];
    const bool moved = c.is_used(f.joint_object, keys::joint_position, usage::variable);
    if (f.mimic < 0 || moved) {
      p.position = c.input(f.joint_object, keys::joint_position, start[i]).get();
      p.velocity = c.input(f.joint_object, keys::joint_velocity, 0.0).get();
      return;
    }
    const auto leader = std::size_t(f.mimic);
    Follower follower;
    follower.leader_position = c.input(robot.links[leader].joint_object, keys::joint_position, start[leader]);
    follower.leader_velocity = c.input(robot.links[leader].joint_object, keys::joint_velocity, 0.0);
    follower.position = c.derived(f.joint_object, keys::joint_position);
    follower.velocity = c.derived(f.joint_object, keys::joint_velocity);
    follower.multiplier = f.mimic_multiplier;
    follower.offset = f.mimic_offset;
    p.position = follower.position.get();
    p.velocity = follower.velocity.get();
    followers_.push_back(follower);
  }

  std::uint32_t model_number(Model model) {
    const auto known = std::find(models_.rbegin(), models_.rend(), model);  // mostly the last one
    if (known != models_.rend()) return std::uint32_t(models_.rend() - known) - 1;
    models_.push_back(std::move(model));
    return std::uint32_t(models_.size() - 1);
  }

  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Model> models_;
  std::vector<Robot> robots_;
  std::vector<RobotState> states_;  ///< one a robot
  std::vector<Follower> followers_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Direct>(description)};

}  // namespace

MURO_PLUGIN(.name = "kinematics_direct", .version = "1.0.0", .licence = "MIT", .summary = "Direct kinematics of robots",
            .algorithms = algorithms)
