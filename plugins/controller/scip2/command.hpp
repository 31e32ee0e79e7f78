// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "model.hpp"

namespace muro::scip2 {

/// Commands of a client, named by their two letters. `G_` returns the latest scan, `M_` sends scans repeatedly. `_D`
/// has three characters for a distance, `_S` two, `_E` three for the distance and three for the intensity. `H_` and
/// `N_` are `G_` and `M_` with all echoes.
enum class Command : std::uint8_t {
  none,  ///< no known command
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

/// Part of a scan that is requested.
struct ScanWindow {
  std::uint32_t start = 0, end = 0;  ///< steps, both included
  std::uint32_t cluster = 1;         ///< number of readings that are merged into one, from 1

  std::uint32_t value_count() const { return (end - start) / cluster + 1; }
};

/// One parsed line of a client.
struct Request {
  Command command = Command::none;
  std::string_view status = "00";  ///< any other: the error, and `command` is not carried out
  std::uint32_t value = 0;         ///< parameter of TM, SS, CR, HS, DB
  ScanWindow window;               ///< for G_, H_, M_, N_
  std::uint32_t interval = 0;      ///< for M_, N_: scans skipped between two
  std::uint32_t count = 0;         ///< for M_, N_: requested scans; 0: until QT
};

/// Longest text after a semicolon.
inline constexpr std::size_t longest_string = 16;
/// Longest line that a device stores and echoes.
inline constexpr std::size_t longest_line = 64;

/// Reads a line without its end. The status is the first error in it.
Request parse(std::string_view line, const Model& model);

}  // namespace muro::scip2
