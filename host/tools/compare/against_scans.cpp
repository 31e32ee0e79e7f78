// SPDX-License-Identifier: MIT
#include "host/tools/compare/against_scans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/instance.hpp"
#include "core/output_registry.hpp"
#include "host/names.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Returns a number that a scanner has stored on its object; NaN when there is none.
template <class T>
double constant_of(const World& world, ObjectId object, const Key<T>& key) {
  const T* const found = world.find_constant(object, key);
  return found ? double(*found) : no_range;
}

/// The readings of a scanner, and the algorithm that writes them.
class ScannerReadings {
 public:
  ScannerReadings(Simulation& simulation, const std::string& sensor)
      : simulation_(simulation), object_(simulation.world().object(sensor)) {
    const World& world = simulation.world();
    truth_ = world.store().find(object_, keys::ranges.name);
    const Slot* with_errors = world.store().find(object_, std::string(keys::ranges.name) + ".measured");
    read_ = with_errors ? with_errors : truth_;
    has_errors_ = with_errors != nullptr;
    for (const auto& instance : simulation.instances())
      if (read_->writer() && instance->accessor() == read_->writer()->accessor)
        rate_ = instance->setup().rate, phase_ = instance->setup().phase;
    if (rate_.on_demand())
      throw SetupError(in_backquotes(sensor) + " scans on demand; give it and its sensor.error a `rate`");
    if (constant_of(world, object_, keys::laser_rows) != 1)
      throw SetupError(in_backquotes(sensor) + " scans several rows; scans are compared of one row (`rows: 1`)");
    if (!(constant_of(world, object_, keys::laser_angle_increment) > 0))
      throw SetupError(in_backquotes(sensor) + " scans a list of directions; give it `min_angle` and `max_angle`");
  }

  bool has_errors() const { return has_errors_; }
  std::vector<double> present() const { return values_of(*read_); }
  /// Returns the ranges without errors; no_range where nothing is seen.
  std::vector<double> truth() const {
    std::vector<double> ranges = values_of(*truth_);
    const double most = constant_of(simulation_.world(), object_, keys::laser_max_range);
    for (double& r : ranges)
      if (!(r < most)) r = no_range;
    return ranges;
  }
  void run_to_scan(std::uint64_t k) { simulation_.run_until(phase_ + rate_.time_of(k) + 1); }
  Pose place() {
    simulation_.refresh();
    return simulation_.world().value(object_, keys::pose);
  }

  /// Returns a record with directions and limits, without ranges.
  ScanRecord empty_record() const {
    const World& world = simulation_.world();
    ScanRecord r;
    r.name = world.object_name(object_);
    const double first = constant_of(world, object_, keys::laser_min_angle),
                 step = constant_of(world, object_, keys::laser_angle_increment);
    for (std::uint32_t i = 0; i < read_->count; ++i) r.angles.push_back(first + i * step);
    r.range_min = constant_of(world, object_, keys::laser_min_range);
    r.range_max = constant_of(world, object_, keys::laser_max_range);
    return r;
  }

 private:
  static std::vector<double> values_of(const Slot& slot) {
    const auto* values = static_cast<const double*>(slot.place);
    return {values, values + slot.count};
  }

  Simulation& simulation_;
  ObjectId object_;
  const Slot *truth_ = nullptr, *read_ = nullptr;
  bool has_errors_ = false;
  Rate rate_;
  std::int64_t phase_ = 0;
};

/// Removes readings outside of the device's range, which are no distances.
void limit_to_device(ScanRecord& r) {
  constexpr double just = 1e-9;  // m; a reading of range_max means that nothing was seen
  r.limit(std::max(r.range_min, just), r.range_max - just);
}

/// Returns, for each beam of the record, the true range of the ray in this direction.
std::vector<double> true_ranges_for(const ScanRecord& record, const SimulatedScans& simulated) {
  const std::vector<double>& angles = simulated.scans.angles;
  std::vector<double> all;
  const double half = angles.size() > 1 ? 0.5 * (angles[1] - angles[0]) : 0;
  for (const double angle : record.angles) {
    const auto next = std::lower_bound(angles.begin(), angles.end(), angle - half);
    const bool is_seen = next != angles.end() && *next - angle <= half;
    all.push_back(is_seen ? simulated.true_ranges[std::size_t(next - angles.begin())] : no_range);
  }
  return all;
}

}  // namespace

std::string scanner_to_compare(const Simulation& simulation, const std::string& wanted) {
  std::vector<std::string> all;
  const World& world = simulation.world();
  for (ObjectId o{}; index_of(o) < world.object_count(); o = ObjectId(index_of(o) + 1))
    if (world.has(o, keys::ranges.name) && world.has(o, keys::laser_min_angle.name))
      all.push_back(world.object_name(o));
  if (all.empty()) throw SetupError("--against is a record of scans, and the scenario has no laser scanner");
  if (wanted.empty() && all.size() == 1) return all.front();
  if (wanted.empty())
    throw SetupError("--against needs --sensor ROBOT/LASER: the scanner to compare; there are: " +
                     comma_separated(all));
  if (std::find(all.begin(), all.end(), wanted) == all.end())
    throw SetupError("--sensor " + in_backquotes(wanted) + ": there is no such laser scanner" +
                     suggestion(wanted, all));
  return wanted;
}

SimulatedScans simulate_scans(const Comparison& comparison, const Variation& variation, const std::string& sensor,
                              std::size_t count, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log) {
  SimulatedScans result;
  result.label = variation.label;
  try {
    const BuiltScenario built = build_variation(comparison, variation, registry, log);
    result.notes = built.notes;
    ScannerReadings readings(*built.simulation, scanner_to_compare(*built.simulation, sensor));
    result.scans = readings.empty_record();
    const std::string& name = result.scans.name;
    const Vec3 start = readings.place().position;
    for (std::size_t k = 0; k < count && !built.simulation->stopped(); ++k) {
      readings.run_to_scan(k);
      result.scans.ranges.push_back(readings.present());
    }
    result.true_ranges = readings.truth();
    limit_to_device(result.scans);
    constexpr double still = 1e-3;  // m
    if (const double moved = (readings.place().position - start).norm(); !(moved < still))
      result.notes.push_back(
          fmt::format("{} has moved by {:.2g} m while it scanned; scans are compared of a scanner "
                      "that stands still",
                      name, moved));
    if (!readings.has_errors()) result.notes.push_back(name + " has no sensor.error, so its ranges are the true ones");
  } catch (const OutputError&) {
    throw;
  } catch (const std::exception& e) {
    result.failure = e.what();
  }
  return result;
}

void complete_scans(ScanRecord& record, const ScanRecord& simulated) {
  if (record.angles.empty() && record.beam_count() != simulated.angles.size())
    throw SetupError(
        fmt::format("{}: it does not say its directions (`# angle_min: ...`, `# angle_increment: ...`, "
                    "rad), and has {} beams while {} has {}",
                    record.name, record.beam_count(), simulated.name, simulated.angles.size()));
  if (record.angles.empty()) {
    record.angles = simulated.angles;
    record.notes.push_back(record.name + ": it does not say its directions; those of " + simulated.name + " are taken");
  }
  if (record.range_max > 0) return;
  record.range_min = std::max(record.range_min, simulated.range_min), record.range_max = simulated.range_max;
  record.notes.push_back(
      fmt::format("{}: it does not say its limits (`# range_min: ...`, `# range_max: ...`, m); "
                  "those of {} are taken, {:g} to {:g} m",
                  record.name, simulated.name, record.range_min, record.range_max));
  limit_to_device(record);
}

ScanDeviation deviation_of(const ScanRecord& record, const SimulatedScans& simulated, bool known_map) {
  ScanDeviation d;
  d.label = simulated.label, d.failure = simulated.failure;
  const bool is_known = known_map && d.failure.empty();
  d.recorded = statistics_of(record, is_known ? true_ranges_for(record, simulated) : std::vector<double>{});
  if (d.failure.empty())
    d.simulated = statistics_of(simulated.scans, known_map ? simulated.true_ranges : std::vector<double>{});
  return d;
}

}  // namespace muro::host
