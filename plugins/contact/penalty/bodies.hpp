// SPDX-License-Identifier: MIT
// The bodies of a scene, and the robots that forces move.
#pragma once

#include <string>
#include <vector>

#include "apparent_mass.hpp"
#include "contact_law.hpp"
#include "friction_anchor.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "patch.hpp"
#include "plugins/common/contact_geometry/contact_responsibility.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "restitution.hpp"
#include "solved_contact.hpp"
#include "turning_spring.hpp"

namespace muro::penalty {

/// In place of an index in Bodies::robots: no force moves it.
inline constexpr std::int32_t not_dynamic = -1;

/// Any object.
struct Body {
  const Pose* pose = nullptr;                  ///< null: scenery
  const Twist* twist = nullptr;                ///< null: scenery, which does not move
  std::int32_t robot = not_dynamic;            ///< in Bodies::robots, when forces can move it
  std::uint32_t dynamic_body = 0;              ///< in Bodies::dynamic_bodies, the same
  std::int32_t kinematic_robot = not_dynamic;  ///< in Bodies::kinematic_robots, of a robot that forces never move
  std::uint32_t model = 0;                     ///< equal for all bodies of a robot
  std::uint64_t name = 0;                      ///< hash
  std::uint32_t first_shape = 0;               ///< in Bodies::shapes
};

/// What forces move as one rigid body: a robot, or, if its motion reads the forces on each link, one of its links.
struct DynamicBody {
  Sum<Wrench> wrench;
  In<Pose> pose;  ///< of the link that the wrench acts on
  In<Twist> twist;
  std::uint32_t mass = 0;  ///< in Bodies::masses
};

/// A robot that forces can move.
struct Robot {
  ListIn<Contact> contacts;
  Anchors anchors;
  ListOut<TurningSpring> turning_springs;        ///< empty: no shape resists rolling or spinning
  ListOut<SolvedContact> solved;                 ///< contacts that it has computed
  ListOut<ContactWrench> told;                   ///< see Bodies::tells_contacts
  std::uint32_t first_body = 0, body_count = 1;  ///< in Bodies::dynamic_bodies; the first is that of the base
  double mass = 0;                               ///< kg, of all its bodies
  bool is_single_body = true;
  bool is_one_link = false;  ///< so it rolls, or slides, or rests
  bool is_shadow = false;    ///< it exerts no force on what it touches
  In<std::uint64_t> world;   ///< see keys::contact_world
  In<double> lag;            ///< see keys::twist_lag
  In<double> impact_step;    ///< see keys::impact_step; none: its motion does not correct paths
  Out<std::int64_t> impact_time;
  Out<double> carried_mass;  ///< none: its motion resolves no contacts
  Out<ImpactCorrection> impact;
  std::uint64_t order_key = 0;  ///< of two robots, the one with the lower key computes their contacts
};

/// A robot that forces never move, and that others push.
struct KinematicRobot {
  ObjectId base = no_object;
  ListOut<ContactWrench> told;  ///< as that of a Robot
  bool is_read = false;
};

struct Material {
  double restitution = 0, damping_ratio = 0;
};

/// What all contacts of a step share.
struct StepContext {
  Stiffness stiffness;
  double omega = 0;             ///< rad/s: of contacts that are solved together, whatever the step
  double elapsed = 0;           ///< s since the last run
  std::int64_t time = 0;        ///< ns
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  double impact_speed = 0;      ///< m/s: contacts that begin faster are impacts
  double correcting_speed = 0;  ///< m/s: overlap that no motion has made is taken back at it
};

/// Whether steps are so long that springs by themselves are much softer than they are to be.
inline bool is_soft(const StepContext& context) {
  constexpr double soft = 0.75;
  return context.stiffness.omega < soft * context.omega;
}

struct Bodies {
  std::vector<Body> all;                              ///< by object id
  std::vector<contact_geometry::ShapeExtent> shapes;  ///< of all bodies
  std::vector<Robot> robots;
  std::vector<std::uint32_t> by_order_key;  ///< numbers of `robots`, the lowest key first
  std::vector<KinematicRobot> kinematic_robots;
  std::vector<DynamicBody> dynamic_bodies;
  std::vector<std::string> names;               ///< by object id, for people
  std::vector<std::int32_t> robot_of;           ///< by robot number: in `robots`, or not_dynamic
  std::vector<MassProperties> masses;           ///< all different
  std::vector<ApparentMasses> apparent_masses;  ///< of `robots`; empty of those that are one body
  std::vector<Material> materials;              ///< of all shapes; a pair has the larger restitution of two
  bool tells_contacts = false;                  ///< somebody reads what each contact does
  bool tells_kinematic_robots = false;  ///< the same of contacts with robots that no force moves, at some time at least

  void connect(Connector& c);
  /// When motions know which links they move by forces.
  void connect_by_name(Connector& c);
  /// `numbers`: of `robots`; in an order that no order of declaration changes.
  void sort_by_order_key(std::vector<std::uint32_t>& numbers) const;

  const Body& operator[](ObjectId id) const { return all[index_of(id)]; }
  const DynamicBody& base_of(const Robot& robot) const { return dynamic_bodies[robot.first_body]; }
  /// Whether the body is of a robot; else it is scenery.
  bool moves(ObjectId id) const { return bool((*this)[id].twist); }
  /// Of a point of a body, m/s.
  Vec3 velocity(ObjectId id, const Vec3& point) const {
    const Body& body = (*this)[id];
    return body.twist ? body.twist->at(point - body.pose->position) : Vec3::Zero();
  }
  /// The robot of the body if forces move it at present, or not_dynamic.
  std::int32_t dynamic_robot_of(const Body& body) const {
    return is_moved_by_forces(world_of(body.robot)) ? body.robot : not_dynamic;
  }
  /// keys::contact_world of a robot, or of not_dynamic: scenery and robots that forces never move.
  std::uint64_t world_of(std::int32_t robot) const {
    return robot == not_dynamic ? kinematic_world : *robots[std::size_t(robot)].world;
  }
  /// Length of the steps (s) of a motion that has impacts act in the instant in which they happen; 0 for others.
  double impact_step_of(std::int32_t robot) const {
    const Robot& r = robots[std::size_t(robot)];
    return r.impact_step && *r.lag == 0 ? *r.impact_step : 0;
  }
  /// Whether what a robot touches is solved at once even where it touches scenery alone: it is one link, and steps are
  /// long, or legs carry it. `robot`: in `robots`.
  bool is_solved_alone(const StepContext& context, std::uint32_t robot) const;
  void clear_wrenches(std::uint32_t robot) const {
    const Robot& r = robots[robot];
    for (std::uint32_t u = r.first_body; u < r.first_body + r.body_count; ++u) *dynamic_bodies[u].wrench = Wrench{};
  }
  /// Where contacts of the body's robot are told if no force moves that robot at present and somebody reads it; else
  /// null.
  const ListOut<ContactWrench>* list_of_kinematic(ObjectId body) const {
    const Body& b = (*this)[body];
    if (b.robot != not_dynamic)
      return is_moved_by_forces(world_of(b.robot)) ? nullptr : &robots[std::size_t(b.robot)].told;
    if (b.kinematic_robot == not_dynamic) return nullptr;
    const KinematicRobot& robot = kinematic_robots[std::size_t(b.kinematic_robot)];
    return robot.is_read ? &robot.told : nullptr;
  }
  void clear_kinematic_lists() const {
    for (const KinematicRobot& robot : kinematic_robots)
      if (robot.is_read) robot.told.clear();
  }
  /// Puts contacts (one or more) into the list of a robot, without what they do. Returns the first.
  static ContactWrench* tell(const Robot& robot, std::span<const Contact> contacts) {
    for (const Contact& c : contacts) robot.told.push_back({c.self, c.other, c.point, c.normal, c.depth, {}});
    return (*robot.told).data() + (*robot.told).size() - contacts.size();
  }
  /// Puts a contact that another robot has computed into the list of the one that it pushes.
  static void tell_reaction(const ListOut<ContactWrench>& list, const ContactWrench& c) {
    list.push_back({c.other, c.body, c.point, -c.normal, c.depth, {-c.wrench.force, -c.wrench.torque}});
  }
  std::uint32_t material_of(double restitution) const {
    std::uint32_t i = 0;
    while (i + 1 < materials.size() && materials[i].restitution != restitution) ++i;
    return i;
  }
  bool is_of_disc(const Contact& c) const {
    return contact_geometry::is_of_disc(shapes[(*this)[c.self].first_shape + c.self_shape],
                                        shapes[(*this)[c.other].first_shape + c.other_shape]);
  }
  std::uint64_t pair_of(const Contact& c) const {
    return penalty::pair_of((*this)[c.self].name, (*this)[c.other].name, c.self_shape, c.other_shape);
  }

 private:
  void connect_robot(Connector& c, const RobotView& view, bool resists_turning);
  void connect_links(Connector& c, const RobotView& view);
  void connect_kinematic_robots(Connector& c);
  void add_dynamic_body(Connector& c, ObjectId body, const MassProperties& mass);
  std::uint32_t number_of(const MassProperties& mass);
};

}  // namespace muro::penalty
