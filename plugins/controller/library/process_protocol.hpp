// SPDX-License-Identifier: MIT
// What the simulation and a process of control code say to each other on a socket, before they share memory: the
// process a Greeting; then it answers two requests. The first is a path of a library, and its answer the table; the
// second says what the instance needs to know, and its answer is empty. From then on they take turns in the shared
// memory.
#pragma once

#include <cstring>

#include "control_instance.hpp"
#include "plugins/common/parser_process/message.hpp"
#include "shared_layout.hpp"

namespace muro::control {

using parser_process::Reader;
using parser_process::Writer;

inline constexpr char process_file[] = "muro_controller_host";
/// In front of each message: its size in bytes, and whether it is a refusal, a text.
struct MessageHeader {
  std::uint64_t size = 0, is_refusal = 0;
};

/// Tells apart programs of different builds.
struct Greeting {
  char magic[24];
  std::uint32_t header_size, table_size;

  static Greeting ours() {
    Greeting greeting{{}, sizeof(SharedHeader), sizeof(muro_controller_table)};
    std::strncpy(greeting.magic, "muro controller host 1", sizeof greeting.magic - 1);
    return greeting;
  }
};

/// The descriptor of the shared memory in the process. On its socket the stack of calls of a crash comes too.
inline constexpr int process_memory = 4;

/// The second request.
struct Preparation {
  InstanceSetup setup{};
  std::vector<std::uint32_t> input_sizes{}, output_sizes{};
  std::uint64_t memory = 0;            ///< bytes that it may take beside what it has
  std::uint64_t spin_nanoseconds = 0;  ///< for which it looks for the next call before it sleeps
};

void write(const ControlTable& table, Writer& to);
ControlTable read_table(Reader& from);
void write(const Preparation& preparation, Writer& to);
Preparation read_preparation(Reader& from);

}  // namespace muro::control
