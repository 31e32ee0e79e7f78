// SPDX-License-Identifier: MIT
#pragma once

namespace muro::bench {

/// What a message and its answer take between two threads that wait for them without sleep, in ns: the price of working
/// together. On virtual machines it changes by the minute: some 50 to 90 where both processors are one core's,
/// 100 to 150 between cores that share a cache, 300 and more between others.
double round_trip();

}  // namespace muro::bench
