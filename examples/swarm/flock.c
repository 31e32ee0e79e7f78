/* SPDX-License-Identifier: MIT
 *
 * Control code of the swarm example: a robot flocks with those that it sees by the three rules of Reynolds (Flocks,
 * herds, and schools: a distributed behavioral model, SIGGRAPH 1987):
 *
 *   separation   away from those that are too near
 *   alignment    with the mean heading of the neighbours
 *   cohesion     towards the middle of the neighbours
 *
 * The sum of the three and of the present heading is the wanted direction. A robot with two driven
 * wheels cannot go sideways: it turns towards this direction, and drives more slowly the farther it has to turn.
 *
 * Frames follow ROS REP-103: x forward, y left, angles counter-clockwise. All units are SI.
 */
#include <math.h>

#include "muro_controller.h"
#include "muro_elementary.h" /* sines and the like with equal bits on every machine */

/* Greatest number of neighbours that the device reports; more are cut off, the farthest first. */
enum { MAX_NEIGHBOURS = 32 };
enum { ID, DISTANCE, BEARING, ELEVATION, HEADING, NUMBERS }; /* numbers of a neighbour */

static const muro_port inputs[] = {{"neighbours", "1, m, rad", NUMBERS* MAX_NEIGHBOURS, MURO_PORT_LIST}};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}}; /* vx vy vz wx wy wz */

enum { SPEED, TURN_GAIN, MAX_TURN_RATE, SPACING, SEPARATION, ALIGNMENT, COHESION, TUNABLES };
static const muro_tunable tunables[TUNABLES] = {
    {"speed", "m/s", 0.2, 0, 2, "of a robot that need not turn"},
    {"turn_gain", "1/s", 1.5, 0, 20, "turn rate in proportion to the angle that is left"},
    {"max_turn_rate", "rad/s", 2, 0, 20, "fastest turn"},
    {"spacing", "m", 0.5, 0.01, 10, "nearer ones are too near"},
    {"separation", "1", 4, 0, 100, "weight of this rule"},
    {"alignment", "1", 2, 0, 100, "weight of this rule"},
    {"cohesion", "1", 1.5, 0, 100, "weight of this rule"},
};

typedef struct {
  double x, y;
} vector;

static void add(vector* sum, double weight, vector v) {
  sum->x += weight * v.x;
  sum->y += weight * v.y;
}

static vector towards(double angle) {
  vector v;
  muro_sincos(angle, &v.y, &v.x);
  return v;
}

/* Returns the wanted direction in the frame of the robot; its length does not matter. */
static vector wanted_direction(const double* neighbour, uint32_t count, const double* tunable) {
  vector separation = {0, 0}, alignment = {0, 0}, cohesion = {0, 0}, wanted = {1, 0};
  if (count == 0) return wanted;
  for (uint32_t i = 0; i < count; ++i, neighbour += NUMBERS) {
    const vector there = towards(neighbour[BEARING]);
    const double distance = neighbour[DISTANCE], lack = tunable[SPACING] / fmax(distance, 0.01) - 1;
    if (lack > 0) add(&separation, -lack, there);
    add(&alignment, 1.0 / count, towards(neighbour[HEADING]));
    add(&cohesion, distance / tunable[SPACING] / count, there);
  }
  add(&wanted, tunable[SEPARATION], separation);
  add(&wanted, tunable[ALIGNMENT], alignment);
  add(&wanted, tunable[COHESION], cohesion);
  return wanted;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)state, (void)error, (void)error_size;
  const double* tunable = now->tunables;
  const vector wanted = wanted_direction(now->inputs[0], now->input_sizes[0] / NUMBERS, tunable);
  const double angle = muro_atan2(wanted.y, wanted.x), most = tunable[MAX_TURN_RATE];
  double* twist = now->outputs[0];
  twist[0] = tunable[SPEED] * fmax(0, towards(angle).x);
  twist[5] = fmax(-most, fmin(most, tunable[TURN_GAIN] * angle));
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "flock",
    .version = "1.0.0",
    .summary = "Flocks with the robots it sees: separation, alignment, cohesion",
    .inputs = inputs,
    .input_count = 1,
    .outputs = outputs,
    .output_count = 1,
    .step = step,
    .tunables = tunables,
    .tunable_count = TUNABLES,
};

const muro_controller_table* muro_controller(void) { return &table; }
