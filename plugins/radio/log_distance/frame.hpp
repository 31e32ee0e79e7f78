// SPDX-License-Identifier: MIT
// State of a radio: lists and blocks in properties, without padding.
#pragma once

#include "muro/vocabulary/radio.hpp"

namespace muro::log_distance {

using radio::Payload;

enum class Stage : std::uint32_t {
  waiting,   ///< in the queue
  on_air,    ///< its times are known
  complete,  ///< its end has come in this step: receivers process it
  past,      ///< kept while it may still overlap with a frame that is received
};

/// A message at its sender, as a frame.
struct Frame {
  double handed_over = 0;     ///< s: time at which the message of the control code was found
  double start = 0, end = 0;  ///< s: times of the transmission, valid from Stage::on_air on
  std::int64_t number = 0;
  std::int64_t receiver = radio::broadcast;  ///< number of a robot
  std::uint32_t size = 0;                    ///< bytes, without overhead
  Stage stage = Stage::waiting;
  Payload payload;
};
static_assert(sizeof(Frame) == 5 * 8 + 2 * 4 + radio::max_bytes);

/// A message at its receiver: on its way there, or received.
struct Arrival {
  double sent = 0, received = 0;  ///< s
  double rssi = 0;                ///< dBm
  std::int64_t number = 0;
  std::int32_t from = -1;
  std::uint32_t size = 0;
  Payload payload;
};
static_assert(sizeof(Arrival) == 4 * 8 + 2 * 4 + radio::max_bytes);

/// State of the channel access of a radio (unslotted CSMA-CA), and the last command of its control code.
struct Access {
  std::int64_t last_command = 0;             ///< radio.send.number
  std::int64_t last_number = 0;              ///< number of the last message
  double attempt = 0;                        ///< s: time at which it next listens whether the medium is free
  double on_air_from = 0, on_air_until = 0;  ///< s: times of its last transmission
  std::int64_t on_air_number = 0;            ///< number of the message in this transmission
  std::int64_t contending_for = 0;           ///< number of the message that waits for the medium
  std::uint64_t draws = 0;                   ///< random back-offs so far
  std::uint32_t backoffs = 0;                ///< NB: of the frame at the head
  std::uint32_t exponent = 0;                ///< BE
};
static_assert(sizeof(Access) == 8 * 8 + 2 * 4);

}  // namespace muro::log_distance

namespace muro {
MURO_OPAQUE_TYPE(log_distance::Frame, "muro.log_distance.Frame", opaque);
MURO_OPAQUE_TYPE(log_distance::Arrival, "muro.log_distance.Arrival", opaque);
MURO_OPAQUE_TYPE(log_distance::Access, "muro.log_distance.Access", opaque);
}  // namespace muro

namespace muro::log_distance {
inline constexpr Key<Frame> key_frames{"radio.frames", "1", "list: frames that wait, are on the air or may disturb"};
inline constexpr Key<Arrival> key_arriving{"radio.arriving", "1", "list: messages that have not come yet"};
inline constexpr Key<Access> key_access{"radio.access", "1", "how the radio gets at the medium"};
}  // namespace muro::log_distance
