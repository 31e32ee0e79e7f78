// SPDX-License-Identifier: MIT
// Drives ahead and stops before obstacles: in C++, as a class. brake.c does the same.
#include <algorithm>

#include "muro_controller.hpp"

namespace {

using namespace muro::controller;

class Brake {
 public:
  static constexpr const char* name = "brake";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Stops before what is in its way";
  static constexpr muro_port inputs[] = {{"ranges", "m", 0, 0}};
  static constexpr muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};
  static constexpr muro_tunable tunables[] = {
      {"speed", "m/s", 0.5, 0.1, 2, "on a free way"},
      {"distance", "m", 0.6, 0.1, 5, "from the obstacle before which it stops"}};

  explicit Brake(const Setup& setup) {
    if (setup.input_size(0) < 3)
      throw std::invalid_argument("the laser has " + std::to_string(setup.input_size(0)) + " rays; it needs 3 or more");
  }

  void step(const Step& now) {
    const std::span<const double> ranges = now.input(0);
    const std::size_t third = ranges.size() / 3;
    const double nearest =
        *std::min_element(ranges.begin() + std::ptrdiff_t(third), ranges.end() - std::ptrdiff_t(third));
    const double wanted = std::clamp(nearest - now.tunable(distance), 0.0, now.tunable(speed));
    if (wanted == 0 && speed_ > 0) now.log().info("stands");
    speed_ = std::min(wanted, speed_ + acceleration * now.period());
    now.output(0)[0] = speed_;
  }

  static constexpr std::size_t save_size = sizeof(double);
  void save(Saver& to) const { to.put(speed_); }
  void load(Loader& from) { speed_ = from.get<double>(); }

 private:
  enum { speed, distance };                    // places of tunables
  static constexpr double acceleration = 0.5;  // m/s^2
  double speed_ = 0;                           // m/s, commanded last
};

}  // namespace

MURO_CONTROLLER(Brake)
