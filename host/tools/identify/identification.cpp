// SPDX-License-Identifier: MIT
#include "host/tools/identify/identification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "core/error.hpp"

namespace muro::host {

namespace {

constexpr double report_step = 0.002;  // s

PredictedRecord predicted(MotorRecord record, bool is_validation, const MotorEstimate& estimate) {
  PredictedRecord p;
  const PreparedRecord prepared = prepare(record, report_step, estimate.delay);
  p.error = error_of(prepared, estimate);
  p.residuals = residuals_of(prepared, record, estimate);
  p.record = std::move(record);
  p.is_validation = is_validation;
  return p;
}

double error_on(const std::vector<MotorRecord>& records, const MotorEstimate& estimate) {
  double sum = 0;
  for (const MotorRecord& r : records) sum += error_of(prepare(r, report_step, estimate.delay), estimate).mean;
  return sum / double(records.size());
}

/// Warns when a record is warmer or colder than all fitted ones: the fit does not predict that.
void warn_of_temperature(const std::string& what, const std::optional<TemperatureSpan>& predicted,
                         const std::optional<TemperatureSpan>& fitted, std::vector<std::string>& notes) {
  if (!predicted || !fitted) return;
  const double beyond = std::max(predicted->high - fitted->high, fitted->low - predicted->low);
  if (beyond < least_temperature_span) return;
  notes.push_back(fmt::format(
      "{} recorded at {:g} to {:g} degrees Celsius, and what was fitted at {:g} to {:g}: a warm motor has more "
      "resistance and weaker magnets; record each P gain with the motor cold and warm, and --fit temperature",
      what, predicted->low, predicted->high, fitted->low, fitted->high));
}

std::vector<CrossValidation> leave_out_in_turn(const std::vector<MotorRecord>& records, const FitSettings& settings,
                                               const MotorEstimate& full_fit,
                                               const std::function<void(const std::string&, double)>& show) {
  std::set<double> gains;
  for (const MotorRecord& r : records) gains.insert(r.p_gain);
  std::vector<CrossValidation> all;
  if (gains.size() < 2)
    throw SetupError("--cross-validate leaves out one P gain in turn, but all records have the same one");
  for (const double gain : gains) {
    std::vector<MotorRecord> rest, out;
    for (const MotorRecord& r : records) (r.p_gain == gain ? out : rest).push_back(r);
    const FitResult fit = fit_motor(rest, settings, [&](double part) {
      if (show) show(fmt::format("without P gain {:g}", gain), part);
    });
    all.push_back({gain, error_on(rest, fit.estimate), error_on(out, fit.estimate), error_on(out, full_fit),
                   temperature_span(rest), temperature_span(out)});
  }
  return all;
}

/// The fits of a validation, and the error on each record (rad).
struct PartialFits {
  Validation validation;
  std::vector<double> errors;
  std::uint64_t evaluations = 0;
};

/// Leaves out each record, or each group of records, in turn. Record i belongs to group i modulo their number.
PartialFits leave_records_out(const std::vector<MotorRecord>& records, const FitSettings& settings,
                              const FitResult& whole, const std::function<void(const std::string&, double)>& show) {
  constexpr std::size_t most_fits = 6;
  const std::size_t fits = std::min(records.size(), most_fits);
  PartialFits result;
  result.validation.data = fits == records.size() ? UnseenData::each_record : UnseenData::groups_of_records;
  result.validation.fits = unsigned(fits);
  result.errors.resize(records.size());
  std::vector<std::uint64_t> evaluations(fits);
  std::atomic<std::size_t> next{0}, done{0};
  const auto work = [&] {
    for (std::size_t k = next++; k < fits; k = next++) {
      std::vector<MotorRecord> seen;
      for (std::size_t i = 0; i < records.size(); ++i)
        if (i % fits != k) seen.push_back(records[i]);
      const FitResult fit = refit_motor(seen, settings, whole);
      for (std::size_t i = k; i < records.size(); i += fits) result.errors[i] = error_on({records[i]}, fit.estimate);
      evaluations[k] = fit.evaluations;
      ++done;
      if (show) show("records left out in turn", double(done) / double(fits));
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t t = 1; t < std::min<std::size_t>(std::max(settings.threads, 1u), fits); ++t)
    threads.emplace_back(work);
  work();
  for (std::thread& t : threads) t.join();
  for (const std::uint64_t e : evaluations) result.evaluations += e;
  for (const double e : result.errors) result.validation.unseen_error += e / double(records.size());
  result.validation.fit_error = error_on(records, whole.estimate);
  return result;
}

/// Mean |error| (rad) from sample `first` on, in a simulation of the whole record.
double error_from(std::size_t first, const MotorRecord& record, const MotorEstimate& estimate) {
  const Residuals r = residuals_of(prepare(record, report_step, estimate.delay), record, estimate);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < r.times.size(); ++i)
    if (r.times[i] >= record.samples[first].time) sum += std::abs(r.errors[i]), count += 1;
  return count > 0 ? sum / count : 0;
}

/// Fits to the first three quarters of the samples, and predicts the others.
PartialFits leave_end_out(const MotorRecord& record, const FitSettings& settings, const FitResult& whole,
                          const std::function<void(const std::string&, double)>& show) {
  MotorRecord seen = record;
  seen.samples.resize(seen.samples.size() * 3 / 4);
  const std::size_t first = seen.samples.size();
  const FitResult fit = fit_motor({seen}, settings, [&](double part) {
    if (show) show("without the last quarter", part);
  });
  const double error = error_from(first, record, fit.estimate);
  return {{UnseenData::last_quarter, 1, error, error_from(first, record, whole.estimate)}, {error}, fit.evaluations};
}

void warn_of_overfit(const Validation& v, FrictionKind friction, std::vector<std::string>& notes) {
  constexpr double usual = 2;
  if (v.data == UnseenData::named_records || !(v.unseen_error > usual * v.fit_error)) return;
  notes.push_back(
      fmt::format("on what a fit has not seen its error is {:.1f} times that of the fit of all; record more movements "
                  "that differ{}",
                  v.unseen_error / v.fit_error,
                  friction == FrictionKind::m1 ? "" : ", or take a model with fewer parameters (--model m1)"));
}

}  // namespace

double mean_error(const std::vector<PredictedRecord>& records, bool validation) {
  double sum = 0, count = 0;
  for (const PredictedRecord& r : records)
    if (r.is_validation == validation) sum += r.error.mean, count += 1;
  return count > 0 ? sum / count : 0;
}

FrictionKind friction_kind_of(const std::string& word) {
  constexpr std::pair<const char*, FrictionKind> kinds[] = {
      {"m1", FrictionKind::m1}, {"m2", FrictionKind::m2}, {"m3", FrictionKind::m3}, {"m4", FrictionKind::m4}};
  for (const auto& [name, kind] : kinds)
    if (word == name) return kind;
  throw SetupError("--model " + in_backquotes(word) + " is none of m1, m2, m3, m4");
}

std::string name_of(FrictionKind kind) { return fmt::format("M{}", 1 + int(kind)); }

double recorded_gain(const std::vector<MotorRecord>& records) {
  constexpr double least = 0.05, most = 0.9;  // duties: smaller ones are rounded, larger ones are limited
  std::vector<double> gains;
  for (const MotorRecord& r : records) {
    if (!r.has_duty) continue;
    for (const RecordSample& s : r.samples) {
      const double error = r.p_gain * (s.goal - s.position);
      if (s.torque_enable && std::abs(s.duty) > least && std::abs(s.duty) < most && error * s.duty > 0)
        gains.push_back(s.duty / error);
    }
  }
  if (gains.empty()) return 0;
  // duties are a little older than positions, which shifts quotients up as often as down
  const auto middle = gains.begin() + std::ptrdiff_t(gains.size() / 2);
  std::nth_element(gains.begin(), middle, gains.end());
  return *middle;
}

Identification identify_motor(std::vector<MotorRecord> fit, std::vector<MotorRecord> validation,
                              const FitSettings& settings, bool cross_validate,
                              const std::function<void(const std::string&, double)>& show) {
  const auto start = std::chrono::steady_clock::now();
  Identification result;
  result.settings = settings;
  result.fit = fit_motor(fit, settings, [&](double part) {
    if (show) show("all records", part);
  });
  PartialFits partial;
  if (validation.empty()) {
    partial = fit.size() > 1 ? leave_records_out(fit, settings, result.fit, show)
                             : leave_end_out(fit.front(), settings, result.fit, show);
    result.validation = partial.validation;
    result.fit.evaluations += partial.evaluations;
    warn_of_overfit(result.validation, settings.friction, result.notes);
  }
  if (cross_validate) result.left_out = leave_out_in_turn(fit, settings, result.fit.estimate, show);
  for (const CrossValidation& c : result.left_out)
    warn_of_temperature(fmt::format("P gain {:g} is", c.p_gain), c.left_out_temperature, c.fit_temperature,
                        result.notes);
  warn_of_temperature("what is left out is", temperature_span(validation), temperature_span(fit), result.notes);
  if (settings.fit_temperature)
    result.notes.push_back(fmt::format("the resistance is that at {:g} degrees Celsius; it grows by {:.2g} % a degree",
                                       result.fit.estimate.reference_temperature,
                                       100 * result.fit.estimate.temperature_coefficient));
  for (auto* const records : {&fit, &validation})
    for (MotorRecord& r : *records) {
      const double told = recorded_gain({r}), used = r.duty_gain > 0 ? r.duty_gain : result.fit.estimate.motor.gain;
      if (told > 0 && std::abs(told / used - 1) > recorded_gain_tolerance)
        result.notes.push_back(
            fmt::format("{}: its duties say a gain of {:.4g} /rad for each unit of the P gain, and {:.4g} was used: "
                        "--duty-gain, --fit gain, or `duty_gain` in the record",
                        r.name, told, used));
      for (const std::string& n : r.notes) result.notes.push_back(n);
      const std::size_t gaps = prepare(r, report_step).gap_count;
      if (gaps > 0)
        result.notes.push_back(fmt::format("{}: {} gap{} in time; behind each the simulation begins anew", r.name, gaps,
                                           gaps == 1 ? "" : "s"));
      result.records.push_back(predicted(std::move(r), records == &validation, result.fit.estimate));
    }
  for (std::size_t i = 0; i < partial.errors.size(); ++i) result.records[i].unseen_error = partial.errors[i];
  if (!validation.empty())
    result.validation = {UnseenData::named_records, 1, mean_error(result.records, true),
                         mean_error(result.records, false)};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace muro::host
