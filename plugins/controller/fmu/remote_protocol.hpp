// SPDX-License-Identifier: MIT
// Messages between the plugin and the process of an instance (`isolate: process`) on a socket. The process sends a
// greeting first. Each request is a size and calls, one after the other. Each answer is a size, log lines, a status,
// and the result of the last call. A call that fails ends its request.
#pragma once

#include <cstring>
#include <string>

#include "component.hpp"
#include "plugins/common/parser_process/message.hpp"

namespace muro::fmu {

using parser_process::Reader;
using parser_process::Writer;

inline constexpr char process_file[] = "muro_fmu_host";
inline constexpr std::uint64_t largest_message = std::uint64_t(1) << 30;

/// Detects programs of different builds.
struct Greeting {
  char text[24] = "muro fmu host 2";
};

enum class Call : std::uint8_t {
  load,  ///< the first call; the others are functions of Component
  instantiate,
  reset,
  enter_configuration,
  exit_configuration,
  enter_initialization,
  exit_initialization,
  set,
  get,
  set_text,
  set_bytes,
  get_bytes,
  do_step,
  keep_state,
  return_to_state,
  state_size,
  write_state,
  read_state,
  end,
};

enum class Answer : std::uint8_t {
  done,
  failed,   ///< followed by a text for the user
  crashed,  ///< followed by the name of the function that crashed
};

/// Data of an FMU that the process needs.
struct RemoteSetup {
  std::string library, resources, name, token;
  std::int32_t version = 0;
  bool can_keep_state = false, can_serialize_state = false, variable_step_size = false, might_return_early = false;
  bool logs_all = false;
  double tolerance = 0;

  void write(Writer& to) const {
    for (const std::string* t : {&library, &resources, &name, &token}) to.text(*t);
    to.value(version);
    for (const bool b : {can_keep_state, can_serialize_state, variable_step_size, might_return_early, logs_all})
      to.value(b);
    to.value(tolerance);
  }
  static RemoteSetup read(Reader& from) {
    RemoteSetup s;
    for (std::string* t : {&s.library, &s.resources, &s.name, &s.token}) *t = from.text();
    s.version = from.value<std::int32_t>();
    for (bool* b :
         {&s.can_keep_state, &s.can_serialize_state, &s.variable_step_size, &s.might_return_early, &s.logs_all})
      *b = from.value<bool>();
    s.tolerance = from.value<double>();
    return s;
  }
};

/// Writes each member separately, so that no padding is sent.
inline void write(const StepOutcome& o, Writer& to) {
  for (const bool b : {o.is_discarded, o.wants_end, o.needs_event, o.returned_early, o.knows_last_time}) to.value(b);
  to.value(o.last_time);
}
inline StepOutcome read_outcome(Reader& from) {
  StepOutcome o;
  for (bool* b : {&o.is_discarded, &o.wants_end, &o.needs_event, &o.returned_early, &o.knows_last_time})
    *b = from.value<bool>();
  o.last_time = from.value<double>();
  return o;
}

}  // namespace muro::fmu
