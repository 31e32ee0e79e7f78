/* SPDX-License-Identifier: MIT
 * Drives in circles of alternating sense. The speed depends on the seed. Fails on demand. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "muro_controller.h"

typedef struct {
  uint64_t steps;
  double speed;   /* m/s */
  double fail_at; /* step */
  double nan_at;  /* step */
} circle;

static const muro_port inputs[] = {{"pose", "m", 7, 0}};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  circle* c = state;
  if (c->steps != 0 || c->speed != 0 || (uintptr_t)state % 64 != 0) {
    snprintf(error, error_size, "the block is not cleared, or not aligned");
    return 1;
  }
  c->speed = 0.1 + (double)(setup->seed >> 11) * 0x1.0p-53;
  c->fail_at = c->nan_at = HUGE_VAL;
  for (const char* const* a = setup->arguments; *a; ++a) {
    if (strcmp(*a, "tell=all") == 0) {
      snprintf(error, error_size, "robot %s, period %g, sizes %u", setup->robot, setup->period, setup->input_sizes[0]);
      return 1;
    }
    if (strcmp(*a, "tell=nothing") == 0) return 1;
    if (strcmp(*a, "tell=endless") == 0) {
      memset(error, 'x', error_size);
      return 1;
    }
    if (strncmp(*a, "fail_at=", 8) == 0) c->fail_at = atof(*a + 8);
    if (strncmp(*a, "nan_at=", 7) == 0) c->nan_at = atof(*a + 7);
  }
  return 0;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  circle* c = state;
  double* twist = now->outputs[0];
  if ((double)c->steps >= c->fail_at) {
    snprintf(error, error_size, "lost at x = %.3f after %.2f s", now->inputs[0][0], now->time);
    return 1;
  }
  ++c->steps;
  twist[0] = c->speed;
  twist[5] = c->steps / 7 % 2 == 0 ? 1 : -1;
  if ((double)c->steps > c->nan_at) twist[5] = NAN;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "circle",
    .version = "1.0.0",
    .summary = "Drives in circles",
    .inputs = inputs,
    .input_count = 1,
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(circle),
    .create = create,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
