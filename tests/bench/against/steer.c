/* SPDX-License-Identifier: MIT
 * Control code of the scenes: drives with another speed and turn at each step. */
#include <string.h>

#include "muro_controller.h"

typedef struct {
  uint64_t number; /* random, from the seed */
} steer;

static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  (void)error, (void)error_size;
  ((steer*)state)->number = setup->seed | 1;
  return 0;
}

/* Returns a number from 0 to 1, by xorshift. */
static double uniform(steer* s) {
  s->number ^= s->number << 13, s->number ^= s->number >> 7, s->number ^= s->number << 17;
  return (double)(s->number >> 11) * 0x1.0p-53;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  const int forward = uniform(state) < 0.75;
  const double speed = uniform(state);
  memset(now->outputs[0], 0, 6 * sizeof(double));
  now->outputs[0][0] = forward ? 0.4 + 0.6 * speed : -0.8 + 0.5 * speed;
  now->outputs[0][5] = 2 * uniform(state) - 1;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "steer",
    .version = "1.0.0",
    .summary = "Drives to and fro",
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(steer),
    .create = create,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
