// SPDX-License-Identifier: MIT
#pragma once

#include <termios.h>

#include <cstdint>
#include <optional>
#include <string>

namespace muro::stream {

/// A bit rate that serial devices support.
struct BaudRate {
  std::uint32_t baud;  ///< bit/s
  speed_t code;
};

inline constexpr BaudRate baud_rates[] = {
    {1200, B1200},       {2400, B2400},       {4800, B4800},       {9600, B9600},       {19200, B19200},
    {38400, B38400},     {57600, B57600},     {115200, B115200},   {230400, B230400},   {460800, B460800},
    {500000, B500000},   {576000, B576000},   {921600, B921600},   {1000000, B1000000}, {1152000, B1152000},
    {1500000, B1500000}, {2000000, B2000000}, {2500000, B2500000}, {3000000, B3000000}, {3500000, B3500000},
    {4000000, B4000000}};

inline std::optional<speed_t> speed_code(std::uint32_t baud) {
  for (const BaudRate& rate : baud_rates)
    if (rate.baud == baud) return rate.code;
  return std::nullopt;
}

/// Returns the bit rate of a code, bit/s; the slowest rate when the code is not in the list.
inline std::uint32_t rate_of(speed_t code) {
  for (const BaudRate& rate : baud_rates)
    if (rate.code == code) return rate.baud;
  return baud_rates[0].baud;
}

inline bool is_standard_rate(std::uint32_t baud) { return speed_code(baud).has_value(); }

inline std::string standard_rates() {
  std::string text;
  for (const BaudRate& rate : baud_rates) text += (text.empty() ? "" : ", ") + std::to_string(rate.baud);
  return text;
}

}  // namespace muro::stream
