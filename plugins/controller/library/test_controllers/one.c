/* SPDX-License-Identifier: MIT
 * A controller that does nothing. Each part can be replaced by a wrong one. */
#include "muro_controller.h"

#ifndef TABLE
#define TABLE &table
#endif
#ifndef ABI
#define ABI MURO_CONTROLLER_ABI
#endif
#ifndef TABLE_SIZE
#define TABLE_SIZE sizeof(muro_controller_table)
#endif
#ifndef NAME
#define NAME "one"
#endif
#ifndef STEP
#define STEP step
#endif
#ifndef STATE_SIZE
#define STATE_SIZE 8
#endif
#ifndef INPUTS
#define INPUTS inputs
#endif
#ifndef SECOND_INPUT
#define SECOND_INPUT "twist"
#endif
#ifndef OUTPUT
#define OUTPUT "command.twist"
#endif
#ifndef UNIT
#define UNIT "m/s, rad/s"
#endif
#ifndef OUTPUT_SIZE
#define OUTPUT_SIZE 6
#endif

const muro_port inputs[] = {{"pose", "m", 7, 0}, {SECOND_INPUT, NULL, 0, 0}};
const muro_port outputs[] = {{OUTPUT, UNIT, OUTPUT_SIZE, 0}};

int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)state, (void)now, (void)error, (void)error_size;
  return 0;
}

const muro_controller_table table = {
    .abi = ABI,
    .table_size = TABLE_SIZE,
    .name = NAME,
    .version = "1.0.0",
    .summary = "Does nothing",
    .inputs = INPUTS,
    .input_count = 2,
    .outputs = outputs,
    .output_count = 1,
    .state_size = STATE_SIZE,
    .step = STEP,
};

const muro_controller_table* muro_controller(void) { return TABLE; }
