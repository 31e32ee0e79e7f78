// SPDX-License-Identifier: MIT
// A player: finds the ball, goes behind it and kicks it to the goal, or keeps its place and leaves the ball to a mate.
// It uses what its camera finds (look.cpp), how it has walked (examples/walk) and messages of mates. The player with
// the shortest way to the ball goes for it; the others keep their places, a keeper the line between ball and goal.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "../common/angle.hpp"
#include "../common/place.hpp"
#include "localisation.hpp"
#include "muro_controller.hpp"
#include "muro_elementary.h"
#include "striker.hpp"
#include "team_message.hpp"

namespace {

using namespace muro::controller;
using namespace soccer;

enum Input {
  ball_seen,
  goal_seen,
  lines_seen,
  players_seen,
  odometry,
  walk_phase,
  orientation,
  match_state,
  match_score,
  match_kick_off,
  mates
};
enum Output { walk_command, walk_kick, message };
enum Tunable {
  // clang-format off
  number, start_x, start_y, start_yaw, home_x, home_y, keeper, forward, sideways, turn, stride,
  attack, goal_x, goal_width, kick_x, kick_y, kick_speed, kick_way,
  // clang-format on
};
enum WalkPhase : std::int64_t { stands = 1, walks = 2, falls = 3, gets_up = 4, kicks = 5 };  ///< see examples/walk

constexpr double forgets = 10;       // s: a ball that nobody has seen for so long is searched for
constexpr double trusts_itself = 3;  // s: age of its own sight from which it believes mates
constexpr double unseen = 2;         // s: after so long without a sight, the kicker has lost the ball
constexpr double far_away = 100;     // m: cost of a player that does not know where the ball is

class Play {
 public:
  static constexpr const char* name = "play";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Plays soccer: finds the ball, kicks it to the goal, keeps its place";
  static constexpr muro_port inputs[] = {{"ball.seen", "1, m, m, s", 4, 0},
                                         {"goal.seen", "1, m, m", 0, MURO_PORT_OPTIONAL},
                                         {"lines.seen", "1, m, m", 0, MURO_PORT_OPTIONAL},
                                         {"players.seen", "1, m, m, 1", 0, MURO_PORT_OPTIONAL},
                                         {"walk.odometry", "m, m, rad", 3, 0},
                                         {"walk.phase", "1", 1, 0},
                                         {"orientation", "1", 4, 0},
                                         {"match.state", "1", 1, MURO_PORT_OPTIONAL},
                                         {"match.score", "1", 2, MURO_PORT_OPTIONAL},
                                         {"match.kick_off", "1", 1, MURO_PORT_OPTIONAL},
                                         {"mates", TeamMessage::units, 0, MURO_PORT_OPTIONAL}};
  static constexpr muro_port outputs[] = {{"walk.command", "m/s, m/s, rad/s", 3, MURO_PORT_OWN},
                                          {"walk.kick", "1, m/s", 2, MURO_PORT_OWN},
                                          {"team.message", TeamMessage::units, TeamMessage::size, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"number", "1", 1, 1, 99, "of the player, in its team"},
      {"start_x", "m", 0, -100, 100, "where it stands at the start, on the field"},
      {"start_y", "m", 0, -100, 100, "the same"},
      {"start_yaw", "rad", 0, -7, 7, "the same"},
      {"home_x", "m", 0, -100, 100, "its place, where another one goes for the ball"},
      {"home_y", "m", 0, -100, 100, "the same"},
      {"keeper", "1", 0, 0, 1, "1: it keeps the goal, and goes for a ball that is near to it"},
      {"forward", "m/s", 0.25, 0, 2, "as fast as it walks"},
      {"sideways", "m/s", 0.08, 0, 2, "the same to the side"},
      {"turn", "rad/s", 0.6, 0, 4, "the same on the spot"},
      {"stride", "1", 1, 0.5, 2, "length of its steps in that of its odometry's"},
      {"attack", "1", 1, -1, 1, "1: the goal at x > 0; -1: the other one"},
      {"goal_x", "m", 4.5, 0.5, 100, "of the goal line"},
      {"goal_width", "m", 2.6, 0.1, 100, "between the posts"},
      {"kick_x", "m", 0.165, 0, 2, "how far ahead of its trunk the ball is to lie when it kicks"},
      {"kick_y", "m", 0.055, 0, 2, "and how far to the left or right of the trunk, by the foot that kicks"},
      {"kick_speed", "m/s", 3, 0, 20, "of the foot"},
      {"kick_way", "m", 1.4, 0, 20, "how far a ball goes that it kicks"}};

  explicit Play(const Setup& setup)
      : pace_{setup.tunable(forward), setup.tunable(sideways), setup.tunable(turn)},
        striker_{.attack = setup.tunable(attack),
                 .goal_x = setup.tunable(goal_x),
                 .goal_width = setup.tunable(goal_width),
                 .kick_x = setup.tunable(kick_x),
                 .kick_y = setup.tunable(kick_y)} {
    if (setup.input_size(mates) % TeamMessage::size != 0)
      throw std::invalid_argument("`mates` are to be messages of players, each the whole team.message");
  }

  void step(const Step& now) {
    reckon(now);
    remember(now);
    memory_.role = role(now);
    if (memory_.role != goes_for_ball) memory_.striker.rest();
    const Place soon = place_soon();
    const Striker::Decision d = act(now, soon, Steering(pace_, soon, memory_.others));
    write(d, now);
    // mates do not wait for a keeper that leaves the ball to them
    const bool leaves_it = now.tunable(keeper) > 0 && memory_.role != goes_for_ball;
    TeamMessage{own_number(now), memory_.role, leaves_it ? far_away : cost(now), me().at, memory_.ball, memory_.age}
        .write(now.output(message));
  }

  void save(Saver& to) const { to.put(memory_); }
  void load(Loader& from) { memory_ = from.get<Memory>(); }

 private:
  /// State that a step leaves for the next.
  struct Memory {
    Localisation self;        ///< its place on the field
    Command pending;          ///< m, m, rad: commanded motion that the legs have not done yet
    Place by_legs;            ///< way of the legs since the start of the walk
    double heading = 0;       ///< rad, by the IMU
    std::int64_t phase = 0;   ///< phase of the walk
    Point ball;               ///< m, on the field: where the player or a mate last saw it
    double age = 1e3;         ///< s: since then
    double goals = 0;         ///< number of goals up to now
    std::int64_t doubts = 0;  ///< number of times in a row that it was seen elsewhere
    double searched = 0;      ///< s: duration of the search
    Role role = searches;
    Striker striker;
    Others others;
    std::int64_t foot = 0;        ///< foot that is to kick: 1 left, -1 right
    std::int64_t has_kicked = 0;  ///< 1: it has kicked, and has not seen the ball since then
    double asked = 0;             ///< s: since the kick was asked for
  };

 public:
  static constexpr std::size_t save_size = sizeof(Memory);

 private:
  const Place& me() const { return memory_.self.place(); }

  /// Dead reckoning, with the way by the legs and the heading by the IMU; corrected by posts and lines.
  void reckon(const Step& now) {
    const auto walked = now.input(odometry);
    const double heading = examples::yaw_of(now.input(orientation));
    const Place by_legs{{walked[0], walked[1]}, walked[2]};
    if (now.index() == 0) {
      memory_.self.start({{now.tunable(start_x), now.tunable(start_y)}, now.tunable(start_yaw)});
      memory_.ball = {}, memory_.age = trusts_itself;  // kick-off is from the centre mark
    } else {
      memory_.self.move(now.tunable(stride) * memory_.by_legs.to_own(by_legs.at), wrapped(heading - memory_.heading),
                        now.period());
    }
    if (phase(now) == falls && memory_.phase != falls) memory_.self.fell();
    if (phase(now) != kicks && memory_.phase == kicks) expect_ball_ahead(now);
    memory_.phase = phase(now), memory_.by_legs = by_legs, memory_.heading = heading;
    if (const bool is_on_its_feet = phase(now) <= walks; !is_on_its_feet) return;
    Points seen;
    memory_.self.see_posts(seen.from(now.input(goal_seen)));
    memory_.self.see_lines(seen.from(now.input(lines_seen)));
  }
  /// Expects a kicked ball that is out of sight where its kicks go.
  void expect_ball_ahead(const Step& now) {
    constexpr double lost = 0.3, near = 0.6;  // s, m
    if (phase(now) == falls || memory_.age < lost || (memory_.ball - me().at).norm() > near) return;
    memory_.ball = me().to_world({now.tunable(kick_x) + now.tunable(kick_way), 0}), memory_.age = lost;
  }
  /// Reads a list of points that begins with their number.
  struct Points {
    std::array<Point, 32> all;
    std::span<const Point> from(std::span<const double> told) {
      std::size_t n = 0;
      while (n < all.size() && 2 * n + 2 < told.size() && double(n) < told[0])
        all[n] = {told[2 * n + 1], told[2 * n + 2]}, ++n;
      return std::span(all).first(n);
    }
  };

  void remember(const Step& now) {
    memory_.age += now.period();
    memory_.others.pass(now.period());
    for_each_mate(now, [&](const TeamMessage& m) {
      memory_.others.see(m.me);
      if (memory_.age > trusts_itself && m.age < memory_.age - 1) memory_.ball = m.ball, memory_.age = m.age;
    });
    const auto players = now.input(players_seen);
    for (std::size_t i = 1; i + 3 <= players.size() && double(i) < 3 * players[0]; i += 3)
      memory_.others.see(me().to_world({players[i], players[i + 1]}));
    hear_goal(now);
    const auto seen = now.input(ball_seen);
    if (seen[0] != 0 && !lies(now)) see_ball(me().to_world({seen[1], seen[2]}));
  }
  /// Expects the ball on the centre mark after a goal.
  void hear_goal(const Step& now) {
    const auto score = now.input(match_score);
    if (score.empty() || score[0] + score[1] == memory_.goals) return;
    constexpr double until_put = 1;  // s
    memory_.goals = score[0] + score[1];
    memory_.ball = {}, memory_.age = until_put;
  }
  /// Takes the place of a seen ball. A place far from the last one is believed after repeated sights.
  void see_ball(const Point& at) {
    constexpr double leap = 0.6, recent = 1.5;  // m, s
    constexpr std::int64_t times = 3;
    memory_.doubts = memory_.age < recent && (at - memory_.ball).norm() > leap ? memory_.doubts + 1 : 0;
    if (memory_.doubts > 0 && memory_.doubts < times) return;
    memory_.ball = at, memory_.age = 0, memory_.doubts = 0, memory_.has_kicked = 0;
  }
  template <class F>
  static void for_each_mate(const Step& now, F f) {
    const auto told = now.input(mates);
    for (std::size_t i = 0; i + TeamMessage::size <= told.size(); i += TeamMessage::size)
      if (const auto m = TeamMessage::from(told.subspan(i, TeamMessage::size));
          m.number != 0 && m.number != own_number(now))
        f(m);  // 0: no message yet
  }
  static std::int64_t own_number(const Step& now) { return std::int64_t(now.tunable(number)); }

  /// Returns where it will be when the legs have done what was commanded.
  Place place_soon() const {
    return {me().to_world({memory_.pending.x, memory_.pending.y}), me().yaw + memory_.pending.turn};
  }
  std::int64_t phase(const Step& now) const { return std::int64_t(now.input(walk_phase)[0]); }
  /// Returns whether it lies, falls or gets up.
  bool lies(const Step& now) const { return phase(now) == falls || phase(now) == gets_up; }
  /// Returns the way to the ball and around it in m; a robot that lies gets up first.
  double cost(const Step& now) const {
    if (memory_.age > forgets) return far_away;
    const Point way = memory_.ball - me().at;
    const double about = way.x * now.tunable(attack) < 0 ? 0.6 : 0, up = lies(now) ? 2 : 0;
    return way.norm() + about + up;
  }

  Role role(const Step& now) const {
    const auto state = now.input(match_state);
    if (!state.empty() && state[0] == 2) return waits;
    const double mine = cost(now);
    if (mine >= far_away) return searches;
    const auto kick_off = now.input(match_kick_off);
    if (!kick_off.empty() && kick_off[0] * now.tunable(attack) < 0) return keeps_place;  // the other team has it
    constexpr double near_goal = 0.6;  // m: a ball that the keeper fetches itself
    if (now.tunable(keeper) > 0 && std::abs(memory_.ball.x - now.tunable(home_x)) > near_goal) return keeps_place;
    constexpr double begins = 0.1, goes_on = 0.3;  // m: begins when nearer by this; goes on until farther by this
    const bool goes = memory_.role == goes_for_ball;
    bool is_best = true, is_nearest = true, somebody_goes = false;
    for_each_mate(now, [&](const TeamMessage& m) {
      const bool is_better = mine < m.cost || (mine == m.cost && own_number(now) < m.number);
      is_best = is_best && is_better;
      if (m.role == goes_for_ball)
        somebody_goes = true, is_nearest = is_nearest && (goes ? is_better : mine < m.cost - begins);
      else
        is_nearest = is_nearest && mine < m.cost + (goes ? goes_on : -begins);
    });
    return is_nearest || (is_best && !somebody_goes) ? goes_for_ball : keeps_place;
  }

  Striker::Decision act(const Step& now, const Place& soon, const Steering& steering) {
    memory_.searched = memory_.role == searches ? memory_.searched + now.period() : 0;
    if (memory_.role == waits) return {};
    if (is_too_near()) return {steering.back(), 0};
    switch (memory_.role) {
      case searches:
        return {search(now, steering), 0};
      case goes_for_ball:
        if (is_lost_at_feet(unseen)) return {steering.back(), 0};
        return memory_.striker.act(me(), soon, memory_.ball, memory_.others, steering, striker_);
      default:
        return {steering.go_to(place(now), steering.heading_to(memory_.ball), {.distance = 0.2, .angle = 0.35}), 0};
    }
  }
  /// Returns whether somebody stands right in front of it. A player at the ball stays there.
  bool is_too_near() const {
    constexpr double touch = 0.3, at_ball = 0.35;  // m
    if (memory_.role == goes_for_ball && memory_.age < unseen && (memory_.ball - me().at).norm() < at_ball)
      return false;
    const Others::Other* const o = memory_.others.nearest(me().at, touch);
    return o && me().to_own(o->at).x > 0;
  }
  /// Returns whether the ball was last seen at its feet, and not lately: it probably lies there still.
  bool is_lost_at_feet(double since) const {
    constexpr double at_feet = 0.6;  // m
    return memory_.age > since && (memory_.ball - me().at).norm() < at_feet;
  }
  /// Walks to the ball's last place and turns there; then before the other goal, then at its own place, and so on.
  Command search(const Step& now, const Steering& steering) const {
    constexpr double walks_for = 9, turns_for = 10, goes_back = 5;  // s
    constexpr double there = 0.8, before_goal = 2;                  // m
    if (memory_.searched < goes_back && is_lost_at_feet(0)) return steering.back();
    const Point home{now.tunable(home_x), now.tunable(home_y)};
    const Point places[] = {memory_.ball, {striker_.attack * (striker_.goal_x - before_goal), 0.5 * home.y}, home};
    const double turn = walks_for + turns_for;
    const Point& to = places[std::size_t(memory_.searched / turn) % std::size(places)];
    if (std::fmod(memory_.searched, turn) > walks_for || (to - me().at).norm() < there) return steering.turn();
    return steering.go_to(to, steering.heading_to(to), {.distance = 0.3, .angle = 0.3});
  }

  /// Returns its place, which moves along with the ball and away from the player who goes for it.
  Point place(const Step& now) const {
    const Point home{now.tunable(home_x), now.tunable(home_y)};
    if (now.tunable(keeper) > 0)
      return {home.x,
              std::clamp(0.5 * memory_.ball.y, -0.35 * now.tunable(goal_width), 0.35 * now.tunable(goal_width))};
    constexpr double apart = 1;  // m
    const Point place{home.x + 0.4 * memory_.ball.x, home.y + 0.4 * memory_.ball.y};
    const Point off = place - memory_.ball;
    return off.norm() >= apart || off.norm() < 1e-6 ? place : memory_.ball + (apart / off.norm()) * off;
  }

  /// Writes the commands. A kick is requested until it is made.
  void write(const Striker::Decision& d, const Step& now) {
    constexpr double patience = 2.5;  // s
    const bool was_asked = memory_.foot != 0;
    memory_.asked = was_asked ? memory_.asked + now.period() : 0;
    if (phase(now) == kicks || phase(now) == falls || memory_.asked > patience) memory_.foot = 0;
    if (phase(now) == kicks) memory_.has_kicked = 1;
    // the walk takes a kick when it changes from 0, while the robot stands or walks
    const bool may_kick = phase(now) == stands || phase(now) == walks;
    if (d.kick != 0 && !was_asked && may_kick && !memory_.has_kicked) memory_.foot = d.kick;
    const auto command = now.output(walk_command), kick = now.output(walk_kick);
    const Command walk = memory_.foot == 0 && phase(now) != kicks ? d.walk : Command{};
    constexpr double lag = 0.5, lag_of_turns = 1.2;  // s: lags of the legs
    const auto follow = [&](double& pending, double told, double lag_of_it) {
      pending = lag_of_it / (lag_of_it + now.period()) * (pending + now.period() * told);
    };
    follow(memory_.pending.x, walk.x, lag), follow(memory_.pending.y, walk.y, lag);
    follow(memory_.pending.turn, walk.turn, lag_of_turns);
    command[0] = walk.x, command[1] = walk.y, command[2] = walk.turn;
    kick[0] = double(memory_.foot), kick[1] = memory_.foot == 0 ? 0 : now.tunable(kick_speed);
  }

  Steering::Pace pace_;
  StrikerSettings striker_;
  Memory memory_;
};

}  // namespace

MURO_CONTROLLER(Play)
