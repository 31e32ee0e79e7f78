// SPDX-License-Identifier: MIT
#include "landmark.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "muro/base/bounds.hpp"
#include "muro/base/did_you_mean.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/mesh/mesh.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::level {

namespace {

bool is_shadow(const Connector& c, const RobotView& robot) {
  return c.constant(robot.base(), keys::shadow_of).has_value();
}

std::vector<std::string> names_of_places(const Connector& c) {
  std::vector<std::string> names;
  for (const TextId id : c.constant_array(world_object, keys::place_names))
    if (std::string name(c.text(id)); std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(std::move(name));
  return names;
}

/// Returns the names of objects of the scenery with shapes.
std::vector<std::string> names_of_scenery(const Connector& c) {
  std::vector<std::string> names;
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId object{i};
    if (c.robot_of(object) != no_robot) continue;
    if (!c.constant_array(object, keys::collision_shapes).empty() ||
        !c.constant_array(object, keys::visual_shapes).empty())
      names.emplace_back(c.object_name(object));
  }
  return names;
}

bool contains(const std::vector<std::string>& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

[[noreturn]] void reject(std::string_view rule, const std::string& name, const std::string& why) {
  throw Error("the rule " + quote(rule) + " names " + quote(name) + ", " + why);
}

}  // namespace

Landmark::Landmark(Connector& c, const RobotView& robot, const std::string& name, std::string_view rule) {
  std::vector<std::string> known;
  for (const RobotView* other : c.robots()) {
    if (other == &robot || is_shadow(c, *other)) continue;
    known.emplace_back(other->name);
    if (name.empty() || name == other->name) robots_.push_back(c.read(other->base(), keys::pose));
  }
  if (name.empty()) return;
  const std::vector<std::string> scenery = names_of_scenery(c), places = names_of_places(c);
  if (contains(scenery, name)) add_scenery(c, c.find_object(name), rule);
  if (contains(places, name)) add_place(c, name);
  if (!rectangles_.empty() && !(robots_.empty() && solids_.empty()))
    reject(rule, name,
           std::string("which is a place and ") + (robots_.empty() ? "an object of the scenery" : "a robot") +
               "; give one of the two another name");
  if (!robots_.empty() || !solids_.empty() || !rectangles_.empty()) return;
  known.insert(known.end(), scenery.begin(), scenery.end());
  known.insert(known.end(), places.begin(), places.end());
  reject(rule, name,
         "but no other robot, no object of the scenery and no place has this name" + did_you_mean(name, known));
}

Landmark Landmark::place(const Connector& c, const std::string& name, std::string_view rule) {
  Landmark landmark;
  landmark.add_place(c, name);
  if (!landmark.rectangles_.empty()) return landmark;
  const std::vector<std::string> places = names_of_places(c);
  reject(rule, name,
         "but there is no place of this name" + did_you_mean(name, places) +
             "; places (`world: {places: ...}`): " + quoted_list(places));
}

void Landmark::add_scenery(const Connector& c, ObjectId object, std::string_view rule) {
  const Pose pose = c.constant(object, keys::pose).value_or(Pose{});
  auto shapes = c.constant_array(object, keys::collision_shapes);
  if (shapes.empty()) shapes = c.constant_array(object, keys::visual_shapes);
  for (const Shape& s : shapes) {
    Solid solid{s.kind, s.size, half_extents(s), {}};
    Pose origin = pose * s.origin;
    if (s.kind == ShapeKind::mesh || s.kind == ShapeKind::heightmap) try {
        const std::string path(c.text(s.mesh));
        const Aabb box = s.kind == ShapeKind::mesh ? mesh::bounds_of(mesh::load(path, s.size))
                                                   : heightmap::bounds_of(heightmap::load(path).heightmap(s.size));
        solid.half = 0.5 * (box.high - box.low);
        origin.position = origin * Vec3(0.5 * (box.low + box.high));
      } catch (const Error& error) {
        reject(rule, std::string(c.object_name(object)), std::string("whose size is not known: ") + error.what());
      }
    solid.to_shape = origin.inverse();
    solids_.push_back(solid);
  }
}

void Landmark::add_place(const Connector& c, std::string_view name) {
  const auto names = c.constant_array(world_object, keys::place_names);
  const auto numbers = c.constant_array(world_object, keys::place_rectangles);
  for (std::size_t i = 0; i < names.size() && 4 * i + 3 < numbers.size(); ++i)
    if (c.text(names[i]) == name)
      rectangles_.push_back({numbers[4 * i], numbers[4 * i + 1], 0.5 * numbers[4 * i + 2], 0.5 * numbers[4 * i + 3]});
}

double Landmark::distance(const Solid& solid, const Vec3& from) {
  const Vec3 p = solid.to_shape * from;
  const auto to_box = [&p](const Vec3& half) { return (p.cwiseAbs() - half).cwiseMax(0).norm(); };
  switch (solid.kind) {
    case ShapeKind::sphere:
      return std::max(0.0, p.norm() - solid.size.x());
    case ShapeKind::capsule:
      return std::max(0.0, to_box({0, 0, 0.5 * solid.size.z()}) - solid.size.x());
    case ShapeKind::cylinder: {
      const double aside = std::max(0.0, p.head<2>().norm() - solid.size.x());
      const double along = std::max(0.0, std::abs(p.z()) - 0.5 * solid.size.z());
      return std::sqrt(aside * aside + along * along);
    }
    case ShapeKind::plane:
      return std::max(0.0, p.z());
    default:
      return to_box(solid.half);
  }
}

double Landmark::distance(const Vec3& from) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const In<Pose>& robot : robots_) nearest = std::min(nearest, (robot->position - from).norm());
  for (const Solid& solid : solids_) nearest = std::min(nearest, distance(solid, from));
  for (const Rectangle& r : rectangles_) {
    const double x = std::max(0.0, std::abs(from.x() - r.x) - r.half_width);
    const double y = std::max(0.0, std::abs(from.y() - r.y) - r.half_depth);
    nearest = std::min(nearest, std::sqrt(x * x + y * y));
  }
  return nearest;
}

}  // namespace muro::level
