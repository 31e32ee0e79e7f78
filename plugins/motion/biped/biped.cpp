// SPDX-License-Identifier: MIT
// The kinematic biped (MuRoSimF, Section 3.1): a foot is held to the ground, and the joints move the robot about it.
#include <cstring>
#include <string>

#include "below_plane.hpp"
#include "keys.hpp"
#include "link_stop.hpp"
#include "muro/plugin.hpp"
#include "muro/toolkit/per_robot.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/motion/common/kinematic_joints/kinematic_joints.hpp"
#include "plugins/motion/common/motion/description.hpp"
#include "plugins/motion/common/motion/motion.hpp"
#include "stance.hpp"

namespace {

using namespace muro;
using namespace muro::biped;

constexpr std::string_view joint_modes[] = {"velocity", "position"};
constexpr Parameter parameters[] = {
    texts("feet",
          "links of the two feet, as [left_foot, right_foot]; when both touch at the start, the first one stands")
        .required(),
    text("plane", "", "object of the scenery on whose plane it walks; default: the only one that looks up"),
    reals("sole_normal", "1", {},
          "out of the soles, in the frames of both feet; default: downwards with all joints at 0. The sole is the side "
          "of the foot's collision shapes that lies that way"),
    real(
        "hysteresis", "m", 1e-10,
        "a foot that is less than this below the plane does not become the stance foot, so that two feet at one height "
        "do not take turns")
        .between(0, 1e-3),
    real("contact_height", "m", 1e-6, "`foot.contact` is 1 while the sole is not higher than this above the plane")
        .between(0, 1),
    text("joints", "position", "which target the joints follow").one_of(joint_modes),
    real("interpolate", "s", 0,
         "targets of position move evenly to a new value in this time: the period of the controller; 0: at once")
        .between(0, 1e3),
    on_contact,
};
constexpr PropertyUse reads[] = {{"pose.initial", "of the base; it is put on its feet from there"},
                                 {"collision.shapes", "of the feet, for their soles; of the scenery, for the plane"},
                                 {"joint.position.initial", "of every joint"},
                                 {"joint.position.target", "of every joint that follows no other", "joints=position"},
                                 {"joint.velocity.target", "of every joint that follows no other", "joints=velocity"},
                                 on_contact_reads};
constexpr PropertyUse own_writes[] = {{"foot.contact", "of the links of the feet"},
                                      {"stance.foot", "on the base"},
                                      {"stance.pose", "on the base"},
                                      {"stance.is_flush", "on the base"},
                                      {"stance.footholds", "on the base"},
                                      {"stance.base_pose", "on the base"}};
constexpr auto writes = joined(motion_writes, own_writes);
constexpr Description description{
    .id = "motion.biped",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary = "Walks on a plane by direct kinematics from the stance foot, which changes when the other one touches",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_joints | feature_velocity_targets | feature_position_targets | feature_joint_limits |
                feature_joint_speed_limits | feature_mimic_joints,
};

/// Properties of a joint of a leg.
struct JointPlace {
  Out<double> position, velocity;
};

/// Properties and parts of a robot.
struct BipedRobot {
  Out<Pose> pose;
  Out<Twist> twist, acceleration;  ///< acceleration: used if somebody reads it
  Out<Pose> stance_pose, base_pose;
  Out<std::uint32_t> stance_foot, is_flush;
  Out<std::uint64_t> footholds;
  std::array<Out<std::uint32_t>, 2> contact;
  std::uint32_t model = 0;  ///< index in Biped::models_
  Range legs;               ///< joints of both legs
  KinematicJoints joints;
  LinkStop stop;
  LinksBelowPlane others;
};

bool is_same(const Pose& a, const Pose& b) {
  return std::memcmp(a.position.data(), b.position.data(), sizeof(double) * 3) == 0 &&
         std::memcmp(a.orientation.coeffs().data(), b.orientation.coeffs().data(), sizeof(double) * 4) == 0;
}

class Biped final : public Motion<PerRobotAlgorithm<BipedRobot>> {
 public:
  /// Puts the robot on its feet after another motion has left it anywhere.
  void on_handover(std::uint32_t item) override {
    const BipedRobot& r = robot(item);
    r.joints.take_over();
    stand_up(r);
    const FootMotion motion = motion_of(r, *r.stance_foot);
    *r.twist = {r.pose->orientation * motion.linear, r.pose->orientation * motion.angular};
  }

 private:
  void bind_by_name(Connector& c) override {
    for (std::uint32_t i = 0; i < c.items().size(); ++i) {
      const ObjectId base = c.items()[i].robot->base();
      if (c.is_used(base, keys::acceleration, usage::read) || c.is_used(base, keys::acceleration, usage::input))
        robot(i).acceleration = c.write(base, keys::acceleration);
    }
  }

  void move(const Step& step, Range range) override {
    for (BipedRobot& r : robots(range)) walk(r, step.dt);
  }

  void refine_accelerations(const Step& step, Range range) override {
    for (const BipedRobot& r : robots(range))
      if (r.acceleration) *r.acceleration = acceleration_of(r, step.dt);
  }

  void read_parameters(const Parameters& p) override {
    hysteresis_ = p.real("hysteresis");
    contact_height_ = p.real("contact_height");
    interpolation_ = p.real("interpolate");
  }

  BipedRobot connect_robot(Connector& c, const Item& item) override {
    const RobotView& view = *item.robot;
    if (models_.empty()) plane_ = find_ground_plane(c, c.parameters().text("plane"));
    FeetOfRobot found = find_feet(c, view);
    BipedRobot r;
    r.model = model_index(std::move(found.feet));
    const std::vector modes(view.links.size(), drive_mode_of(c.parameters().text("joints")));
    r.joints = KinematicJoints(c, view, modes);
    r.joints.interpolate(c, view.base(), interpolation_);
    r.legs = connect_joints(c, view, found.joints);
    r.stop = LinkStop(c, view, plane_.shape);
    r.others = LinksBelowPlane(c, view, found.is_of_foot);
    host_ = &c.host();

    const std::vector<double> start = initial_joint_positions(c, view);
    const Feet& feet = models_[r.model];
    const auto position = [&](std::uint32_t i) { return start[found.joints[i]]; };
    const FootPoses at{{feet.legs[0].foot(position), feet.legs[1].foot(position)}};
    const Pose initial = c.constant(view.base(), keys::initial_pose).value_or(Pose{});
    Stance stance = Footing(feet, plane_, hysteresis_).stand_up(initial, at, Stance{});
    const Pose base = base_at(stance, at.foot[stance.foot]);
    r.pose = c.variable(view.base(), keys::pose, base);
    r.twist = c.variable(view.base(), keys::twist, Twist{});
    r.stance_foot = c.variable(view.base(), own::stance_foot, stance.foot);
    r.stance_pose = c.variable(view.base(), own::stance_pose, stance.pose);
    r.is_flush = c.variable(view.base(), own::stance_is_flush, std::uint32_t(stance.is_flush));
    r.footholds = c.variable(view.base(), own::stance_footholds, stance.footholds);
    r.base_pose = c.variable(view.base(), own::stance_base_pose, base);
    for (std::uint32_t i = 0; i < 2; ++i) {
      const bool touches = i == stance.foot || swing_height(feet, stance, at) <= contact_height_;
      r.contact[i] = c.variable(view.links[found.links[i]].object, keys::foot_contact, std::uint32_t(touches));
    }
    return r;
  }

  Range connect_joints(Connector& c, const RobotView& view, const std::vector<std::uint32_t>& links) {
    std::vector<JointPlace> places;
    for (const std::uint32_t i : links) {
      const ObjectId joint = view.links[i].joint_object;
      places.push_back({c.write(joint, keys::joint_position), c.write(joint, keys::joint_velocity)});
    }
    from_.resize(from_.size() + places.size());
    to_.resize(from_.size());
    rates_.resize(from_.size());
    return joints_.add(places);
  }

  std::uint32_t model_index(Feet feet) {
    const auto known = std::find(models_.rbegin(), models_.rend(), feet);  // mostly it is the last one
    if (known != models_.rend()) return std::uint32_t(models_.rend() - known) - 1;
    models_.push_back(std::move(feet));
    return std::uint32_t(models_.size() - 1);
  }

  std::span<double> of(std::vector<double>& numbers, Range joints) const {
    return {numbers.data() + joints.begin, joints.end - joints.begin};
  }
  void take_positions(Range joints, std::vector<double>& numbers) const {
    const std::span<const JointPlace> places = joints_[joints];
    double* const to = numbers.data() + joints.begin;
    for (std::size_t i = 0; i < places.size(); ++i) to[i] = *places[i].position;
  }

  Stance stance_of(const BipedRobot& r) const {
    return {*r.stance_foot, *r.is_flush != 0, *r.stance_pose, *r.footholds};
  }
  void keep(const BipedRobot& r, const Stance& s) const {
    if (s.footholds == *r.footholds) return;
    *r.stance_foot = s.foot;
    *r.is_flush = s.is_flush ? 1 : 0;
    *r.stance_pose = s.pose;
    *r.footholds = s.footholds;
  }

  /// Returns the height of the sole of the swing foot (m).
  double swing_height(const Feet& feet, const Stance& s, const FootPoses& at) const {
    return Footing(feet, plane_, hysteresis_).height(1 - s.foot, s.pose * at.other(s.foot));
  }

  /// Returns the pose of the base when the stance foot, at `foot` in the frame of the base, is at its stance pose.
  static Pose base_at(const Stance& s, const Pose& foot) {
    Pose base = s.pose * foot.inverse();
    base.orientation.normalize();
    return base;
  }

  FootMotion motion_of(const BipedRobot& r, std::uint32_t foot) const {
    const std::span<const JointPlace> joints = joints_[r.legs];
    return models_[r.model].legs[foot].motion([&](std::uint32_t i) { return *joints[i].position; },
                                              [&](std::uint32_t i) { return *joints[i].velocity; });
  }
  FootPoses feet_of(const BipedRobot& r, std::uint32_t stance, const FootMotion& motion) const {
    const std::span<const JointPlace> joints = joints_[r.legs];
    FootPoses feet;
    feet.foot[stance] = motion.foot;
    feet.foot[1 - stance] =
        models_[r.model].legs[1 - stance].foot([&](std::uint32_t i) { return *joints[i].position; });
    return feet;
  }

  /// Puts the robot on its feet near the pose of its base, and keeps its joints as they are.
  void stand_up(const BipedRobot& r) const {
    Stance stance = stance_of(r);
    const FootPoses feet = feet_of(r, stance.foot, motion_of(r, stance.foot));
    stance = Footing(models_[r.model], plane_, hysteresis_).stand_up(*r.pose, feet, stance);
    keep(r, stance);
    *r.pose = *r.base_pose = base_at(stance, feet.foot[stance.foot]);
    *r.contact[stance.foot] = 1;
    *r.contact[1 - stance.foot] = swing_height(models_[r.model], stance, feet) <= contact_height_ ? 1 : 0;
  }

  void walk(BipedRobot& r, double dt) {
    if (!is_same(*r.pose, *r.base_pose)) stand_up(r);
    take_positions(r.legs, from_);
    if (r.acceleration) {
      const std::span<const JointPlace> joints = joints_[r.legs];
      for (std::size_t i = 0; i < joints.size(); ++i) rates_[r.legs.begin + i] = *joints[i].velocity;
    }
    if (r.stop) r.stop.begin_step();
    r.joints.move(dt);
    take_positions(r.legs, to_);

    Stance stance = stance_of(r);
    const std::uint32_t before = stance.foot;
    FootMotion motion = motion_of(r, before);
    const FootPoses end = feet_of(r, before, motion);
    const Footing footing(models_[r.model], plane_, hysteresis_);
    const double swing_height = footing.walk({of(from_, r.legs), of(to_, r.legs)}, end, stance);
    if (stance.foot != before) motion = motion_of(r, stance.foot);
    const Pose base = base_at(stance, motion.foot);
    const Twist twist{base.orientation * motion.linear, base.orientation * motion.angular};
    if (r.stop && r.stop.blocks(base, twist)) {
      r.stop.take_back();
      *r.twist = {};
      return;
    }
    if (stance.footholds != *r.footholds) r.others.tell(*host_, plane_, base, is_told_);
    keep(r, stance);
    *r.pose = *r.base_pose = base;
    *r.twist = twist;
    *r.contact[stance.foot] = 1;
    *r.contact[1 - stance.foot] = swing_height <= contact_height_ ? 1 : 0;
  }

  /// Returns the derivative of the twist while the foot stands, by the accelerations of the joints. It does not contain
  /// a change of the stance foot.
  [[gnu::flatten]] Twist acceleration_of(const BipedRobot& r, double dt) const {
    const std::span<const JointPlace> joints = joints_[r.legs];
    const double* const before = rates_.data() + r.legs.begin;
    const auto foot = models_[r.model].legs[*r.stance_foot].relative(
        [&](std::uint32_t i) { return *joints[i].position; }, [&](std::uint32_t i) { return *joints[i].velocity; },
        [&](std::uint32_t i) { return (*joints[i].velocity - before[i]) / dt; });
    const Quat& axes = r.pose->orientation;
    const Vec3 arm = axes * foot.pose.position, speed = axes * foot.twist.linear, &turn = r.twist->angular;
    const Vec3 angular = -(axes * foot.acceleration.angular);
    return {
        -(angular.cross(arm) + turn.cross(turn.cross(arm)) + 2 * turn.cross(speed) + axes * foot.acceleration.linear),
        angular};
  }

  Host* host_ = nullptr;
  std::atomic<bool> is_told_ = false;  ///< a link other than a foot below the plane was reported
  GroundPlane plane_;
  std::vector<Feet> models_;
  PackedLists<JointPlace> joints_;
  std::vector<double> from_, to_, rates_;  ///< of these joints in a step: positions at its begin and end; velocities
  double hysteresis_ = 0, contact_height_ = 0, interpolation_ = 0;
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<Biped>(description)};

}  // namespace

MURO_PLUGIN(.name = "motion_biped", .version = description.version, .licence = "MIT", .summary = "The kinematic biped",
            .algorithms = algorithms)
