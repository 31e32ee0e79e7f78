// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/parameter.hpp"

namespace muro {

/// A value in the file of a part.
struct PartValue {
  std::vector<double> numbers;
  std::string word;  ///< where it is no number
  int line = 0, column = 0;
};

/// The errors of one of the readings of a part, under the names that sensor.error has for them.
struct PartSection {
  std::string name;     ///< "gyro"
  std::string reading;  ///< the property: "angular_velocity"
  int line = 0;
  std::map<std::string, PartValue, std::less<>> values;
};

/// A real device by its data sheet: what the errors of its readings are. Its file is YAML of two levels, sections and
/// their values, which are numbers, lists of numbers in brackets, or words:
///
///     # what the device is, and where the values are from
///     gyro:
///       reading: angular_velocity
///       noise_density: 8.73e-5  # 0.005 deg/s/sqrt(Hz): section 6.1
///       turn_on_bias_tolerance: [0.35, 0.35, 0.35]
struct Part {
  std::string file;
  std::vector<PartSection> sections;

  /// The section of a property, or null.
  const PartSection* section_of(std::string_view reading) const;
  /// "FILE:LINE:COLUMN: ", for messages about a value.
  std::string place(const PartValue& value) const;
};

/// Reads `text`, the content of `file`. Values are those of `parameters`, and must be what these allow. Throws
/// muro::Error with the place of the first mistake.
Part parse_part(const std::string& file, std::string_view text, std::span<const Parameter> parameters);
/// Reads a file of at most 1 MiB.
Part read_part(const std::string& file, std::span<const Parameter> parameters);

}  // namespace muro
