// SPDX-License-Identifier: MIT
// Messages of a scanner, by the communication protocol specification of SCIP 2.0.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace muro::test {

/// Returns the line with its check character added: the lower six bits of the sum of its bytes, + 0x30.
inline std::string with_sum(const std::string& line) {
  unsigned sum = 0;
  for (const char c : line) sum += static_cast<unsigned char>(c);
  return line + char((sum & 0x3f) + 0x30);
}

/// Returns a reply to MD with `values` (mm) of three characters each, 64 characters a line.
inline std::string scip_scan(const std::string& echo, const std::vector<std::uint32_t>& values) {
  std::string data, text = echo + "\n" + with_sum("99") + "\n" + with_sum("0000") + "\n";
  for (const std::uint32_t v : values)
    for (const int shift : {12, 6, 0}) data += char(((v >> shift) & 0x3f) + 0x30);
  for (std::size_t at = 0; at < data.size(); at += 64) text += with_sum(data.substr(at, 64)) + "\n";
  return text + "\n";
}

}  // namespace muro::test
