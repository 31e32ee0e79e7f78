// SPDX-License-Identifier: MIT
#include "host/tools/identify/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/tools/identify/record_text.hpp"
#include "muro/base/input_file.hpp"

namespace muro::host {

namespace {

constexpr std::size_t largest_record = std::size_t(1) << 28;  // bytes

void check_constant(const MotorRecord& r, double value, bool zero_is_fine, const char* what, const char* option) {
  if (std::isfinite(value) && (zero_is_fine ? value >= 0 : value > 0)) return;
  throw SetupError(fmt::format("{}: {} is {:g}, which is not {}; the record says it, or {}", r.name, what, value,
                               zero_is_fine ? "0 or more" : "above 0", option));
}

/// Checks the period. `longest` (s): the longest usual period.
void check_period(const MotorRecord& r, double longest) {
  constexpr double shortest = 1e-5;
  std::vector<double> periods;
  for (std::size_t i = 1; i < r.samples.size(); ++i) periods.push_back(r.samples[i].time - r.samples[i - 1].time);
  const auto middle = periods.begin() + std::ptrdiff_t(periods.size() / 2);
  std::nth_element(periods.begin(), middle, periods.end());
  if (*middle >= shortest && *middle <= longest) return;
  throw SetupError(fmt::format("{}: its samples are {:g} s apart, and {:g} to {:g} s is what is of use; times are in s",
                               r.name, *middle, shortest, longest));
}

}  // namespace

TextPlace place_in(const std::string& text, std::size_t offset) {
  offset = std::min(offset, text.size());
  const auto end = text.begin() + std::ptrdiff_t(offset);
  const std::size_t begin = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  return {std::size_t(std::count(text.begin(), end, '\n')) + 1,
          begin == std::string::npos ? offset + 1 : offset - begin};
}

SetupError record_error(const std::string& name, TextPlace place, const std::string& what) {
  return SetupError(fmt::format("{}:{}:{}: {}", name, place.line, place.column, what));
}

void complete_record(MotorRecord& r, const RecordDefaults& defaults, std::vector<TextPlace> places) {
  r.p_gain = defaults.p_gain.value_or(r.p_gain);
  r.load.mass = defaults.mass.value_or(r.load.mass);
  r.load.length = defaults.length.value_or(r.load.length);
  r.load.arm_mass = defaults.arm_mass.value_or(r.load.arm_mass);
  r.load.inertia = defaults.inertia.value_or(r.load.inertia);
  if (defaults.supply_voltage)
    for (RecordSample& s : r.samples) s.supply_voltage = *defaults.supply_voltage;
  check_constant(r, r.p_gain, defaults.commands_only, "the P gain", "--p-gain");
  check_constant(r, r.duty_gain, true, "`duty_gain`", "--duty-gain");
  check_constant(r, r.duty_limit, true, "`duty_limit`", "--duty-limit");
  if (r.duty_limit > 1)
    throw SetupError(fmt::format("{}: `duty_limit` is {:g}, and 1 is full duty", r.name, r.duty_limit));
  check_constant(r, r.load.mass, true, "the mass of the load", "--mass");
  check_constant(r, r.load.length, true, "the length of the load", "--length");
  check_constant(r, r.load.arm_mass, true, "the mass of the arm", "--arm-mass");
  check_constant(r, r.load.inertia, true, "the inertia of the load", "--inertia");
  if (!defaults.commands_only && !(r.load.moment_of_inertia() > 0))
    throw SetupError(r.name +
                     ": there is no load, so nothing tells how strong the motor is; give --mass and --length, "
                     "or --inertia");
  constexpr std::size_t fewest = 20;
  if (r.samples.size() < fewest)
    throw SetupError(
        fmt::format("{}: it has {} samples; {} are the fewest that tell anything", r.name, r.samples.size(), fewest));
  std::size_t kept = 1;
  for (std::size_t i = 1; i < r.samples.size(); ++i) {
    if (r.samples[i].time < r.samples[kept - 1].time)
      throw record_error(
          r.name, places[i],
          fmt::format("time goes back from {:g} s to {:g} s", r.samples[kept - 1].time, r.samples[i].time));
    if (r.samples[i].time == r.samples[kept - 1].time) continue;
    places[kept] = places[i];
    r.samples[kept++] = r.samples[i];
  }
  if (kept < r.samples.size())
    r.notes.push_back(
        fmt::format("{}: {} samples at the time of the one before are left out", r.name, r.samples.size() - kept));
  if (kept < fewest)
    throw SetupError(fmt::format("{}: it has {} samples at different times; {} are the fewest that tell anything",
                                 r.name, kept, fewest));
  r.samples.resize(kept);
  check_period(r, defaults.commands_only ? 10 : 0.2);
  for (std::size_t i = 0; i < kept && !defaults.commands_only; ++i)
    if (!(r.samples[i].supply_voltage > 0 && r.samples[i].supply_voltage < 1e4))
      throw record_error(r.name, places[i],
                         fmt::format("the supply voltage is {:g} V; it is above 0, by the record or by "
                                     "--supply",
                                     r.samples[i].supply_voltage));
}

MotorRecord parse_motor_record(const std::string& text, const std::string& name, const RecordDefaults& defaults) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw SetupError(name + " is empty");
  return text[first] == '{' ? parse_json_record(text, name, defaults) : parse_csv_record(text, name, defaults);
}

std::string read_record_text(const std::string& file) {
  try {
    return InputFile(file).rest(largest_record);
  } catch (const Error& e) {
    throw SetupError(e.what());
  }
}

MotorRecord read_motor_record(const std::string& file, const RecordDefaults& defaults) {
  return parse_motor_record(read_record_text(file), file, defaults);
}

}  // namespace muro::host
