// SPDX-License-Identifier: MIT
// The parameters of a motor with which its simulation meets records best.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/tools/identify/motor_simulation.hpp"

namespace muro::host {

enum class FrictionKind : std::uint8_t { m1, m2, m3, m4 };

/// A quantity that is searched for, between two bounds.
struct FitParameter {
  std::string name, unit;
  double low = 0, high = 1;
  bool logarithmic = false;  ///< searched by its logarithm
  bool may_be_low = false;   ///< its lower bound is a value of its own, such as no friction
  double value = 0;
  double deviation = 0;  ///< standard deviation by the curvature at the optimum; 0: not known
  bool is_at_low = false, is_at_high = false;
};

struct FitSettings {
  FrictionKind friction = FrictionKind::m4;
  bool fit_gain = false;   ///< the gain of the firmware, too
  bool fit_delay = false;  ///< of commands
  /// The resistance by the recorded temperature, where the records span `least_temperature_span`; that of copper
  /// elsewhere.
  bool fit_temperature = false;
  double gain = 0;  ///< 1/rad for each unit of the P gain; where it is fitted: about, or 0
  double duty_limit = 1;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  unsigned starts = 4;              ///< of the global search; results depend on it
  unsigned global_evaluations = 0;  ///< of each; 0: by the number of parameters
  unsigned local_evaluations = 0;   ///< of each; 0: by the number of parameters
};

struct FitResult {
  MotorEstimate estimate;
  std::vector<FitParameter> parameters;
  double mean_error = 0;  ///< rad: of |error|, over the records
  std::uint64_t evaluations = 0;
  std::vector<std::vector<FitParameter>> optima;  ///< the result, and what each start of the search came to
  std::vector<std::string> warnings;
};

inline constexpr double least_temperature_span = 2;               ///< K
inline constexpr double copper_temperature_coefficient = 0.0039;  ///< 1/K, of its resistance at 20 degrees Celsius

/// The lowest and highest temperature (degrees Celsius) that is recorded; nothing where none is.
struct TemperatureSpan {
  double low = 0, high = 0;
  double middle() const { return 0.5 * (low + high); }
};
std::optional<TemperatureSpan> temperature_span(const std::vector<MotorRecord>& records);

/// Whether this build can fit: NLopt is there.
bool can_fit();

/// Minimizes the error of the simulated position (pseudo-Huber), in open simulation from the first sample of each
/// record: controlled random search (NLopt's CRS2) from several starts, each refined by Subplex; the best one again in
/// fine steps. The same for any number of threads. `show`: told the part that is done, 0 .. 1, from any thread. Throws
/// SetupError where NLopt is missing.
FitResult fit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings,
                    const std::function<void(double)>& show = {});

/// Fits to a part of the records that `whole` was fitted to, in about a sixth of the time: Subplex from that of the
/// whole's optima which these records prefer, and from a short search of its own; the better one again in fine steps.
/// `settings`: those of `whole`. The result has no ranges, warnings and optima. Throws SetupError where NLopt is
/// missing.
FitResult refit_motor(const std::vector<MotorRecord>& records, const FitSettings& settings, const FitResult& whole);

}  // namespace muro::host
