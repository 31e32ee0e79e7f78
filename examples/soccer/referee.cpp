// SPDX-License-Identifier: MIT
// The referee of a match: counts goals, falls and balls that went out, puts the ball on its spot, ends the half. It
// sees the true poses of ball and players, like the referee of the league's virtual season. It writes properties of the
// world object, `match.*`, which players may read and recorder.report puts into the report.
#include <array>
#include <cstdint>
#include <span>

#include "../common/vector.hpp"
#include "falls.hpp"
#include "muro_controller.hpp"
#include "pitch.hpp"

namespace {

using namespace muro::controller;
using namespace soccer;

enum Input { ball_pose, left_poses, right_poses, place_answer };
enum Output { place_pose, place_twist, place_count, match_state, match_score, match_falls, match_outs, match_kick_off };
enum Tunable { length, width, goal_width, half, pause, patience, kick_off };
enum State { waits_for_ball, plays, is_over };  ///< `match.state`

constexpr double reach = 0.3;   // m: the player nearest to the ball within this distance has touched it last
constexpr double stuck = 0.15;  // m: a ball that stays within this distance for `patience` is stuck
constexpr int most_players = 32;

/// State of the match, as it is saved.
struct Match {
  std::array<std::int64_t, 2> score{}, falls{};
  std::int64_t outs = 0, state = plays, placements = 0, tries = 0, last_touch = no_team;
  double restart_time = 0;    // s: time at which the ball is put on its spot
  Point spot;                 // spot of the ball
  Point rest;                 // place of the ball when it began to rest
  double rest_time = 0;       // s: time at which it began to rest
  std::int64_t kick_off = 0;  // 1: the left team has it, -1: the right team, 0: the ball is in play
  double kick_off_time = 0;   // s: time at which the ball was put on the centre mark for it
  std::array<FallWatch, most_players> players{};
};

struct Player {
  double x, y, up;
};
Player player_of(std::span<const double> poses, std::size_t i) {
  const std::span<const double> p = poses.subspan(7 * i, 7);  // x y z qx qy qz qw
  return {p[0], p[1], examples::Rotation::of(p.last(4)).up().z};
}

class Referee {
 public:
  static constexpr const char* name = "referee";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Counts goals and falls, puts the ball on its spot, ends the half";
  static constexpr muro_port inputs[] = {{"ball.pose", "m", 7, 0},
                                         {"left.poses", "m", 0, MURO_PORT_OPTIONAL},
                                         {"right.poses", "m", 0, MURO_PORT_OPTIONAL},
                                         {"place.answer", "1", 1, 0}};
  static constexpr muro_port outputs[] = {{"place.pose", "m", 7, 0},
                                          {"place.twist", "m/s, rad/s", 6, 0},
                                          {"place.count", "1", 1, 0},
                                          {"match.state", "1", 1, MURO_PORT_OWN},
                                          {"match.score", "1", 2, MURO_PORT_OWN},
                                          {"match.falls", "1", 2, MURO_PORT_OWN},
                                          {"match.outs", "1", 1, MURO_PORT_OWN},
                                          {"match.kick_off", "1", 1, MURO_PORT_OWN}};
  static constexpr muro_tunable tunables[] = {
      {"length", "m", 9, 1, 200, "of the field, from goal line to goal line"},
      {"width", "m", 6, 1, 200, "from touch line to touch line"},
      {"goal_width", "m", 2.6, 0.1, 100, "between the posts"},
      {"half", "s", 600, 1, 1e6, "time of play, after which the match is over"},
      {"pause", "s", 1, 0, 100, "between a goal or a ball that went out and the next kick"},
      {"patience", "s", 30, 1, 1e6, "a ball that does not move for so long is put on the centre mark"},
      {"kick_off", "s", 10, 0, 1e6,
       "so long one team alone may play the ball on the centre mark, at the start and after a goal"}};
  static constexpr std::size_t save_size = sizeof(Match);

  explicit Referee(const Setup& setup) {
    pitch_.length = setup.tunable(length), pitch_.width = setup.tunable(width);
    pitch_.goal_width = setup.tunable(goal_width);
    if (setup.input_size(left_poses) % 7 != 0 || setup.input_size(right_poses) % 7 != 0)
      throw std::invalid_argument("left.poses and right.poses are to be poses of players");
    if (setup.input_size(left_poses) + setup.input_size(right_poses) > 7 * most_players)
      throw std::invalid_argument("there are more players than 32");
  }

  void step(const Step& now) {
    watch_players(now);
    const auto ball = now.input(ball_pose);
    if (now.index() == 0 && ball[0] * ball[0] + ball[1] * ball[1] < stuck * stuck) match_.kick_off = 1;
    if (match_.state == plays && now.time() >= now.tunable(half)) {
      match_.state = is_over;
      now.log().info("the half is over: " + score());
    }
    if (match_.state == plays) watch_ball(now, ball[0], ball[1], ball[2]);
    if (match_.state == waits_for_ball) put_ball(now);
    now.output(match_state)[0] = double(match_.state);
    for (std::size_t t = 0; t < 2; ++t) {
      now.output(match_score)[t] = double(match_.score[t]);
      now.output(match_falls)[t] = double(match_.falls[t]);
    }
    now.output(match_outs)[0] = double(match_.outs);
    now.output(match_kick_off)[0] = double(match_.kick_off);
  }

  void save(Saver& to) const { to.put(match_); }
  void load(Loader& from) { match_ = from.get<Match>(); }

 private:
  std::string score() const { return std::to_string(match_.score[left]) + " : " + std::to_string(match_.score[right]); }

  void watch_players(const Step& now) {
    std::size_t number = 0;
    double nearest = reach * reach;
    for (const Team team : {left, right}) {
      const auto poses = now.input(team == left ? left_poses : right_poses);
      for (std::size_t i = 0; i < poses.size() / 7; ++i, ++number) {
        const Player p = player_of(poses, i);
        const double dx = p.x - now.input(ball_pose)[0], dy = p.y - now.input(ball_pose)[1];
        if (dx * dx + dy * dy < nearest) nearest = dx * dx + dy * dy, match_.last_touch = team;
        if (match_.players[number].has_fallen(p.up, now.period())) ++match_.falls[team];
      }
    }
  }

  void watch_ball(const Step& now, double x, double y, double z) {
    const double dx = x - match_.rest.x, dy = y - match_.rest.y;
    const bool moves = dx * dx + dy * dy > stuck * stuck;
    if (moves) match_.rest = {x, y}, match_.rest_time = now.time();
    if (moves || now.time() - match_.kick_off_time > now.tunable(kick_off)) match_.kick_off = 0;
    if (const Team team = pitch_.scorer(x, y, z); team != no_team) {
      ++match_.score[team];
      now.log().info("goal: " + score());
      stop_for(now, {});
      match_.kick_off = team == left ? -1 : 1;
    } else if (pitch_.is_out(x, y)) {
      ++match_.outs;
      stop_for(now, pitch_.restart(x, y, Team(match_.last_touch)));
    } else if (now.time() - match_.rest_time > now.tunable(patience)) {
      stop_for(now, {});
    }
  }

  void stop_for(const Step& now, const Point& spot) {
    match_.state = waits_for_ball;
    match_.spot = spot;
    match_.restart_time = now.time() + now.tunable(pause);
    match_.tries = 0;
  }

  /// Puts the ball on its spot, or beside the spot when somebody stands there.
  void put_ball(const Step& now) {
    if (now.time() < match_.restart_time) return;
    const double answer = now.input(place_answer)[0];
    if (match_.tries > 0 && answer == double(match_.placements)) {
      match_.state = plays;
      match_.rest = match_.spot, match_.rest_time = match_.kick_off_time = now.time();
      return;
    }
    if (match_.tries > 0 && answer != double(-1 - match_.placements)) return;  // not answered yet
    constexpr double aside = 0.25;                                             // m
    const double side = match_.tries % 2 == 0 ? 1 : -1;
    if (match_.tries > 0 && std::abs(match_.spot.x) > aside) match_.spot.x -= std::copysign(aside, match_.spot.x);
    match_.spot.y += side * aside * double(match_.tries);
    ++match_.tries, ++match_.placements;
    const auto pose = now.output(place_pose), twist = now.output(place_twist);
    const double values[] = {match_.spot.x, match_.spot.y, pitch_.ball_radius, 0, 0, 0, 1};
    std::copy(std::begin(values), std::end(values), pose.begin());
    std::fill(twist.begin(), twist.end(), 0.0);
    now.output(place_count)[0] = double(match_.placements);
  }

  Pitch pitch_;
  Match match_;
};

}  // namespace

MURO_CONTROLLER(Referee)
