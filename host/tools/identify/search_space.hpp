// SPDX-License-Identifier: MIT
#pragma once

#include "host/tools/identify/motor_fit.hpp"

namespace muro::host {

/// Parameters of the search and their bounds, from the scale of the recorded values.
class SearchSpace {
 public:
  SearchSpace(const std::vector<MotorRecord>& records, const FitSettings& settings);

  const std::vector<FitParameter>& parameters() const { return parameters_; }
  std::size_t size() const { return parameters_.size(); }
  /// Returns the value of parameter `i` at `x`, 0 .. 1 from its lower to its upper bound; coordinate() is the inverse.
  double value(std::size_t i, double x) const;
  double coordinate(std::size_t i, double value) const;
  /// Returns the coordinates of parameters of another space, by their names; the middle for a missing name.
  std::vector<double> coordinates(const std::vector<FitParameter>& others) const;
  /// `x`: one coordinate for each parameter.
  MotorEstimate estimate(const double* x) const;
  /// Returns the parameters with their values at `x`, and whether they are at a bound.
  std::vector<FitParameter> described(const double* x) const;

 private:
  void add(const char* name, const char* unit, double low, double high, bool logarithmic, bool may_be_low = false);

  FitSettings settings_;
  double temperature_coefficient_ = 0, reference_temperature_ = 25;  ///< of the estimates, when they are not searched
  std::vector<FitParameter> parameters_;
};

}  // namespace muro::host
