// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <thread>

#include "core/error.hpp"
#include "host/commands/commands.hpp"
#include "host/names.hpp"
#include "host/outputs/failures.hpp"
#include "host/outputs/output_file.hpp"
#include "host/tools/identify/identification.hpp"
#include "host/tools/identify/known_motors.hpp"

namespace muro::host {

namespace {

bool ends_with(const std::string& file, const std::string& end) {
  return file.size() > end.size() && file.compare(file.size() - end.size(), end.size(), end) == 0;
}

/// Called before the search, which takes long.
void check_identify_files(const IdentifyOptions& o) {
  for (const std::string& file : o.reports)
    if (!ends_with(file, ".md") && !ends_with(file, ".json"))
      throw SetupError("--report " + in_backquotes(file) + ": reports are Markdown (*.md) or JSON (*.json)");
  if (!o.plot.empty() && !ends_with(o.plot, ".svg"))
    throw SetupError("--plot " + in_backquotes(o.plot) + ": pictures are SVG files, so name it *.svg");
  std::vector<std::string> outputs = o.reports;
  outputs.push_back(o.plot);
  outputs.push_back(o.fragment);
  for (const std::string& file : outputs) {
    if (file.empty()) continue;
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    if (!std::filesystem::is_directory(folder))
      throw SetupError(in_backquotes(file) + " cannot be written: there is no folder " +
                       in_backquotes(folder.string()));
    for (const auto* inputs : {&o.records, &o.validate})
      for (const std::string& input : *inputs) {
        std::error_code none;
        if (std::filesystem::equivalent(file, input, none))
          throw SetupError(in_backquotes(file) + " is a record; it would be overwritten");
      }
  }
}

std::optional<double> fraction_of(const std::vector<std::string>& validate) {
  if (validate.size() != 1) return std::nullopt;
  double x = 0;
  const std::string& text = validate.front();
  const auto [used, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  if (code != std::errc{} || used != text.data() + text.size()) return std::nullopt;
  if (!(x > 0 && x < 1)) throw SetupError("--validate " + text + ": a part of the records is above 0 and below 1");
  return x;
}

/// Leaves out the records for validation, however their paths are written: an error on fitted records proves nothing.
std::vector<std::string> left_for_the_fit(const IdentifyOptions& o) {
  const auto is_validated = [&](const std::string& file) {
    return std::any_of(o.validate.begin(), o.validate.end(), [&](const std::string& other) {
      std::error_code ignored;
      return std::filesystem::equivalent(file, other, ignored);
    });
  };
  std::vector<std::string> left;
  std::remove_copy_if(o.records.begin(), o.records.end(), std::back_inserter(left), is_validated);
  if (left.empty()) throw SetupError("--validate names every record; leave some of them for the fit");
  return left;
}

/// Moves the share `part` of the records, chosen at random, to the result.
std::vector<MotorRecord> take_part(std::vector<MotorRecord>& records, double part, std::uint64_t seed) {
  const auto count = std::size_t(std::lround(part * double(records.size())));
  if (count == 0 || count >= records.size())
    throw SetupError(fmt::format("--validate {:g} of {} records leaves none on one side", part, records.size()));
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  std::uint64_t state = seed;
  for (std::size_t i = 0; i < records.size(); ++i) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    order.emplace_back(state >> 20, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(order[k].second);
  std::sort(chosen.begin(), chosen.end());
  std::vector<MotorRecord> out;
  for (const std::size_t i : chosen) out.push_back(std::move(records[i]));
  for (std::size_t k = chosen.size(); k-- > 0;) records.erase(records.begin() + std::ptrdiff_t(chosen[k]));
  return out;
}

/// Returns the name of the motor; empty when no record gives it. Records of several motors are refused.
std::string motor_of(const std::vector<const MotorRecord*>& records) {
  const MotorRecord* named = nullptr;
  for (const MotorRecord* r : records) {
    if (r->motor.empty()) continue;
    if (!named) named = r;
    if (r->motor != named->motor)
      throw SetupError(fmt::format("{} is of {} and {} of {}; identify one motor at a time", named->name,
                                   in_backquotes(named->motor), r->name, in_backquotes(r->motor)));
  }
  return named ? named->motor : "";
}

/// Records whose duties give another gain than the others keep their own.
void keep_recorded_gains(std::vector<MotorRecord>& records, double gain) {
  for (MotorRecord& r : records) {
    const double told = r.duty_gain > 0 ? 0 : recorded_gain({r});
    if (!(told > 0) || std::abs(told / gain - 1) <= recorded_gain_tolerance) continue;
    r.duty_gain = told;
    r.notes.push_back(
        fmt::format("{}: its duties say a gain of {:.4g} /rad for each unit of the P gain, which is used for it in "
                    "place of {:.4g} (--duty-gain is for all)",
                    r.name, told, gain));
  }
}

/// Returns the value of the first record when all records have one of their own; no other value is then used.
std::optional<double> own_of_all(std::vector<MotorRecord>& records, double MotorRecord::*what, const char* name) {
  if (!std::all_of(records.begin(), records.end(), [&](const MotorRecord& r) { return r.*what > 0; })) return {};
  MotorRecord& first = records.front();
  for (const MotorRecord& r : records) {
    if (r.*what == first.*what) continue;
    first.notes.push_back(
        fmt::format("records differ in `{}`: {} has {:.4g}, {} has {:.4g}; each is used for its own, "
                    "and the scenario gets the first",
                    name, first.name, first.*what, r.name, r.*what));
    break;
  }
  return first.*what;
}

/// Sets the firmware's gain and limit: from the command line, each record, the motor that they name, or their duties.
void set_firmware(const IdentifyOptions& o, std::vector<MotorRecord>& fit, std::vector<MotorRecord>& validation,
                  FitSettings& s) {
  std::vector<const MotorRecord*> all;
  for (auto* const records : {&fit, &validation})
    for (MotorRecord& r : *records) {
      if (o.duty_gain) r.duty_gain = 0;
      if (o.duty_limit) r.duty_limit = 0;
      all.push_back(&r);
    }
  const std::string motor = motor_of(all);
  const KnownMotor* const known = known_motor(motor);
  s.gain = o.duty_gain ? *o.duty_gain : known ? known->duty_gain : recorded_gain(fit);
  s.duty_limit = o.duty_limit ? *o.duty_limit : known ? known->duty_limit : 1;
  if (s.fit_gain && !o.duty_gain) s.gain = recorded_gain(fit);
  const bool each_has = std::all_of(all.begin(), all.end(), [](const MotorRecord* r) { return r->duty_gain > 0; });
  if (each_has) s.gain = fit.front().duty_gain;
  if (each_has && s.fit_gain)
    throw SetupError("--fit gain: every record says its `duty_gain`, so there is none to find");
  if (s.gain > 0 && !s.fit_gain && !o.duty_gain)
    for (auto* const records : {&fit, &validation}) keep_recorded_gains(*records, s.gain);
  if (const std::optional<double> own = own_of_all(fit, &MotorRecord::duty_gain, "duty_gain")) s.gain = *own;
  if (const std::optional<double> own = own_of_all(fit, &MotorRecord::duty_limit, "duty_limit")) s.duty_limit = *own;
  if (s.gain > 0 || s.fit_gain) return;
  throw SetupError(
      "how the firmware turns its P gain into a duty is not known of " +
      (motor.empty() ? "this motor" : in_backquotes(motor)) +
      ", and no duty is recorded; give --duty-gain (1/rad for each unit of the P gain), or have it found: --fit gain");
}

void check_temperatures(const std::vector<MotorRecord>& records) {
  for (const MotorRecord& r : records)
    if (!r.has_temperature)
      throw SetupError("--fit temperature: " + r.name + " has no temperatures (column `temperature`, degrees Celsius)");
  const TemperatureSpan span = *temperature_span(records);
  if (span.high - span.low < least_temperature_span)
    throw SetupError(
        fmt::format("--fit temperature: the records are all of {:g} to {:g} degrees Celsius; record the "
                    "motor cold and warm, {:g} K apart or more",
                    span.low, span.high, least_temperature_span));
}

class SearchProgress {
 public:
  void show(const std::string& what, double part) {
    if (!shown_) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    fmt::print(stderr, "\r\033[K{}: {:.0f} %", what, 100 * part);
    std::fflush(stderr);
  }
  void close() const {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  std::mutex mutex_;
  bool shown_ = isatty(STDERR_FILENO) != 0;
};

}  // namespace

int identify(const IdentifyOptions& o) {
  if (!can_fit())
    throw SetupError("this muro was built without NLopt, which `muro identify` needs (Debian: libnlopt-cxx-dev)");
  FitSettings settings;
  settings.friction = friction_kind_of(o.model);
  for (const std::string& what : o.fit) {
    if (what != "gain" && what != "delay" && what != "temperature")
      throw SetupError("--fit " + in_backquotes(what) + suggestion(what, {"gain", "delay", "temperature"}));
    (what == "gain" ? settings.fit_gain : what == "delay" ? settings.fit_delay : settings.fit_temperature) = true;
  }
  settings.seed = o.seed;
  settings.threads = o.threads > 0 ? o.threads : std::max(1u, std::thread::hardware_concurrency());
  check_identify_files(o);

  const RecordDefaults defaults{o.p_gain, o.supply_voltage, o.mass, o.length, o.arm_mass, o.inertia};
  std::vector<MotorRecord> records, validation;
  const std::optional<double> part = fraction_of(o.validate);
  for (const std::string& file : part ? o.records : left_for_the_fit(o))
    records.push_back(read_motor_record(file, defaults));
  if (part)
    validation = take_part(records, *part, o.seed);
  else
    for (const std::string& file : o.validate) validation.push_back(read_motor_record(file, defaults));
  set_firmware(o, records, validation, settings);
  if (settings.fit_temperature) check_temperatures(records);

  SearchProgress progress;
  const Identification id = identify_motor(std::move(records), std::move(validation), settings, o.cross_validate,
                                           [&](const std::string& what, double done) { progress.show(what, done); });
  progress.close();
  std::string unwritten;
  Failures failures(unwritten);
  for (const std::string& file : o.reports)
    failures.guard([&] { write_file(file, ends_with(file, ".json") ? report_json(id) : report_text(id, true)); });
  if (!o.plot.empty()) failures.guard([&] { write_file(o.plot, residual_plot(id)); });
  if (!o.fragment.empty()) failures.guard([&] { write_file(o.fragment, scenario_fragment(id)); });
  fmt::print("{}", report_text(id, false));
  if (!unwritten.empty()) throw StepError(unwritten);
  return 0;
}

}  // namespace muro::host
