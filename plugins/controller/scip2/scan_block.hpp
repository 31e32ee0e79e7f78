// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "command.hpp"
#include "encoding.hpp"

namespace muro::scip2 {

/// A scan in the memory of a device; values from `first_step` on.
struct ScanView {
  std::span<const std::uint32_t> distances;    ///< mm, or a code below `least_distance`
  std::span<const std::uint32_t> intensities;  ///< one for each distance
  std::uint32_t first_step = 0;
  std::uint32_t least_distance = 20;
};

/// Format of the values of a scan.
struct ValueForm {
  int characters = 3;  ///< for each value; a value that does not fit is written as the greatest one
  bool has_intensities = false;
};
ValueForm form_of(Command c);

/// Writes the data lines of a reply. A cluster gets the least distance that is no error code, with its intensity, or
/// the code of its first step when all are codes. Steps that are not in the scan read 0.
void write_scan(ReplyWriter& reply, const ScanView& scan, const ScanWindow& window, ValueForm form,
                bool has_sums = true);

}  // namespace muro::scip2
