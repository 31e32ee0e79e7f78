/* SPDX-License-Identifier: MIT
 * Sends all others, once a step, the number of messages that it has heard, and shows the last message: vx is the number
 * in its text, vy its sender, vz the number of messages in the list. */
#include <stdio.h>
#include <stdlib.h>

#include "muro_controller.h"

enum { MESSAGES = 64 };
enum { FROM, NUMBER, SENT, RECEIVED, RSSI, SIZE, FIRST, HEADER };

static const muro_port inputs[] = {{"radio.received", "1, s, dBm", HEADER* MESSAGES, MURO_PORT_LIST},
                                   {"radio.received.bytes", "1", 256 * MESSAGES, MURO_PORT_LIST}};
static const muro_port outputs[] = {{"radio.send.bytes", "1", 32, MURO_PORT_TEXT},
                                    {"radio.send.size", "1", 1, 0},
                                    {"radio.send.number", "1", 1, MURO_PORT_INTEGER},
                                    {"command.twist", "m/s, rad/s", 6, 0}};

typedef struct {
  int64_t sent, heard;
} talk;

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  talk* t = state;
  double* shown = now->outputs[3];
  const uint32_t messages = now->input_sizes[0] / HEADER;
  for (uint32_t i = 0; i < messages; ++i) {
    const double* header = now->inputs[0] + HEADER * i;
    const double* bytes = now->inputs[1] + (uint32_t)header[FIRST];
    char text[33] = "";
    for (int k = 0; k < 32 && k < header[SIZE]; ++k) text[k] = (char)bytes[k];
    shown[0] = atof(text);
    shown[1] = header[FROM];
    ++t->heard;
  }
  shown[2] = messages;
  now->outputs[1][0] = snprintf(now->text_outputs[0], 32, "%ld", (long)t->heard);
  now->integer_outputs[2][0] = ++t->sent;
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "talk",
    .version = "1.0.0",
    .summary = "Tells how many messages it has heard",
    .inputs = inputs,
    .input_count = 2,
    .outputs = outputs,
    .output_count = 4,
    .state_size = sizeof(talk),
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
