/* SPDX-License-Identifier: MIT
 *
 * The interface of control code that muro loads from a shared library (algorithm `controller.library`).
 * C11 and C++20; no muro header or library is needed beside this file.
 *
 * A library exports one function, `muro_controller`, which returns a constant table: the names of its
 * inputs and outputs and a few functions. One library serves any number of robots; each instance has
 * its own `state` block.
 *
 * Inputs and outputs are arrays of double with a name, a unit and a size. A name is that of a property
 * ("ranges", "joint.position", "command.twist"; `muro describe SCENARIO` lists them); its elements are
 * converted to double and stand in the order of the property's columns. The scenario can connect a
 * port to another property.
 *
 * All functions of one instance are called from one thread at a time; instances may run in parallel,
 * so a library keeps no variables outside its state block.
 */
#ifndef MURO_CONTROLLER_H
#define MURO_CONTROLLER_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define MURO_CONTROLLER_ABI 1u

/* One input or output. */
typedef struct muro_port {
  const char* name; /* a property, e.g. "ranges" */
  const char* unit; /* its SI unit as muro writes it, e.g. "m"; NULL: not checked */
  uint32_t size;    /* number of doubles; 0: as many as the property has (inputs only) */
} muro_port;

/* What an instance learns when it is created. All pointers are valid during `create` only. */
typedef struct muro_controller_setup {
  const char* robot;            /* name of the robot */
  double period;                /* s between steps */
  uint64_t seed;                /* differs between robots, equal between runs */
  const uint32_t* input_sizes;  /* actual size of each input */
  const char* const* arguments; /* "name=value" texts from the scenario, ended by NULL */
} muro_controller_setup;

/* One step. */
typedef struct muro_controller_step {
  double time; /* s since the start of the simulation */
  const double* const* inputs; /* inputs[i][0 .. input_sizes[i] - 1] */
  double* const* outputs;      /* outputs[i][0 .. size - 1]; they keep their last value */
} muro_controller_step;

typedef struct muro_controller_table {
  uint32_t abi;        /* MURO_CONTROLLER_ABI */
  uint32_t table_size; /* sizeof(muro_controller_table) */
  const char* name;
  const char* version;
  const char* summary;

  const muro_port* inputs;
  uint32_t input_count;
  const muro_port* outputs;
  uint32_t output_count;

  /* Bytes of state of one instance. muro owns the block, clears it before `create`, and saves and
   * restores it byte by byte: so it holds no pointers and nothing that lives elsewhere. */
  size_t state_size;

  /* Each returns 0 for success. Otherwise it writes a reason of at most `error_size` bytes with its
   * closing zero to `error`; muro then ends the run and reports it. `create` and `destroy` may be NULL. */
  int (*create)(void* state, const muro_controller_setup* setup, char* error, size_t error_size);
  int (*step)(void* state, const muro_controller_step* step, char* error, size_t error_size);
  void (*destroy)(void* state);
} muro_controller_table;

#if defined(_WIN32)
#define MURO_CONTROLLER_EXPORT __declspec(dllexport)
#else
#define MURO_CONTROLLER_EXPORT __attribute__((visibility("default")))
#endif

/* The one function a library exports. */
MURO_CONTROLLER_EXPORT const muro_controller_table* muro_controller(void);

#ifdef __cplusplus
}
#endif

#endif
