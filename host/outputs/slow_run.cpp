// SPDX-License-Identifier: MIT
#include "host/outputs/slow_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/instance.hpp"
#include "host/names.hpp"

namespace muro::host {

namespace {

std::string who(const Instance& instance) {
  const AlgorithmSetup& s = instance.setup();
  const bool robots = !s.items.empty() && s.items.front().robot;
  return fmt::format("{} ({}{})", s.name, s.use, robots ? ", " + plural(s.items.size(), "robot") : "");
}

std::string advice(const Instance& instance, Rate rate) {
  const std::uint32_t capabilities = instance.description().capabilities;
  const std::string lower = rate.on_demand() ? "run what reads it less often"
                                             : fmt::format("give it a lower rate than {:g} Hz", rate.hertz());
  const bool motion = instance.description().kind == Kind::motion;
  if (motion && (capabilities & Capability::world) != 0 && instance.setup().items.size() > 1)
    return "all its robots are in one world, and an engine takes more than twice the time for twice the robots: give "
           "robots that do not meet worlds of their own (`world: NAME`), " +
           lower + ", or move robots that need no forces by a simpler motion";
  if (motion) return lower + ", or use a simpler motion";
  if (instance.description().kind == Kind::collision || instance.description().kind == Kind::contact)
    return "use simpler collision shapes, or motions that no force moves where contacts do not matter";
  return lower + ", or let it do less in each step";
}

}  // namespace

std::string SlowRun::note(double wall) {
  if (told_ || wall < patience) return "";
  const double simulated = 1e-9 * double(simulation_.now());
  if (simulated >= slow * wall) return "";
  const auto& instances = simulation_.instances();
  std::size_t largest = instances.size();
  double total = 0, most = 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    if ((instances[i]->description().capabilities & Capability::runs_alone) != 0) continue;
    const double seconds =
        double(simulation_.scheduler().cost(simulation_.task_of(i)).ticks) * simulation_.scheduler().seconds_per_tick();
    total += seconds;
    if (seconds > most) largest = i, most = seconds;
  }
  if (largest == instances.size() || total < 0.5 * wall) return "";
  told_ = true;
  const Instance& instance = *instances[largest];
  const Rate rate = simulation_.scheduler().tasks()[simulation_.task_of(largest)].rate;
  return fmt::format(
      "note: the run is slow, {:.2g} times real time: {:.0f} % of the time goes to {}; {}. `muro run --profile` shows "
      "what each algorithm costs",
      simulated / wall, 100 * most / total, who(instance), advice(instance, rate));
}

}  // namespace muro::host
