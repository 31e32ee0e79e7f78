// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "model.hpp"

namespace muro::scip2 {

/// What a client may ask for, by its two letters. `G_` answers with the latest scan, `M_` keeps sending scans; `_D` has
/// three characters a distance, `_S` two, `_E` three for the distance and three for the intensity. `H_` and `N_` are
/// `G_` and `M_` with all echoes.
enum class Command : std::uint8_t {
  none,  ///< no command that the device knows
  VV,
  PP,
  II,
  BM,
  QT,
  RS,
  RT,
  RB,
  TM,
  SS,
  CR,
  HS,
  DB,
  ST,  ///< `%ST`: state
  SL,  ///< `%SL`: sleep
  GD,
  GS,
  GE,
  HD,
  HE,
  MD,
  MS,
  ME,
  ND,
  NE,
  scip2,  ///< `SCIP2.0`
};

bool is_single_scan(Command c);  ///< G_ and H_
bool is_scanning(Command c);     ///< M_ and N_

/// What of a scan is asked for.
struct ScanWindow {
  std::uint32_t start = 0, end = 0;  ///< steps, both included
  std::uint32_t cluster = 1;         ///< readings that become one, from 1

  std::uint32_t value_count() const { return (end - start) / cluster + 1; }
};

/// One line of a client, as it was understood.
struct Request {
  Command command = Command::none;
  std::string_view status = "00";  ///< another: what is wrong with it, and `command` is not to be carried out
  std::uint32_t value = 0;         ///< of TM, SS, CR, HS, DB
  ScanWindow window;               ///< of G_, H_, M_, N_
  std::uint32_t interval = 0;      ///< of M_, N_: scans that are left out between two
  std::uint32_t count = 0;         ///< of M_, N_: scans that are asked for; 0: until QT
};

/// Longest text behind a semicolon.
inline constexpr std::size_t longest_string = 16;
/// Longest line that a device keeps, and echoes.
inline constexpr std::size_t longest_line = 64;

/// Reads a line without its end. The status says the first thing that is wrong with it.
Request parse(std::string_view line, const Model& model);

}  // namespace muro::scip2
