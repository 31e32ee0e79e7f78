// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/names.hpp"
#include "host/outputs/output_file.hpp"
#include "host/outputs/output_options.hpp"
#include "host/process/interrupt.hpp"
#include "host/tools/sensors/allan_report.hpp"

namespace muro::host {

namespace {

constexpr std::size_t fewest_samples = 20, most_numbers = 200'000'000;

void check_picture(const std::string& file) {
  if (!file.empty() && !file.ends_with(".svg"))
    throw SetupError(fmt::format("--out {}: pictures are SVG files, so name it *.svg", file));
}

std::uint64_t samples_in(const SensorReading& reading, double duration) {
  const std::int64_t end = std::llround(duration * 1e9);
  const std::uint64_t count = end <= reading.phase ? 0 : reading.rate.first_from(end - reading.phase);
  if (count < fewest_samples)
    throw SetupError(fmt::format(
        "`{}` of `{}` is read {} in {:g} s, at {:g} Hz; an Allan deviation takes at least {}: "
        "give a longer --duration",
        reading.property, reading.sensor, plural(count, "time"), duration, reading.rate.hertz(), fewest_samples));
  if (count * reading.labels.size() > most_numbers)
    throw SetupError(fmt::format("`{}` of `{}` are {} numbers in {:g} s, more than fit; give a shorter --duration",
                                 reading.property, reading.sensor, count * reading.labels.size(), duration));
  return count;
}

/// Returns the samples of all readings of one rate: [reading][component][sample].
std::vector<std::vector<std::vector<double>>> record(Simulation& simulation, const std::vector<SensorReading>& readings,
                                                     std::uint64_t count) {
  std::vector<std::vector<std::vector<double>>> all(readings.size());
  for (std::size_t r = 0; r < readings.size(); ++r) {
    all[r].resize(readings[r].labels.size());
    for (auto& component : all[r]) component.reserve(count);
  }
  for (std::uint64_t k = 0; k < count; ++k) {
    simulation.run_until(readings.front().time_after(k), Interrupt::pending);
    if (Interrupt::pending() || simulation.stopped()) break;
    for (std::size_t r = 0; r < readings.size(); ++r)
      for (std::size_t i = 0; i < all[r].size(); ++i) all[r][i].push_back(readings[r].values[i]);
  }
  return all;
}

}  // namespace

int allan(const AllanOptions& options) {
  check_picture(options.picture);
  Registry registry(Registry::search_path(options.scenario.plugin_path));
  BuiltScenario built = open_scenario(open_file(options.scenario, registry), registry, [&](Simulation& s) {
    add_outputs(s, {{"--out", options.picture}});
  });
  Simulation& simulation = *built.simulation;
  std::vector<SensorReading> readings = find_readings(simulation, options.sensor, options.reading);
  if (!options.picture.empty() && readings.size() > 1) {
    std::vector<std::string> names;
    for (const SensorReading& r : readings) names.push_back(r.property);
    throw SetupError(
        fmt::format("--out {}: a picture shows one reading, and `{}` has several; choose one by --reading: "
                    "{}",
                    options.picture, readings.front().sensor, comma_separated(names)));
  }
  // readings of another rate would need a run of their own
  std::erase_if(readings, [&](const SensorReading& r) {
    const bool other = r.rate != readings.front().rate || r.phase != readings.front().phase;
    if (other)
      fmt::print(stderr, "note: {} has another rate than {}; choose it by --reading\n", r.property,
                 readings.front().property);
    return other;
  });
  const std::uint64_t count = samples_in(readings.front(), options.duration.value_or(built.scenario.duration));
  const Interrupt interrupt;
  const auto samples = record(simulation, readings, count);
  if (samples.front().front().size() < fewest_samples) return Interrupt::pending() ? 130 : 1;
  for (std::size_t r = 0; r < readings.size(); ++r) {
    const AllanCurves curves = allan_curves(readings[r], samples[r]);
    if (!options.picture.empty()) write_file(options.picture, allan_picture(curves, built.scenario.name));
    fmt::print("{}{}", r > 0 ? "\n" : "", allan_table(curves));
  }
  return Interrupt::pending() ? 130 : 0;
}

}  // namespace muro::host
