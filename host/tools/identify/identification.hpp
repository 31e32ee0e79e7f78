// SPDX-License-Identifier: MIT
// A motor that was identified from records, and its prediction of each of them.
#pragma once

#include "host/tools/identify/motor_fit.hpp"

namespace muro::host {

/// A record and the deviation of its simulation.
struct PredictedRecord {
  MotorRecord record;
  bool is_validation = false;  ///< left out of the fit
  RecordError error;
  Residuals residuals;
  std::optional<double> unseen_error{};  ///< rad: mean |error| of fits without this record, see Validation
};

/// A fit without the records of one P gain, and its error on them. All errors are means of |error|, rad.
struct CrossValidation {
  double p_gain = 0;
  double fit_error = 0;       ///< on the records of this fit
  double left_out_error = 0;  ///< on the records that are left out
  double full_fit_error = 0;  ///< of the fit of all records on those that are left out: what the model can reach there
  std::optional<TemperatureSpan> fit_temperature{}, left_out_temperature{};
};

/// Data that a fit has not seen.
enum class UnseenData : std::uint8_t { named_records, each_record, groups_of_records, last_quarter };

/// Deviation of fits from data that they have not seen.
struct Validation {
  UnseenData data = UnseenData::named_records;
  unsigned fits = 1;        ///< number of fits without some of the data
  double unseen_error = 0;  ///< rad: mean |error| on the unseen data; the mean over records
  double fit_error = 0;     ///< rad: mean |error| of the fit of all, on the same data; for named
                            ///< records, on those of the fit
};

struct Identification {
  FitSettings settings;
  FitResult fit;
  std::vector<PredictedRecord> records;
  Validation validation;
  std::vector<CrossValidation> left_out;
  std::vector<std::string> notes;
  double seconds = 0;  ///< wall-clock time
};

/// Mean of the mean errors of the records, with or without those of validation, rad.
double mean_error(const std::vector<PredictedRecord>& records, bool validation);

/// Returns the friction model of "m1" to "m4", and back. Throws SetupError for another word.
FrictionKind friction_kind_of(const std::string& word);
std::string name_of(FrictionKind kind);

/// Returns the gain that follows from recorded duties (1/rad for each unit of the P gain); 0: none.
double recorded_gain(const std::vector<MotorRecord>& records);
/// Relative deviation of a gain from duties that is possible: in fast movements duties lag behind positions.
inline constexpr double recorded_gain_tolerance = 0.1;

/// Fits, and predicts all records. If `validation` is empty, it fits again without a part of the data in turn: each
/// record, or one of six groups if there are more records, or the last quarter if there is one record.
/// `cross_validate`: fits again without each P gain in turn.
Identification identify_motor(std::vector<MotorRecord> fit, std::vector<MotorRecord> validation,
                              const FitSettings& settings, bool cross_validate,
                              const std::function<void(const std::string&, double)>& show = {});

/// Returns the report as plain text or as Markdown.
std::string report_text(const Identification& identification, bool markdown);
std::string report_json(const Identification& identification);
/// Returns a line of a scenario: the motor as motor.servo takes it.
std::string scenario_fragment(const Identification& identification);
/// Returns errors over time, a panel for each record (SVG). `by`: simulator, for the title; empty: identified model.
std::string residual_plot(const Identification& identification, const std::string& by = "");

}  // namespace muro::host
