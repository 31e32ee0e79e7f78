/* SPDX-License-Identifier: MIT
 * Moves joints steadily, by 0.5 rad/s; also commands their speed when it is built so. */
#include "muro_controller.h"

#ifdef WITH_VELOCITY
#define OUTPUTS 2
#else
#define OUTPUTS 1
#endif

static const muro_port outputs[] = {{"position", NULL, 0, 0}, {"velocity", NULL, 0, 0}};
static const double speed = 0.5;

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)state, (void)error, (void)error_size;
  for (uint32_t i = 0; i < now->output_sizes[0]; ++i) now->outputs[0][i] = speed * now->time;
#ifdef WITH_VELOCITY
  for (uint32_t i = 0; i < now->output_sizes[1]; ++i) now->outputs[1][i] = speed;
#endif
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "ramp",
    .version = "1.0.0",
    .summary = "Moves joints steadily",
    .outputs = outputs,
    .output_count = OUTPUTS,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
