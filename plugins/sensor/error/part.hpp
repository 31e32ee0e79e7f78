// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "muro/parameter.hpp"
#include "plugins/common/part_file/part_file.hpp"

namespace muro {

/// A value in the file of a part.
struct PartValue {
  std::vector<double> numbers;
  std::string word;   ///< value of a parameter that is a text
  std::string place;  ///< "FILE:LINE:COLUMN: ", for messages about it
};

/// The errors of one reading of a part, with the parameter names of sensor.error.
struct PartSection {
  std::string name;     ///< "gyro"
  std::string reading;  ///< the property: "angular_velocity"
  std::map<std::string, PartValue, std::less<>> values;
};

/// A real device by its data sheet: the errors of its readings. Its file has the form of all parts
/// (plugins/common/part_file). Each section has one reading:
///
///     # what the device is, and where the values are from
///     gyro:
///       reading: angular_velocity
///       noise_density: 8.73e-5  # 0.005 deg/s/sqrt(Hz): section 6.1
///       turn_on_bias_tolerance: [0.35, 0.35, 0.35]
struct Part {
  std::string file;
  std::vector<PartSection> sections;

  /// Returns the section of a property, or null.
  const PartSection* section_of(std::string_view reading) const;
};

/// Reads the part in a file. Names and values must be allowed by `parameters`. Throws muro::Error with file, line and
/// column of the first mistake.
Part make_part(const PartFile& file, std::span<const Parameter> parameters);

}  // namespace muro
