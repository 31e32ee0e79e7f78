// SPDX-License-Identifier: MIT
// Cost of radio.log_distance in parts of one core: robots broadcast at 10 Hz, each with a number of others in range.
//   --robots N       1000 by default
//   --neighbours K   average number of robots in range of each, 20 by default
//   --case N         only this row, from 0
//   --rounds N       20 by default
#include <fmt/format.h>

#include <time.h>
#include <cmath>
#include <memory>
#include <random>

#include "muro/vocabulary/radio.hpp"
#include "tests/bench/report.hpp"
#include "tests/support/bodies.hpp"

namespace {

using namespace muro;
using namespace muro::bench;

constexpr double range = 31.2;      // m, of a radio with the default parameters
constexpr int broadcast_rate = 10;  // Hz

/// Returns the processor time of this thread, s.
double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

using Settings = std::map<std::string, ParameterInput>;

/// Balls of 0.1 m at random places of a square with walls, each with a radio. They move at up to 1 m/s, or rest. All
/// send at the same instants, as control code of one rate does.
class Crowd : public test::Scene {
 public:
  Crowd(int robots, double neighbours, bool moving, const Settings* settings) : Scene(3), has_radios_(settings) {
    const double side = range * std::sqrt(M_PI * robots / neighbours);
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> place(-side / 2, side / 2), angle(-M_PI, M_PI), speed(0, 1);
    for (int i = 0; i < robots / 10; ++i) {
      const Shape wall = Shape::box({10, 0.2, 2});
      world().add_scenery("wall" + std::to_string(i),
                          {{place(engine), place(engine), 0}, Quat(Eigen::AngleAxisd(angle(engine), Vec3::UnitZ()))},
                          std::span<const Shape>(&wall, 1));
    }
    std::vector<Item> radios;
    for (int i = 0; i < robots; ++i) {
      const RobotView& r =
          add(std::to_string(i), test::ball(1, 0.1, 0.5), {{place(engine), place(engine), 0}, Quat::Identity()});
      objects_.push_back(add_sensor_object(r, "radio", r.base()));
      radios.push_back({&r, objects_.back()});
      bases_.push_back(r.base());
    }
    if (settings) use("radio.log_distance", 100, radios, *settings);
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    set_threads(1);
    build();
    for (const ObjectId base : bases_) {
      const double heading = angle(engine), v = speed(engine);
      if (moving) world().value(base, keys::command_twist).linear = {v * std::cos(heading), v * std::sin(heading), 0};
    }
    if (has_radios_)
      for (const ObjectId o : objects_) world().value(o, keys::radio_send_size) = 32;
    round();
  }
  /// Simulates half a second; returns the processor time (s) of a simulated second.
  double round() {
    constexpr int broadcasts = 5;
    double spent = 0;
    for (int k = 0; k < broadcasts; ++k) {
      if (has_radios_)
        for (const ObjectId o : objects_) ++world().value(o, keys::radio_send_number);
      const double before = processor_time();
      run_for(1.0 / broadcast_rate);
      spent += processor_time() - before;
    }
    return spent * broadcast_rate / broadcasts;
  }
  radio::Counters sum() {
    radio::Counters all;
    for (const ObjectId o : objects_) {
      const radio::Counters& c = world().value(o, keys::radio_counters);
      all.sent += c.sent, all.received += c.received, all.lost_collision += c.lost_collision;
    }
    return all;
  }

 private:
  std::vector<ObjectId> objects_, bases_;
  bool has_radios_ = true;
};

struct Case {
  const char* name;
  bool moving;
  Settings settings;
  const char* target;
};

}  // namespace

int main(int argc, char** argv) {
  Report report("radio", "Radio messages of many robots", argc, argv);
  const int robots = std::stoi(report.argument("robots", "1000"));
  const double neighbours = std::stod(report.argument("neighbours", "20"));
  const int rounds = std::stoi(report.argument("rounds", "20"));
  const std::string only = report.argument("case", "");
  const Case cases[] = {
      {"obstacles: ignore", true, {{"obstacles", "ignore"}}, "at most 0.1"},
      {"lines of sight", true, {}, "at most 0.1"},
      {"lines of sight, robots at rest", false, {}, "at most 0.1"},
      {"medium: shared, obstacles: ignore", true, {{"medium", "shared"}, {"obstacles", "ignore"}}, ""},
      {"medium: shared, lines of sight", true, {{"medium", "shared"}}, ""},
  };
  struct Row {
    const Case& of;
    std::unique_ptr<Crowd> crowd;
    double least = INFINITY;  // s of the processor a simulated second
  };
  std::vector<Row> rows;
  for (std::size_t i = 0; i < std::size(cases); ++i)
    if (only.empty() || only == std::to_string(i))
      rows.push_back({cases[i], std::make_unique<Crowd>(robots, neighbours, cases[i].moving, &cases[i].settings)});
  Crowd without(robots, neighbours, true, nullptr);
  double rest = INFINITY;
  for (int k = 0; k < rounds; ++k) {
    rest = std::min(rest, without.round());
    for (Row& row : rows) row.least = std::min(row.least, row.crowd->round());
  }
  report.table(fmt::format("{} point robots that broadcast 32 bytes at {} Hz, about {:g} in range of each, radios at "
                           "100 Hz, one thread: what a run takes more than one without radios; the least of {} rounds "
                           "of half a second, taking turns",
                           robots, broadcast_rate, neighbours, rounds),
               {"radio.log_distance", "of a core", "received a message sent", "lost to collisions"});
  for (Row& row : rows) {
    const radio::Counters n = row.crowd->sum();
    const double part = row.least - rest;
    report.row(
        {row.of.name, fixed(part, 3), fixed(double(n.received) / double(n.sent), 2), whole(double(n.lost_collision))});
    report.ratio(fmt::format("radios, {}: parts of a core", row.of.name), part, row.of.target);
  }
  report.finish();
  return 0;
}
