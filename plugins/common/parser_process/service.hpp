// SPDX-License-Identifier: MIT
// Services of the parser process: what it can read.
#pragma once

#include "message.hpp"

namespace muro::parser_process {

/// Reads what `request` names and writes its content. Throws muro::Error with the whole message for the user.
using Serve = void (*)(Reader& request, Writer& answer);

struct Service {
  std::string_view name;
  Serve serve;
};

/// Returns all services of this program and of the modules that it has loaded.
__attribute__((visibility("default"))) std::vector<Service>& services();

/// Makes a service known to the process; used at namespace scope. It is linked into the program. If its library takes
/// long to load, it is in a module muro_parser_WORD.so instead, which is loaded for the first request of a service
/// whose name begins with WORD.
struct Registration {
  Registration(std::string_view name, Serve serve) { services().push_back({name, serve}); }
};

}  // namespace muro::parser_process
