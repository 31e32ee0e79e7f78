// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "command.hpp"
#include "encoding.hpp"

namespace muro::scip2 {

/// A scan in the memory of a device: for each step from `first_step` on.
struct ScanView {
  std::span<const std::uint32_t> distances;    ///< mm, or a code below `least_distance`
  std::span<const std::uint32_t> intensities;  ///< as many
  std::uint32_t first_step = 0;
  std::uint32_t least_distance = 20;
};

/// How the values of a scan are written.
struct ValueForm {
  int characters = 3;  ///< a value; greater ones are written as the greatest that fits
  bool has_intensities = false;
};
ValueForm form_of(Command c);

/// The data lines of a reply. A cluster reads the least distance among those that are no error codes, with its
/// intensity, and the code of its first step where there are only codes. Steps that are not in the scan read 0.
void write_scan(ReplyWriter& reply, const ScanView& scan, const ScanWindow& window, ValueForm form,
                bool has_sums = true);

}  // namespace muro::scip2
