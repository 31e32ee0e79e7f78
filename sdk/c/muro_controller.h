/* SPDX-License-Identifier: MIT
 *
 * The interface of control code that muro loads from a shared library (algorithm `controller.library`).
 * C11 and C++20; no muro header or library is needed beside this file. docs/controllers.md is the how-to,
 * examples/urban/wander.c a complete library.
 *
 * A library exports one function, `muro_controller`, which returns a constant table: the names of its
 * inputs and outputs, the size of its state, and two functions. One library serves any number of robots;
 * each of them, an instance, has a state block of its own.
 *
 * Inputs and outputs are arrays of double with a name, a unit and a size. The name is that of a property
 * ("ranges", "laser.min_angle", "joint.position", "command.twist"); its elements are converted to double
 * and stand in the order of the property's columns (a twist: vx vy vz wx wy wz). muro looks for the property
 * on the base of the robot, then on its other objects; the scenario can connect a port to any other one.
 *
 * Life of an instance:
 *
 *     block cleared -> create -> step -> step -> ...
 *
 * `create` runs just before the first step. A reset clears the block and begins again with `create`. A
 * restored snapshot brings back the bytes of the block and goes on with `step`: nothing else is called,
 * so all that a step leaves for the next one must be in the block.
 *
 * All functions of one instance are called from one thread at a time; instances may run in parallel, so a
 * library keeps no variables outside the state blocks. Nothing may be thrown or jumped out of a function.
 * Control code runs inside the simulator: an invalid memory access ends the whole program.
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
  const char* name; /* a property, e.g. "ranges"; no two inputs, and no two outputs, have the same */
  const char* unit; /* its SI unit letter by letter as muro writes it, e.g. "m"; NULL: not checked */
  uint32_t size;    /* number of doubles; 0: as many as the property has (inputs only) */
  uint32_t flags;   /* 0, or MURO_PORT_OPTIONAL */
} muro_port;

/* An input that may be missing: where nothing of the robot has such a property, muro says so once and the input has
 * size 0, so control code can live with a robot that lacks a sensor. */
#define MURO_PORT_OPTIONAL 1u

/* What an instance learns when it is created. All pointers are valid during `create` only. */
typedef struct muro_controller_setup {
  const char* robot;            /* name of the robot */
  double period;                /* s between steps */
  uint64_t seed;                /* from the simulation's seed and the robot's name: equal between runs */
  const uint32_t* input_sizes;  /* actual size of each input */
  const char* const* arguments; /* "name=value" texts from the scenario, ended by NULL */
} muro_controller_setup;

/* One step. The pointers are valid during `step` only. */
typedef struct muro_controller_step {
  double time;                 /* s since the start of the simulation */
  const double* const* inputs; /* inputs[i][0 .. input_sizes[i] - 1] */
  double* const* outputs;      /* outputs[i][0 .. size - 1]: finite numbers; they keep their last value */
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

  /* Bytes of state of one instance. muro owns the block, aligns it to 64 bytes and saves, restores and
   * hashes it byte by byte: so it holds no pointers and no handles, and is best free of padding. */
  size_t state_size;

  /* Each returns 0 for success. Otherwise it writes a reason of at most `error_size` bytes, with its closing
   * zero, to `error`; muro ends the run and reports it with the robot's name. `create` may be NULL. */
  int (*create)(void* state, const muro_controller_setup* setup, char* error, size_t error_size);
  int (*step)(void* state, const muro_controller_step* step, char* error, size_t error_size);
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
