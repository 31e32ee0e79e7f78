/* SPDX-License-Identifier: MIT
 * Control code with the fault that its argument `does` names, in step 3 of robot ball_1; `when=create`: in create. */
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "muro_controller.h"

typedef struct {
  int steps;
  int does; /* place in `deeds`, from 1; 0: nothing */
} misbehaves;

static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

static void invalid_memory(void) {
  volatile int* volatile nowhere = (volatile int*)16;
  *nowhere = 1;
}
static void gives_up(void) { abort(); }
static void divides_by_zero(void) {
  volatile int zero = 0;
  zero = 7 / zero;
}
static void invalid_instruction(void) { __builtin_trap(); }
static void lost_memory(void) {
  FILE* file = tmpfile();
  volatile char* memory = mmap(NULL, 4096, PROT_READ, MAP_SHARED, fileno(file), 0);
  (void)memory[0];
}
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winfinite-recursion"
static int deeper(volatile char* above) {
  volatile char frame[4096];
  frame[0] = above[0];
  return deeper(frame) + frame[0];
}
#pragma GCC diagnostic pop
static void endless_recursion(void) {
  volatile char first = 1;
  deeper(&first);
}
static void* crash(void* unused) {
  invalid_memory();
  return unused;
}
static void thread_of_its_own(void) {
  pthread_t thread;
  pthread_create(&thread, NULL, crash, NULL);
  pthread_join(thread, NULL);
}
static void leaves(void) { exit(0); }
static void leaves_quickly(void) { quick_exit(0); }
static void leaves_at_once(void) { _exit(0); }
static void hangs(void) {
  for (;;) pause();
}
static void interrupts(void) { raise(SIGINT); }
static void hangs_up(void) { raise(SIGHUP); }
static void interrupts_twice(void) {
  raise(SIGINT);
  raise(SIGINT);
}

static const struct {
  const char* name;
  void (*deed)(void);
} deeds[] = {{"invalid_memory", invalid_memory},
             {"gives_up", gives_up},
             {"divides_by_zero", divides_by_zero},
             {"invalid_instruction", invalid_instruction},
             {"lost_memory", lost_memory},
             {"endless_recursion", endless_recursion},
             {"thread_of_its_own", thread_of_its_own},
             {"leaves", leaves},
             {"leaves_quickly", leaves_quickly},
             {"leaves_at_once", leaves_at_once},
             {"hangs", hangs},
             {"interrupts", interrupts},
             {"hangs_up", hangs_up},
             {"interrupts_twice", interrupts_twice}};

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  misbehaves* m = state;
  int at_once = 0;
  if (strcmp(setup->robot, "ball_1") != 0) return 0;
  for (const char* const* a = setup->arguments; *a; ++a) {
    at_once |= strcmp(*a, "when=create") == 0;
    for (size_t i = 0; i < sizeof deeds / sizeof *deeds; ++i)
      if (strncmp(*a, "does=", 5) == 0 && strcmp(*a + 5, deeds[i].name) == 0) m->does = (int)i + 1;
  }
  if (m->does == 0) {
    snprintf(error, error_size, "there is no such deed");
    return 1;
  }
  if (at_once) deeds[m->does - 1].deed();
  return 0;
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  misbehaves* m = state;
  (void)error, (void)error_size;
  now->outputs[0][0] = 1;
  if (++m->steps == 3 && m->does != 0) deeds[m->does - 1].deed();
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "misbehaves",
    .version = "1.0.0",
    .summary = "Crashes, hangs or leaves",
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(misbehaves),
    .create = create,
    .step = step,
};

#ifdef LEAVES_WHEN_LOADED
__attribute__((constructor)) static void loaded(void) { leaves(); }
#endif

const muro_controller_table* muro_controller(void) { return &table; }
