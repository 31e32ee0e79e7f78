// SPDX-License-Identifier: MIT
#include "laser.hpp"

#include <cmath>
#include <cstdio>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::scip2 {

namespace {

const FoundProperty* property(const Connector& c, ObjectId object, std::string_view name) {
  for (const FoundProperty& p : c.properties(object))
    if (p.key->name == name && p.multiplicity == Multiplicity::array && *p.key->type == value_type<double>) return &p;
  return nullptr;
}

bool is_laser(const Connector& c, ObjectId object) {
  return property(c, object, keys::ranges.name) && c.constant(object, keys::laser_columns);
}

ArrayIn<double> bound(Connector& c, ObjectId object, std::string_view name) {
  const FoundProperty* p = property(c, object, name);
  return p ? ArrayIn<double>(c.read_any(FoundProperty(*p))) : ArrayIn<double>();
}

/// Returns laser parameters that fit a device exactly, for messages.
std::string fitting_rays(const Model& m) {
  char text[128];
  std::snprintf(text, sizeof text, "min_angle: %.6f, max_angle: %.6f, rays: %u", m.angle_of(m.first_step),
                m.angle_of(m.last_step), m.step_count());
  return text;
}

}  // namespace

ObjectId Laser::find(const Connector& c, const Item& item) {
  if (is_laser(c, item.object)) return item.object;
  std::string names;
  ObjectId found = no_object;
  int count = 0;
  for (std::uint32_t o = 0; o < c.object_count() && item.robot; ++o) {
    if (c.robot_of(ObjectId{o}) != item.robot->id || !is_laser(c, ObjectId{o})) continue;
    found = ObjectId{o};
    names += (count++ ? ", " : "") + quote(c.object_name(found));
  }
  if (count == 1) return found;
  const std::string owner = item.robot ? "robot " + quote(item.robot->name) : "the world";
  if (count == 0)
    throw Error(owner +
                " has no laser for the device to report; give it one, such as {use: laser.raycast}, and name it " +
                "by `on`");
  throw Error(owner + " has several lasers: " + names + "; say by `on` whose readings the device reports");
}

bool Laser::is_swept(const Connector& c, ObjectId laser) { return property(c, laser, "laser.sweep.ranges") != nullptr; }

void Laser::bind(Connector& c, ObjectId laser, const Model& model) {
  const std::string name = quote(c.object_name(laser));
  read_grid(c, laser, name);
  truth_ = bound(c, laser, keys::ranges.name);
  measured_ = bound(c, laser, keys::measured_ranges.name);
  if (!measured_) measured_ = truth_;
  incidence_ = bound(c, laser, keys::laser_incidence.name);
  const Readings readings(model, grid_);
  const std::uint32_t missing = readings.steps_without_ray(), all = model.step_count();
  if (missing == all)
    throw Error("no ray of " + name + " looks where the " + std::to_string(all) +
                " steps of the device look; give the laser " + fitting_rays(model));
  if (missing > 0)
    c.host().log(LogLevel::warning, std::to_string(missing) + " of " + std::to_string(all) +
                                        " steps of the device have no ray of " + name +
                                        " and read 0; what covers them is " + fitting_rays(model));
  if (readings.rays_per_step() < 0.6)
    c.host().log(LogLevel::warning, "rays of " + name +
                                        " are farther apart than steps of the device, so that several " +
                                        "steps read the same ray; as fine as the device is " + fitting_rays(model));
}

void Laser::read_grid(Connector& c, ObjectId laser, const std::string& name) {
  grid_.columns = *c.constant(laser, keys::laser_columns);
  grid_.min_angle = c.constant(laser, keys::laser_min_angle).value_or(0);
  grid_.angle_increment = c.constant(laser, keys::laser_angle_increment).value_or(0);
  if (grid_.columns > 1 && !(grid_.angle_increment > 0))
    throw Error(name + " looks along a list of directions, which no property tells; the device needs rays at equal " +
                "steps: replace `directions` by `min_angle`, `max_angle` and `rays`");
  const std::uint32_t rows = c.constant(laser, keys::laser_rows).value_or(1);
  const double first = c.constant(laser, keys::laser_min_elevation).value_or(0);
  const double spacing = c.constant(laser, keys::laser_elevation_increment).value_or(0);
  std::uint32_t level = 0;  // the row nearest to the horizontal
  for (std::uint32_t row = 1; row < rows; ++row)
    if (std::abs(first + row * spacing) < std::abs(first + level * spacing)) level = row;
  grid_.first_ray = level * grid_.columns;
  max_range_ = c.constant(laser, keys::laser_max_range).value_or(1e9);
}

void Laser::read(const Readings& readings, std::span<std::uint32_t> distances,
                 std::span<std::uint32_t> intensities) const {
  const LaserScan scan{*measured_, *truth_, incidence_ ? *incidence_ : std::span<const double>(), max_range_};
  readings.read(scan, distances, intensities);
}

}  // namespace muro::scip2
