// SPDX-License-Identifier: MIT
// Functions that readers of records share.
#pragma once

#include "core/error.hpp"
#include "host/tools/identify/record.hpp"

namespace muro::host {

/// A place in a file, from 1.
struct TextPlace {
  std::size_t line = 1, column = 1;
};
/// Returns the place of the byte `offset` of `text`.
TextPlace place_in(const std::string& text, std::size_t offset);
/// Returns the error "FILE:LINE:COLUMN: WHAT".
SetupError record_error(const std::string& name, TextPlace place, const std::string& what);

MotorRecord parse_json_record(const std::string& text, const std::string& name, const RecordDefaults& defaults);
MotorRecord parse_csv_record(const std::string& text, const std::string& name, const RecordDefaults& defaults);

/// Adds values from the command line, and checks required values. `places`: one for each sample.
void complete_record(MotorRecord& record, const RecordDefaults& defaults, std::vector<TextPlace> places);

}  // namespace muro::host
