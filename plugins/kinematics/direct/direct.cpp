// SPDX-License-Identifier: MIT
// Poses and twists of all bodies of a robot from its base and its joints.
#include "chain.hpp"
#include "muro/composite.hpp"
#include "muro/plugin.hpp"

namespace {

using namespace muro;
using namespace muro::kinematics;

constexpr Use reads[] = {
    {"pose", "of the base"},
    {"twist", "of the base"},
    {"joint.position", "of every joint; where nothing moves it, its initial position"},
    {"joint.velocity", "of every joint; where nothing moves it, 0"},
    {"joint.position.initial", "of every joint, optional"},
};
constexpr Use writes[] = {
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
    .promises = deterministic | batched | allocation_free | restorable,
};

static_assert(sizeof(Pose) == 7 * sizeof(double) && sizeof(Twist) == 6 * sizeof(double), "kernels see numbers");

class Direct final : public Algorithm {
 public:
  void connect(Connector& c) override {
    for (const Item& item : c.items()) {
      if (!item.robot) throw Error("it places the bodies of robots, but no robot is named");
      connect_robot(c, *item.robot);
    }
  }

  void start() override {
    bodies_.clear();
    for (const Robot& r : robots_)
      bodies_.push_back({numbers(r.pose), numbers(r.twist), places_.data() + r.first_place});
  }

  std::span<const Phase> phases() const override {
    static constexpr Phase phases[] = {{Phase::Over::items, Phase::Reach::own}};
    return phases;
  }

  /// Neighbours of one chain go eight at a time.
  void step(const Step&, Range range) override {
    for (std::uint32_t i = range.begin, end = i; i < range.end; i = end) {
      const Robot& first = robots_[i];
      for (; end < range.end && end < i + lane_width && robots_[end].chain == first.chain; ++end) follow(robots_[end]);
      const std::vector<Link>& links = chains_[first.chain].links;
      const auto count = std::uint32_t(links.size());
      if (end - i == lane_width)
        kernels_->place_eight(links.data(), count, &bodies_[i]);
      else
        for (std::uint32_t k = i; k < end; ++k) kernels_->place_one(links.data(), count, &bodies_[k]);
    }
  }

 private:
  static constexpr std::uint32_t lane_width = 8;

  struct Robot {
    In<Pose> pose;
    In<Twist> twist;
    std::uint32_t chain = 0;                             ///< in chains_
    std::uint32_t first_place = 0;                       ///< in places_: one a frame but the base
    std::uint32_t first_follower = 0, end_follower = 0;  ///< in followers_
  };
  /// A mimic joint that nothing else moves.
  struct Follower {
    In<double> leader_position, leader_velocity;
    Out<double> position, velocity;
    double multiplier = 1, offset = 0;
  };

  void connect_robot(Connector& c, const RobotView& robot) {
    Robot r;
    r.pose = c.read(robot.base(), keys::pose);
    r.twist = c.read(robot.base(), keys::twist);
    r.chain = chain_number(kinematics::chain_of(robot.frames));
    r.first_place = std::uint32_t(places_.size());
    r.first_follower = std::uint32_t(followers_.size());
    const std::vector<double> start = initial_joint_positions(c, robot);
    for (std::size_t i = 1; i < robot.frames.size(); ++i) {
      const Frame& f = robot.frames[i];
      Place p;
      p.pose = c.derived(f.object, keys::pose)->position.data();
      p.twist = c.derived(f.object, keys::twist)->linear.data();
      if (f.joint != JointKind::fixed) connect_joint(c, robot, i, start, p);
      places_.push_back(p);
    }
    r.end_follower = std::uint32_t(followers_.size());
    robots_.push_back(r);
  }

  static const double* numbers(const In<Pose>& pose) { return pose->position.data(); }
  static const double* numbers(const In<Twist>& twist) { return twist->linear.data(); }

  void follow(const Robot& r) const {
    for (std::uint32_t k = r.first_follower; k < r.end_follower; ++k) {
      const Follower& f = followers_[k];
      *f.position = f.offset + f.multiplier * *f.leader_position;
      *f.velocity = f.multiplier * *f.leader_velocity;
    }
  }

  void connect_joint(Connector& c, const RobotView& robot, std::size_t i, const std::vector<double>& start, Place& p) {
    const Frame& f = robot.frames[i];
    const bool moved = c.is_used(f.joint_object, keys::joint_position, Access::variable);
    if (f.mimic < 0 || moved) {
      p.position = c.input(f.joint_object, keys::joint_position, start[i]).get();
      p.velocity = c.input(f.joint_object, keys::joint_velocity, 0.0).get();
      return;
    }
    const auto leader = std::size_t(f.mimic);
    Follower follower;
    follower.leader_position = c.input(robot.frames[leader].joint_object, keys::joint_position, start[leader]);
    follower.leader_velocity = c.input(robot.frames[leader].joint_object, keys::joint_velocity, 0.0);
    follower.position = c.derived(f.joint_object, keys::joint_position);
    follower.velocity = c.derived(f.joint_object, keys::joint_velocity);
    follower.multiplier = f.mimic_multiplier;
    follower.offset = f.mimic_offset;
    p.position = follower.position.get();
    p.velocity = follower.velocity.get();
    followers_.push_back(follower);
  }

  std::uint32_t chain_number(Chain chain) {
    const auto known = std::find(chains_.begin(), chains_.end(), chain);
    if (known != chains_.end()) return std::uint32_t(known - chains_.begin());
    chains_.push_back(std::move(chain));
    return std::uint32_t(chains_.size() - 1);
  }

  const Kernels* kernels_ = &kernels_for(lane::best_isa());
  std::vector<Chain> chains_;
  std::vector<Robot> robots_;
  std::vector<Body> bodies_;  ///< one a robot
  std::vector<Place> places_;
  std::vector<Follower> followers_;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Direct>(description)};

}  // namespace

MURO_PLUGIN(.name = "kinematics_direct", .version = "1.0.0", .licence = "MIT", .summary = "Direct kinematics of robots",
            .algorithms = algorithms)
