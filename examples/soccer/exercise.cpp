// SPDX-License-Identifier: MIT
// Open loop: a humanoid squats, or steps in place, or shifts its weight and kicks once. The angles of its joints depend
// on time alone. No sensor is read; soles and servos keep it upright.
//
// Thighs are bent forward by an angle and knees by twice as much, so that soles and trunk stay level. Hips and ankles
// roll by opposite angles to shift the trunk sideways. The leg without weight is lifted by a further bend.
#include <cmath>
#include <numbers>

#include "muro_controller.hpp"
#include "muro_elementary.h"  // sines with equal bits on every machine

namespace {

using namespace muro::controller;
using std::numbers::pi;

constexpr double crouch = 0.4;  // rad, of the thigh
constexpr double arm = 1.3;     // rad: arms hang down

enum Output { targets };
enum Tunable { squat, sway, lift, period, phase, kick };
enum Joint { hip_roll, hip_pitch, knee, ankle_pitch, ankle_roll, shoulder_pitch, shoulder_roll, elbow, joints_of_side };

/// Returns 0 before `start`, 1 after `end`, and a smooth rise in between.
double rise(double t, double start, double end) {
  if (t <= start) return 0;
  if (t >= end) return 1;
  return 0.5 - 0.5 * muro_cos(pi * (t - start) / (end - start));
}

class Exercise {
 public:
  static constexpr const char* name = "exercise";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Squats, steps in place and kicks open loop";
  static constexpr muro_port outputs[] = {{"joint.position.target", "rad", 2 * joints_of_side, 0}};
  static constexpr muro_tunable tunables[] = {
      {"squat", "rad", 0, 0, 0.4, "by which thighs bend more and less"},
      {"sway", "rad", 0, 0, 0.4, "of the legs, to either side"},
      {"lift", "rad", 0, 0, 0.6, "by which the thigh of the leg without weight bends more"},
      {"period", "s", 1, 0.2, 100, "of all of these"},
      {"phase", "1", 0, 0, 1, "at the start, in periods"},
      {"kick", "s", 0, 0, 1e6, "when the left leg kicks, with everything else at rest; 0: never"}};
  static constexpr std::size_t save_size = sizeof(double);

  explicit Exercise(const Setup&) {}

  void step(const Step& now) {
    time_ += now.period();
    const double angle = 2 * pi * (time_ / now.tunable(period) + now.tunable(phase));
    const double begun = rise(time_, 0, 0.5);
    const bool kicks = now.tunable(kick) > 0;
    const double t = time_ - now.tunable(kick);
    const double shifted = kicks ? rise(t, -1.2, -0.5) - rise(t, 0.7, 1.3) : 0;
    const double raised = kicks ? rise(t, -0.5, -0.2) - rise(t, 0.6, 0.9) : 0;
    const double swung = kicks ? rise(t, -0.05, 0.08) - rise(t, 0.25, 0.6) : 0;
    const double back = kicks ? rise(t, -0.4, -0.1) - rise(t, -0.05, 0.08) : 0;
    // above 0: the weight is on the right leg
    const double lean = begun * now.tunable(sway) * muro_sin(angle) + kick_lean * shifted;
    const double bend = crouch - begun * now.tunable(squat) * muro_sin(angle);
    const auto q_of_all = now.output(targets);
    for (const bool left : {true, false}) {
      const double side = left ? 1 : -1;
      const double free = begun * std::fmax(0, side * muro_sin(angle));
      double thigh = bend + now.tunable(lift) * free * free;
      double ahead = 0;
      if (left) thigh += kick_lift * raised, ahead = kick_swing * swung - kick_back * back;
      double* const q = q_of_all.data() + (left ? 0 : joints_of_side);
      q[hip_roll] = lean;
      q[hip_pitch] = -thigh - ahead;
      q[knee] = 2 * thigh;
      q[ankle_pitch] = -thigh + ahead;
      q[ankle_roll] = -lean;
      q[shoulder_pitch] = 0.4 * (left ? 1 : -1) * begun * now.tunable(sway) * muro_sin(angle) + 0.8 * ahead;
      q[shoulder_roll] = -side * arm;
      q[elbow] = -side * 0.4;
    }
  }

  void save(Saver& to) const { to.put(time_); }
  void load(Loader& from) { time_ = from.get<double>(); }

 private:
  static constexpr double kick_lean = 0.22, kick_lift = 0.22, kick_swing = 0.45, kick_back = 0.35;  // rad

  double time_ = 0;  // s
};

}  // namespace

MURO_CONTROLLER(Exercise)
