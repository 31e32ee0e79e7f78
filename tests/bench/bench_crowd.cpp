// SPDX-License-Identifier: MIT
// Cost of vehicles that touch each other, compared with the same vehicles spread out on the same plane:
// motion.simplified with collision.native and contact.penalty, on one thread, alternately in one run.
//   --vehicles N   number of vehicles, 300 by default
#include <fmt/format.h>

#include <chrono>
#include <random>

#include "tests/bench/muro_team.hpp"
#include "tests/bench/report.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr const char* rover_urdf = MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf";

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Vehicles at rest on a grid.
class Vehicles : public test::Scene {
 public:
  /// `apart_x`, `apart_y`: m, from middle to middle. With `turned` each vehicle has another heading.
  Vehicles(int count, double apart_x, double apart_y, bool turned) {
    add_ground(0.8);
    const RobotTree rover = read_model(rover_urdf);
    const int side = int(std::ceil(std::sqrt(count)));
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> heading(-M_PI, M_PI);
    for (int v = 0; v < count; ++v) {
      const int row = v / side, column = v % side;
      const Vec3 at(apart_x * (column - 0.5 * (side - 1)), apart_y * (row - 0.5 * (side - 1)), 0.09);
      const double yaw = heading(engine);
      add(std::to_string(v), rover, {at, Quat(Eigen::AngleAxisd(turned ? yaw : 0, Vec3::UnitZ()))});
    }
    use("motion.simplified", 1000, all_robots());
    use_contacts();
    set_threads(1);
    build();
    run_for(3);  // vehicles that overlap at first push each other away
  }
  /// Returns the time of a step of one vehicle, us.
  double round() {
    const double start = wall_clock();
    run_for(0.1);
    return 1e6 * (wall_clock() - start) / (100 * double(world().robots().size()));
  }
  /// Returns the number of vehicles that touch another one.
  int touching() {
    int count = 0;
    for (const RobotView* r : world().robots()) {
      const std::span<const Contact> contacts = world().values(r->base(), keys::contacts);
      count += std::any_of(contacts.begin(), contacts.end(),
                           [&](const Contact& c) { return world().robot_of(c.other) != no_robot; });
    }
    return count;
  }
};

struct Grid {
  const char* name;
  double apart_x, apart_y;
  bool turned;
};

}  // namespace

int main(int argc, char** argv) {
  Report report("crowd", "Vehicles that touch each other", argc, argv);
  const int vehicles = std::stoi(report.argument("vehicles", "300"));
  constexpr Grid grids[] = {{"0.5 m, random headings", 0.5, 0.5, true},
                            {"0.44 m, random headings", 0.44, 0.44, true},
                            {"0.4 m, random headings", 0.4, 0.4, true},
                            {"0.36 m by 0.34 m, one heading", 0.36, 0.34, false}};
  report.table(fmt::format("{} vehicles at rest after 3 s, motion.simplified at 1000 Hz, one thread; the least of 20 "
                           "rounds of 0.1 s each",
                           vehicles),
               {"grid at the start", "vehicles that touch others", "us a vehicle and step", "3 m apart", "ratio"});
  for (const Grid& grid : grids) {
    Vehicles spread(vehicles, 3, 3, grid.turned), crowd(vehicles, grid.apart_x, grid.apart_y, grid.turned);
    double one = INFINITY, many = INFINITY;
    for (int k = 0; k < 20; ++k) {
      one = std::min(one, spread.round());
      many = std::min(many, crowd.round());
    }
    report.row({grid.name, crowd.touching(), fixed(many, 3), fixed(one, 3), fixed(many / one, 2)});
    report.ratio(fmt::format("a grid of {}: cost of a vehicle, to that 3 m apart", grid.name), many / one, "at most 3");
  }
  report.finish();
  return 0;
}
