// SPDX-License-Identifier: MIT
// Logs the values of its inputs, and writes 1, 2, 3 and so on to its outputs.
#include <cstdio>

#include "muro_controller.hpp"

namespace {

using muro::controller::Setup;
using muro::controller::Step;

class Look {
 public:
  static constexpr const char* name = "look";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Shows what it reads";
  static constexpr muro_port inputs[] = {{"numbers", nullptr, 0, MURO_PORT_OPTIONAL},
                                         {"whole", nullptr, 0, MURO_PORT_OPTIONAL | MURO_PORT_INTEGER},
                                         {"words", nullptr, 0, MURO_PORT_OPTIONAL | MURO_PORT_TEXT},
                                         {"short", nullptr, 6, MURO_PORT_OPTIONAL | MURO_PORT_TEXT},
                                         {"list", nullptr, 15, MURO_PORT_OPTIONAL | MURO_PORT_LIST},
                                         {"velocity", "rad/s", 1, MURO_PORT_OPTIONAL},
                                         {"mixed", "rad, rad, m", 0, MURO_PORT_OPTIONAL},
                                         {"either", "rad or m", 0, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"commands", nullptr, 0, 0}};

  explicit Look(const Setup& setup) { setup.log().info("outputs " + std::to_string(setup.output_size(0))); }

  void step(const Step& now) {
    std::string line = "numbers";
    for (const double x : now.input(0)) line += " " + text(x);
    line += ", whole";
    for (const std::int64_t x : now.integer_input(1)) line += " " + std::to_string(x);
    if (!now.integer_input(1).empty() || now.raw().text_inputs[2]) line += ", words";
    if (!now.raw().input_sizes[2])
      line += " none";
    else
      line += " [" + std::string(now.text_input(2)) + "]";
    if (now.raw().input_sizes[3]) line += ", short [" + std::string(now.text_input(3)) + "]";
    line += ", list";
    for (const double x : now.input(4)) line += " " + text(x);
    now.log().info(line);
    for (std::size_t i = 0; i < now.output(0).size(); ++i) now.output(0)[i] = double(i + 1);
  }

 private:
  static std::string text(double number) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%g", number);
    return digits;
  }
};

}  // namespace

MURO_CONTROLLER(Look)
