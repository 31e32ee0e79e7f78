// SPDX-License-Identifier: MIT
// Targets of fuzzing: each reads bytes as the program reads data from elsewhere.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace muro::fuzz {

using Bytes = std::span<const std::uint8_t>;

struct Target {
  const char* name;  ///< also the name of the folder with its corpus
  /// Returns for any bytes. A fault ends the process: a crash, a hang, too much memory, a failed assertion, or an
  /// exception that is neither muro::Error nor SetupError.
  void (*run)(Bytes);
};
const std::vector<Target>& targets();

void read_as_scenario(Bytes);
void read_as_urdf(Bytes);
void read_as_sdf(Bytes);
void read_as_mesh(Bytes);
void read_as_picture(Bytes);
void read_as_description(Bytes);
void read_as_controller(Bytes);
void read_as_jsonrpc(Bytes);
void read_as_library(Bytes);
void read_as_lines(Bytes);
void read_as_frames(Bytes);
void read_as_part(Bytes);
void read_as_scip2(Bytes);
void read_as_fmu(Bytes);   ///< only in builds with controller.fmu
void read_as_mjcf(Bytes);  ///< only in builds with reader.mjcf

/// Writes the bytes to a file in a folder of this process and returns its path.
std::string file_with(Bytes bytes, const std::string& name);

/// Reports an effect of the input, such as a message: libFuzzer keeps inputs that have new effects. Numbers, paths and
/// quoted text make no difference. Ends the process if the text is empty.
void outcome(std::string_view text);

/// Ends the process with the text unless `fine`.
void require(bool fine, const char* text);

inline std::string text_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace muro::fuzz
