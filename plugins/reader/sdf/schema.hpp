// SPDX-License-Identifier: MIT
// Which elements of SDFormat are read, and what is reported of the others.
#pragma once

#include <span>
#include <string_view>

#include "muro/robot_builder.hpp"

namespace muro::sdf {

enum class ValueType {
  section,      ///< holds other elements
  numbers,      ///< `count` of them
  pose,         ///< 6 numbers, or 7 with a quaternion
  limit,        ///< a number that may be infinite
  color,        ///< 3 or 4 numbers
  flag,         ///< true, false, 1, 0
  text,         ///< any text
  device,       ///< a sensor, a plugin or a flag that becomes a subsystem of the robot
  unsupported,  ///< an element of SDFormat that is not read
};

/// An element that a section of the document may hold.
struct SchemaElement {
  std::string_view parent;  ///< name of the section
  std::string_view name;
  ValueType type = ValueType::section;
  int count = 1;                          ///< numbers
  bool repeatable = false;                ///< may occur several times in its section
  std::string_view section = {};          ///< a section: under which name its children are looked up; none: its own
  Severity severity = Severity::note;     ///< unsupported: of the message
  std::string_view reason = {};           ///< unsupported: what a reader of the message should know
  std::string_view supported_value = {};  ///< unsupported: an element with this value is no loss and not reported
};

/// Null when SDFormat has no such element there.
const SchemaElement* find_in_schema(std::string_view parent, std::string_view name);
std::span<const SchemaElement> schema();

/// Whether an element of a section may have the attribute.
bool is_attribute_of(std::string_view section, std::string_view attribute);

}  // namespace muro::sdf
