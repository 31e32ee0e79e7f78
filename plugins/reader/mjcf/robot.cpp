// SPDX-License-Identifier: MIT
#include "robot.hpp"

#include <algorithm>
#include <cmath>

#include "muro/toolkit/pair_surface.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"
#include "plugins/common/model_file/build_tree.hpp"
#include "plugins/common/parser_process/builder_calls/model_constants.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::mjcf {

namespace {

constexpr double no_length = 1e-12;  // m

/// MuJoCo's cameras look along -z with y up, muro's sensors look along x with z up (REP-103).
const Quat camera_turn(Mat3((Mat3() << 0, -1, 0, 0, 0, 1, -1, 0, 0).finished()));

class RobotMaker {
 public:
  RobotMaker(const RobotSource& from, Shapes& shapes, RobotBuilder& builder, Problems& problems)
      : m_(from.model), from_(from), shapes_(shapes), builder_(builder), problems_(problems) {}

  void run(int top) {
    const bool held_by_joints = m_.body_jntnum[top] > 0 && !is_free(m_, top);
    builder_.base(names_.unique(held_by_joints ? "world" : body_name(m_, top)));
    builder_.set(model_constants::mjcf_file, builder_.intern(from_.source.path()));
    builder_.set(model_constants::mjcf_in_world, std::uint32_t(from_.in_world));
    std::vector<Child> children = {{Child::body, top}};
    if (!held_by_joints) {
      fill(top);
      children = children_of(top);
    }
    if (!is_free(m_, top))
      problems_.note(from_.source.location_of("body", name_of(m_, m_.name_bodyadr, top)),
                     concat("body ", quote(body_name(m_, top)), " is ", held_by_joints ? "held by joints" : "fixed",
                            " in the world; to have that, set `base: fixed` in the motion"));
    model_file::build_tree(builder_, children, [this](const Child& child) { return add(child); });
    tell_springs();
  }

 private:
  struct Child {
    enum Kind { body, site, camera } kind;
    int number;
  };

  std::vector<Child> children_of(int body) const {
    std::vector<Child> children;
    for (int b = body + 1; b < m_.nbody; ++b)
      if (m_.body_parentid[b] == body) children.push_back({Child::body, b});
    for (int s = 0; s < m_.nsite; ++s)
      if (m_.site_bodyid[s] == body && !name_of(m_, m_.name_siteadr, s).empty()) children.push_back({Child::site, s});
    for (int c = 0; c < m_.ncam; ++c)
      if (m_.cam_bodyid[c] == body && !name_of(m_, m_.name_camadr, c).empty() && m_.cam_mode[c] == mjCAMLIGHT_FIXED)
        children.push_back({Child::camera, c});
    return children;
  }

  std::vector<Child> add(const Child& child) {
    const int i = child.number;
    switch (child.kind) {
      case Child::site:
        add_transform(pose_of(m_.site_pos + 3 * i, m_.site_quat + 4 * i));
        builder_.body(names_.unique(name_of(m_, m_.name_siteadr, i), "_site"));
        return {};
      case Child::camera: {
        Pose pose = pose_of(m_.cam_pos + 3 * i, m_.cam_quat + 4 * i);
        pose.orientation = pose.orientation * camera_turn;
        add_transform(pose);
        builder_.body(names_.unique(name_of(m_, m_.name_camadr, i), "_camera"));
        return {};
      }
      default:
        add_body(i);
        return children_of(i);
    }
  }

  void add_transform(const Pose& pose) {
    if (pose.position.norm() > no_length) builder_.translation(pose.position);
    if (pose.orientation.vec().norm() > 1e-15) builder_.rotation(pose.orientation);
  }

  /// Adds a body with its joints. They act one after the other, each about an axis through its own anchor.
  void add_body(int body) {
    const std::string name = names_.unique(body_name(m_, body), "_body");
    Pose pending = pose_of(m_.body_pos + 3 * body, m_.body_quat + 4 * body);
    const int first = m_.body_jntadr[body], count = m_.body_jntnum[body];
    for (int j = first; j < first + count; ++j) {
      const bool last = j + 1 == first + count;
      const Vec3 axis = vector_of(m_.jnt_axis + 3 * j);
      if (m_.jnt_type[j] == mjJNT_BALL) refuse_ball(j);
      const double reference = m_.jnt_type[j] == mjJNT_BALL ? 0 : m_.qpos0[m_.jnt_qposadr[j]];
      Vec3 anchor = Vec3::Zero();
      if (m_.jnt_type[j] == mjJNT_HINGE) {
        anchor = vector_of(m_.jnt_pos + 3 * j);
        if (anchor.cross(axis).norm() <= no_length) anchor.setZero();  // the body's origin does not move
        pending = pending * Pose{anchor, Quat(Eigen::AngleAxisd(-reference, axis))};
      } else if (m_.jnt_type[j] == mjJNT_SLIDE) {
        pending = pending * Pose{-reference * axis, Quat::Identity()};
      }
      add_transform(pending);
      add_joint(j, axis, reference);
      pending = Pose{-anchor, Quat::Identity()};
      if (!last) builder_.body(names_.unique(joint_name(m_, j) + "_body", "_body"));
      if (last && !anchor.isZero(0)) builder_.body(names_.unique(name + "_frame", "_body"));
    }
    add_transform(pending);
    builder_.body(name);
    fill(body);
  }

  void add_joint(int joint, const Vec3& axis, double reference) {
    const int dof = m_.jnt_dofadr[joint];
    const Drive& drive = from_.drives.of_joint[std::size_t(joint)];
    JointLimits limits;
    if (m_.jnt_limited[joint] != 0 && m_.jnt_type[joint] != mjJNT_BALL) {
      limits.lower = m_.jnt_range[2 * joint];
      limits.upper = m_.jnt_range[2 * joint + 1];
    }
    limits.effort = drive.effort;
    limits.damping = m_.dof_damping[dof];
    limits.friction = m_.dof_frictionloss[dof];
    limits.armature = m_.dof_armature[dof];
    const std::string name = names_.unique(joint_name(m_, joint), "_joint");
    m_.jnt_type[joint] == mjJNT_SLIDE ? builder_.prismatic(name, axis, limits) : builder_.revolute(name, axis, limits);
    if (reference != 0) builder_.set(keys::initial_joint_position, reference);
    builder_.set(model_constants::mjcf_joint, std::uint32_t(joint));
    if (from_.drives.any) builder_.set(keys::joint_drive, std::uint32_t(drive.mode));
    if (drive.mode == DriveMode::position) {
      builder_.set(keys::joint_drive_stiffness, drive.stiffness);
      builder_.set(keys::joint_drive_damping, drive.damping);
    }
    if (m_.jnt_stiffness[joint] != 0) springs_.push_back(joint);
  }

  void refuse_ball(int joint) {
    const std::string given = name_of(m_, m_.name_jntadr, joint);
    const std::string body = name_of(m_, m_.name_bodyadr, m_.jnt_bodyid[joint]);
    const Location joint_at = from_.source.location_of("joint", given), at = from_.source.location_of("body", body);
    problems_.error(
        joint_at.line > 0 ? joint_at : at,
        concat("joint ", quote(joint_name(m_, joint)), " of body ", quote(body_name(m_, m_.jnt_bodyid[joint])),
               " is a ball, which robots do not have; write three hinges about x, y and z in its place"));
  }

  void tell_springs() {
    if (springs_.empty()) return;
    std::vector<std::string> names;
    for (const int j : springs_) names.push_back(joint_name(m_, j));
    problems_.warning(from_.source.location_of("joint", name_of(m_, m_.name_jntadr, springs_.front())),
                      concat("the stiffness of ", names.size() == 1 ? "joint " : "joints ", quoted_list(names),
                             " is left out: joints have no springs; motion.mujoco has them with `settings: model`, "
                             "elsewhere a controller may act as one"));
  }

  void fill(int body) {
    Solid solid;
    for (int g = m_.body_geomadr[body]; g < m_.body_geomadr[body] + m_.body_geomnum[body]; ++g)
      shapes_.add(
          g, {}, [this](std::string_view text) { return builder_.intern(text); }, solid);
    builder_.set(model_constants::mjcf_body, std::uint32_t(body));
    if (m_.body_mass[body] > 0) builder_.set(keys::inertial, inertia_of(body));
    if (!solid.collisions.empty()) builder_.set_array<Shape>(keys::collision_shapes, solid.collisions);
    if (solid.visuals.empty()) return;
    builder_.set_array<Shape>(keys::visual_shapes, solid.visuals);
    if (std::any_of(solid.materials.begin(), solid.materials.end(), [](TextId m) { return m != no_text; }))
      builder_.set_array<TextId>(keys::visual_materials, solid.materials);
  }

  Inertia inertia_of(int body) const {
    const Mat3 axes = quaternion_of(m_.body_iquat + 4 * body).toRotationMatrix();
    const Mat3 tensor = axes * vector_of(m_.body_inertia + 3 * body).asDiagonal() * axes.transpose();
    return Inertia::from(m_.body_mass[body], vector_of(m_.body_ipos + 3 * body), tensor);
  }

  const mjModel& m_;
  const RobotSource& from_;
  Shapes& shapes_;
  RobotBuilder& builder_;
  Problems& problems_;
  Names names_;
  std::vector<int> springs_;
};

}  // namespace

Pose base_pose(const mjModel& m, int top) {
  return m.body_jntnum[top] > 0 && !is_free(m, top) ? Pose{} : pose_in_world(m, top);
}

void build_robot(const RobotSource& from, int top, Shapes& shapes, RobotBuilder& builder, Problems& problems) {
  RobotMaker(from, shapes, builder, problems).run(top);
}

}  // namespace muro::mjcf
