// SPDX-License-Identifier: MIT
// The player that goes for the ball: gets behind it, lines up, and kicks it to where nobody stands, best into the goal.
#pragma once

#include <cstdint>

#include "steering.hpp"

namespace soccer {

/// Settings of a player for its robot and the field.
struct StrikerSettings {
  double attack = 1;        ///< 1: the goal at x > 0; -1: the other one
  double goal_x = 4.5;      ///< m: x of the goal line
  double goal_width = 2.6;  ///< m
  double kick_x = 0.165;    ///< m: place of the ball for a kick, ahead of the trunk
  double kick_y = 0.055;    ///< m: and sideways, on the side of the kicking foot
  double kick_room_x = 0.04, kick_room_y = 0.035, kick_room_angle = 0.3;  ///< m, m, rad: tolerances
};

class Striker {
 public:
  struct Decision {
    Command walk;
    std::int64_t kick = 0;  ///< 1: kick with the left foot, -1: with the right one
  };

  /// `here`: its place; `me`: its place when the legs have done what was commanded.
  Decision act(const Place& here, const Place& me, const Point& ball, const Others& others, const Steering& steering,
               const StrikerSettings& s) {
    const double aim = choose_aim(me, ball, others, s);
    const Place from_ball{ball, aim};
    const Point rest = from_ball.to_own(me.at);  // x along the kick
    const double off = wrapped(aim - me.yaw);
    const double wide = foot_ != 0 ? 1.8 : 1;
    const bool lines_up =
        rest.x < -0.05 && rest.x > -wide * 0.4 && std::abs(rest.y) < wide * 0.1 && std::abs(off) < wide * 0.4;
    if (lines_up) return line_up(here.to_own(ball), me.to_own(ball), off, steering, s);
    foot_ = 0;
    return {go_behind(me, ball, aim, steering), 0};
  }
  /// Forgets the aim: another player goes for the ball now.
  void rest() { *this = {}; }

 private:
  static constexpr double behind = 0.3;    ///< m: distance from the ball at which it lines up
  static constexpr double aside = 0.32;    ///< m: it passes the ball at this distance and a fifth more
  static constexpr double shot = 1.0;      ///< m: length of the ball's way that must be free
  static constexpr double corridor = 0.2;  ///< m: half a player, a ball's radius, and a margin for errors

  /// Returns the aim, rad, on the field: into the goal, or past a player in front of it; directions near the present
  /// heading are preferred. An aim is kept while the ball lies still, its way is free, and no other aim is much better.
  double choose_aim(const Place& me, const Point& ball, const Others& others, const StrikerSettings& s) {
    constexpr double near = 0.6, moved = 0.25;                 // m
    constexpr double step = 0.25, turned = 0.5, better = 0.3;  // rad, 1, rad
    constexpr int steps = 5;                                   // to each side
    const double direct = aim_at_goal(me, ball, s);
    const auto cost = [&](double aim) {
      const double turn = (me.at - ball).norm() < near ? turned * std::abs(wrapped(aim - me.yaw)) : 0;
      return std::abs(wrapped(aim - direct)) + turn;
    };
    const auto is_free = [&](double aim) {
      return others.is_free(ball, Place{ball, aim}.to_world({shot, 0}), corridor);
    };
    double best = direct, least = 1e3;
    for (int i = -steps; i <= steps; ++i)
      if (const double aim = direct + step * i; cost(aim) < least && is_free(aim)) best = aim, least = cost(aim);
    const bool holds = (me.at - ball).norm() < near && (ball - aimed_from_).norm() < moved && is_free(aim_);
    if (!holds || cost(aim_) > least + better) aim_ = best, aimed_from_ = ball;
    return aim_;
  }
  /// Returns the direction to the goal. From far away it need not be exact: another kick follows.
  static double aim_at_goal(const Place& me, const Point& ball, const StrikerSettings& s) {
    constexpr double from_post = 0.35, far = 2.5, careless = 0.15;  // m, m, rad
    const double line = s.attack * s.goal_x, mouth = 0.5 * s.goal_width - from_post;
    const auto angle_to = [&](double y) {
      return muro_atan2(y - ball.y, s.attack * std::max(0.2, std::abs(line - ball.x)));
    };
    const double middle = angle_to(0), from_here = bearing(ball - me.at);
    const double wide = std::abs(line - ball.x) > far ? careless : 0;
    const double one = wrapped(angle_to(mouth) - middle), other = wrapped(angle_to(-mouth) - middle);
    return middle + std::clamp(wrapped(from_here - middle), std::min(one, other) - wide, std::max(one, other) + wide);
  }

  /// Makes the last steps to the ball, and the kick. The ball lies ahead of its present place and of its next place.
  Decision line_up(const Point& from_here, const Point& ball, double off, const Steering& steering,
                   const StrikerSettings& s) {
    constexpr double firm = 0.02, steadily = 0.3;  // m, 1
    const bool begins = foot_ == 0;
    if (begins || double(foot_) * ball.y < -firm) foot_ = ball.y < 0 ? -1 : 1;
    // the trunk sways about its way during a walk
    sway_ = begins ? ball.y : sway_ + steadily * (ball.y - sway_);
    const auto from_foot = [&](double x, double y) { return Point{x - s.kick_x, y - double(foot_) * s.kick_y}; };
    const auto is_within = [&](const Point& p, double share) {
      return std::abs(p.x) < share * s.kick_room_x && std::abs(p.y) < share * s.kick_room_y;
    };
    constexpr double roughly = 1.7;  // factor of the present tolerance, while it still sways and turns
    const Point way = from_foot(ball.x, sway_);
    const bool is_there = is_within(way, 1) && is_within(from_foot(from_here.x, from_here.y), roughly) &&
                          std::abs(off) < s.kick_room_angle;
    if (is_there) return {{}, foot_};
    return {steering.small_step(way, off), 0};
  }

  Command go_behind(const Place& me, const Point& ball, double aim, const Steering& steering) const {
    const Point place = Place{ball, aim}.to_world({-behind, 0});
    if (!Others::blocks(ball, me.at, place, 0.8 * aside)) return steering.go_to(place, aim, {});
    return steering.go_to(Others::beside(ball, me.at, place, aside), steering.heading_to(ball), {});
  }

  double sway_ = 0;             ///< m: lateral place of the ball, averaged over the sway of the walk
  std::int64_t foot_ = 0;       ///< foot that is going to kick; 0: it does not line up
  double aim_ = 0;              ///< rad, on the field
  Point aimed_from_{1e3, 1e3};  ///< m: place of the ball when the aim was chosen
};

}  // namespace soccer
