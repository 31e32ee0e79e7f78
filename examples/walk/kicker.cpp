// SPDX-License-Identifier: MIT
// Makes a robot that walks by the library `walk` kick again and again, as the code of a soccer player would. It writes
// `walk.kick`, a property of its own that `walk` reads.
#include <cmath>

#include "muro_controller.hpp"

namespace {

using namespace muro::controller;

enum Tunable { foot, alternate, speed, start, every };

class Kicker {
 public:
  static constexpr const char* name = "kicker";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Has a robot that walks kick again and again";
  static constexpr muro_port outputs[] = {{"walk.kick", "1, m/s", 2, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {{"foot", "1", 1, -1, 1, "1: the left one, -1: the right one"},
                                              {"alternate", "1", 0, 0, 1, "1: the feet take turns"},
                                              {"speed", "m/s", 1, 0, 5, "of the foot"},
                                              {"start", "s", 3, 0, 1e6, "when it kicks first"},
                                              {"every", "s", 4, 0.1, 1e6, "from kick to kick"}};
  static constexpr std::size_t save_size = sizeof(double);

  explicit Kicker(const Setup&) {}

  void step(const Step& now) {
    const double since = time_ - now.tunable(start), count = std::floor(since / now.tunable(every));
    const bool asks = since >= 0 && since - count * now.tunable(every) < 0.5 * now.tunable(every);
    const double turned = now.tunable(alternate) > 0 && std::fmod(count, 2) != 0 ? -1 : 1;
    now.output(0)[0] = asks ? turned * now.tunable(foot) : 0;
    now.output(0)[1] = now.tunable(speed);
    time_ += now.period();
  }

  void save(Saver& to) const { to.put(time_); }
  void load(Loader& from) { time_ = from.get<double>(); }

 private:
  double time_ = 0;  // s
};

}  // namespace

MURO_CONTROLLER(Kicker)
