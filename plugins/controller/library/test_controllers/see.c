/* SPDX-License-Identifier: MIT
 * Writes what it reads: vx is the first range, vy the last, vz the number of columns, wx the smaller angle. */
#include "muro_controller.h"

static const muro_port inputs[] = {{"ranges", "m", 0, 0}, {"laser.columns", "1", 1, 0}, {"angle", "rad", 1, 0}};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  (void)error, (void)error_size;
  *(uint64_t*)state = setup->input_sizes[0];
  return 0;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  const uint64_t rays = *(uint64_t*)state;
  double* twist = now->outputs[0];
  twist[0] = now->inputs[0][0];
  twist[1] = now->inputs[0][rays - 1];
  twist[2] = now->inputs[1][0];
  twist[3] = now->inputs[2][0];
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "see",
    .version = "1.0.0",
    .summary = "Shows what it reads",
    .inputs = inputs,
    .input_count = 3,
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(uint64_t),
    .create = create,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
