// SPDX-License-Identifier: MIT
// The frames of a sender: what control code hands over, what is on the air, what is through.
#pragma once

#include "radio.hpp"

namespace muro::log_distance {

/// Frames that were complete in the step before are past.
void end_reception(const Radio& r);

/// Removes past frames that ended by `time` (s).
void forget_frames(const Radio& r, double time);

/// Takes the message that control code has written since the last step, if any, at `now` (s): as a frame that waits, or
/// as one that is lost where the queue is full.
void take_message(const Radio& r, double now);

/// Where each sender has a medium of its own: gives waiting frames their times, one behind the other.
void transmit(const Radio& r);

/// Marks the frames whose end has come by `now` (s) as complete and counts them; returns whether there are any.
bool complete_frames(const Radio& r, double now);

/// The first frame that waits; null where there is none.
Frame* first_waiting(const Radio& r);

}  // namespace muro::log_distance
