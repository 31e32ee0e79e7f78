// SPDX-License-Identifier: MIT
// Software of a robot on the ground, on wheels or on legs. It takes the nearest target that the team knows and no mate
// claims, and goes there around mates and the obstacles that its laser sees. There it looks for the target by its
// camera, else by its laser, and reports it. It knows its place by satellite navigation, odometry and its IMU.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../common/place.hpp"
#include "../common/vector.hpp"
#include "locator.hpp"
#include "mates.hpp"
#include "muro_controller.hpp"
#include "obstacles.hpp"
#include "radio.hpp"
#include "spots.hpp"

namespace {

using namespace muro::controller;
using namespace mixed_team;

enum Input {
  gps_position,
  gps_velocity,
  orientation,
  odometry,
  ranges,
  min_angle,
  increment,
  max_range,
  seen,
  received,
  received_bytes
};
enum Output { command, send_bytes, send_size, send_number, confirmed, estimate };
enum Tunable { speed, turn, radius, stop, hold, patience, target_radius, laser_x, laser_z, tell_period };

class Seek {
 public:
  static constexpr const char* name = "seek";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Goes to targets that the team has found, and confirms them";
  static constexpr muro_port inputs[] = {{"gps.position", "m", 3, 0},
                                         {"gps.velocity", "m/s", 3, 0},
                                         {"orientation", "1", 4, 0},
                                         {"odometry.twist", "m/s, rad/s", 6, MURO_PORT_OPTIONAL},
                                         {"ranges", "m", 0, MURO_PORT_OPTIONAL},
                                         {"laser.min_angle", "rad", 1, MURO_PORT_OPTIONAL},
                                         {"laser.angle_increment", "rad", 1, MURO_PORT_OPTIONAL},
                                         {"laser.max_range", "m", 1, MURO_PORT_OPTIONAL},
                                         spots_port,
                                         received_port,
                                         received_bytes_port};
  static constexpr muro_port outputs[] = {{"seek.command", "m/s, rad/s", 6, MURO_PORT_OWN},
                                          send_bytes_port,
                                          send_size_port,
                                          send_number_port,
                                          {"seek.confirmed", "1", 1, MURO_PORT_OWN},
                                          {"seek.estimate", "m, m, rad", 3, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"speed", "m/s", 0.6, 0.01, 10, "straight on"},
      {"turn", "rad/s", 1, 0.01, 10, "at most"},
      {"radius", "m", 0.32, 0.05, 5, "of the robot as a disc, with a margin"},
      {"stop", "m", 0.55, 0.05, 5, "from its middle to that of a target: there it stands and looks"},
      {"hold", "s", 1, 0, 60, "it has to see a target for so long"},
      {"patience", "s", 10, 1, 600,
       "where it stands so long and sees nothing, or comes no nearer for twice as long, it leaves the target to "
       "others"},
      {"target_radius", "m", 0.22, 0.01, 5, "of a target as a disc"},
      {"laser_x", "m", 0.1, -5, 5, "the scanner in the frame of the base"},
      {"laser_z", "m", 0.12, 0, 5, "the scanner above the ground"},
      {"tell_period", "s", 0.5, 0.05, 60, "between messages"}};

  explicit Seek(const Setup& setup) {
    memory_.name = name_of(setup.seed());
    if (setup.input_size(ranges) > 0 && setup.input_size(min_angle) == 0)
      throw std::invalid_argument("there are ranges, but no `laser.min_angle` to go with them");
    if (setup.input_size(ranges) == 0)
      setup.log().warning("there is no laser, so it keeps clear of mates and targets alone, not of obstacles");
  }

  void step(const Step& now) {
    memory_.me.step(now.input(gps_position), now.input(gps_velocity), now.input(orientation), now.input(odometry),
                    now.period());
    receive(now.input(received), now.input(received_bytes), [&](const Message& m) {
      for (std::size_t i = 0; i < m.targets.size(); ++i) memory_.targets.learn(m.targets[i]);
      memory_.mates.hear(m, now.time());
    });
    choose(now);
    const auto twist = now.output(command);
    twist[0] = twist[5] = 0;
    if (claims()) go(now, twist);
    if (is_turn(now, memory_.name, now.tunable(tell_period))) tell(now);
    now.output(confirmed)[0] = double(memory_.confirmed);
    const auto me = now.output(estimate);
    me[0] = memory_.me.at().x, me[1] = memory_.me.at().y, me[2] = memory_.me.yaw();
  }

 private:
  /// State that a step leaves for the next.
  struct Memory {
    Locator me;
    Targets targets;
    Mates mates;
    std::int64_t claim = std::int64_t(Targets::none);
    double seen = 0;             // s: time for which it has seen the target that it claims
    double nearest = 1e9;        // m: least distance to this target so far
    double waited = 0;           // s: time since then; without a claim: since the last one
    double heading = 0;          // rad: heading of its way, in its own axes
    std::int64_t given_up = 0;   // a bit for each target that it has given up
    std::int64_t confirmed = 0;  // number of targets that it has confirmed itself
    std::int64_t name = 0, messages = 0;
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);
  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  static constexpr double near_by = 0.15;  // m: it looks for the target this near to its stopping point

  bool claims() const { return memory_.claim != std::int64_t(Targets::none); }
  const Target& target() const { return memory_.targets[std::size_t(memory_.claim)]; }
  bool has_given_up(std::size_t i) const { return (memory_.given_up >> i & 1) != 0; }

  void claim(std::size_t i) {
    if (memory_.claim == std::int64_t(i)) return;
    memory_.claim = std::int64_t(i), memory_.nearest = 1e9, memory_.waited = memory_.seen = 0;
  }
  /// Returns the time to a target (s), with the turn towards it.
  double cost(const Step& now, const Target& t) const {
    const Point way = memory_.me.to_own(t.at);
    return way.norm() / now.tunable(speed) + std::abs(bearing(way)) / now.tunable(turn);
  }

  void choose(const Step& now) {
    if (claims()) {
      const bool lost = memory_.mates.hold(target(), now.time(), cost(now, target()), memory_.name, true);
      if (lost || target().confirmed != 0) claim(Targets::none);
    }
    constexpr double better = 0.5;  // share of the cost: a target below it replaces the present one
    std::size_t best = Targets::none;
    double least = claims() ? better * cost(now, target()) : 1e9;
    for (std::size_t i = 0; i < memory_.targets.size(); ++i) {
      const Target& t = memory_.targets[i];
      const double c = cost(now, t);
      if (c >= least || t.confirmed != 0 || has_given_up(i)) continue;
      if (memory_.mates.hold(t, now.time(), c, memory_.name, false)) continue;
      least = c, best = i;
    }
    if (best != Targets::none) claim(best);
    if (!claims() && memory_.waited > now.tunable(patience)) memory_.given_up = 0;  // then it tries all targets again
    watch(now);
  }
  /// Gives up a target when it comes no nearer.
  void watch(const Step& now) {
    constexpr double nearer = 0.1;  // m
    memory_.waited += now.period();
    if (!claims()) return;
    constexpr double detour = 2;  // factor of its patience while it is under way
    const double rest = distance(memory_.me.at(), target().at);
    const bool is_there = rest < now.tunable(stop) + near_by;
    if (rest < memory_.nearest - nearer) memory_.nearest = rest, memory_.waited = 0;
    if (memory_.waited < (is_there ? 1 : detour) * now.tunable(patience)) return;
    now.log().warning(is_there ? "there is no target where one was told"
                               : "it does not get to a target, and leaves it to others");
    memory_.given_up |= std::int64_t(1) << memory_.claim;
    claim(Targets::none);
  }

  void go(const Step& now, std::span<double> twist) {
    const Point way = memory_.me.to_own(target().at);
    const double rest = way.norm() - now.tunable(stop), wanted = bearing(way);
    constexpr double ahead = 0.3;  // rad
    const bool is_there = rest < near_by;
    const double gain = 1.5, most = now.tunable(turn);
    if (is_there) {
      memory_.heading = wanted;
      twist[5] = std::abs(wanted) > 0.5 * ahead ? std::clamp(gain * wanted, -most, most) : 0;
      if (rest > 0) twist[0] = std::min(0.4 * now.tunable(speed), rest) * (std::abs(wanted) < ahead ? 1 : 0);
      look(now);
      return;
    }
    const Obstacles::Way best = obstacles(now).best(wanted, rest, memory_.heading);
    constexpr double sharp = 0.9, margin = 0.5;  // rad, m
    const double fast = std::min(1.0, std::min(rest, best.free) / margin);
    twist[0] = now.tunable(speed) * std::max(0.0, 1 - std::abs(best.heading) / sharp) * fast;
    twist[5] = std::clamp(gain * best.heading, -most, most);
    memory_.heading = best.heading - twist[5] * now.period();
  }

  /// Returns echoes of the laser without its target; other targets, which the laser may be too high to see; and mates.
  Obstacles obstacles(const Step& now) const {
    Obstacles all(now.tunable(radius));
    const double around = 2 * now.tunable(target_radius);
    const auto seen = now.input(ranges);
    constexpr std::size_t sectors = 120;
    for (std::size_t s = 0, i = 0; s < sectors && !seen.empty(); ++s) {
      std::size_t nearest = seen.size();
      for (const std::size_t end = seen.size() * (s + 1) / sectors; i < end; ++i)
        if (is_echo(now, i) && (nearest == seen.size() || seen[i] < seen[nearest])) nearest = i;
      if (nearest == seen.size()) continue;
      const Point p = echo(now, nearest);
      if (distance(memory_.me.to_map(p), target().at) > around) all.add(p, 0);
    }
    for (std::size_t i = 0; i < memory_.targets.size(); ++i)
      if (std::int64_t(i) != memory_.claim)
        all.add(memory_.me.to_own(memory_.targets[i].at), now.tunable(target_radius));
    for (const Mate& mate : memory_.mates)
      if (now.time() - mate.heard < Mates::forgotten) all.add(memory_.me.to_own(mate.at), 0.8 * now.tunable(radius));
    return all;
  }
  /// Returns whether a ray shows an object: no lost reading, and not the ground before a robot that leans.
  bool is_echo(const Step& now, std::size_t i) const {
    const double range = now.input(ranges)[i];
    if (range <= 0 || range >= now.input(max_range)[0]) return false;
    const auto up = examples::Rotation::of(now.input(orientation)).up();
    const double angle = now.input(min_angle)[0] + double(i) * now.input(increment)[0];
    const double rise = up.x * muro_cos(angle) + up.y * muro_sin(angle);
    return now.tunable(laser_z) + range * rise > 0.4 * now.tunable(laser_z);
  }
  Point echo(const Step& now, std::size_t i) const {
    const double angle = now.input(min_angle)[0] + double(i) * now.input(increment)[0], range = now.input(ranges)[i];
    return {now.tunable(laser_x) + range * muro_cos(angle), range * muro_sin(angle)};
  }

  /// Looks for the target in front of it.
  void look(const Step& now) {
    if (!sees(now)) return;
    memory_.seen += now.period();
    if (memory_.seen < now.tunable(hold)) return;
    memory_.targets[std::size_t(memory_.claim)].confirmed = 1;
    ++memory_.confirmed;
    claim(Targets::none);
  }
  /// Returns whether its camera sees the target, or its laser if it has no camera. Without both it trusts the report.
  bool sees(const Step& now) const {
    const double around = 2 * now.tunable(target_radius);
    const auto is_here = [&](const Point& p) { return distance(memory_.me.to_map(p), target().at) < around; };
    const bool has_camera = !now.input(seen).empty() && now.input(seen)[0] > 0;
    if (has_camera) {
      bool found = false;
      for_spots(now.input(seen), [&](const Point& p) { found = found || is_here(p); });
      return found;
    }
    for (std::size_t i = 0; i < now.input(ranges).size(); ++i)
      if (is_echo(now, i) && is_here(echo(now, i))) return true;
    return now.input(ranges).empty();
  }

  void tell(const Step& now) {
    const Message m{memory_.me.at(), memory_.name, std::size_t(memory_.claim), claims() ? cost(now, target()) : 0,
                    memory_.targets};
    now.output(send_size)[0] = double(write(m, 0, now.output(send_bytes)));
    now.integer_output(send_number)[0] = ++memory_.messages;
  }

  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Seek)
