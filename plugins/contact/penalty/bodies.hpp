// SPDX-License-Identifier: MIT
// What contact knows of a scene: its bodies, and the robots that forces move.
#pragma once

#include <vector>

#include "contact_law.hpp"
#include "grip.hpp"
#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "patch.hpp"
#include "restitution.hpp"

namespace muro::penalty {

inline constexpr std::int32_t nobody = -1;

/// Any object.
struct Body {
  const Pose* pose = nullptr;    ///< null: scenery
  const Twist* twist = nullptr;  ///< null: scenery, which does not move
  std::int32_t robot = nobody;   ///< in Bodies::robots, when forces can move it
  std::uint32_t unit = 0;        ///< in Bodies::units, the same
  std::uint32_t whole = 0;       ///< equal for all bodies of a robot
  std::uint64_t name = 0;        ///< hash
};

/// What forces move as one: a robot, or, where its motion asks for the forces on each body, one of its bodies.
struct Unit {
  Sum<Wrench> wrench;
  In<Pose> pose;  ///< of the frame that the wrench refers to
  In<Twist> twist;
  std::uint32_t mass = 0;  ///< in Bodies::masses
};

/// A robot that forces can move.
struct Robot {
  ListIn<Contact> contacts;
  ListOut<Grip> grips;
  std::uint32_t first_unit = 0, units = 1;  ///< in Bodies::units; the first is that of the base
  bool alone = true;                        ///< it has one unit
  bool shadow = false;                      ///< what it touches does not feel it
  In<std::uint64_t> world;                  ///< see keys::contact_world
  In<double> lag;                           ///< see keys::twist_lag
  std::uint64_t rank = 0;                   ///< of two robots, the one with the lower rank works out their contacts
};

struct Material {
  double restitution = 0, damping_ratio = 0;
};

struct Bodies {
  std::vector<Body> all;  ///< by object id
  std::vector<Robot> robots;
  std::vector<Unit> units;
  std::vector<std::int32_t> robot_of;  ///< by robot number: in `robots`, or nobody
  std::vector<MassProperties> masses;  ///< all different
  std::vector<Material> materials;     ///< of all shapes; a pair has the larger restitution of two

  void connect(Connector& c);

  const Body& operator[](ObjectId id) const { return all[index_of(id)]; }
  const Unit& base_of(const Robot& robot) const { return units[robot.first_unit]; }
  /// The robot that the body belongs to when forces move it at present, or nobody.
  std::int32_t moved(const Body& body) const {
    return body.robot != nobody && *robots[std::size_t(body.robot)].world != 0 ? body.robot : nobody;
  }
  /// Whether contact of `robot` with another one that forces move, or with nobody, is not its own world's business.
  bool answers(const Robot& robot, std::int32_t other) const {
    const std::uint64_t own = *robot.world;
    return own == keys::contact_for_all || (other != nobody && *robots[std::size_t(other)].world != own);
  }
  /// Nothing acts on the robot.
  void leave(std::uint32_t robot) const {
    const Robot& r = robots[robot];
    for (std::uint32_t u = r.first_unit; u < r.first_unit + r.units; ++u) *units[u].wrench = Wrench{};
  }
  std::uint32_t material_of(double restitution) const {
    std::uint32_t i = 0;
    while (i + 1 < materials.size() && materials[i].restitution != restitution) ++i;
    return i;
  }
  std::uint64_t pair_of(const Contact& c) const {
    return penalty::pair_of((*this)[c.self].name, (*this)[c.other].name, c.self_shape, c.other_shape);
  }

 private:
  void connect_robot(Connector& c, const RobotView& view);
  void add_unit(Connector& c, ObjectId body, const MassProperties& mass);
  std::uint32_t note(const MassProperties& mass);
};

/// What all contacts of a step have in common.
struct Moment {
  Stiffness stiffness;
  double elapsed = 0;  ///< s since the last run
};

}  // namespace muro::penalty
