// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "unit.hpp"

namespace muro::fmu {

/// Types of variables in both versions: Real is float64, Integer is int32.
enum class Type : std::uint8_t {
  float64,
  float32,
  int64,
  uint64,
  int32,
  uint32,
  int16,
  uint16,
  int8,
  uint8,
  boolean,
  enumeration,
  string,
  binary,
};
inline constexpr std::size_t type_count = 14;

inline constexpr std::uint64_t largest_array = 1'000'000;  ///< elements

/// Returns the standard's name of a type in this version: "Real", "Float64".
std::string_view name_of(Type type, int version);

enum class Causality : std::uint8_t {
  parameter,
  calculated_parameter,
  input,
  output,
  local,
  independent,
  structural_parameter,
};

/// Items of an enumeration type: names and values.
using EnumerationItems = std::vector<std::pair<std::string, std::int64_t>>;

/// One dimension of an array.
struct Dimension {
  std::uint64_t length = 0;
  std::optional<std::size_t> parameter;  ///< index of the variable that gives the length; nothing: constant
};

struct Variable {
  std::string name;
  std::uint32_t reference = 0;
  Type type = Type::float64;
  Causality causality = Causality::local;
  bool is_tunable = false;                        ///< a parameter that may change during the run
  bool is_continuous = false;                     ///< may change at any time, not only at communication points
  bool may_be_set = false;                        ///< before the initialization
  std::string unit;                               ///< empty: none is given
  bool is_relative = false;                       ///< a difference: the offset of its unit is not used
  std::vector<Dimension> dimensions;              ///< dimensions of an array
  std::uint64_t size = 1;                         ///< number of values: for arrays, all elements
  std::shared_ptr<const EnumerationItems> items;  ///< from its declared type; null: there are none
  int line = 0;
};

/// The parts of modelDescription.xml that are used here.
struct ModelDescription {
  int version = 0;  ///< 2 or 3
  std::string model_name, model_version, generation_tool;
  std::string token;       ///< guid (FMI 2), instantiationToken (FMI 3)
  std::string identifier;  ///< name of the library without .so
  bool once_per_process = false;
  bool variable_step_size = false;
  bool can_keep_state = false;       ///< canGetAndSetFMUState
  bool can_serialize_state = false;  ///< canSerializeFMUState
  bool might_return_early = false;
  double fixed_internal_step = 0;  ///< s; 0: none is given
  double preferred_step = 0;       ///< s; 0: none is given
  double tolerance = 0;            ///< tolerance of the default experiment; 0: none is given
  std::vector<Variable> variables;
  std::map<std::string, Unit, std::less<>> units;

  const Variable* find(std::string_view name) const;
  /// Returns the name of a flag; one letter differs: "canGetAndSetFMUstate" in FMI 2, "...FMUState" in FMI 3.
  std::string flag_of_state(std::string_view verb) const;
  /// Whether a variable, by its index, gives the length of a dimension of an array.
  bool is_length(std::size_t variable) const;
  /// Sets such a variable, and the sizes of arrays. False: one would have more than largest_array elements.
  [[nodiscard]] bool set_length(std::size_t variable, std::uint64_t length);

 private:
  friend class DescriptionReader;
  std::map<std::string, std::size_t, std::less<>> by_name_;
};

/// Reads the bytes of a modelDescription.xml; `path`: path of the FMU, for messages. Throws Error, which says what is
/// wrong and where, and names features that an FMU needs but that are not supported here.
ModelDescription read_model_description(std::string bytes, const std::string& path);

}  // namespace muro::fmu
