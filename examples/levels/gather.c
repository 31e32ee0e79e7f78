/* SPDX-License-Identifier: MIT
 *
 * Control code of the example of levels: drives to the origin and stays there, without regard to obstacles.
 *
 *   speed=0.4   m/s, at most
 *   stop=0.05   m from the origin at which it rests
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "muro_controller.h"
#include "muro_elementary.h"

typedef struct {
  double speed, stop;
} gather;

static const muro_port inputs[] = {{"pose", "m", 7, 0}};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

/* "name=value" sets *number; returns 1 when `argument` has this name and a value from 0 to `max`. */
static int parse_argument(const char* argument, const char* name, double max, double* number) {
  const size_t length = strlen(name);
  if (strncmp(argument, name, length) != 0 || argument[length] != '=') return 0;
  char* end;
  const double value = strtod(argument + length + 1, &end);
  if (end == argument + length + 1 || *end != 0 || !(value >= 0 && value <= max)) return 0;
  *number = value;
  return 1;
}

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  gather* g = state;
  g->speed = 0.4;
  g->stop = 0.05;
  for (const char* const* a = setup->arguments; *a; ++a) {
    if (parse_argument(*a, "speed", 2, &g->speed) || parse_argument(*a, "stop", 100, &g->stop)) continue;
    snprintf(error, error_size, "argument `%s` is none of: speed=0..2 (m/s), stop=0..100 (m)", *a);
    return 1;
  }
  return 0;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  const gather* g = state;
  const double *pose = now->inputs[0], x = pose[0], y = pose[1];
  double* twist = now->outputs[0];
  const double heading = 2 * muro_atan2(pose[5], pose[6]);
  const double turn = remainder(muro_atan2(-y, -x) - heading, 2 * 3.14159265358979323846);
  (void)error;
  (void)error_size;
  memset(twist, 0, 6 * sizeof(double));
  if (muro_hypot(x, y) < g->stop) return 0;
  twist[0] = g->speed * fmax(0, muro_cos(turn));
  twist[5] = fmax(-1, fmin(1, 2 * turn));
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "gather",
    .version = "1.0.0",
    .summary = "Drives to the origin",
    .inputs = inputs,
    .input_count = 1,
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(gather),
    .create = create,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
