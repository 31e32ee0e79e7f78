// SPDX-License-Identifier: MIT
// Facts about noise, motors and radio that are known without simulation: closed forms, data sheets, measurements.
#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace muro::known_answers {

/// Difference of a run from the known value.
struct Found {
  double error = 0;
  double tolerance = 0;
};

struct Answer {
  std::string_view plugin;
  std::string_view name;     ///< a sentence
  std::string_view source;   ///< of the known value
  std::string_view unit;     ///< of the error
  std::string_view allowed;  ///< meaning of the tolerance
  Found (*run)() = nullptr;
};

std::vector<Answer> noise_answers();
std::vector<Answer> servo_answers();
std::vector<Answer> radio_answers();
std::vector<Answer> all_answers();

/// A fault that users of another simulator have found in it, and the answer that shows that muro does not have it.
struct PeerBug {
  std::string_view peer;  ///< "Gazebo", with the number of the issue
  std::string_view bug;
  std::string_view answer;  ///< name of an Answer, or of a case of tests/conformance/sensor
};
std::vector<PeerBug> peer_bugs();

/// Three relative standard deviations of an estimate from `n` independent samples: of a standard deviation, and of a
/// variance.
inline double three_sigma_of_deviation(double n) { return 3 / std::sqrt(2 * n); }
inline double three_sigma_of_variance(double n) { return 3 * std::sqrt(2 / n); }
/// Three standard deviations of the ratio of `n` trials of probability `p`.
inline double three_sigma_of_ratio(double p, double n) { return 3 * std::sqrt(p * (1 - p) / n); }

}  // namespace muro::known_answers
