// SPDX-License-Identifier: MIT
// Messages for two streams that need one place, as the copies of a robot do by mistake, or for a file at that place.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace muro::stream {

inline std::string port_is_taken(std::uint16_t port) {
  const std::string text = std::to_string(port);
  return "port " + text +
         " is taken, by another program or by another stream of this scenario; choose another one, or 0 for any that "
         "is free; in a team each robot needs its own, such as tcp: \"" +
         text + "+{index}\"";
}

inline constexpr std::string_view another_socket =
    "; choose another path; in a team each robot needs its own, such as unix: /tmp/muro-{robot}.sock";
inline std::string socket_is_taken() { return "another stream has it" + std::string(another_socket); }
inline constexpr std::string_view no_socket =
    "there is a file of this name that is no socket; remove it or choose another path";

inline std::string pty_is_taken() {
  return "another stream has this name; in a team each robot needs its own, such as pty: /tmp/{robot}.laser";
}

}  // namespace muro::stream
