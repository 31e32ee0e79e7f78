// SPDX-License-Identifier: MIT
// What the plugin and the process of an instance (`isolate: process`) say to each other on a socket. The process begins
// with a greeting. Each request is a size and calls, one behind the other; each answer a size, log lines, how it went,
// and what the last call returns. A call that fails ends its request.
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

/// Tells apart programs of different builds.
struct Greeting {
  char text[24] = "muro fmu host 2";
};

enum class Call : std::uint8_t {
  load,  ///< the first one; the others are those of Component
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
  failed,   ///< with a text for the user
  crashed,  ///< with the name of the function that did
};

/// What the process needs to know of an FMU.
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

/// Member by member: padding between them is nobody's.
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
