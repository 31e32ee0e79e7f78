// SPDX-License-Identifier: MIT
// What is fuzzed: each target reads bytes as the program reads what others wrote.
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
  const char* name;  ///< and that of the folder with its corpus
  /// Returns, whatever the bytes are. What it must not do ends the process: crash, hang, take too much memory, fail an
  /// assertion; so does an exception that is neither muro::Error nor SetupError.
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
void read_as_fmu(Bytes);   ///< where muro is built with controller.fmu
void read_as_mjcf(Bytes);  ///< where muro is built with reader.mjcf

/// A file of this process for what reads files: the bytes under a name in a folder of its own.
std::string file_with(Bytes bytes, const std::string& name);

/// What an input has led to, such as a message: libFuzzer keeps inputs that lead to something new. Numbers, paths and
/// what is quoted make no difference. Ends the process where the text is empty.
void outcome(std::string_view text);

/// Ends the process with the text unless `fine`.
void require(bool fine, const char* text);

inline std::string text_of(Bytes bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace muro::fuzz
