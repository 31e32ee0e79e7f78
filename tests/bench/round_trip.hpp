// SPDX-License-Identifier: MIT
#pragma once

namespace muro::bench {

/// Returns the time that a message and its answer take between two threads that wait without sleep, ns: the cost of
/// cooperation. On virtual machines it changes by the minute: some 50 to 90 where both processors are one core's, 100
/// to 150 between cores that share a cache, 300 and more between others.
double round_trip();

}  // namespace muro::bench
