// SPDX-License-Identifier: MIT
// Software of the base station: collects by radio which targets the team has found and confirmed, and when.
#include <algorithm>
#include <cstdint>
#include <string>

#include "muro_controller.hpp"
#include "radio.hpp"

namespace {

using namespace muro::controller;
using namespace mixed_team;

enum Input { received, received_bytes };
enum Output { found, confirmed, last_found, last_confirmed, targets_told };

class Collect {
 public:
  static constexpr const char* name = "collect";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Collects what a team has found, and tells how many targets that are";
  static constexpr muro_port inputs[] = {received_port, received_bytes_port};
  static constexpr muro_port outputs[] = {{"mission.found", "1", 1, MURO_PORT_OWN},
                                          {"mission.confirmed", "1", 1, MURO_PORT_OWN},
                                          {"mission.last_found", "s", 1, MURO_PORT_OWN},
                                          {"mission.last_confirmed", "s", 1, MURO_PORT_OWN},
                                          // for each target: x, y (m), 1 if there is one, 1 if it is confirmed
                                          {"mission.targets", "m, m, 1, 1", 4 * Targets::most, MURO_PORT_OWN}};

  explicit Collect(const Setup&) {}

  void step(const Step& now) {
    receive(now.input(received), now.input(received_bytes), [&](const Message& m) {
      for (std::size_t i = 0; i < m.targets.size(); ++i) memory_.targets.learn(m.targets[i]);
    });
    double count = 0, there = 0;
    const auto told = now.output(targets_told);
    for (std::size_t i = 0; i < memory_.targets.size(); ++i, ++count) {
      const Target& t = memory_.targets[i];
      const double row[] = {t.at.x, t.at.y, 1, double(t.confirmed)};
      std::copy(std::begin(row), std::end(row), told.begin() + std::ptrdiff_t(4 * i));
      there += double(t.confirmed);
    }
    if (count > memory_.found) memory_.last_found = now.time();
    if (there > memory_.confirmed) memory_.last_confirmed = now.time();
    memory_.found = count, memory_.confirmed = there;
    now.output(found)[0] = count, now.output(confirmed)[0] = there;
    now.output(last_found)[0] = memory_.last_found, now.output(last_confirmed)[0] = memory_.last_confirmed;
  }

 private:
  struct Memory {
    Targets targets;
    double found = 0, confirmed = 0, last_found = 0, last_confirmed = 0;  // s
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);
  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Collect)
