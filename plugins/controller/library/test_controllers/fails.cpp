// SPDX-License-Identifier: MIT
// Drives ahead at 1 m/s. In step 3 of robot `a` it does what its argument `does` says. `when=create`: at once;
// `always=1`: also after a restart.
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "muro_controller.h"

namespace {

struct State {
  std::uint64_t steps;
  std::uint64_t deed;  // place in the list, from 1
};

const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};

void invalid_memory() {
  volatile int* volatile nowhere = reinterpret_cast<volatile int*>(16);
  *nowhere = 1;
}
void copy_itself() { static_cast<void>(fork()); }
volatile bool forever = true;
void loop() {
  while (forever) continue;
}
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winfinite-recursion"
int deeper(volatile char* above) {
  volatile char frame[4096];
  frame[0] = above[0];
  return deeper(frame) + frame[0];
}
#pragma GCC diagnostic pop
void recurse() {
  volatile char first = 1;
  deeper(&first);
}
void allocate() {  // as C code that does not check the result
  for (;;) std::memset(std::malloc(1 << 20), 1, 1 << 20);
}
void allocate_by_new() {
  for (;;) std::memset(new char[1 << 20], 1, 1 << 20);
}
void print() {
  std::printf("to standard output\n");
  std::fprintf(stderr, "to standard error\n");
}
void print_endlessly() {
  for (int i = 0; i < 100000; ++i) std::printf("line %d\n", i);
}
void sleep_long() { sleep(100); }
void close_all() {
  for (int descriptor = 3; descriptor < 1024; ++descriptor) close(descriptor);
}
/// Writes to the begin of all open files.
void write_to_all() {
  const std::string bytes(1 << 16, '\xff');
  for (int descriptor = 3; descriptor < 1024; ++descriptor)
    if (pwrite(descriptor, bytes.data(), bytes.size(), 0) < 0) continue;
}
void tell_process() { std::printf("process %d\n", int(getpid())); }
/// Starts a process that would continue on its own.
void start_another() {
  const pid_t other = fork();
  if (other != 0) return void(std::printf("process %d\n", int(other)));
  for (;;) pause();
}

const struct {
  const char* name;
  void (*deed)();
} deeds[] = {{"invalid_memory", invalid_memory},
             {"loop", loop},
             {"sleep", sleep_long},
             {"exit", [] { std::exit(3); }},
             {"exit_at_once", [] { _exit(0); }},
             {"abort", [] { std::abort(); }},
             {"recurse", recurse},
             {"throw", [] { throw std::runtime_error("a wheel is off"); }},
             {"throw_a_number", [] { throw 7; }},
             {"throw_in_thread", [] { std::thread([] { throw std::runtime_error("of a thread"); }).join(); }},
             {"allocate", allocate},
             {"allocate_by_new", allocate_by_new},
             {"print", print},
             {"print_endlessly", print_endlessly},
             {"copy_itself", copy_itself},
             {"kill", [] { raise(SIGKILL); }},
             {"close_all", close_all},
             {"write_to_all", write_to_all},
             {"tell_process", tell_process},
             {"close_all_and_tell",
              [] {
                close_all();
                tell_process();
              }},
             {"start_another", start_another},
             {"start_another_and_crash",
              [] {
                start_another();
                invalid_memory();
              }},
             {"start_another_and_loop",
              [] {
                start_another();
                loop();
              }},
             {"start_another_and_leave", [] {
                start_another();
                std::exit(3);
              }}};

int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  auto& s = *static_cast<State*>(state);
  bool at_once = false;
  for (const char* const* a = setup->arguments; *a; ++a) {
    at_once = at_once || std::strcmp(*a, "when=create") == 0;
    for (std::size_t i = 0; i < sizeof deeds / sizeof *deeds; ++i)
      if (std::string("does=") + deeds[i].name == *a) s.deed = i + 1;
  }
  if (std::strcmp(setup->robot, "a") != 0) s.deed = 0;
  if (at_once && s.deed) deeds[s.deed - 1].deed();
  static_cast<void>(error), static_cast<void>(error_size);
  return 0;
}

int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  auto& s = *static_cast<State*>(state);
  static_cast<void>(error), static_cast<void>(error_size);
  now->outputs[0][0] = 1;
  if (++s.steps == 3 && s.deed != 0) {
    now->outputs[0][0] = 5;
    deeds[s.deed - 1].deed();
  }
  return 0;
}

muro_controller_table make_table() {
  muro_controller_table t{};
  t.abi = MURO_CONTROLLER_ABI, t.table_size = sizeof t;
  t.name = "fails", t.version = "1.0.0", t.summary = "Fails";
  t.outputs = outputs, t.output_count = 1;
  t.state_size = sizeof(State);
  t.create = create, t.step = step;
  return t;
}
const muro_controller_table table = make_table();

#ifdef CRASHES_WHEN_LOADED
const int crash = (invalid_memory(), 0);
#endif
#ifdef CLOSES_ALL_WHEN_LOADED
const int closed = (close_all(), 0);
#endif

}  // namespace

const muro_controller_table* muro_controller() { return &table; }
