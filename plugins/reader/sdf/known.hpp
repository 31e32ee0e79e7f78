// SPDX-License-Identifier: MIT
// Which elements of SDFormat are read, and what becomes of the others.
#pragma once

#include <span>
#include <string_view>

#include "muro/robot_builder.hpp"

namespace muro::sdf {

/// An element that may stand in a place of the document.
struct Known {
  enum class Form {
    section,   ///< holds other elements
    numbers,   ///< `count` of them
    pose,      ///< 6 numbers, or 7 with a quaternion
    limit,     ///< a number that may be infinite
    color,     ///< 3 or 4 numbers
    flag,      ///< true, false, 1, 0
    text,      ///< whatever it says
    left_out,  ///< known to SDFormat, and not read
  };
  std::string_view inside;  ///< name of the section it stands in
  std::string_view name;
  Form form = Form::section;
  int count = 1;                       ///< numbers
  bool many = false;                   ///< may stand several times
  std::string_view section = {};       ///< a section: under which name its children are looked up; none: its own
  Severity severity = Severity::note;  ///< left out: how bad that is
  std::string_view why = {};           ///< left out: what a reader of the message should know
  std::string_view harmless = {};      ///< left out: with this value nothing is lost
};

/// Null when SDFormat has no such element there.
const Known* find_known(std::string_view inside, std::string_view name);
/// All that may stand in a section.
std::span<const Known> all_known();

/// The attributes an element of a section may have.
bool knows_attribute(std::string_view section, std::string_view attribute);

}  // namespace muro::sdf
