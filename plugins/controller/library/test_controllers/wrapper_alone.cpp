// SPDX-License-Identifier: MIT
#include "muro_controller.hpp"

/// The smallest class that the wrapper accepts.
struct Least {
  static constexpr const char* name = "least";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Does nothing";
  explicit Least(const muro::controller::Setup&) {}
  void step(const muro::controller::Step&) {}
};
MURO_CONTROLLER(Least)
