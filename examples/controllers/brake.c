/* SPDX-License-Identifier: MIT
 * Drives ahead and stops before obstacles: in C, with a block of state. brake.cpp, brake.f90 and brake.rs do the same
 * to the bit. */
#include <stdio.h>

#include "muro_controller.h"

typedef struct {
  double speed; /* m/s, commanded last */
} brake;

static const muro_port inputs[] = {{"ranges", "m", 0, 0}};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

enum { SPEED, DISTANCE };
static const muro_tunable tunables[] = {{"speed", "m/s", 0.5, 0.1, 2, "on a free way"},
                                        {"distance", "m", 0.6, 0.1, 5, "from the obstacle before which it stops"}};
static const double acceleration = 0.5; /* m/s^2 */

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  (void)state;
  if (setup->input_sizes[0] >= 3) return 0;
  snprintf(error, error_size, "the laser has %u rays; it needs 3 or more", setup->input_sizes[0]);
  return 1;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  brake* b = state;
  const uint32_t rays = now->input_sizes[0];
  double nearest = now->inputs[0][rays / 3]; /* least range of the middle third */
  for (uint32_t i = rays / 3; i < rays - rays / 3; ++i)
    if (now->inputs[0][i] < nearest) nearest = now->inputs[0][i];
  double wanted = nearest - now->tunables[DISTANCE];
  if (wanted > now->tunables[SPEED]) wanted = now->tunables[SPEED];
  if (wanted < 0) wanted = 0;
  const double most = b->speed + acceleration * now->period;
  if (wanted == 0 && b->speed > 0) muro_write_log(now->log, MURO_LOG_INFO, "stands");
  b->speed = wanted < most ? wanted : most;
  now->outputs[0][0] = b->speed;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "brake",
    .version = "1.0.0",
    .summary = "Stops before what is in its way",
    .inputs = inputs,
    .input_count = 1,
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(brake),
    .create = create,
    .step = step,
    .tunables = tunables,
    .tunable_count = 2,
};

const muro_controller_table* muro_controller(void) { return &table; }
