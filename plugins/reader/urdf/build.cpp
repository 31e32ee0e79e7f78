// SPDX-License-Identifier: MIT
#include "build.hpp"

#include <algorithm>
#include <set>

#include "bodies.hpp"
#include "muro/toolkit/rotations.hpp"
#include "plugins/common/model_file/build_tree.hpp"

namespace muro::urdf {

namespace {

double or_infinite(double limit) {
  if (std::abs(limit) < no_limit) return limit;
  return std::copysign(std::numeric_limits<double>::infinity(), limit);
}

JointLimits limits_of(const ::urdf::Joint& joint, const JointInfo& info) {
  JointLimits limits;
  if (joint.limits) {
    if (joint.type != ::urdf::Joint::CONTINUOUS) {
      limits.lower = or_infinite(joint.limits->lower);
      limits.upper = or_infinite(joint.limits->upper);
    }
    limits.velocity = or_infinite(joint.limits->velocity);
    limits.effort = or_infinite(joint.limits->effort);
  }
  if (joint.dynamics) {
    limits.damping = joint.dynamics->damping;
    limits.friction = joint.dynamics->friction;
  }
  limits.armature = info.armature.value_or(0);
  return limits;
}

class TreeBuilder {
 public:
  TreeBuilder(const ::urdf::ModelInterface& model, const ModelInfo& info, const Places& places, RobotBuilder& builder,
              Problems& problems)
      : model_(model), info_(info), builder_(builder), problems_(problems), bodies_(places, builder, problems) {
    for (const auto& [name, link] : info.links) used_.insert(name);
    name_joints();
  }

  void run() {
    builder_.base(info_.root);
    sdf_devices::give(info_.subsystems, builder_);
    fill(info_.root);
    model_file::build_tree(builder_, info_.links.at(info_.root).child_joints, [this](const std::string& joint) {
      add_joint(joint);
      return info_.links.at(info_.joints.at(joint).child).child_joints;
    });
    bodies_.report_missing_meshes();
    if (bodies_.mass() == 0)
      problems_.warning(info_.links.at(info_.root).location,
                        "no link has a mass; only motion without forces can move the robot");
    else
      report_massless();
  }

 private:
  /// Returns `name`, followed by `suffix` as often as needed to be unique.
  std::string unique(std::string name, std::string_view suffix) {
    while (!used_.insert(name).second) name += suffix;
    return name;
  }

  void name_joints() {
    for (const std::string& name : info_.joint_order)
      if (!info_.links.count(name)) used_.insert(name);
    for (const std::string& name : info_.joint_order) {
      const JointInfo& joint = info_.joints.at(name);
      if (!joint.moves) continue;
      std::string& part = part_names_[name];
      part = name;
      if (!info_.links.count(name)) continue;
      part = unique(name, "_joint");
      problems_.note(joint.location,
                     concat("joint ", quote(name), " has the name of a link; it is called ", quote(part)));
    }
  }

  void fill(const std::string& link) { bodies_.fill(*model_.getLink(link), info_.links.at(link)); }

  void add_transform(const Pose& pose) {
    if (!pose.position.isZero(0)) builder_.translation(pose.position);
    if (!pose.orientation.vec().isZero(0)) builder_.rotation(pose.orientation);
  }

  void add_joint(const std::string& name) {
    const auto joint = model_.getJoint(name);
    const JointInfo& info = info_.joints.at(name);
    add_transform(pose_of(joint->parent_to_joint_origin_transform, info.rotation));
    const Vec3 axis(joint->axis.x, joint->axis.y, joint->axis.z);
    switch (joint->type) {
      case ::urdf::Joint::REVOLUTE:
      case ::urdf::Joint::CONTINUOUS:
        builder_.revolute(part_names_.at(name), axis.normalized(), limits_of(*joint, info));
        break;
      case ::urdf::Joint::PRISMATIC:
        builder_.prismatic(part_names_.at(name), axis.normalized(), limits_of(*joint, info));
        break;
      case ::urdf::Joint::PLANAR:
        add_planar(name, info, axis.normalized());
        break;
      case ::urdf::Joint::FLOATING:
        report_floating(name, info);
        break;
      case ::urdf::Joint::FIXED:
        report_fixed_base(name, info);
        break;
      default:
        break;
    }
    if (joint->mimic)
      follow(*joint);
    else if (info.moves && info.spring)
      info.spring->add_to(builder_);
    if (joint->mimic && info.spring)
      problems_.warning(info.location,
                        concat("joint ", quote(name), ": its spring is left out, as it follows a joint"));
    if (info.moves && info_.links.at(info.child).child_joints.empty() && !model_.getLink(info.child)->inertial)
      massless_.push_back(info.child);
    builder_.body(info.child);
    fill(info.child);
  }

  void report_massless() {
    if (massless_.empty()) return;
    const bool several = massless_.size() > 1;
    problems_.warning(info_.links.at(massless_.front()).location,
                      concat(several ? "links " : "link ", quoted_list(massless_),
                             several ? " hang on moving joints but have" : " hangs on a moving joint but has",
                             " no mass; a motion by forces needs an <inertial> there"));
  }

  /// Sets the leader of a mimic joint. A mimic of a mimic gets the first leader, as the host has only one level.
  void follow(const ::urdf::Joint& joint) {
    double multiplier = joint.mimic->multiplier, offset = joint.mimic->offset;
    auto leader = model_.getJoint(joint.mimic->joint_name);
    while (leader->mimic) {
      offset += multiplier * leader->mimic->offset;
      multiplier *= leader->mimic->multiplier;
      leader = model_.getJoint(leader->mimic->joint_name);
    }
    builder_.mimic(part_names_.at(leader->name), multiplier, offset);
  }

  bool hangs_on_bare_root(const JointInfo& joint) const {
    return joint.parent == info_.root && info_.links.at(info_.root).bare;
  }

  void report_free_base(const std::string& name, const JointInfo& joint) {
    problems_.note(joint.location,
                   concat("joint ", quote(name), " is ", joint.type, " and joins the robot to the empty root ",
                          quote(joint.parent), "; it is fixed, as the base of a robot moves anyway"));
  }

  /// In Gazebo a root named `world` is the world, and the links fixed to it do not move. Reports that muro differs.
  void report_fixed_base(const std::string& name, const JointInfo& joint) {
    if (joint.parent != "world" || !hangs_on_bare_root(joint)) return;
    problems_.note(joint.location,
                   concat("joint ", quote(name), " fixes the robot to the empty root ", quote(joint.parent),
                          ", which is its base and can move; a motion by forces holds it with `base: fixed`"));
  }

  /// Adds two prismatic joints in the plane and a revolute one about its normal, with massless bodies between them.
  void add_planar(const std::string& name, const JointInfo& joint, const Vec3& normal) {
    if (hangs_on_bare_root(joint)) return report_free_base(name, joint);
    const Quat turn = turn_between(Vec3::UnitZ(), normal);
    const std::string x = unique(name + "_x", "_joint"), y = unique(name + "_y", "_joint");
    const std::string yaw = unique(name + "_yaw", "_joint");
    problems_.warning(joint.location,
                      concat("joint ", quote(name), " is planar; it is made of the prismatic joints ", quote(x),
                             " and ", quote(y), " and the revolute joint ", quote(yaw), ", without limits"));
    builder_.prismatic(x, turn * Vec3::UnitX(), {});
    builder_.body(unique(name + "_x_body", "_body"));
    builder_.prismatic(y, turn * Vec3::UnitY(), {});
    builder_.body(unique(name + "_y_body", "_body"));
    builder_.revolute(yaw, normal, {});
  }

  void report_floating(const std::string& name, const JointInfo& joint) {
    if (hangs_on_bare_root(joint)) return report_free_base(name, joint);
    problems_.warning(joint.location,
                      concat("joint ", quote(name), " is floating and taken as fixed; link ", quote(joint.child),
                             " and what hangs on it move freely only as a robot of their own"));
  }

  const ::urdf::ModelInterface& model_;
  const ModelInfo& info_;
  RobotBuilder& builder_;
  Problems& problems_;
  Bodies bodies_;
  std::set<std::string> used_;
  std::vector<std::string> massless_;              ///< links without mass at the ends of branches that move
  std::map<std::string, std::string> part_names_;  ///< the robot's names of joints that move
};

}  // namespace

void build(const ::urdf::ModelInterface& model, const ModelInfo& info, const Places& places, RobotBuilder& builder,
           Problems& problems) {
  TreeBuilder(model, info, places, builder, problems).run();
}

}  // namespace muro::urdf
