// SPDX-License-Identifier: MIT
// Messages between the simulation and a process of control code on a socket, before they share memory. The process
// sends a Greeting, then answers two requests. The first request is the path of a library; its answer is the table. The
// second request has the data of the instance; its answer is empty. After that they take turns in the shared memory.
#pragma once

#include <cstring>

#include "control_instance.hpp"
#include "plugins/common/parser_process/message.hpp"
#include "shared_layout.hpp"

namespace muro::control {

using parser_process::Reader;
using parser_process::Writer;

inline constexpr char process_file[] = "muro_controller_host";
/// Precedes each message: its size in bytes, and whether it is a refusal with a text.
struct MessageHeader {
  std::uint64_t size = 0, is_refusal = 0;
};

/// Detects programs of different builds.
struct Greeting {
  char magic[24];
  std::uint32_t header_size, table_size;

  static Greeting ours() {
    Greeting greeting{{}, sizeof(SharedHeader), sizeof(muro_controller_table)};
    std::strncpy(greeting.magic, "muro controller host 1", sizeof greeting.magic - 1);
    return greeting;
  }
};

/// Descriptor of the shared memory in the process. The socket also carries the stack of calls after a crash.
inline constexpr int process_memory = 4;

/// The second request.
struct Preparation {
  InstanceSetup setup{};
  std::vector<std::uint32_t> input_sizes{}, output_sizes{};
  std::uint64_t memory = 0;            ///< bytes that it may use beyond its present memory
  std::uint64_t spin_nanoseconds = 0;  ///< time that it polls for the next call before it sleeps
};

void write(const ControlTable& table, Writer& to);
ControlTable read_table(Reader& from);
void write(const Preparation& preparation, Writer& to);
Preparation read_preparation(Reader& from);

}  // namespace muro::control
