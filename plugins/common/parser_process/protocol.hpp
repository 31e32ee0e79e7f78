// SPDX-License-Identifier: MIT
// Messages between the parser process and its client on a socket. First the process sends a Hello. Then it answers each
// request of the client (RequestHeader, name of the service, bytes) with a frame. An Allowance in a memory file of both
// shows what the request may take.
#pragma once

#include <cstdint>
#include <cstring>

#include "muro/robot.hpp"
#include "muro/shape.hpp"

namespace muro::parser_process {

/// Distinguishes programs of different builds.
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
  refusal,     ///< a text: the reason why there is no answer
  no_service,  ///< nothing: the program was built without the service
};
struct FrameHeader {
  Frame frame;
  std::uint64_t size;  ///< bytes
};

/// Memory and time that a request may take.
struct Allowance {
  std::uint64_t memory = 0;  ///< bytes
  double seconds = 0;        ///< of processor time
};

/// Descriptor of the file of the Allowance in the parser process.
inline constexpr int process_allowance = 4;
/// Exit code of the process if it was refused memory. 0: it was idle for some time, or its client has ended.
inline constexpr int exit_out_of_memory = 71;

/// The way in which a request ended, for users of the client library.
enum class Ending : int {
  answered,
  refused,     ///< the text is for the user
  no_service,  ///< this muro was built without it
  no_process,  ///< the text says why it cannot be started, and what to do
  died,        ///< the text gives the cause
};

/// Provides memory for the answer or the text.
struct Sink {
  void* (*reserve)(Sink*, std::uint64_t size) noexcept;
};

/// Function of the client library.
using AskFunction = int (*)(const char* service, const void* request, std::uint64_t size, Sink*) noexcept;
inline constexpr char ask_symbol[] = "muro_parser_ask_1";

/// An answer that several libraries of the program have at once. It is valid until each of them has passed its handle
/// to the release function.
struct SharedAnswer {
  const void* bytes = nullptr;
  std::uint64_t size = 0;
  void* handle = nullptr;
};
/// Does the same as AskFunction, but all who ask for the same thing get one answer, while one of them has it; so does
/// the next one after the last of them. `version`: of the file, such as the time of its last change. The sink gets only
/// texts.
using ShareFunction = int (*)(const char* service, const void* request, std::uint64_t size, const char* version,
                              SharedAnswer*, Sink*) noexcept;
using ReleaseFunction = void (*)(void* handle) noexcept;
inline constexpr char share_symbol[] = "muro_parser_share_1";
inline constexpr char release_symbol[] = "muro_parser_release_1";

inline constexpr char client_file[] = "muro_parser_client.so";
inline constexpr char program_file[] = "muro_parser";

/// Variables that users set for valid files that need more than 512 MiB, and 5 s of processor time, beside what their
/// size allows.
inline constexpr char memory_variable[] = "MURO_PARSER_MEMORY";
inline constexpr char seconds_variable[] = "MURO_PARSER_SECONDS";

}  // namespace muro::parser_process
