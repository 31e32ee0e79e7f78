// SPDX-License-Identifier: MIT
#include "host/tools/sensors/sensor_reading.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/instance.hpp"
#include "host/names.hpp"

namespace muro::host {

namespace {

constexpr std::string_view measured = ".measured";
constexpr std::size_t most_components = 16;

/// A property that a sensor or a sensor.error writes.
struct Found {
  std::string name;
  const Slot* slot;
  const Instance* writer;

  bool has_errors() const { return name.size() > measured.size() && name.ends_with(measured); }
  std::string truth() const { return has_errors() ? name.substr(0, name.size() - measured.size()) : name; }
};

class SensorObjects {
 public:
  explicit SensorObjects(const Simulation& simulation) : world_(simulation.world()) {
    for (const auto& instance : simulation.instances()) {
      const Kind kind = instance->description().kind;
      if (kind == Kind::sensor || kind == Kind::sensor_error)
        by_accessor_.emplace(instance->accessor(), instance.get());
    }
  }

  /// Returns the readings that devices write on an object: numbers, few enough to be checked one by one.
  std::vector<Found> readings(ObjectId object) const {
    std::vector<Found> all;
    for (const auto& [key, id] : world_.store().properties(object)) {
      const Slot& slot = world_.store().slot(id);
      const Slot::User* user = slot.writer();
      const auto writer = user ? by_accessor_.find(user->accessor) : by_accessor_.end();
      const ValueType& type = *world_.store().key_of(slot).type;
      const bool is_angle = std::find(type.labels.begin(), type.labels.end(), "qw") != type.labels.end();
      if (writer == by_accessor_.end() || slot.multiplicity == Multiplicity::list || type.scalar != Scalar::f64 ||
          is_angle || std::size_t(slot.count) * type.scalars() > most_components)
        continue;
      all.push_back({std::string(key), &slot, writer->second});
    }
    return all;
  }

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (ObjectId o{}; index_of(o) < world_.object_count(); o = ObjectId(index_of(o) + 1))
      if (!readings(o).empty()) all.push_back(world_.object_name(o));
    return all;
  }

  ObjectId find(const std::string& sensor) const {
    std::vector<std::string> same;
    const std::vector<std::string> all = names();
    for (const std::string& name : all) {
      if (name == sensor) return world_.object(name);
      if (name.ends_with("/" + sensor)) same.push_back(name);
    }
    if (same.size() == 1) return world_.object(same.front());
    if (same.size() > 1)
      throw SetupError(
          fmt::format("--sensor {}: several robots have it; choose one of: {}", sensor, comma_separated(same)));
    throw SetupError(fmt::format("--sensor {}: there is no sensor of this name whose readings are numbers{}", sensor,
                                 all.empty() ? "; the scenario has none" : suggestion(sensor, all)));
  }

 private:
  const World& world_;
  std::map<Accessor, const Instance*> by_accessor_;
};

/// Returns a constant that sensor.error has stored for a reading; zeros when there is none.
std::vector<double> figure(const World& world, ObjectId object, const std::string& truth, const char* name,
                           std::size_t components) {
  std::vector<double> numbers(components, 0.0);
  const Slot* slot = world.store().find(object, truth + ".error." + name);
  if (!slot || slot->kind != Slot::Class::constant || world.store().key_of(*slot).type->scalar != Scalar::f64)
    return numbers;
  const auto* values = static_cast<const double*>(slot->place);
  const bool one_each = world.store().key_of(*slot).type->scalars() == components;
  for (std::size_t i = 0; i < components; ++i) numbers[i] = values[one_each ? i : 0];
  return numbers;
}

std::vector<NoiseFigures> figures(const World& world, ObjectId object, const std::string& truth,
                                  std::size_t components) {
  std::vector<NoiseFigures> all(components);
  const std::pair<const char*, double NoiseFigures::*> members[] = {
      {"noise_density", &NoiseFigures::noise_density},
      {"bias_instability", &NoiseFigures::bias_instability},
      {"flicker_from", &NoiseFigures::flicker_from},
      {"flicker_to", &NoiseFigures::flicker_to},
      {"random_walk", &NoiseFigures::random_walk},
      {"gauss_markov_sigma", &NoiseFigures::gauss_markov_sigma},
      {"gauss_markov_time", &NoiseFigures::gauss_markov_time},
      {"resolution", &NoiseFigures::resolution}};
  for (const auto& [name, member] : members) {
    const std::vector<double> numbers = figure(world, object, truth, name, components);
    for (std::size_t i = 0; i < components; ++i) all[i].*member = numbers[i];
  }
  return all;
}

SensorReading reading_of(const World& world, ObjectId object, const Found& found) {
  const KeyInfo& key = world.store().key_of(*found.slot);
  SensorReading r;
  r.sensor = world.object_name(object);
  r.property = found.name;
  r.unit = key.unit;
  r.rate = found.writer->setup().rate;
  r.phase = found.writer->setup().phase;
  r.values = static_cast<const double*>(found.slot->place);
  const bool is_array = found.slot->multiplicity == Multiplicity::array;
  for (std::uint32_t i = 0; i < found.slot->count * key.type->scalars(); ++i)
    r.labels.push_back(is_array                   ? std::to_string(i)
                       : key.type->labels.empty() ? std::string()
                                                  : std::string(key.type->labels[i]));
  r.figures = figures(world, object, found.truth(), r.labels.size());
  if (r.rate.on_demand())
    throw SetupError(fmt::format("`{}` of `{}` is written on demand; give its sensor and its sensor.error a `rate`",
                                 r.property, r.sensor));
  return r;
}

}  // namespace

std::vector<SensorReading> find_readings(const Simulation& simulation, const std::string& sensor,
                                         const std::string& reading) {
  const SensorObjects sensors(simulation);
  const ObjectId object = sensors.find(sensor);
  std::vector<SensorReading> chosen;
  std::vector<std::string> names;
  const std::vector<Found> all = sensors.readings(object);
  for (const Found& f : all) {
    const bool is_hidden = std::any_of(all.begin(), all.end(), [&](const Found& other) {
      return other.has_errors() && other.truth() == f.name;  // its reading with errors replaces it
    });
    if (is_hidden) continue;
    names.push_back(f.truth());
    if (reading.empty() ? f.has_errors() : reading == f.name || reading == f.truth())
      chosen.push_back(reading_of(simulation.world(), object, f));
  }
  if (!chosen.empty()) return chosen;
  const std::string& name = simulation.world().object_name(object);
  if (reading.empty())
    throw SetupError(
        fmt::format("`{}` has no sensor.error, so its readings are true; add one `on` it, or choose a "
                    "reading by --reading: {}",
                    name, comma_separated(names)));
  throw SetupError(
      fmt::format("--reading {}: `{}` has no such reading of numbers{}", reading, name, suggestion(reading, names)));
}

}  // namespace muro::host
