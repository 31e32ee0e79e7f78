// SPDX-License-Identifier: MIT
// For the parser process: what it can read.
#pragma once

#include "message.hpp"

namespace muro::parser_process {

/// Reads what `request` names and writes what it holds. Throws muro::Error with the whole message for the user.
using Serve = void (*)(Reader& request, Writer& answer);

struct Service {
  std::string_view name;
  Serve serve;
};

/// All services of this program and of the modules that it has loaded.
__attribute__((visibility("default"))) std::vector<Service>& services();

/// At namespace scope: makes a service known to the process. It is linked into the program, or, where its library takes
/// long to load, into a module muro_parser_WORD.so, which is loaded for the first request whose service begins with
/// WORD.
struct Registration {
  Registration(std::string_view name, Serve serve) { services().push_back({name, serve}); }
};

}  // namespace muro::parser_process
