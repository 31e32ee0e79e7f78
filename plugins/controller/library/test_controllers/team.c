/* SPDX-License-Identifier: MIT
 * Steers two robots along x, each to the place of the other. */
#include "muro_controller.h"

static const muro_port inputs[] = {{"poses", "m", 14, 0}};
static const muro_port outputs[] = {{"commands", "m/s, rad/s", 12, 0}};

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)state, (void)error, (void)error_size;
  const double apart = now->inputs[0][7] - now->inputs[0][0];
  now->outputs[0][0] = apart;
  now->outputs[0][6] = -apart;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "team",
    .version = "1.0.0",
    .summary = "Brings two robots together",
    .inputs = inputs,
    .input_count = 1,
    .outputs = outputs,
    .output_count = 1,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
