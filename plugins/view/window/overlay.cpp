// SPDX-License-Identifier: MIT
#include "overlay.hpp"

#include <algorithm>

#include "muro/base/elementary.hpp"
#include "muro/vocabulary.hpp"

namespace muro::view {

namespace {

const Vec3 red(0.95, 0.2, 0.15), green(0.2, 0.8, 0.2), blue(0.25, 0.4, 1), orange(1, 0.6, 0.1);

/// Returns the value of a property, or `default_value` when it is missing.
template <class T>
T value_of(std::span<const LiveProperty> properties, const Key<T>& key, const T& default_value) {
  for (const LiveProperty& p : properties)
    if (p.key->name == key.name && *p.key->type == *key.type && p.count > 0) return *static_cast<const T*>(p.data);
  return default_value;
}

template <class T>
std::span<const T> values_of(std::span<const LiveProperty> properties, const Key<T>& key) {
  for (const LiveProperty& p : properties)
    if (p.key->name == key.name && *p.key->type == *key.type) return {static_cast<const T*>(p.data), p.count};
  return {};
}

}  // namespace

void Overlay::connect_by_name(Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const FoundProperty& p : c.properties(ObjectId(i)))
      if (p.key->name == keys::ranges.name) {
        c.read(ObjectId(i), keys::pose);  // so that it is up to date
        scanners_.push_back(ObjectId(i));
      }
}

void Overlay::add_frame(const Pose& pose, double length, render::DebugLines& lines) {
  const Vec3 colors[] = {red, green, blue};
  for (int k = 0; k < 3; ++k) lines.add_line(pose.position, pose * Vec3(length * Vec3::Unit(k)), colors[k], 1);
}

void Overlay::add_scan(Inspection& simulation, ObjectId sensor, render::DebugLines& lines) const {
  const std::span<const LiveProperty> properties = simulation.properties(sensor);
  const std::span<const double> ranges = values_of(properties, keys::ranges);
  const auto columns = value_of(properties, keys::laser_columns, 0U);
  const double increment = value_of(properties, keys::laser_angle_increment, 0.0);
  if (columns == 0 || (columns > 1 && increment == 0)) return;  // the sensor has a list of directions
  const Pose device = value_of(properties, keys::pose, Pose{}) * value_of(properties, keys::sensor_origin, Pose{});
  const double first = value_of(properties, keys::laser_min_angle, 0.0);
  const double low = value_of(properties, keys::laser_min_elevation, 0.0);
  const double step = value_of(properties, keys::laser_elevation_increment, 0.0);
  const double max_range = value_of(properties, keys::laser_max_range, 1e9);
  constexpr std::size_t max_points = 4000, max_lines = 90;
  const std::size_t point_stride = 1 + ranges.size() / max_points;
  const std::size_t line_stride = std::max<std::size_t>(point_stride, ranges.size() / max_lines);
  for (std::size_t i = 0; i < ranges.size(); i += point_stride) {
    const std::size_t row = i / columns;
    const double a = first + double(i % columns) * increment, e = low + double(row) * step;
    const Vec3 direction(elementary::cos(e) * elementary::cos(a), elementary::cos(e) * elementary::sin(a),
                         elementary::sin(e));
    const Vec3 end = device * Vec3(ranges[i] * direction);
    const bool hit = ranges[i] < max_range;
    if (hit) lines.add_point(end, red);
    if (i % line_stride < point_stride) lines.add_line(device.position, end, hit ? red : orange, hit ? 0.25 : 0.08);
  }
}

void Overlay::collect(Inspection& simulation, const BodyPoses& bodies, ObjectId selected,
                      render::DebugLines& lines) const {
  RobotId robot = no_robot;
  for (const BodyPoses::Body& b : bodies.links())
    if (b.object == selected) robot = b.robot;
  for (const BodyPoses::Body& b : bodies.links()) {
    const bool is_selected = b.object == selected;
    if (frames && b.is_base) add_frame(*b.pose, 0.4, lines);
    if (b.robot == robot && (frames || is_selected)) add_frame(*b.pose, is_selected ? 0.3 : 0.12, lines);
    if (contacts && b.is_base)
      for (const Contact& contact : values_of(simulation.properties(b.object), keys::contacts)) {
        lines.add_point(contact.point, orange);
        lines.add_line(contact.point, contact.point + 0.12 * contact.normal, orange, 1);
      }
  }
  if (scans)
    for (const ObjectId scanner : scanners_) add_scan(simulation, scanner, lines);
}

}  // namespace muro::view
