// SPDX-License-Identifier: MIT
#include "host/commands/compare_against.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/output_registry.hpp"
#include "host/commands/current_run.hpp"
#include "host/names.hpp"
#include "host/outputs/failures.hpp"
#include "host/outputs/messages.hpp"
#include "host/outputs/output_file.hpp"
#include "host/tools/compare/against_record.hpp"
#include "host/tools/compare/against_scans.hpp"
#include "host/tools/identify/identification.hpp"

namespace muro::host {

namespace {

struct RecordFile {
  std::string name, text;
};

std::vector<RecordFile> read_files(const std::vector<std::string>& names) {
  std::vector<RecordFile> files;
  for (const std::string& name : names) files.push_back({name, read_record_text(name)});
  return files;
}

/// Returns a simulation of the first variation, for inspection.
BuiltScenario build_first(const Comparison& comparison, const std::vector<Variation>& variations, Registry& registry) {
  return build(read_variation(comparison, variations.front().overrides, registry), registry,
               [](Simulation& simulation) {
                 simulation.set_log([](LogLevel, std::string_view) {});
                 simulation.keep_inputs_closed();
               });
}

/// Runs every variation on the commands of every record.
int compare_with_joints(const CompareOptions& options, const std::vector<RecordFile>& files,
                        const Comparison& comparison, const std::vector<Variation>& variations, Registry& registry) {
  if (!options.sensor.empty() || options.known_map)
    throw SetupError("--sensor and --known-map are for records of laser scanners, and " + files.front().name +
                     " is one of a joint");
  std::vector<MotorRecord> records;
  for (const RecordFile& f : files) records.push_back(parse_motor_record(f.text, f.name, {.commands_only = true}));
  joint_to_compare(*build_first(comparison, variations, registry).simulation, options.joint);
  const CurrentRun progress;
  Messages messages;
  std::vector<RecordDeviation> deviations;
  Identification drawn;  // for the picture: errors over time, one panel for each run
  for (const MotorRecord& r : records)
    for (const Variation& v : variations) {
      progress.show(v.label + " on " + r.name);
      deviations.push_back(
          run_against(comparison, v, options.joint, r, registry, [&](LogLevel level, std::string_view text) {
            progress.close();
            messages.log(level, text);
          }));
      progress.close();
      for (const std::string& n : deviations.back().notes) messages.say(n);
      PredictedRecord panel;
      panel.record = r;
      if (!v.label.empty()) panel.record.name += " " + v.label;
      panel.error = deviations.back().error;
      panel.residuals = deviations.back().residuals;
      drawn.records.push_back(std::move(panel));
    }
  std::string unwritten;
  Failures failures(unwritten);
  if (!options.table.empty()) failures.guard([&] { write_file(options.table, record_csv(records, deviations)); });
  if (!options.picture.empty())
    failures.guard([&] { write_file(options.picture, residual_plot(drawn, "the scenario")); });
  fmt::print("{}", record_table(records, deviations));
  if (!unwritten.empty()) throw StepError(unwritten);
  return std::all_of(deviations.begin(), deviations.end(), [](const RecordDeviation& d) { return d.failure.empty(); })
             ? 0
             : 1;
}

/// Returns "scan.svg" for the first record, "scan_2.svg" for the second.
std::string picture_of(const std::string& file, std::size_t record) {
  if (record == 0) return file;
  return fmt::format("{}_{}.svg", file.substr(0, file.size() - 4), record + 1);
}

/// Compares the scanner of every variation with every record.
int compare_with_scans(const CompareOptions& options, const std::vector<RecordFile>& files,
                       const Comparison& comparison, const std::vector<Variation>& variations, Registry& registry) {
  if (!options.joint.empty())
    throw SetupError("--joint is for records of a joint, and " + files.front().name + " is one of a laser scanner");
  std::vector<ScanRecord> records;
  for (const RecordFile& f : files) records.push_back(parse_scan_record(f.text, f.name));
  scanner_to_compare(*build_first(comparison, variations, registry).simulation, options.sensor);
  constexpr std::size_t fewest = 100, most = 2000;  // scans: enough simulated ones for the statistics
  std::size_t count = fewest;
  for (const ScanRecord& r : records) count = std::clamp(r.ranges.size(), count, most);
  const CurrentRun progress;
  Messages messages;
  std::vector<SimulatedScans> simulated;
  for (const Variation& v : variations) {
    progress.show(v.label);
    simulated.push_back(
        simulate_scans(comparison, v, options.sensor, count, registry, [&](LogLevel level, std::string_view text) {
          progress.close();
          messages.log(level, text);
        }));
    progress.close();
    for (const std::string& n : simulated.back().notes) messages.say(n);
  }
  std::vector<ScanDeviation> deviations;
  const auto first =
      std::find_if(simulated.begin(), simulated.end(), [](const SimulatedScans& s) { return s.failure.empty(); });
  if (first == simulated.end()) throw SetupError(simulated.front().failure);
  for (ScanRecord& r : records) {
    complete_scans(r, first->scans);
    for (const SimulatedScans& s : simulated) deviations.push_back(deviation_of(r, s, options.known_map));
  }
  std::string unwritten;
  Failures failures(unwritten);
  if (!options.table.empty()) failures.guard([&] { write_file(options.table, scan_csv(records, deviations)); });
  for (std::size_t i = 0; i < records.size(); ++i) {
    const auto begin = deviations.begin() + std::ptrdiff_t(i * variations.size());
    const std::vector<ScanDeviation> own(begin, begin + std::ptrdiff_t(variations.size()));
    if (!options.picture.empty())
      failures.guard([&] { write_file(picture_of(options.picture, i), scan_picture(records[i], own)); });
    fmt::print("{}{}", i == 0 ? "" : "\n", scan_table(records[i], own));
  }
  if (!unwritten.empty()) throw StepError(unwritten);
  return std::all_of(simulated.begin(), simulated.end(), [](const SimulatedScans& s) { return s.failure.empty(); }) ? 0
                                                                                                                    : 1;
}

}  // namespace

int compare_against(const CompareOptions& options, const Comparison& comparison,
                    const std::vector<Variation>& variations, Registry& registry) {
  const std::vector<RecordFile> files = read_files(options.against);
  const auto scans =
      std::count_if(files.begin(), files.end(), [](const RecordFile& f) { return is_scan_record(f.text); });
  if (scans == 0) return compare_with_joints(options, files, comparison, variations, registry);
  if (std::size_t(scans) < files.size())
    throw SetupError("--against has records of scans and of a joint; compare with one kind at a time");
  return compare_with_scans(options, files, comparison, variations, registry);
}

}  // namespace muro::host
