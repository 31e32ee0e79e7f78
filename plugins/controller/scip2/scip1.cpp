// SPDX-License-Identifier: MIT
// SCIP 1.1, which older devices use until `SCIP2.0`: commands of one letter, a status of one character, no sums.
//   V             version
//   L0, L1        laser off, on
//   G SSSEEECC    the latest scan: start, end, cluster; two characters for a distance
//   S BBBBBBrrrrrrr  bit rate and seven unused characters
#include <algorithm>

#include "device.hpp"

namespace muro::scip2 {

namespace {

bool are_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::uint32_t number_in(std::string_view digits) {
  std::uint32_t n = 0;
  for (const char c : digits) n = n * 10 + std::uint32_t(c - '0');
  return n;
}

bool is_command(std::string_view line) {
  if (line == "V" || line == "L0" || line == "L1" || line == "SCIP2.0") return true;
  return ((line[0] == 'G' && line.size() == 9) || (line[0] == 'S' && line.size() == 14)) && are_digits(line.substr(1));
}

}  // namespace

bool Device::is_scip1(const State& s, std::string_view line) const {
  return !s.speaks_scip2 && (model_.start == Start::scip1 || is_command(line));
}

bool Device::answer_scip1(const Call& call) {
  State& s = call.state;
  const std::string_view line = call.line;
  const char letter = is_command(line) ? line[0] : 0;
  ScanWindow window;
  if (letter == 'G') {
    window = {number_in(line.substr(1, 3)), number_in(line.substr(4, 3)), std::max(number_in(line.substr(7, 2)), 1u)};
    const auto last = std::uint32_t(model_.last_measurement_point());
    if (window.start > window.end || window.end > last) return reply_scip1(call, '1'), true;
    laser_on(s, call.now);
    if (!s.has_scan) return false;
  }
  if (letter == 'L' && line[1] == '1') laser_on(s, call.now);
  if (letter == 'L' && line[1] == '0') laser_off(s);
  if (letter != 'V' && letter != 'G') {
    reply_scip1(call, letter == 0 ? 'E' : '0');
    if (line == "SCIP2.0") s.speaks_scip2 = 1;
    return true;
  }
  text_.clear();
  ReplyWriter r(text_);
  r.plain(line);
  r.plain("0");
  if (letter == 'V') write_version_of_scip1(r);
  if (letter == 'G') write_scan(r, scan_of(s), window, {2, false}, false);
  r.end();
  send(call);
  return true;
}

void Device::reply_scip1(const Call& call, char status) {
  text_.clear();
  ReplyWriter r(text_);
  r.plain(call.line);
  r.plain({&status, 1});
  r.end();
  send(call);
}

}  // namespace muro::scip2
