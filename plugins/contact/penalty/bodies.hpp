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

/// Value instead of an index in Bodies::robots: no force moves the body.
inline constexpr std::int32_t not_dynamic = -1;

/// An object of the scene.
struct Body {
  const Pose* pose = nullptr;         ///< null: scenery
  const Twist* twist = nullptr;       ///< null: scenery, which does not move
  std::int32_t robot = not_dynamic;   ///< index in Bodies::robots, when forces can move it
  std::uint32_t dynamic_body = 0;     ///< index in Bodies::dynamic_bodies, when forces can move it
  std::int32_t kinematic_robot = -1;  ///< index in Bodies::kinematic_robots, if forces never move it
  std::uint32_t model = 0;            ///< equal for all bodies of one robot
  std::uint64_t name = 0;             ///< hash of the name of the object
  std::uint32_t first_shape = 0;      ///< index in Bodies::shapes
};

/// A rigid body that forces move: a robot, or one of its links if its motion reads the forces on each link.
struct DynamicBody {
  Sum<Wrench> wrench;
  In<Pose> pose;  ///< of the link that the wrench acts on
  In<Twist> twist;
  std::uint32_t mass = 0;  ///< index in Bodies::masses
};

/// A robot that forces can move.
struct Robot {
  ListIn<Contact> contacts;
  Anchors anchors;
  ListOut<TurningSpring> turning_springs;        ///< empty: no shape resists rolling or spinning
  ListOut<SolvedContact> solved;                 ///< contacts that the robot has computed
  ListOut<ContactWrench> told;                   ///< see Bodies::tells_contacts
  std::uint32_t first_body = 0, body_count = 1;  ///< range in Bodies::dynamic_bodies; the base is first
  double mass = 0;                               ///< kg, of all its bodies
  bool is_single_body = true;
  bool is_one_link = false;  ///< it rolls, slides or rests
  bool is_shadow = false;    ///< it exerts no force on what it touches
  In<std::uint64_t> world;   ///< see keys::contact_world
  In<double> lag;            ///< see keys::twist_lag
  In<double> impact_step;    ///< see keys::impact_step; none: its motion does not correct paths
  Out<std::int64_t> impact_time;
  Out<double> carried_mass;  ///< none: its motion resolves no contacts
  Out<ImpactCorrection> impact;
  std::uint64_t order_key = 0;  ///< of two robots, the one with the lower key computes their contacts
};

/// A robot that forces never move, and that other robots push.
struct KinematicRobot {
  ObjectId base = no_object;
  ListOut<ContactWrench> told;  ///< as in Robot
  bool is_read = false;
};

struct Material {
  double restitution = 0, damping_ratio = 0;
};

/// Values that all contacts of a step share.
struct StepContext {
  Stiffness stiffness;
  double omega = 0;             ///< rad/s: of contacts that are solved together, at any step
  double elapsed = 0;           ///< s since the last run
  std::int64_t time = 0;        ///< ns
  Vec3 gravity = Vec3::Zero();  ///< m/s^2
  double impact_speed = 0;      ///< m/s: contacts that begin faster are impacts
  double correcting_speed = 0;  ///< m/s: speed at which overlap that no motion has made is taken back
};

/// Whether steps are so long that single springs are much softer than wanted.
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
  std::vector<std::string> names;               ///< by object id, for messages
  std::vector<std::int32_t> robot_of;           ///< by robot number: index in `robots`, or not_dynamic
  std::vector<MassProperties> masses;           ///< all different
  std::vector<ApparentMasses> apparent_masses;  ///< of `robots`; empty for robots that are one body
  std::vector<Material> materials;              ///< of all shapes; a pair has the larger restitution of two
  bool tells_contacts = false;                  ///< something reads the wrenches of contacts
  bool tells_kinematic_robots = false;          ///< the same for robots that no force moves, at least at times

  void connect(Connector& c);
  /// Call it when motions know which links they move by forces.
  void connect_by_name(Connector& c);
  /// Sorts `numbers` (of `robots`) into an order that does not depend on the order of declaration.
  void sort_by_order_key(std::vector<std::uint32_t>& numbers) const;

  const Body& operator[](ObjectId id) const { return all[index_of(id)]; }
  const DynamicBody& base_of(const Robot& robot) const { return dynamic_bodies[robot.first_body]; }
  /// Whether the body belongs to a robot; otherwise it is scenery.
  bool moves(ObjectId id) const { return bool((*this)[id].twist); }
  /// Returns the velocity (m/s) of a point (m, world) of a body.
  Vec3 velocity(ObjectId id, const Vec3& point) const {
    const Body& body = (*this)[id];
    return body.twist ? body.twist->at(point - body.pose->position) : Vec3::Zero();
  }
  /// Returns the robot of the body if forces move it at present, or not_dynamic.
  std::int32_t dynamic_robot_of(const Body& body) const {
    return is_moved_by_forces(world_of(body.robot)) ? body.robot : not_dynamic;
  }
  /// Returns keys::contact_world of a robot, or of not_dynamic: scenery and robots that forces never move.
  std::uint64_t world_of(std::int32_t robot) const {
    return robot == not_dynamic ? kinematic_world : *robots[std::size_t(robot)].world;
  }
  /// Returns the step (s) of a motion that lets impacts act at the instant at which they happen; 0 for others.
  double impact_step_of(std::int32_t robot) const {
    const Robot& r = robots[std::size_t(robot)];
    return r.impact_step && *r.lag == 0 ? *r.impact_step : 0;
  }
  /// Whether all contacts of a robot are solved together even if it touches only scenery. This holds if it is one link
  /// and steps are long, or if legs carry it. `robot`: index in `robots`.
  bool is_solved_alone(const StepContext& context, std::uint32_t robot) const;
  void clear_wrenches(std::uint32_t robot) const {
    const Robot& r = robots[robot];
    for (std::uint32_t u = r.first_body; u < r.first_body + r.body_count; ++u) *dynamic_bodies[u].wrench = Wrench{};
  }
  /// Returns the list in which contacts of the body's robot are reported, if no force moves that robot at present and
  /// something reads the list; otherwise null.
  const ListOut<ContactWrench>* list_of_kinematic(ObjectId body) const {
    const Body& b = (*this)[body];
    if (b.robot != not_dynamic)
      return is_moved_by_forces(world_of(b.robot)) ? nullptr : &robots[std::size_t(b.robot)].told;
    if (b.kinematic_robot < 0) return nullptr;
    const KinematicRobot& robot = kinematic_robots[std::size_t(b.kinematic_robot)];
    return robot.is_read ? &robot.told : nullptr;
  }
  void clear_kinematic_lists() const {
    for (const KinematicRobot& robot : kinematic_robots)
      if (robot.is_read) robot.told.clear();
  }
  /// Adds contacts (one or more) to the list of a robot, without their wrenches. Returns the first.
  static ContactWrench* tell(const Robot& robot, std::span<const Contact> contacts) {
    for (const Contact& c : contacts) robot.told.push_back({c.self, c.other, c.point, c.normal, c.depth, {}});
    return (*robot.told).data() + (*robot.told).size() - contacts.size();
  }
  /// Adds a contact that another robot has computed to the list of the robot that it pushes.
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
