// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/simulation.hpp"

namespace muro::host {

/// Number of calls of each thread in a timeline: some seconds of a busy run, in a file that viewers can open.
inline constexpr std::size_t timeline_calls = 200'000;

/// Writes the simulation's timeline in the Trace Event Format, which Perfetto (ui.perfetto.dev) and chrome://tracing
/// show: a row for each thread, a bar for each call. Throws StepError when the file cannot be written.
void write_timeline(const std::string& path, const Simulation& simulation);

}  // namespace muro::host
