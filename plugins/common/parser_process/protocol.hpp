// SPDX-License-Identifier: MIT
// What the parser process and its client say to each other on a socket: the process a Hello; then, for each request of
// the client (RequestHeader, name of the service, bytes), a frame. An Allowance, in a file in memory that both have,
// says what the request may take.
#pragma once

#include <cstdint>
#include <cstring>

#include "muro/robot.hpp"
#include "muro/shape.hpp"

namespace muro::parser_process {

/// Tells apart programs of different builds.
struct Hello {
  char magic[16];
  std::uint32_t shape_size, limits_size;

  static Hello ours() {
    Hello hello{{}, sizeof(Shape), sizeof(JointLimits)};
    std::strncpy(hello.magic, "muro parser 1", sizeof hello.magic - 1);
    return hello;
  }
};

struct RequestHeader {
  std::uint64_t service_size, size;  ///< bytes
};

enum class Frame : std::uint64_t {
  answer,      ///< what the service has written
  refusal,     ///< a text: why there is no answer
  no_service,  ///< nothing: the program was built without it
};
struct FrameHeader {
  Frame frame;
  std::uint64_t size;  ///< bytes
};

/// What a request may take.
struct Allowance {
  std::uint64_t memory = 0;  ///< bytes
  double seconds = 0;        ///< of processor time
};

/// The descriptor of the file of the Allowance in the parser process.
inline constexpr int process_allowance = 4;
/// Its exit code when it was refused memory; 0: nobody has asked for some time, or nobody listens any more.
inline constexpr int exit_out_of_memory = 71;

/// How a request ended, for those who ask through the client library.
enum class Ending : int {
  answered,
  refused,     ///< the text is for the user
  no_service,  ///< this muro was built without it
  no_process,  ///< the text says why it cannot be started, and what to do
  died,        ///< the text says of what
};

/// Gives room for the answer or the text.
struct Sink {
  void* (*reserve)(Sink*, std::uint64_t size) noexcept;
};

/// The function of the client library.
using AskFunction = int (*)(const char* service, const void* request, std::uint64_t size, Sink*) noexcept;
inline constexpr char ask_symbol[] = "muro_parser_ask_1";

/// An answer that several libraries of the program have at once; good until each has given its handle to the release
/// function.
struct SharedAnswer {
  const void* bytes = nullptr;
  std::uint64_t size = 0;
  void* handle = nullptr;
};
/// As the AskFunction, but that all who ask for the same have one answer, while one of them has it; also the next one
/// after the last of them. `version`: of what is read, such as the time of its last change. The sink gets texts alone.
using ShareFunction = int (*)(const char* service, const void* request, std::uint64_t size, const char* version,
                              SharedAnswer*, Sink*) noexcept;
using ReleaseFunction = void (*)(void* handle) noexcept;
inline constexpr char share_symbol[] = "muro_parser_share_1";
inline constexpr char release_symbol[] = "muro_parser_release_1";

inline constexpr char client_file[] = "muro_parser_client.so";
inline constexpr char program_file[] = "muro_parser";

/// What users set for sound files that need more than 512 MiB, and 5 s of processor time, beside what their size
/// allows.
inline constexpr char memory_variable[] = "MURO_PARSER_MEMORY";
inline constexpr char seconds_variable[] = "MURO_PARSER_SECONDS";

}  // namespace muro::parser_process
