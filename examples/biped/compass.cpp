// SPDX-License-Identifier: MIT
// Walks by angles of joints that depend on time alone. No sensor is read; the robot stays upright only in a motion that
// does not let it fall (motion.biped).
//
// The legs swing like a pair of compasses: the line from hip to ankle of the stance leg moves evenly from `swing` ahead
// to `swing` behind. The line of the other leg moves the other way, with a knee that bends more on the way. Soles stay
// parallel to the trunk. A step is 2 l sin(swing) long, with l the distance from hip to ankle.
#include <cmath>

#include "muro_controller.hpp"
#include "muro_elementary.h"  // sines with equal bits on every machine

namespace {

using namespace muro::controller;

constexpr double crouch = 0.6;  // rad, of the knee of the stance leg
constexpr double arm = 1.3;     // rad: arms hang down
constexpr double pi = 3.14159265358979323846;

enum Output { targets };
enum Tunable { swing, turn, period, lift };
enum Joint { hip_yaw, hip_pitch, knee, ankle_pitch, shoulder_pitch, shoulder_roll, joints_of_side };

class Compass {
 public:
  static constexpr const char* name = "compass";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Walks open loop, by angles of joints that depend on time alone";
  static constexpr muro_port outputs[] = {{"joint.position.target", "rad", 2 * joints_of_side, 0}};
  static constexpr muro_tunable tunables[] = {
      {"swing", "rad", 0.25, -0.6, 0.6, "of the legs, ahead and behind; below 0 it walks backwards"},
      {"turn", "rad", 0, -0.6, 0.6, "of the body, to the left, in each step"},
      {"period", "s", 0.4, 0.05, 10, "of a step"},
      {"lift", "rad", 0.5, 0, 1.5, "by which the knee of the swing leg bends more"}};
  static constexpr std::size_t save_size = sizeof(double);

  explicit Compass(const Setup&) {}

  void step(const Step& now) {
    phase_ += now.period() / now.tunable(period);
    const double done = std::floor(phase_), part = phase_ - done;
    const double amplitude = done < 1 ? part : 1;  // the first step begins with both legs upright
    const bool left_stands = std::fmod(done, 2) == 0;
    const auto targets_of_all = now.output(targets);
    for (const bool left : {true, false}) {
      const bool stands = left == left_stands;
      const double way = (stands ? 1 : -1) * (2 * part - 1) * amplitude;
      const double leg = now.tunable(swing) * way;
      const double bend = crouch + (stands ? 0 : now.tunable(lift) * muro_sin(pi * part));
      double* const q = targets_of_all.data() + (left ? 0 : joints_of_side);
      q[hip_yaw] = -0.5 * now.tunable(turn) * way;
      q[hip_pitch] = leg - 0.5 * bend;
      q[knee] = bend;
      q[ankle_pitch] = -leg - 0.5 * bend;
      q[shoulder_pitch] = -leg;
      q[shoulder_roll] = left ? -arm : arm;
    }
  }

  void save(Saver& to) const { to.put(phase_); }
  void load(Loader& from) { phase_ = from.get<double>(); }

 private:
  double phase_ = 0;  // steps
};

}  // namespace

MURO_CONTROLLER(Compass)
