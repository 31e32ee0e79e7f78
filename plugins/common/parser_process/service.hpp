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

/// All services of this program.
std::vector<Service>& services();

/// At namespace scope: makes a service known to the process it is linked into.
struct Registration {
  Registration(std::string_view name, Serve serve) { services().push_back({name, serve}); }
};

}  // namespace muro::parser_process
