// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "muro/ext/external_inputs.hpp"

namespace muro::inputs {

/// The end of a recorded run.
struct RunEnd {
  std::uint64_t epoch = 0;
  std::int64_t time = 0;          ///< ns
  std::uint64_t robots_hash = 0;  ///< hash of the state of all robots at the end

  bool operator==(const RunEnd&) const = default;
};

/// A recording that was read. `texts` holds the texts of its inputs.
struct Recording {
  std::uint64_t initial_hash = 0;
  std::vector<RecordedInput> inputs;
  std::optional<RunEnd> end;  ///< none: the run was broken off

  std::deque<std::string> texts;
};

/// Lines of a recording, each with its line end; README.md describes them.
std::string header_line(std::uint64_t initial_hash);
void add_line(std::string& out, const RecordedInput& input);
std::string end_line(const RunEnd& end);

/// Reads a recording. Throws muro::Error with file, line and column of a mistake, and says what is allowed there.
Recording read_recording(const std::string& path);

}  // namespace muro::inputs
