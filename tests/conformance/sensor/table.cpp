// SPDX-License-Identifier: MIT
// Prints docs/reference/sensor-levels.md: every case of the suite with its known answer, by motion.
#include <cstdio>

#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {
namespace {

std::string cell(const std::string& motion, const Case& c) {
  switch (how(motion, c)) {
    case How::left_out:
      return "";
    case How::refused:
      return "refused";
    default:
      break;
  }
  char text[64];
  const Outcome seen = c.run(motion);
  std::snprintf(text, sizeof text, "%s, %.1e", how(motion, c) == How::analytic ? "exact" : "step", seen.error);
  return text;
}

void print() {
  std::printf(
      "# Sensors of a robot's own state, by motion\n\n"
      "For those who choose a motion for what their sensors need. Made by `build/bin/sensor_table`, which\n"
      "asks [tests/conformance/sensor](../../tests/conformance/sensor); each number is the error that it\n"
      "found, in the unit of the reading.\n\n"
      "- **exact**: from the state of the motion itself, up to rounding and to what the motion makes of it.\n"
      "- **step**: an acceleration, from the change of velocity in the last step (1 ms here).\n"
      "- **refused**: the motion knows no such thing; `muro check` says so, and a run does not begin.\n"
      "- empty: the question makes no sense at this motion.\n\n");
  std::printf("| sensor | known answer | unit |");
  for (const std::string& m : motions()) std::printf(" %s |", m.substr(7).c_str());
  std::printf("\n|---|---|---|");
  for (std::size_t i = 0; i < motions().size(); ++i) std::printf("---|");
  std::printf("\n");
  for (const Case& c : all_cases()) {
    std::printf("| %s | %s | %s |", std::string(c.plugin).c_str(), std::string(c.name).c_str(),
                std::string(c.unit).c_str());
    for (const std::string& m : motions()) std::printf(" %s |", cell(m, c).c_str());
    std::printf("\n");
  }
}

}  // namespace
}  // namespace muro::sensor_conformance

int main() { muro::sensor_conformance::print(); }
