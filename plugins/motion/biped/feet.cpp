// SPDX-License-Identifier: MIT
#include "feet.hpp"

#include <algorithm>
#include <string>

#include "muro/base/did_you_mean.hpp"
#include "muro/shape.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/hull_vertices.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::biped {

namespace {

/// Links and the rigid bodies that they are part of, with all joints at 0.
class Structure {
 public:
  Structure(const Connector& c, const RobotView& robot) : connector_(c), robot_(robot) {
    const std::size_t n = robot.links.size();
    in_base_.resize(n), in_body_.resize(n), body_.resize(n);
    for (std::size_t i = 1; i < n; ++i) {
      const Link& l = robot.links[i];
      const auto parent = std::size_t(l.parent);
      const bool is_fixed = l.joint == JointKind::fixed;
      in_base_[i] = in_base_[parent] * l.origin;
      body_[i] = is_fixed ? body_[parent] : std::uint32_t(i);
      in_body_[i] = is_fixed ? in_body_[parent] * l.origin : Pose{};
    }
  }

  /// Returns the first link of the rigid body of link `i`: a joint leads to it, or it is the base.
  std::uint32_t body(std::uint32_t i) const { return body_[i]; }
  const Pose& in_body(std::uint32_t i) const { return in_body_[i]; }
  const Pose& in_base(std::uint32_t i) const { return in_base_[i]; }

  std::string_view name(ObjectId part) const { return connector_.object_name(part).substr(robot_.name.size() + 1); }
  std::uint32_t named(std::string_view wanted) const {
    std::vector<std::string> links;
    for (std::uint32_t i = 0; i < robot_.links.size(); ++i) {
      const Link& l = robot_.links[i];
      if (name(l.object) == wanted) return i;
      if (l.joint_object != no_object && name(l.joint_object) == wanted)
        throw Error("feet: " + quote(wanted) + " is a joint of " + quote(robot_.name) +
                    ", and a foot is a link; the link behind it is " + quote(name(l.object)));
      links.emplace_back(name(l.object));
    }
    throw Error("feet: " + quote(robot_.name) + " has no link " + quote(wanted) + did_you_mean(wanted, links) +
                "; links that carry no other: " + quoted_list(leaves()));
  }

  /// Whether one or more joints lie between the base and `from`, and between `from` and `to`.
  bool is_before(std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t wanted = body(from);
    for (std::uint32_t at = body(to); at != wanted; at = body(std::uint32_t(robot_.links[at].parent)))
      if (at == 0) return false;
    return true;
  }

 private:
  std::vector<std::string_view> leaves() const {
    std::vector<bool> carries(robot_.links.size());
    for (const Link& l : robot_.links)
      if (l.parent >= 0) carries[std::size_t(l.parent)] = true;
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < carries.size(); ++i)
      if (!carries[i]) names.push_back(name(robot_.links[i].object));
    return names;
  }

  const Connector& connector_;
  const RobotView& robot_;
  std::vector<Pose> in_base_, in_body_;
  std::vector<std::uint32_t> body_;
};

/// Throws Error for two links that cannot be feet of one robot.
void check_feet(const Structure& s, const RobotView& robot, const std::array<std::uint32_t, 2>& links,
                std::span<const std::string_view> names) {
  if (links[0] == links[1])
    throw Error("feet: " + quote(names[0]) + " is named twice; name the left foot and the right one");
  if (s.body(links[0]) == s.body(links[1]))
    throw Error("feet: " + quote(names[0]) + " and " + quote(names[1]) +
                " are one rigid body: no joint lies between them; name the two feet");
  for (const int i : {0, 1})
    if (s.is_before(links[std::size_t(i)], links[std::size_t(1 - i)]))
      throw Error("feet: " + quote(names[std::size_t(i)]) + " lies between the base of " + quote(robot.name) + " and " +
                  quote(names[std::size_t(1 - i)]) +
                  ", which is behind it; a biped has two legs, each with a foot at its end");
}

void add_points(const Connector& c, const Shape& shape, const Pose& at, std::vector<SolePoint>& points,
                std::string_view link) {
  const Vec3 half = 0.5 * shape.size, along = at.orientation * Vec3::UnitZ();
  switch (shape.kind) {
    case ShapeKind::box:
      for (int i = 0; i < 8; ++i)
        points.push_back({.center = at * Vec3(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                                              i & 4 ? half.z() : -half.z())});
      return;
    case ShapeKind::sphere:
      points.push_back({.center = at.position, .radius = shape.size.x()});
      return;
    case ShapeKind::cylinder:
      for (const double side : {-half.z(), half.z()})
        points.push_back({.center = at.position + side * along, .rim = shape.size.x(), .axis = along});
      return;
    case ShapeKind::capsule:
      for (const double side : {-half.z(), half.z()})
        points.push_back({.center = at.position + side * along, .radius = shape.size.x()});
      return;
    case ShapeKind::mesh: {
      const std::vector<Vec3> vertices = mesh::hull_vertices(c, shape);
      if (vertices.empty())
        throw Error("the mesh of the foot " + quote(link) + " cannot be read: " + quote(c.text(shape.mesh)));
      for (const Vec3& v : vertices) points.push_back({.center = at * v});
      return;
    }
    case ShapeKind::plane:
    case ShapeKind::heightmap:
      throw Error("the foot " + quote(link) +
                  " has a plane or a heightmap as collision shape; give it a box, a sphere, "
                  "a cylinder, a capsule or a mesh");
  }
}

Sole sole_of(const Connector& c, const RobotView& robot, const Structure& s, std::uint32_t foot) {
  std::vector<SolePoint> points;
  const Pose to_foot = s.in_body(foot).inverse();
  for (std::uint32_t i = 0; i < robot.links.size(); ++i)
    if (s.body(i) == s.body(foot))
      for (const Shape& shape : c.constant_array(robot.links[i].object, keys::collision_shapes))
        add_points(c, shape, to_foot * s.in_body(i) * shape.origin, points, s.name(robot.links[i].object));
  if (points.empty())
    throw Error("the foot " + quote(s.name(robot.links[foot].object)) +
                " has no collision shape, so it has no sole; give it one in the model");
  const std::span<const double> normal = c.parameters().reals("sole_normal");
  if (normal.empty()) return {std::move(points), s.in_base(foot).orientation.conjugate() * Vec3(0, 0, -1)};
  const Vec3 given = Vec3(normal[0], normal[1], normal[2]);
  if (!(given.norm() > 1e-6)) throw Error("sole_normal: (0, 0, 0) is no direction");
  return {std::move(points), given.normalized()};
}

}  // namespace

FeetOfRobot find_feet(const Connector& c, const RobotView& robot) {
  const std::span<const std::string_view> names = c.parameters().texts("feet");
  const Structure structure(c, robot);
  if (names.size() != 2)
    throw Error("feet names the links of the two feet of " + quote(robot.name) + ", as [left_foot, right_foot]; " +
                std::to_string(names.size()) + " are given");
  FeetOfRobot found;
  for (std::size_t i = 0; i < 2; ++i) found.links[i] = structure.named(names[i]);
  check_feet(structure, robot, found.links, names);
  std::vector<std::int32_t> number(robot.links.size(), -1);
  for (std::size_t i = 0; i < 2; ++i) {
    Leg& leg = found.feet.legs[i];
    const std::uint32_t body = structure.body(found.links[i]);
    for (std::uint32_t at = body; at != 0;) {
      const Link& link = robot.links[at];
      const auto parent = std::uint32_t(link.parent);
      if (number[at] < 0) {
        number[at] = std::int32_t(found.joints.size());
        found.joints.push_back(at);
      }
      LegJoint joint;
      joint.origin = structure.in_body(parent) * link.origin;
      joint.is_turned = !joint.origin.orientation.vec().isZero(0);
      joint.is_shifted = !joint.origin.position.isZero(0);
      joint.axis = link.axis;
      joint.axis_number = link.axis == Vec3::UnitX()   ? 1
                          : link.axis == Vec3::UnitY() ? 2
                          : link.axis == Vec3::UnitZ() ? 3
                                                       : 0;
      joint.kind = link.joint;
      joint.number = std::uint32_t(number[at]);
      leg.joints.push_back(joint);
      at = structure.body(parent);
    }
    std::reverse(leg.joints.begin(), leg.joints.end());
    leg.end = structure.in_body(found.links[i]);
    found.feet.soles[i] = sole_of(c, robot, structure, found.links[i]);
  }
  for (std::uint32_t i = 0; i < robot.links.size(); ++i)
    found.is_of_foot.push_back(structure.body(i) == structure.body(found.links[0]) ||
                               structure.body(i) == structure.body(found.links[1]));
  return found;
}

}  // namespace muro::biped
