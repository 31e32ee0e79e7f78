/* SPDX-License-Identifier: MIT
 * Control code built with the first header of ABI 1, with a copy of its structs. It must continue to work. */
#include <stddef.h>
#include <stdint.h>

typedef struct {
  const char* name;
  const char* unit;
  uint32_t size;
  uint32_t flags;
} port;
typedef struct {
  const char* robot;
  double period;
  uint64_t seed;
  const uint32_t* input_sizes;
  const char* const* arguments;
} setup;
typedef struct {
  double time;
  const double* const* inputs;
  double* const* outputs;
} step;
typedef struct {
  uint32_t abi;
  uint32_t table_size;
  const char* name;
  const char* version;
  const char* summary;
  const port* inputs;
  uint32_t input_count;
  const port* outputs;
  uint32_t output_count;
  size_t state_size;
  int (*create)(void* state, const setup* s, char* error, size_t error_size);
  int (*step)(void* state, const step* now, char* error, size_t error_size);
} table;

typedef struct {
  double period;
  uint64_t steps;
} state;

static const port inputs[] = {{"pose", "m", 7, 0}, {"ranges", "m", 0, 1}};
static const port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

static int create(void* block, const setup* s, char* error, size_t error_size) {
  (void)error, (void)error_size;
  ((state*)block)->period = s->period;
  return s->input_sizes[0] == 7 && s->input_sizes[1] == 0 && s->arguments[0] == NULL ? 0 : 1;
}

static int steer(void* block, const step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  state* s = block;
  ++s->steps;
  now->outputs[0][0] = 0.5;
  now->outputs[0][1] = (double)s->steps * s->period - now->time; /* the period, as the first step is at time 0 */
  return 0;
}

/* muro must not read the data behind the table */
static const struct {
  table first;
  uint64_t behind[16];
} exported = {
    {1, sizeof(table), "frozen", "1.0.0", "Built with the first header", inputs, 2, outputs, 1, sizeof(state), create,
     steer},
    {~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull},
};

__attribute__((visibility("default"))) const table* muro_controller(void);
const table* muro_controller(void) { return &exported.first; }
