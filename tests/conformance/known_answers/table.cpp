// SPDX-License-Identifier: MIT
// Prints docs/reference/known-answers.md.
#include <cstdio>

#include "tests/conformance/known_answers/answer.hpp"

namespace muro::known_answers {
namespace {

constexpr const char* head =
    "# Known answers: noise, motors, radio\n\n"
    "For those who want to know how far errors of sensors, servos and radios are what closed forms, data\n"
    "sheets and measurements say, and whether a bug of their simulator is here, too. Made by\n"
    "`build/bin/known_answers_table`, which asks\n"
    "[tests/conformance/known_answers](../../tests/conformance/known_answers); each number is the error that\n"
    "it found, in the unit beside it, and the test fails where it is above the tolerance. Seeds are\n"
    "fixed. What sensors read at which motion is in [sensor-levels.md](sensor-levels.md).\n\n";

constexpr const char* elsewhere =
    "\n## Held elsewhere\n\n"
    "| known answer | where |\n|---|---|\n"
    "| accelerometers at rest, in free fall, on turntables; gyros; slow sensors; resets | "
    "[sensor-levels.md](sensor-levels.md) |\n"
    "| pendulums, held arms, feet and centres of pressure, bumpers | [sensor-levels.md](sensor-levels.md) |\n"
    "| steps of a 12-bit encoder, odometry by a wrong radius and track | [sensor-levels.md](sensor-levels.md) |\n"
    "| flicker noise, the peak of a Gauss-Markov bias, second order of the low-pass, order of the links | "
    "[plugins/sensor/error](../../plugins/sensor/error/README.md) |\n"
    "| noise of orientations, poses, depth and neighbours, latitude and longitude with errors | "
    "[plugins/sensor/error](../../plugins/sensor/error/README.md) |\n"
    "| noise of odometry by way and turn, at 10 and at 100 Hz | "
    "[plugins/sensor/odometry](../../plugins/sensor/odometry/README.md) |\n"
    "| servo steps and sticking at each engine, models M2 to M4 | "
    "[plugins/motor/servo](../../plugins/motor/servo/README.md) |\n"
    "| motors identified from twelve real records, and from records of their own | [motors.md](../guide/motors.md) |\n"
    "| bit errors of IEEE 802.15.4, a shared medium, hidden senders | "
    "[plugins/radio/log_distance](../../plugins/radio/log_distance/README.md) |\n"
    "| steps, velocities and turns of compass walkers, on inclined planes too | "
    "[plugins/motion/biped](../../plugins/motion/biped/README.md) |\n\n"
    "Not held: the linear inverted pendulum and its preview gains, which belong to control code.\n";

void print() {
  std::printf("%s| plugin | known answer | source | error | unit | tolerance | |\n|---|---|---|---|---|---|---|\n",
              head);
  for (const Answer& a : all_answers()) {
    const Found found = a.run();
    std::printf("| %s | %s | %s | %.1e | %s | %.1e | %s |\n", a.plugin.data(), a.name.data(), a.source.data(),
                found.error, a.unit.data(), found.tolerance, a.allowed.data());
  }
  std::printf(
      "\n## Bugs that users of other simulators have named\n\n"
      "In parentheses the issue. What holds against it here is a row above or of\n"
      "[sensor-levels.md](sensor-levels.md).\n\n| simulator | bug | known answer |\n|---|---|---|\n");
  for (const PeerBug& b : peer_bugs()) std::printf("| %s | %s | %s |\n", b.peer.data(), b.bug.data(), b.answer.data());
  std::printf("%s", elsewhere);
}

}  // namespace
}  // namespace muro::known_answers

int main() { muro::known_answers::print(); }
