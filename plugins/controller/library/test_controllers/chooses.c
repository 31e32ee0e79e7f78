/* SPDX-License-Identifier: MIT
 * Commands another motion for its robot from second `from` on. */
#include "muro_controller.h"

static const muro_port outputs[] = {{"motion.level.target", "1", 1, MURO_PORT_INTEGER}};
static const muro_tunable tunables[] = {{"level", NULL, 1, 0, 9, NULL}, {"from", "s", 0, 0, 1000, NULL}};

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)state, (void)error, (void)error_size;
  now->integer_outputs[0][0] = now->time >= now->tunables[1] ? (int64_t)now->tunables[0] : -1;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "chooses",
    .version = "1.0.0",
    .summary = "Chooses a motion",
    .outputs = outputs,
    .output_count = 1,
    .step = step,
    .tunables = tunables,
    .tunable_count = 2,
};

const muro_controller_table* muro_controller(void) { return &table; }
