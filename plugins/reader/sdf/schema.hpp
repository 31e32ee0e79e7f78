// SPDX-License-Identifier: MIT
// Lists the elements of SDFormat that are read, and the reports about the others.
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
  int count = 1;                          ///< numbers: how many
  bool repeatable = false;                ///< may occur several times in its section
  std::string_view section = {};          ///< section: name under which its children are looked up; empty: its own name
  Severity severity = Severity::note;     ///< unsupported: severity of the message
  std::string_view reason = {};           ///< unsupported: text of the message
  std::string_view supported_value = {};  ///< unsupported: value with which nothing is lost or reported
};

/// Returns null if SDFormat has no such element there.
const SchemaElement* find_in_schema(std::string_view parent, std::string_view name);
std::span<const SchemaElement> schema();

/// Whether elements of a section may have the attribute.
bool is_attribute_of(std::string_view section, std::string_view attribute);

}  // namespace muro::sdf
