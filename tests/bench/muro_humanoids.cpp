// SPDX-License-Identifier: MIT
#include "tests/bench/muro_humanoids.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace muro::bench {

namespace {

constexpr const char* humanoid_urdf = MURO_TEST_SOURCE_DIR "/examples/models/humanoid.urdf";
constexpr double apart = 0.7;        ///< m, from robot to robot
constexpr double phase_shift = 0.3;  ///< rad, from robot to robot

template <class T>
std::vector<T> constants_of(const RobotTree& tree, std::int32_t component, const Key<T>& key) {
  for (const RobotTree::Constant& c : tree.components()[std::size_t(component)].constants) {
    if (c.key.name != key.name) continue;
    std::vector<T> values(c.data.size() / sizeof(T));
    std::memcpy(static_cast<void*>(values.data()), c.data.data(), c.data.size());
    return values;
  }
  return {};
}

/// Returns the bodies of the model; links on fixed joints are part of one body.
std::vector<HumanoidBody> bodies_of(const RobotTree& tree) {
  std::vector<HumanoidBody> bodies;
  std::vector<std::pair<int, Pose>> places;  // of each link: its body, and its pose in the body's frame
  for (const RobotTree::FlatLink& l : tree.links()) {
    const std::string& name = tree.components()[std::size_t(l.body)].name;
    if (l.link.joint == JointKind::prismatic) throw std::runtime_error("a joint of the humanoid slides");
    if (l.link.parent >= 0 && l.joint < 0) {
      const auto& [body, pose] = places[std::size_t(l.link.parent)];
      places.emplace_back(body, pose * l.link.origin);
    } else {
      places.emplace_back(int(bodies.size()), Pose{});
      HumanoidBody& b = bodies.emplace_back();
      b.name = name;
      if (l.link.parent >= 0) {
        const auto& [parent, pose] = places[std::size_t(l.link.parent)];
        b.parent = parent;
        b.origin = pose * l.link.origin;
        b.joint = tree.components()[std::size_t(l.joint)].name;
        b.axis = l.link.axis;
        b.effort = l.link.limits.effort;
      }
    }
    const auto& [body, pose] = places.back();
    HumanoidBody& b = bodies[std::size_t(body)];
    for (const Inertia& i : constants_of(tree, l.body, keys::inertial)) b.inertia = b.inertia + i.in(pose);
    for (Shape s : constants_of(tree, l.body, keys::collision_shapes)) {
      s.origin = pose * s.origin;
      b.shapes.push_back(s);
    }
  }
  for (const HumanoidBody& b : bodies)
    if (std::abs(b.inertia.ixy) + std::abs(b.inertia.ixz) + std::abs(b.inertia.iyz) > 1e-3 * b.inertia.ixx)
      throw std::runtime_error("the axes of " + b.name + " are not principal");
  return bodies;
}

class MuroHumanoids final : public Humanoids {
 public:
  MuroHumanoids(const HumanoidScene& given, const std::string& motion, unsigned threads) {
    scene_.add_ground(given.friction);
    const RobotTree tree = humanoid_model(scene_);
    for (std::size_t r = 0; r < given.robots(); ++r) {
      const RobotView& robot = scene_.add(std::to_string(r), tree, given.starts[r]);
      for (std::size_t h = 0; h < given.hinges(); ++h)
        scene_.world().set(scene_.world().object(std::to_string(r) + "/" + given.bodies[h + 1].joint),
                           keys::initial_joint_position, given.positions[r][h]);
      bases_.push_back(robot.base());
    }
    std::map<std::string, ParameterInput> parameters = {
        {"joints", "position"}, {"stiffness", Servo::stiffness}, {"damping", Servo::damping}};
    scene_.use(motion, 1000, scene_.all_robots(), parameters);
    scene_.use_contacts();
    scene_.set_threads(threads);
    scene_.build();
    World& world = scene_.world();
    for (std::size_t r = 0; r < given.robots(); ++r) {
      poses_.push_back(&world.value(bases_[r], keys::pose));
      for (std::size_t h = 0; h < given.hinges(); ++h) {
        const ObjectId joint = world.object(std::to_string(r) + "/" + given.bodies[h + 1].joint);
        targets_.push_back(&world.value(joint, keys::joint_position_target));
        positions_.push_back(&world.value(joint, keys::joint_position));
      }
      command(r, given.positions[r]);
    }
  }

  void command(std::size_t robot, std::span<const double> targets) override {
    for (std::size_t h = 0; h < targets.size(); ++h) *targets_[robot * targets.size() + h] = targets[h];
  }
  void run(int milliseconds) override { scene_.run_for(1e-3 * milliseconds); }
  Pose trunk(std::size_t robot) const override { return *poses_[robot]; }
  double position(std::size_t robot, std::size_t hinge) const override {
    return *positions_[robot * (positions_.size() / poses_.size()) + hinge];
  }

 private:
  test::Scene scene_;
  std::vector<ObjectId> bases_;
  std::vector<const Pose*> poses_;
  std::vector<double*> targets_;
  std::vector<const double*> positions_;
};

}  // namespace

RobotTree humanoid_model(test::Scene& scene) {
  RobotTree tree = scene.read_model(humanoid_urdf);
  for (std::size_t i = 0; i < tree.links().size(); ++i) {
    if (tree.links()[i].joint < 0) continue;
    JointLimits limits = tree.links()[i].link.limits;
    limits.damping = limits.friction = 0;
    limits.armature = Servo::armature;
    tree.set_limits(i, limits);
  }
  return tree;
}

Squat::Squat(const std::vector<HumanoidBody>& bodies) {
  const auto body = [&](const char* joint) -> const HumanoidBody& {
    const auto found =
        std::find_if(bodies.begin(), bodies.end(), [&](const HumanoidBody& b) { return b.joint == joint; });
    if (found == bodies.end()) throw std::runtime_error("the humanoid has no joint " + std::string(joint));
    return *found;
  };
  const auto hinge = [&](const char* joint) { return std::size_t(&body(joint) - bodies.data()) - 1; };
  for (const char* joint : {"l_hip_pitch", "r_hip_pitch", "l_ank_pitch", "r_ank_pitch"}) back_.push_back(hinge(joint));
  for (const char* joint : {"l_knee", "r_knee"}) knees_.push_back(hinge(joint));
  arms_ = {{hinge("l_sho_roll"), -1.3}, {hinge("r_sho_roll"), 1.3}};
  leg_ = -body("l_knee").origin.position.z() - body("l_ank_pitch").origin.position.z();
  const HumanoidBody& foot = body("l_ank_roll");
  const Shape& sole = foot.shapes.front();
  upright_ = 0.5 * sole.size.z() - sole.origin.position.z();
  for (const HumanoidBody* b = &foot; b->parent >= 0; b = &bodies[std::size_t(b->parent)])
    upright_ -= b->origin.position.z();
}

double Squat::bend(Exercise exercise, std::size_t robot, int time) {
  if (exercise == Exercise::standing) return 0.4;
  return 0.4 + 0.25 * std::sin(2 * M_PI * 1e-3 * time + phase_shift * double(robot));
}

void Squat::set(double bend, std::span<double> hinges) const {
  std::fill(hinges.begin(), hinges.end(), 0.0);
  for (const std::size_t h : back_) hinges[h] = -bend;
  for (const std::size_t h : knees_) hinges[h] = 2 * bend;
  for (const auto& [h, angle] : arms_) hinges[h] = angle;
}

double Squat::height(double bend) const { return upright_ - leg_ * (1 - std::cos(bend)); }

HumanoidScene humanoid_scene(std::size_t robots, Exercise exercise) {
  test::Scene reading;
  HumanoidScene scene;
  scene.bodies = bodies_of(humanoid_model(reading));
  const Squat squat(scene.bodies);
  const auto side = std::size_t(std::ceil(std::sqrt(double(robots))));
  for (std::size_t r = 0; r < robots; ++r) {
    const double bend = Squat::bend(exercise, r, 0);
    const std::size_t row = r / side, column = r % side;
    scene.starts.push_back({{apart * double(column), apart * double(row), squat.height(bend)}, Quat::Identity()});
    squat.set(bend, scene.positions.emplace_back(scene.hinges()));
  }
  return scene;
}

std::unique_ptr<Humanoids> muro_humanoids(const HumanoidScene& scene, const std::string& motion, unsigned threads) {
  return std::make_unique<MuroHumanoids>(scene, motion, threads);
}

}  // namespace muro::bench
