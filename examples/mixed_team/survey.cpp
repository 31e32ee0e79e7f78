// SPDX-License-Identifier: MIT
// Software of the flying robot: it flies over an area in lanes, reports to the team where its camera sees targets
// (spot.cpp), comes home and lands. It knows its place by satellite navigation and its IMU, with their errors.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "locator.hpp"
#include "muro_controller.hpp"
#include "radio.hpp"
#include "spots.hpp"

namespace {

using namespace muro::controller;
using namespace mixed_team;

enum Input { gps_position, gps_velocity, orientation, seen, received, received_bytes };
enum Output { command, send_bytes, send_size, send_number, targets_seen };
enum Tunable { center_x, center_y, size_x, size_y, altitude, spacing, speed, rounds, least_sightings, tell_period };

class Survey {
 public:
  static constexpr const char* name = "survey";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Flies over an area in lanes and tells where it sees targets";
  static constexpr muro_port inputs[] = {
      {"gps.position", "m", 3, 0}, {"gps.velocity", "m/s", 3, 0}, {"orientation", "1", 4, 0}, spots_port, received_port,
      received_bytes_port};
  static constexpr muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0},
                                          send_bytes_port,
                                          send_size_port,
                                          send_number_port,
                                          {"survey.targets", "1", 1, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"center_x", "m", 0, -1e4, 1e4, "middle of the area, east of the origin of the map"},
      {"center_y", "m", 0, -1e4, 1e4, "the same, north"},
      {"size_x", "m", 12, 1, 1e4, "of the area; lanes lie along x"},
      {"size_y", "m", 12, 1, 1e4, "of the area"},
      {"altitude", "m", 4, 0.5, 500, "at which it flies, above the origin of the map"},
      {"spacing", "m", 3, 0.2, 500, "between lanes, at most"},
      {"speed", "m/s", 1.5, 0.05, 30, "along a lane"},
      {"rounds", "1", 1, 1, 1000, "times that it flies over the area before it comes home"},
      {"least_sightings", "1", 3, 1, 255, "as often it has to see a target before it tells"},
      {"tell_period", "s", 0.5, 0.05, 60, "between messages"}};

  explicit Survey(const Setup& setup) {
    memory_.name = name_of(setup.seed());
    if (setup.input_size(seen) == 0)
      setup.log().warning("it sees nothing, so it finds nothing: give it a camera, and `spot` to look at its pictures");
  }

  void step(const Step& now) {
    memory_.me.step(now.input(gps_position), now.input(gps_velocity), now.input(orientation), {}, now.period());
    if (now.index() == 0) memory_.home = memory_.me.at(), memory_.ground = memory_.me.height();
    receive(now.input(received), now.input(received_bytes), [&](const Message& m) {
      for (std::size_t i = 0; i < m.targets.size(); ++i) memory_.targets.learn(m.targets[i]);
    });
    look(now);
    fly(now);
    if (is_turn(now, memory_.name, now.tunable(tell_period))) tell(now);
    now.output(targets_seen)[0] = double(told(now));
  }

 private:
  enum Phase : std::int64_t { climbs, sweeps, returns, lands, has_landed };

  /// State that a step leaves for the next.
  struct Memory {
    Locator me;
    Targets targets;
    Point home;           // m: place where it started
    double ground = 0;    // m: height of this place
    double pictures = 0;  // number of pictures so far
    std::int64_t phase = climbs, turn = 0, is_full = 0, name = 0, messages = 0;
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);
  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  void look(const Step& now) {
    constexpr double lowest = 0.5;  // share of the altitude: below, it sees too little around a target
    if (now.input(seen).empty() || now.input(seen)[0] == memory_.pictures) return;
    memory_.pictures = now.input(seen)[0];
    if (memory_.me.height() < lowest * now.tunable(altitude)) return;
    for_spots(now.input(seen), [&](const Point& p) { memory_.targets.see(memory_.me.to_map(p)); });
    if (memory_.is_full == 0 && told(now) == std::int64_t(Targets::most)) {
      memory_.is_full = 1;
      now.log().warning("it tells of " + std::to_string(Targets::most) + " targets, and there is no room for more");
    }
  }

  /// Returns ends of lanes: 0 and 1 of the first lane, 3 and 2 of the second, and so on: it flies to and fro.
  Point waypoint(const Step& now, std::int64_t number) const {
    const std::int64_t lane = number / 2;
    const bool east = (number % 2 == 0) == (lane % 2 != 0);
    const double between = now.tunable(size_y) / double(lanes(now));
    return {now.tunable(center_x) + (east ? 0.5 : -0.5) * now.tunable(size_x),
            now.tunable(center_y) - 0.5 * now.tunable(size_y) + (double(lane) + 0.5) * between};
  }
  static std::int64_t lanes(const Step& now) {
    return std::int64_t(std::ceil(now.tunable(size_y) / now.tunable(spacing) - 1e-9));
  }

  void fly(const Step& now) {
    constexpr double there = 0.3, touches = 0.03;  // m
    const std::int64_t ends = 2 * lanes(now);
    const double top = memory_.phase == lands ? memory_.ground : now.tunable(altitude);
    Point goal = memory_.home;
    if (memory_.phase == sweeps) goal = waypoint(now, memory_.turn % ends);
    const bool arrived = distance(goal, memory_.me.at()) < there;
    switch (memory_.phase) {
      case climbs:
        if (memory_.me.height() > top - there) memory_.phase = sweeps;
        break;
      case sweeps:
        if (arrived && ++memory_.turn == ends * std::int64_t(now.tunable(rounds))) memory_.phase = returns;
        break;
      case returns:
        if (arrived) memory_.phase = lands;
        break;
      case lands:
        if (memory_.me.height() < memory_.ground + touches) memory_.phase = has_landed;
        break;
      default:
        break;
    }
    if (memory_.phase == has_landed) {
      std::ranges::fill(now.output(command), 0.0);
      return;
    }

    constexpr double gain = 1.2;  // 1/s
    const Point way = memory_.me.to_own(goal);
    const double far = std::max(way.norm(), 1e-9), fast = std::min(now.tunable(speed), gain * far);
    const auto twist = now.output(command);
    twist[0] = fast * way.x / far;
    twist[1] = fast * way.y / far;
    twist[2] = std::clamp(gain * (top - memory_.me.height()), -0.6 * now.tunable(speed), 0.6 * now.tunable(speed));
  }

  std::int64_t told(const Step& now) const {
    const auto least = std::int64_t(now.tunable(least_sightings));
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < memory_.targets.size(); ++i) sum += memory_.targets[i].sightings >= least;
    return sum;
  }
  void tell(const Step& now) {
    const Message m{memory_.me.at(), memory_.name, Targets::none, 0, memory_.targets};
    now.output(send_size)[0] = double(write(m, std::int64_t(now.tunable(least_sightings)), now.output(send_bytes)));
    now.integer_output(send_number)[0] = ++memory_.messages;
  }

  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Survey)
