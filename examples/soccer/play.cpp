// SPDX-License-Identifier: MIT
// A player: goes behind the ball and drives it into the goal, by what its camera has found (look.cpp) and by the way
// that it has walked since the start (examples/walk). Players tell each other how soon they would be at the ball; the
// nearest one goes for it, the others keep to their places, a keeper to the line between ball and goal.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "muro_controller.hpp"
#include "muro_elementary.h"
#include "place.hpp"

namespace {

using namespace muro::controller;
using namespace soccer;

enum Input { ball_seen, odometry, orientation, match_state, mates };
enum Output { walk_command, message };
enum Tunable { start_x, start_y, start_yaw, attack, home_x, home_y, keeper, forward, sideways, turn, goal_x, stride };
enum Role : std::int64_t { waits, searches, goes_for_ball, keeps_place };

constexpr double forgets = 3;     // s: a ball that was not seen for so long is searched for
constexpr double behind = 0.3;    // m: the place behind the ball from which it is driven
constexpr double line = 0.08;     // m: so far from the line through ball and goal it drives
constexpr double goes_on = 2;     // times as far off it goes on, once it drives
constexpr double calm = 0.25;     // rad/s: near the ball it turns no faster
constexpr double ahead = 0.35;    // rad: so far off the direction to the goal it drives
constexpr double aside = 0.4;     // m: it passes the ball at that distance
constexpr double far_away = 100;  // m: of who does not know where the ball is
constexpr std::size_t message_size = 4;

class Play {
 public:
  static constexpr const char* name = "play";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Plays soccer: goes behind the ball and drives it into the goal";
  static constexpr muro_port inputs[] = {{"ball.seen", "1, m, m, s", 4, 0},
                                         {"walk.odometry", "m, m, rad", 3, 0},
                                         {"orientation", "1", 4, 0},
                                         {"match.state", "1", 1, MURO_PORT_OPTIONAL},
                                         {"mates", "m, m, m, 1", 0, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"walk.command", "m/s, m/s, rad/s", 3, MURO_PORT_OWN},
                                          {"team.message", "m, m, m, 1", message_size, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"start_x", "m", 0, -100, 100, "where it stands at the start, on the field"},
      {"start_y", "m", 0, -100, 100, "the same"},
      {"start_yaw", "rad", 0, -7, 7, "the same"},
      {"attack", "1", 1, -1, 1, "1: the goal at x > 0; -1: the other one"},
      {"home_x", "m", 0, -100, 100, "its place, where another one goes for the ball"},
      {"home_y", "m", 0, -100, 100, "the same"},
      {"keeper", "1", 0, 0, 1, "1: it keeps the goal, and goes for a ball that is near to it"},
      {"forward", "m/s", 0.2, 0, 2, "as fast as it walks"},
      {"sideways", "m/s", 0.08, 0, 2, "the same to the side"},
      {"turn", "rad/s", 0.6, 0, 4, "the same on the spot"},
      {"goal_x", "m", 4.5, 0.5, 100, "of the goal line"},
      {"stride", "1", 1, 0.5, 2, "length of its steps in that of its odometry's"}};

  explicit Play(const Setup&) {}

  void step(const Step& now) {
    reckon(now);
    remember_ball(now);
    memory_.role = role(now);
    const auto command = now.output(walk_command);
    const Command c = act(now);
    command[0] = c.x, command[1] = c.y, command[2] = c.turn;
    const auto told = now.output(message);
    told[0] = distance_to_ball(), told[1] = memory_.me.at.x, told[2] = memory_.me.at.y, told[3] = double(memory_.role);
  }

  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  /// All that a step leaves for the next.
  struct Memory {
    Place me;           ///< on the field
    Place by_legs;      ///< as the legs have gone, since the start of the walk
    double turned = 0;  ///< rad: from the IMU's heading to that on the field
    Point ball;         ///< m, on the field: where it was last seen
    double age = 1e3;   ///< s: since then
    Role role = searches;
    std::int64_t drives = 0;  ///< it drives the ball
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);

 private:
  struct Command {
    double x = 0, y = 0, turn = 0;
  };

  /// Dead reckoning: the way as the legs have gone it, the heading by the IMU.
  void reckon(const Step& now) {
    const auto walked = now.input(odometry), q = now.input(orientation);
    const double heading = muro_atan2(2 * (q[3] * q[2] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2]));
    const Place by_legs{{walked[0], walked[1]}, walked[2]};
    if (now.index() == 0) {
      memory_.me.at = {now.tunable(start_x), now.tunable(start_y)};
      memory_.turned = now.tunable(start_yaw) - heading;
    } else {
      constexpr double most = 0.3;  // m, in a step: legs that got up count anew
      const Point way = memory_.by_legs.to_own(by_legs.at);
      if (way.norm() < most) memory_.me.at = memory_.me.to_world(now.tunable(stride) * way);
    }
    memory_.me.yaw = wrapped(heading + memory_.turned);
    memory_.by_legs = by_legs;
  }

  void remember_ball(const Step& now) {
    const auto seen = now.input(ball_seen);
    memory_.age += now.period();
    if (seen[0] == 0) return;
    memory_.ball = memory_.me.to_world({seen[1], seen[2]});
    memory_.age = 0;
  }
  Command act(const Step& now) {
    switch (memory_.role) {
      case waits:
        return {};
      case searches:
        return search(now);
      case goes_for_ball:
        return drive(now);
      case keeps_place:
        return go_to(now, place(now), heading_to(memory_.ball));
    }
    return {};
  }
  /// A ball that was last seen at its feet lies there still: it goes back to see it. Else it turns about.
  Command search(const Step& now) const {
    constexpr double at_feet = 0.6, back = 6;  // m, s
    const bool goes_back = memory_.age < forgets + back && (memory_.ball - memory_.me.at).norm() < at_feet;
    return goes_back ? Command{-0.4 * now.tunable(forward), 0, 0} : Command{0, 0, now.tunable(turn)};
  }
  double distance_to_ball() const { return memory_.age < forgets ? (memory_.ball - memory_.me.at).norm() : far_away; }
  double heading_to(const Point& p) const { return muro_atan2(p.y - memory_.me.at.y, p.x - memory_.me.at.x); }

  Role role(const Step& now) const {
    const auto state = now.input(match_state);
    if (!state.empty() && state[0] == 2) return waits;
    const double mine = distance_to_ball();
    const auto told = now.input(mates);
    double nearest = far_away;
    for (std::size_t i = 0; i + message_size <= told.size(); i += message_size) nearest = std::min(nearest, told[i]);
    if (mine >= far_away && nearest >= far_away) return searches;
    if (now.tunable(keeper) > 0 && mine > 1) return mine >= far_away ? searches : keeps_place;
    constexpr double begins = 0.1, hysteresis = 0.3;  // m: what was told is a little old; who goes for the ball goes on
    const double allowed = memory_.role == goes_for_ball ? hysteresis : begins;
    if (mine < far_away && mine <= nearest + allowed) return goes_for_ball;
    return mine < far_away ? keeps_place : searches;
  }

  /// Its place, from which it goes along with the ball.
  Point place(const Step& now) const {
    const Point home{now.tunable(home_x), now.tunable(home_y)};
    if (now.tunable(keeper) > 0) return {home.x, std::clamp(0.5 * memory_.ball.y, -1.0, 1.0)};
    return {home.x + 0.3 * memory_.ball.x, home.y + 0.3 * memory_.ball.y};
  }

  Command drive(const Step& now) {
    constexpr double mouth = 0.8, in_goal = 0.3;  // m: it drives to a point in the goal, straight ahead where it can
    const Point goal{now.tunable(attack) * (now.tunable(goal_x) + in_goal), std::clamp(memory_.ball.y, -mouth, mouth)};
    const double to_goal = muro_atan2(goal.y - memory_.ball.y, goal.x - memory_.ball.x);
    const Point rest = Place{memory_.ball, to_goal}.to_own(memory_.me.at);  // from the ball, x to the goal
    const double off = wrapped(to_goal - memory_.me.yaw);
    const double wide = memory_.drives ? goes_on : 1;
    memory_.drives = rest.x < -0.03 && std::abs(rest.y) < wide * (line + 0.2 * std::max(0.0, -rest.x - behind)) &&
                     std::abs(off) < wide * ahead;
    if (memory_.drives) {
      const double sway = std::clamp(-0.8 * rest.y, -now.tunable(sideways), now.tunable(sideways));
      return {now.tunable(forward), sway, std::clamp(0.6 * off, -calm, calm)};
    }
    const double side = rest.y < 0 ? -1 : 1;
    const Place ball{memory_.ball, to_goal};
    // past the ball first, then behind it
    if (rest.x > -0.5 * behind) return go_to(now, ball.to_world({-behind, side * aside}), heading_to(memory_.ball));
    return go_to(now, ball.to_world({-behind, 0}), to_goal);
  }

  /// To a point, and to a heading there; what is far is walked to forwards.
  Command go_to(const Step& now, const Point& target, double heading) const {
    constexpr double near_by = 0.5, there = 0.04;  // m
    const Point way = memory_.me.to_own(target);
    const double distance = way.norm(), fast = now.tunable(forward), quick = now.tunable(turn);
    const double most = distance > near_by ? quick : std::min(quick, calm), gain = distance > near_by ? 1.2 : 0.6;
    const auto turning = [&](double angle) { return std::clamp(gain * wrapped(angle - memory_.me.yaw), -most, most); };
    if (distance > near_by) {
      const double off = wrapped(heading_to(target) - memory_.me.yaw);
      return {fast * std::max(0.0, 1 - std::abs(off) / 0.8), 0, turning(heading_to(target))};
    }
    if (distance < there) return {0, 0, std::abs(wrapped(heading - memory_.me.yaw)) > 0.1 ? turning(heading) : 0};
    return {std::clamp(0.8 * way.x, -0.5 * fast, 0.5 * fast),
            std::clamp(0.8 * way.y, -now.tunable(sideways), now.tunable(sideways)), turning(heading)};
  }

  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Play)
