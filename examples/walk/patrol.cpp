// SPDX-License-Identifier: MIT
// Steers a robot that walks by the library `walk`, as the code of a soccer player would: straight on, a quarter turn to
// the left, and so on. It writes `walk.command`, a property of its own that `walk` reads.
#include <cmath>
#include <numbers>

#include "muro_controller.hpp"

namespace {

using namespace muro::controller;

enum Tunable { speed, turn, straight };

class Patrol {
 public:
  static constexpr const char* name = "patrol";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Has a robot that walks go round a square";
  static constexpr muro_port outputs[] = {{"walk.command", "m/s, m/s, rad/s", 3, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {{"speed", "m/s", 0.1, -1, 1, "straight on"},
                                              {"turn", "rad/s", 0.3, 0.01, 3, "to the left"},
                                              {"straight", "s", 6, 0.1, 1000, "between two turns"}};
  static constexpr std::size_t save_size = sizeof(double);

  explicit Patrol(const Setup&) {}

  void step(const Step& now) {
    const double quarter = 0.5 * std::numbers::pi / now.tunable(turn);
    const double part = std::fmod(time_, now.tunable(straight) + quarter);
    const bool turns = part >= now.tunable(straight);
    now.output(0)[0] = turns ? 0 : now.tunable(speed);
    now.output(0)[2] = turns ? now.tunable(turn) : 0;
    time_ += now.period();
  }

  void save(Saver& to) const { to.put(time_); }
  void load(Loader& from) { time_ = from.get<double>(); }

 private:
  double time_ = 0;  // s
};

}  // namespace

MURO_CONTROLLER(Patrol)
