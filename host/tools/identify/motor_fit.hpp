// SPDX-License-Identifier: MIT
// Parameters of a motor with which its simulation fits records best.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/tools/identify/motor_simulation.hpp"

namespace muro::host {

enum class FrictionKind : std::uint8_t { m1, m2, m3, m4 };

/// A parameter of the search, between two bounds.
struct FitParameter {
  std::string name, unit;
  double low = 0, high = 1;
  bool logarithmic = false;  ///< searched by its logarithm
  bool may_be_low = false;   ///< its lower bound is a meaningful value, such as no friction
  double value = 0;
  double deviation = 0;  ///< standard deviation from the curvature at the optimum; 0: unknown
  bool is_at_low = false, is_at_high = false;
};

struct FitSettings {
  FrictionKind friction = FrictionKind::m4;
  bool fit_gain = false;   ///< also fit the gain of the firmware
  bool fit_delay = false;  ///< also fit the delay of commands
  /// Also fit the change of resistance with the recorded temperature, if the records span `least_temperature_span`;
  /// otherwise that of copper is used.
  bool fit_temperature = false;
  double gain = 0;  ///< 1/rad for each unit of the P gain; if it is fitted: an approximate value, or 0
  double duty_limit = 1;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  unsigned starts = 4;              ///< number of global searches; results depend on it
  unsigned global_evaluations = 0;  ///< for each start; 0: by the number of parameters
  unsigned local_evaluations = 0;   ///< for each start; 0: by the number of parameters
};

struct FitResult {
  MotorEstimate estimate;
  std::vector<FitParameter> parameters;
  double mean_error = 0;  ///< rad: mean of |error| over the records
  std::uint64_t evaluations = 0;
  std::vector<std::vector<FitParameter>> optima;  ///< the result, and the result of each start of the search
  std::vector<std::string> warnings;
};

inline constexpr double least_temperature_span = 2;               ///< K
inline constexpr double copper_temperature_coefficient = 0.0039;  ///< 1/K, of the resistance at 20 degrees Celsius

/// Lowest and highest recorded temperature (degrees Celsius).
struct TemperatureSpan {
  double low = 0, high = 0;
  double middle() const { return 0.5 * (low + high); }
};
std::optional<TemperatureSpan> temperature_span(const std::vector<MotorRecord>& records);

/// Whether this build can fit: it needs NLopt.
bool can_fit();

/// Minimizes the error of the simulated position (pseudo-Huber), in open simulation from the first sample of each
/// record. Uses controlled random search (NLopt's CRS2) from several starts, each refined by Subplex; the best result
/// is refined again in fine steps. The result is the same for any number of threads. `show`: gets the completed part, 0
/// .. 1, from any thread. Throws SetupError when NLopt is missing.
FitResult fit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings,
                    const std::function<void(double)>& show = {});

/// Fits to a part of the records to which `whole` was fitted, in about a sixth of the time. Subplex starts from the
/// optimum of `whole` that fits these records best, and from a short search of its own; the better result is refined
/// again in fine steps. `settings`: those of `whole`. The result has no ranges, warnings and optima. Throws SetupError
/// when NLopt is missing.
FitResult refit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings, const FitResult& whole);

}  // namespace muro::host
