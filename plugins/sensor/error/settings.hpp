// SPDX-License-Identifier: MIT
#pragma once

#include "error_chain.hpp"
#include "muro/parameter.hpp"
#include "part.hpp"

namespace muro {

enum class ReadingForm : std::uint8_t {
  value,        ///< one number, or several of different kinds
  vector,       ///< Vec3
  array,        ///< neighbours of one kind, such as the rays of a scan
  image,        ///< an array of f32, in which pixels that see nothing are infinite
  orientation,  ///< a quaternion
  pose,         ///< a position and a quaternion
  list,         ///< a list of neighbours, each with its id
};

/// The kind of the reading that has the errors.
struct ReadingShape {
  std::string_view name;       ///< name of the property
  std::size_t components = 1;  ///< components with errors; three of a rotation vector for an orientation
  ReadingForm form = ReadingForm::value;

  bool is_array() const { return form == ReadingForm::array || form == ReadingForm::image; }
  bool has_orientation() const { return form == ReadingForm::orientation || form == ReadingForm::pose; }
};

/// The settings of one reading: from the scenario, else from a part, else the defaults.
class GivenErrors {
 public:
  /// `section`: null if there is no part.
  GivenErrors(const Parameters& scenario, const PartSection* section) : scenario_(scenario), section_(section) {}

  bool given(std::string_view name) const { return scenario_.given(name) || in_part(name); }
  bool in_scenario(std::string_view name) const { return scenario_.given(name); }
  double real(std::string_view name) const;
  int integer(std::string_view name) const { return int(real(name)); }
  std::string_view text(std::string_view name) const;
  std::span<const double> numbers(std::string_view name) const;
  /// Throws muro::Error about a value, with its place if it is in the file of a part.
  [[noreturn]] void fail(std::string_view name, const std::string& what) const;

 private:
  const PartValue* in_part(std::string_view name) const;
  const Parameters& scenario_;
  const PartSection* section_;
};

/// Returns the settings of a chain. Throws muro::Error if they contradict each other or do not fit the reading.
ErrorSettings settings_of(const GivenErrors& given, const ReadingShape& reading);

}  // namespace muro
