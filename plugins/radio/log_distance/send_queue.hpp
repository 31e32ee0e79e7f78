// SPDX-License-Identifier: MIT
// Frames of a sender: handed over by control code, on the air, or complete.
#pragma once

#include "radio.hpp"

namespace muro::log_distance {

/// Marks the frames that were complete in the last step as past.
void end_reception(const Radio& r);

/// Removes past frames that ended by `time` (s).
void forget_frames(const Radio& r, double time);

/// Takes the message that control code has written since the last step, if there is one, at `now` (s). It becomes a
/// waiting frame, or is lost when the queue is full.
void take_message(const Radio& r, double now);

/// Gives waiting frames their times, one after the other. Used when each sender has a medium of its own.
void transmit(const Radio& r);

/// Marks the frames whose end has come by `now` (s) as complete and counts them; returns whether there are any.
bool complete_frames(const Radio& r, double now);

/// Returns the first waiting frame, or null when there is none.
Frame* first_waiting(const Radio& r);

}  // namespace muro::log_distance
