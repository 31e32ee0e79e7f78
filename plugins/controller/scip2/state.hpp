// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <type_traits>

#include "command.hpp"

namespace muro::scip2 {

/// A line that waits for its answer.
struct Pending {
  std::uint32_t client;
  std::uint8_t length;
  std::uint8_t is_repeated;  ///< a line with the same command waits already
  std::uint8_t unused[2];
  char line[longest_line];

  std::string_view text() const { return {line, length}; }
};

/// Scans that a client has requested by an `M_` command.
struct Measurement {
  std::int64_t since;  ///< only scans that begin at this time or later are sent, ns
  std::uint32_t client;
  std::uint32_t start, end, cluster;
  std::uint32_t interval, left_out;  ///< scans to skip between two, and skipped scans so far
  std::uint32_t remaining;
  std::uint8_t command;  ///< a Command; none: no scans are sent
  std::uint8_t is_endless;
  std::uint8_t line_length;
  std::uint8_t unused;
  char line[longest_line];  ///< the request, which scans echo
};

/// The complete state of a device between steps. After it follow the distances (mm) and the intensities of the scan in
/// memory, as std::uint32_t for each step from AMIN to AMAX. All zero: a device that was not switched on. Times are in
/// ns of simulated time.
struct State {
  static constexpr std::uint32_t queue_size = 16;

  std::int64_t power_on, timer_zero;
  std::int64_t scan_begin, scan_period;  ///< the present turn of the mirror: when it passed step 0
  std::int64_t laser_since;
  std::int64_t scan_time;           ///< the scan in memory: when the mirror passed step 0
  std::int64_t answered_scan_time;  ///< the scan of the last answer to `G_`
  std::int64_t reply_index;         ///< for ReplyTime::at_interval: the last interval with replies
  std::int64_t line_free;           ///< when all sent bytes have passed, on a line with transmission time
  std::uint32_t bit_rate;           ///< set by `SS`, bit/s; 0: the initial rate of the line
  std::uint32_t fault_scans;        ///< turns since DB
  std::uint8_t is_on, speaks_scip2, has_laser_on, is_adjusting;
  std::uint8_t is_sensitive, percent_slower, fault, has_scan;
  std::uint8_t is_restart_asked, is_asleep;
  std::uint8_t answered_command;  ///< a Command: the `G_` of that answer
  std::uint8_t unused[5];
  std::uint32_t answered_client;
  std::uint32_t pending_count;
  Measurement measurement;
  Pending pending[queue_size];
};

static_assert(std::is_trivially_copyable_v<State> && std::has_unique_object_representations_v<State>,
              "a state block is compared and hashed byte by byte");

}  // namespace muro::scip2
