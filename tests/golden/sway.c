/* SPDX-License-Identifier: MIT
 * Control code of the golden scenes: swings to and fro by functions with equal bits on every machine. Compiled for one
 * of three outputs: a base command (SWAY_TWIST), a pose to go to (SWAY_POSE), or two joint targets. */
#include <string.h>

#include "muro_controller.h"
#include "muro_elementary.h"

typedef struct {
  double phase; /* rad, from the seed, so that each robot has its own */
} sway;

#if defined(SWAY_TWIST)
static const muro_port outputs[] = {{"command.twist", NULL, 6, 0}};
#elif defined(SWAY_POSE)
static const muro_port outputs[] = {{"command.pose", NULL, 7, 0}};
#else
static const muro_port outputs[] = {{"targets", NULL, 2, 0}};
#endif

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  (void)error, (void)error_size;
  ((sway*)state)->phase = muro_asin((double)(setup->seed >> 11) * 0x1.0p-53) + muro_tanh(1);
  return 0;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  double *out = now->outputs[0], sine, cosine;
  const double angle = 3 * now->time + ((const sway*)state)->phase;
  muro_sincos(angle, &sine, &cosine);
#if defined(SWAY_TWIST)
  out[0] = 0.4 + 0.3 * sine;
  out[1] = 0.2 * muro_exp(-now->time) * cosine;
  out[5] = 0.8 * muro_sin(0.5 * angle);
#elif defined(SWAY_POSE)
  out[0] = muro_hypot(sine, 2 * cosine);
  out[1] = muro_log(2 + sine);
  out[2] = 0.5 * muro_pow(1.5, cosine);
  const double half = 0.5 * muro_atan2(sine, 2 * cosine), turn = muro_atan(0.5 * cosine);
  out[3] = muro_sin(half) * muro_sin(turn);
  out[4] = 0;
  out[5] = muro_sin(half) * muro_cos(turn);
  out[6] = muro_cos(half);
#else
  out[0] = 0.3 * sine;
  out[1] = -0.6 + 0.3 * cosine;
#endif
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "sway",
    .version = "1.0.0",
    .summary = "Swings to and fro",
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(sway),
    .create = create,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
