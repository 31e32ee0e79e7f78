/* SPDX-License-Identifier: MIT */
/* The model of the FMUs of the tests: decays with closed forms, a controller, an input that is passed to an output for
 * every type, and faults on demand. A communication step advances it from `time` to `time` + `size`. */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { INTERNAL_STEPS = 100 }; /* per second */

enum fault {
  FAULT_NONE,
  FAULT_ERROR,
  FAULT_FATAL,
  FAULT_END,
  FAULT_CRASH,
  FAULT_PENDING,
  FAULT_EVENT,
  FAULT_EARLY,
  FAULT_NAN,
  FAULT_GROWS,
  FAULT_AT_START,
  FAULT_WARNS,
  FAULT_NO_LAST_TIME,
  FAULT_HANGS,
  FAULT_EXITS,
  FAULT_CHATS,
  FAULT_FORKS,
  FAULT_CLOSES,
  FAULT_COPIES,
};

typedef struct {
  double reals[32]; /* index: value reference */
  int64_t integers[32];
  bool booleans[32];
  char label[32];
  double time;
  int64_t internal_steps;
  bool is_paused;  /* it has returned early at `fault_at` */
  int32_t pending; /* number of answers that the step is not complete */
  int32_t child;   /* a process that it has started, which would continue on its own */
  /* only for FMI 3 */
  float f32;
  int64_t i64;
  uint64_t u64;
  int32_t i32;
  uint32_t u32;
  int16_t i16;
  uint16_t u16;
  int8_t i8;
  uint8_t u8;
  double vector[8];
  uint64_t length;
  uint8_t bytes[6];
} model;

/* Value references. */
enum {
  TIME,
  DECAY, /* e^(-k t) */
  K,     /* 1/s */
  U,     /* m */
  SPEED, /* m/s: gain (goal - u) */
  GAIN,  /* 1/s */
  GOAL,  /* m */
  FAULT,
  FAULT_TIME,   /* s: begin of the fault */
  LARGEST_STEP, /* s: larger ones are discarded */
  ANGLE,        /* deg */
  TURN,         /* deg/s: -angle / 1 s */
  COUNT,        /* communication steps */
  EULER,        /* (1 - k / 100)^n after n internal steps */
  LABEL,
  HAS_RESOURCE,
  INT_IN,
  INT_OUT,
  BOOL_IN,
  BOOL_OUT,
  CHOICE_IN,
  CHOICE_OUT,
  STEP_END,    /* s: time + size of the call */
  AS_IT_IS,    /* structural: bool_out is bool_in, not its opposite */
  LENGTH = 99, /* structural: of vector_in */
};

enum outcome { DONE, DISCARDED, FAILED, BROKEN, ENDED, EVENT, EARLY };

static volatile uintptr_t model_nowhere = 8;

/* For FMUs that allow only one instance in a process. */
static int model_instances;
#ifdef ONLY_ONE
#define MODEL_MAY_BE_MADE (model_instances == 0)
#else
#define MODEL_MAY_BE_MADE (model_instances >= 0)
#endif

static inline void model_reset(model* m) {
  memset(m, 0, sizeof *m);
  m->reals[DECAY] = m->reals[EULER] = m->reals[K] = 1;
  m->reals[GAIN] = 2;
  m->reals[FAULT_TIME] = 0.5;
  m->reals[LARGEST_STEP] = 1e9;
  m->reals[GOAL] = 1;
  m->length = 3;
}

static inline void model_outputs(model* m) {
  m->reals[SPEED] = m->reals[GAIN] * (m->reals[GOAL] - m->reals[U]);
  if (m->integers[FAULT] == FAULT_NAN && m->time >= m->reals[FAULT_TIME]) m->reals[SPEED] = NAN;
  m->reals[TURN] = -m->reals[ANGLE];
  m->integers[INT_OUT] = m->integers[INT_IN];
  m->booleans[BOOL_OUT] = m->booleans[BOOL_IN] == m->booleans[AS_IT_IS];
  m->integers[CHOICE_OUT] = m->integers[CHOICE_IN];
}

/* A visible function with a name that the C library has, too. */
#ifdef OPEN_STEP
__attribute__((visibility("default"))) int step(const char* string, const char* place) {
  (void)string, (void)place;
  return 42;
}
#define MODEL_HAS_ITS_OWN_STEP (step("", "") == 42)
#else
#define MODEL_HAS_ITS_OWN_STEP true
#endif

static inline void model_move(model* m, double end) {
  m->reals[DECAY] *= exp(-m->reals[K] * (end - m->time));
  for (; (double)(m->internal_steps + 1) / INTERNAL_STEPS <= end + 1e-9; ++m->internal_steps)
    m->reals[EULER] *= 1 - m->reals[K] / INTERNAL_STEPS;
  m->time = m->reals[TIME] = end;
}

/* `reached`: time that it reached, when that is not the end. */
static inline enum outcome model_step(model* m, double time, double size, double* reached) {
  const double end = time + size;
  const bool is_due = end >= m->reals[FAULT_TIME];
  *reached = time;
  if (!MODEL_HAS_ITS_OWN_STEP) return FAILED;
  if (fabs(time - m->time) > 1e-9) return FAILED;
  if (size > m->reals[LARGEST_STEP] * (1 + 1e-9)) {
    *reached = time + m->reals[LARGEST_STEP];
    return DISCARDED;
  }
  if (is_due) switch (m->integers[FAULT]) {
      case FAULT_ERROR:
        return FAILED;
      case FAULT_FATAL:
        return BROKEN;
      case FAULT_END:
        return ENDED;
      case FAULT_EVENT:
        return EVENT;
      case FAULT_CRASH:
        *(volatile int*)model_nowhere = 1;
        break;
      case FAULT_HANGS:
        while (model_nowhere) continue;
        break;
      case FAULT_EXITS:
        _Exit(3);
      case FAULT_FORKS:
        if (m->child == 0) m->child = fork();
        while (m->child == 0) pause();
        break;
      case FAULT_COPIES:
        fork();
        break;
      case FAULT_CLOSES:
        for (int descriptor = 3; descriptor < 1024; ++descriptor) close(descriptor);
        break;
      case FAULT_EARLY:
        if (m->is_paused) break;
        m->is_paused = true;
        *reached = m->reals[FAULT_TIME];
        model_move(m, *reached);
        return EARLY;
      default:
        break;
    }
  model_move(m, end);
  m->reals[STEP_END] = end;
  ++m->integers[COUNT];
  if (m->child != 0) m->integers[COUNT] = m->child;
  model_outputs(m);
  return DONE;
}

static inline size_t model_size(const model* m) {
  return sizeof *m + (m->integers[FAULT] == FAULT_GROWS ? (size_t)m->integers[COUNT] * 1000 : 0);
}

static inline bool model_has_resource(const char* folder) {
  char path[4096];
  snprintf(path, sizeof path, "%s/table.txt", folder);
  FILE* file = fopen(path, "r");
  if (file) fclose(file);
  return file;
}
