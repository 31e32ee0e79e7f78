/* SPDX-License-Identifier: MIT
 *
 * The interface of control code that muro loads from a shared library (algorithm `controller.library`).
 * C11 and C++20; no other header and no library of muro is needed. docs/guide/controllers.md explains how to use it;
 * examples/controllers has the same complete library in four languages. For C++ there is muro_controller.hpp.
 *
 * A library exports one function, `muro_controller`, which returns a constant table: the names of its
 * inputs and outputs, the size of its state, and its functions. One library serves any number of robots;
 * each of them is an instance.
 *
 * Inputs and outputs are arrays with a name, a unit and a size, of double unless a flag says otherwise. The
 * name is that of a property ("ranges", "laser.min_angle", "joint.position", "command.twist"); its elements
 * are converted to double and have the order of the property's columns (a twist: vx vy vz wx wy wz). muro
 * looks for the property on the base of the robot, then on its other objects; the scenario can connect a port
 * to any other property.
 *
 * An instance keeps its state between steps in one of two ways:
 *
 *     a block of bytes:      block cleared -> create -> step -> step -> ...
 *     memory of its own:     instantiate -> step -> step -> ... -> destroy
 *
 * `create` or `instantiate` runs just before the first step. A reset clears the block, or destroys the
 * instance, and begins again. A restored snapshot restores the bytes of the block and goes on with `step`:
 * nothing else is called, so the block must hold everything that a step keeps for the next one. For an instance
 * with memory of its own, `save` is called after each step; a restored snapshot destroys the instance, and goes
 * on with `instantiate` and `load`.
 *
 * All functions of one instance are called from one thread at a time; instances may run in parallel, so a
 * library must keep no variables outside its instances. No exception and no jump may leave a function.
 * Control code runs inside the simulator, where an invalid memory access ends the whole program, or in a
 * process of its own, as the scenario says (`isolate: process`).
 *
 * New members are added at the ends of structs. A library that was built with an older header still works; one
 * with a newer header than that of muro is refused.
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
  const char* name; /* a property, e.g. "ranges"; inputs have different names, and outputs have different names */
  const char* unit; /* its SI unit exactly as muro writes it, e.g. "m"; NULL: not checked. When the scenario connects
                     * several properties: one unit for all, or one for each in their order, as "rad, rad, m" */
  uint32_t size;    /* number of elements; 0: that of the property (outputs: see output_sizes) */
  uint32_t flags;   /* 0, or a bitwise OR of MURO_PORT_... */
} muro_port;

/* An input that may be missing: when no object of the robot has such a property, muro reports it once and the input
 * has size 0, so control code can work without a sensor. */
#define MURO_PORT_OPTIONAL 1u
/* The elements are int64_t and therefore exact; the property holds whole numbers. */
#define MURO_PORT_INTEGER 2u
/* One text in UTF-8 with a closing zero; the size counts its bytes and the zero. The property holds texts, objects
 * (the text is their name) or bytes; several texts are lines. A text that is too long is cut. */
#define MURO_PORT_TEXT 4u
/* An input whose number of elements changes from step to step, such as "contacts": muro_controller_step::input_sizes
 * gives the present number. The size is the largest number that is passed. */
#define MURO_PORT_LIST 8u
/* An output for which muro creates a property of this name on the robot, so that others can read or record it. */
#define MURO_PORT_OWN 16u

/* A number that the scenario may set: `tunables: ["speed=0.8"]`. */
typedef struct muro_tunable {
  const char* name;     /* different for each tunable */
  const char* unit;     /* SI, for the reader; NULL: none */
  double default_value; /* from min to max */
  double min, max;      /* the allowed range, both included; equal: any finite number */
  const char* doc;      /* one line for the reader, or NULL */
} muro_tunable;

/* Levels of log lines. */
#define MURO_LOG_DEBUG 0u
#define MURO_LOG_INFO 1u
#define MURO_LOG_WARNING 2u
#define MURO_LOG_ERROR 3u

/* Receives log lines: muro adds the names of robot and library, and the simulated time. To be called only within a
 * function of the instance, from its thread. */
typedef struct muro_log_sink {
  void* context;
  void (*write)(void* context, uint32_t level, const char* text);
} muro_log_sink;

/* The values that an instance gets when it is created. All pointers are valid only during that call. */
typedef struct muro_controller_setup {
  const char* robot;            /* name of the robot */
  double period;                /* s between steps */
  uint64_t seed;                /* from the simulation's seed and the robot's name: equal in all runs */
  const uint32_t* input_sizes;  /* actual size of each input */
  const char* const* arguments; /* "name=value" texts from the scenario, ended by NULL */
  /* The following fields were added with `tunables` of the table: a muro that accepts such a table has them. */
  const uint32_t* output_sizes; /* actual size of each output */
  uint32_t index;               /* index of this instance among those of the controller, from 0, as in the scenario */
  uint32_t count;               /* number of these instances */
  const double* tunables;       /* the value of each tunable */
  const muro_log_sink* log;     /* valid as long as the instance */
} muro_controller_setup;

/* One step. The pointers are valid only during `step`. */
typedef struct muro_controller_step {
  double time;                 /* s since the start of the simulation */
  const double* const* inputs; /* inputs[i][0 .. input_sizes[i] - 1]; NULL for ports of integers and texts */
  double* const* outputs;      /* outputs[i][0 .. size - 1]: finite numbers; they keep their last value */
  /* The following fields were added with `tunables` of the table: a muro that accepts such a table has them. */
  double period;                        /* s between calls of this function */
  uint64_t index;                       /* number of earlier runs of the controller */
  const uint32_t* input_sizes;          /* actual size of each input, which changes for lists */
  const uint32_t* output_sizes;         /* actual size of each output */
  const int64_t* const* integer_inputs; /* by index of the input; NULL for all others */
  const char* const* text_inputs;       /* by index of the input; NULL for all others */
  int64_t* const* integer_outputs;      /* by index of the output; NULL for all others */
  char* const* text_outputs;            /* by index of the output; NULL for all others */
  const double* tunables;               /* the value of each tunable */
  const muro_log_sink* log;
} muro_controller_step;

/* A part of the control code that runs less often than `step`. It is called in the same way, before `step` when both
 * are due. */
typedef struct muro_task {
  const char* name; /* for messages and for the scenario: `rates: ["plan=5"]` */
  double rate;      /* Hz; the controller's rate divided by a whole number: 20, 10, 5, 4, ... of 20 */
  int (*step)(void* instance, const muro_controller_step* step, char* error, size_t error_size);
} muro_task;

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
   * hashes it byte by byte: so it must hold no pointers and no handles, and should have no padding. */
  size_t state_size;

  /* Each returns 0 for success. Otherwise it writes a reason of at most `error_size` bytes, including its closing
   * zero, to `error`; muro ends the run and reports it with the robot's name. `create` may be NULL. */
  int (*create)(void* state, const muro_controller_setup* setup, char* error, size_t error_size);
  int (*step)(void* state, const muro_controller_step* step, char* error, size_t error_size);

  const muro_tunable* tunables;
  uint32_t tunable_count;
  const muro_task* tasks;
  uint32_t task_count;

  /* Instances with memory of their own: then `create` is NULL and state_size 0, and all other functions get the result
   * of `instantiate` in place of the block. It returns NULL for a failure, with a reason in `error`. */
  void* (*instantiate)(const muro_controller_setup* setup, char* error, size_t error_size);
  void (*destroy)(void* instance);

  /* Both or none. Without them a run of such a library has no snapshots, and muro reports that. `save` writes all that
   * `load` needs, at most `*size` bytes, which is save_size, and sets `*size` to their number. `load` is called on a
   * new instance. Equal instances must save equal bytes: muro hashes them. */
  size_t save_size;
  int (*save)(void* instance, void* to, size_t* size, char* error, size_t error_size);
  int (*load)(void* instance, const void* from, size_t size, char* error, size_t error_size);
} muro_controller_table;

/* Writes a log line, such as muro_write_log(now->log, MURO_LOG_INFO, "at the goal"). */
static inline void muro_write_log(const muro_log_sink* log, uint32_t level, const char* text) {
  log->write(log->context, level, text);
}

#if defined(_WIN32)
#define MURO_CONTROLLER_EXPORT __declspec(dllexport)
#else
#define MURO_CONTROLLER_EXPORT __attribute__((visibility("default")))
#endif

/* The only function that a library exports. */
MURO_CONTROLLER_EXPORT const muro_controller_table* muro_controller(void);

#ifdef __cplusplus
}
#endif

#endif
