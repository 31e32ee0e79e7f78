/* SPDX-License-Identifier: MIT
 * Control code of the scenes: broadcasts a message at each step. */
#include "muro_controller.h"

typedef struct {
  int64_t number; /* of the last message */
} chatter;

static const muro_port outputs[] = {{"radio.send.size", "1", 1, MURO_PORT_INTEGER},
                                    {"radio.send.number", "1", 1, MURO_PORT_INTEGER}};

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  now->integer_outputs[0][0] = 32;
  now->integer_outputs[1][0] = ++((chatter*)state)->number;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "chatter",
    .version = "1.0.0",
    .summary = "Broadcasts",
    .outputs = outputs,
    .output_count = 2,
    .state_size = sizeof(chatter),
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
