// SPDX-License-Identifier: MIT
// Computes the poses and twists of all bodies of a robot from its base and its joints.
#include "kinematic_tree.hpp"
#include "muro/plugin.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/toolkit/mass_properties.hpp"
#include "muro/toolkit/per_robot.hpp"

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

/// A mimic joint that no other algorithm moves.
struct MimicJoint {
  In<double> leader_position, leader_velocity;
  Out<double> position, velocity;
  double multiplier = 1, offset = 0;
};

/// Data of one robot.
struct DirectRobot {
  std::uint32_t model = 0;  ///< index in Direct::models_
  Range mimics;
};

class Direct final : public PerRobotAlgorithm<DirectRobot> {
 public:
  /// Serves neighbouring robots of one model eight at a time.
  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      const std::uint32_t model = robot(i).model;
      for (; end < range.end && end < i + lane_width && robot(end).model == model; ++end) follow(robot(end));
      const Model& m = models_[model];
      kernels_->forward_kinematics(m.tree.links.data(), m.offsets.data(), int(m.offsets.size()), &states_[i],
                                   int(end - i));
    }
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  /// The common structure of robots that also have the same layout of their state in memory.
  struct Model {
    KinematicTree tree;
    std::vector<StateOffsets> offsets;  ///< one for each link
    bool operator==(const Model&) const = default;
  };
  /// Addresses of the state of one link; null if there is no joint.
  struct LinkState {
    double* pose = nullptr;
    double* twist = nullptr;
    const double* position = nullptr;
    const double* velocity = nullptr;
  };

  DirectRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& robot = *item.robot;
    DirectRobot r;
    const std::vector<double> start = initial_joint_positions(c, robot);
    std::vector<LinkState> links;
    std::vector<MimicJoint> mimics;
    for (std::size_t i = 1; i < robot.links.size(); ++i) {
      const Link& link = robot.links[i];
      LinkState s;
      s.pose = numbers(c.derived(link.object, keys::pose).get());
      s.twist = numbers(c.derived(link.object, keys::twist).get());
      if (link.joint != JointKind::fixed) connect_joint(c, robot, i, start, mimics, s);
      links.push_back(s);
    }

    RobotState state;
    state.base_pose = numbers(c.read(robot.base(), keys::pose).get());
    state.base_twist = numbers(c.read(robot.base(), keys::twist).get());
    Model model{kinematic_tree(robot.links), {}};
    for (const LinkState& s : links) {
      if (!state.poses) state.poses = s.pose, state.twists = s.twist;
      if (!state.positions) state.positions = s.position, state.velocities = s.velocity;
      model.offsets.push_back({numbers_between(state.poses, s.pose), numbers_between(state.twists, s.twist),
                               s.position ? numbers_between(state.positions, s.position) : 0,
                               s.velocity ? numbers_between(state.velocities, s.velocity) : 0});
    }
    r.model = model_index(std::move(model));
    r.mimics = mimics_.add(mimics);
    states_.push_back(state);
    return r;
  }

  /// Binds the joint that leads to link `i`.
  static void connect_joint(Connector& c, const RobotView& robot, std::size_t i, const std::vector<double>& start,
                            std::vector<MimicJoint>& mimics, LinkState& s) {
    const Link& link = robot.links[i];
    const bool is_moved = c.is_used(link.joint_object, keys::joint_position, usage::variable);
    if (link.mimic < 0 || is_moved) {
      s.position = c.input(link.joint_object, keys::joint_position, start[i]).get();
      s.velocity = c.input(link.joint_object, keys::joint_velocity, 0.0).get();
      return;
    }
    const auto leader = std::size_t(link.mimic);
    MimicJoint mimic;
    mimic.leader_position = c.input(robot.links[leader].joint_object, keys::joint_position, start[leader]);
    mimic.leader_velocity = c.input(robot.links[leader].joint_object, keys::joint_velocity, 0.0);
    mimic.position = c.derived(link.joint_object, keys::joint_position);
    mimic.velocity = c.derived(link.joint_object, keys::joint_velocity);
    mimic.multiplier = link.mimic_multiplier;
    mimic.offset = link.mimic_offset;
    s.position = mimic.position.get();
    s.velocity = mimic.velocity.get();
    mimics.push_back(mimic);
  }

  void follow(const DirectRobot& r) const {
    for (const MimicJoint& m : mimics_[r.mimics]) {
      *m.position = m.offset + m.multiplier * *m.leader_position;
      *m.velocity = m.multiplier * *m.leader_velocity;
    }
  }

  std::uint32_t model_index(Model model) {
    const auto known = std::find(models_.rbegin(), models_.rend(), model);  // usually the last one
    if (known != models_.rend()) return std::uint32_t(models_.rend() - known) - 1;
    models_.push_back(std::move(model));
    return std::uint32_t(models_.size() - 1);
  }

  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Model> models_;
  std::vector<RobotState> states_;  ///< one for each robot
  PackedLists<MimicJoint> mimics_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Direct>(description)};

}  // namespace

MURO_PLUGIN(.name = "kinematics_direct", .version = description.version, .licence = "MIT",
            .summary = "Direct kinematics of robots", .algorithms = algorithms)
