/* SPDX-License-Identifier: MIT
 *
 * Control code that hardly takes any time: a velocity from a pose. */
#include "muro_controller.h"

static const muro_port inputs[] = {{"pose", "m", 7, 0}};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)state, (void)error, (void)error_size;
  now->outputs[0][0] = now->inputs[0][0] > 1 ? -0.5 : 0.5;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "turn_about",
    .version = "1.0.0",
    .summary = "Drives to and fro",
    .inputs = inputs,
    .input_count = 1,
    .outputs = outputs,
    .output_count = 1,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
