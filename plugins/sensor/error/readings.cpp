// SPDX-License-Identifier: MIT
#include "readings.hpp"

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/sensor/common/neighbours/neighbour.hpp"

namespace muro {

namespace {

template <class... Types>
bool is_one_of(const ValueType& type) {
  return ((type == value_type<Types>) || ...);
}

std::vector<std::string> names_of_readings(const Connector& c, ObjectId object) {
  std::vector<std::string> names;
  for (const FoundProperty& p : c.properties(object))
    if (is_reading(p)) names.emplace_back(p.key->name);
  return names;
}

/// Returns "; it has a, b", or what to do if there is no reading.
std::string what_there_is(const Connector& c, ObjectId object) {
  const std::vector<std::string> names = names_of_readings(c, object);
  return names.empty() ? "; add the sensor that writes it" : "; it has " + quoted_list(names);
}

}  // namespace

bool is_reading(const FoundProperty& p) {
  if (p.multiplicity == Multiplicity::list) return *p.key->type == value_type<neighbours::Neighbour>;
  if (p.is_sum || p.count == 0) return false;
  if (p.multiplicity == Multiplicity::array) return is_one_of<double, float>(*p.key->type);
  return is_one_of<double, Vec3, Twist, Wrench, Quat, Pose>(*p.key->type);
}

ReadingShape shape_of(const FoundProperty& p) {
  const ValueType& type = *p.key->type;
  const bool has_orientation = is_one_of<Quat, Pose>(type);
  ReadingShape shape{.name = p.key->name, .components = type.scalars()};
  if (p.multiplicity == Multiplicity::list)
    shape.form = ReadingForm::list, shape.components = 4;  // without the id
  else if (p.multiplicity == Multiplicity::array)
    shape.form = type == value_type<float> ? ReadingForm::image : ReadingForm::array, shape.components = p.count;
  else if (type == value_type<Vec3>)
    shape.form = ReadingForm::vector;
  else if (has_orientation)
    shape.form = type == value_type<Quat> ? ReadingForm::orientation : ReadingForm::pose, --shape.components;
  return shape;
}

FoundProperty find_reading(const Connector& c, ObjectId object, std::string_view name) {
  for (const FoundProperty& p : c.properties(object)) {
    if (p.key->name != name) continue;
    if (is_reading(p)) return p;
    throw Error(
        quote(name) + " of " + quote(c.object_name(object)) + " is not made of real numbers but of " +
        std::string(p.key->type->name) +
        (p.multiplicity == Multiplicity::list    ? ", in a list"
         : p.multiplicity == Multiplicity::array ? ", in an array"
                                                 : "") +
        "; sensor.error works on numbers, on arrays of f64 and f32, on Vec3, Twist, Wrench, Quat and Pose, and on the "
        "neighbours of sensor.neighbours");
  }
  throw Error(quote(c.object_name(object)) + " has no property " + quote(name) + what_there_is(c, object));
}

std::vector<FoundProperty> readings_of_part(const Connector& c, ObjectId object, const Part& part) {
  std::vector<FoundProperty> found;
  std::vector<std::string> known;
  for (const PartSection& s : part.sections) {
    known.push_back(s.reading);
    for (const FoundProperty& p : c.properties(object))
      if (p.key->name == s.reading && is_reading(p)) {
        found.push_back(p);
        break;
      }
  }
  if (found.empty())
    throw Error(quote(c.object_name(object)) + " has none of the readings of the part (" + quoted_list(known) + ")" +
                what_there_is(c, object));
  return found;
}

}  // namespace muro
