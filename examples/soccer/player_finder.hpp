// SPDX-License-Identifier: MIT
// Finds other players: objects that stand on the grass and show the colour of a team.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "../common/limited_list.hpp"
#include "camera_view.hpp"
#include "image.hpp"

namespace soccer {

using examples::LimitedList;

struct SeenPlayer {
  Vector feet;   ///< m, in the heading frame
  int team = 0;  ///< 1 blue, -1 red, 0 unknown
};

class PlayerFinder {
 public:
  using Players = LimitedList<SeenPlayer, 4>;

  /// Returns the nearest players first. `ball`: a ball that is seen (m); it is dark, too, and lies at feet.
  Players find(const Image& image, const CameraView& view, const std::optional<Vector>& ball) {
    scan(image, view, ball);
    Players players;
    while (!players.is_full()) {
      const auto nearest = std::min_element(columns_.begin(), columns_.begin() + used_,
                                            [](const Column& a, const Column& b) { return a.range < b.range; });
      if (nearest == columns_.begin() + used_ || nearest->range > farthest) break;
      if (const auto player = player_about(std::size_t(nearest - columns_.begin()), image, view)) add(*player, players);
    }
    return players;
  }

 private:
  static constexpr double farthest = 5;         ///< m
  static constexpr double none = 1e3;           ///< m
  static constexpr double half_width = 0.17;    ///< m, of a player with its arms down
  static constexpr double height = 0.5;         ///< m
  static constexpr double own = 0.25;           ///< m: nearer objects are parts of the player itself
  static constexpr double reach_of_arms = 0.6;  ///< m: limit of its own parts at its sides
  static constexpr int step = 2;                ///< px, from column to column
  static constexpr int middle_of_step = step / 2;
  static constexpr std::size_t most_columns = 1024;

  struct Column {
    double range = none;  ///< m, distance along the ground of the object there
    int row = 0;          ///< px, row of its foot
  };

  /// Finds for each column the lowest pixel that is neither grass nor line.
  void scan(const Image& image, const CameraView& view, const std::optional<Vector>& ball) {
    const auto centre = ball ? view.pixel_of(*ball) : std::nullopt;
    const double size =
        centre ? 1.3 * ball->z * view.lens().fx / view.depth_of(*ball) : 0;  // px; its centre is a radius high
    used_ = std::min(most_columns, std::size_t(image.width() / step));
    for (std::size_t i = 0; i < used_; ++i) {
      const int u = int(i) * step + middle_of_step;
      columns_[i] = {};
      for (int v = image.height() - 1; v >= 0; --v) {
        const Color color = image.color(u, v);
        if (color == green || color == white) continue;
        if (centre && std::abs(u - centre->u) < size && std::abs(v - centre->v) < size) continue;
        const auto ground = view.at_height({u + 0.5, v + 1.0}, 0);
        if (!ground) break;
        const double range = std::sqrt(ground->x * ground->x + ground->y * ground->y);
        const bool is_own = range < own || (range < reach_of_arms && std::abs(ground->y) > 2 * std::abs(ground->x));
        if (is_own) continue;
        columns_[i] = {range, v};
        break;
      }
    }
  }

  /// Finds the player about the nearest column, and removes all columns that belong to it.
  std::optional<SeenPlayer> player_about(std::size_t i, const Image& image, const CameraView& view) {
    const double range = columns_[i].range;
    const int u = int(i) * step + middle_of_step;
    const auto ground = view.at_height({u + 0.5, columns_[i].row + 1.0}, 0);
    const double depth = view.depth_of(*ground), wide = half_width * view.lens().fx / depth;  // px
    const int reach = std::max(1, int(0.9 * wide / step));
    const std::size_t begin = std::size_t(std::max(0, int(i) - reach)),
                      end = std::min(used_, i + std::size_t(reach) + 1);
    std::size_t left = i, right = i;
    constexpr double step_of_feet = 0.15;  // m
    for (std::size_t k = begin; k < end; ++k)
      if (columns_[k].range < range + step_of_feet) left = std::min(left, k), right = std::max(right, k);
    const double middle = 0.5 * double(left + right) * step + middle_of_step;
    const int row = columns_[i].row;
    const int team = team_in(image, middle, row, wide, height * view.lens().fy / depth);
    // arms may be held away from the trunk; hands are less than half as high as the camera
    constexpr double arms = 1.4;
    const std::size_t first = std::size_t(std::max(0.0, (middle - arms * wide) / step));
    const std::size_t last = std::min(used_, std::size_t(std::max(0.0, (middle + arms * wide) / step)) + 1);
    columns_[i].range = none;
    if (team == 0) return std::nullopt;
    for (std::size_t k = first; k < last; ++k) {
      const double off = std::abs(double(int(k) * step + middle_of_step) - middle);
      if (off < wide || columns_[k].range < 2 * range) columns_[k].range = none;
    }
    const auto feet = view.at_height({middle + 0.5, row + 1.0}, 0);
    if (!feet) return std::nullopt;
    constexpr double behind_toes = 0.05;  // m: the middle of the feet
    const double distance = std::sqrt(feet->x * feet->x + feet->y * feet->y);
    return SeenPlayer{(1 + behind_toes / distance) * Vector{feet->x, feet->y, 0}, team > 0 ? 1 : -1};
  }

  /// Returns more than 0 for mostly blue, less than 0 for mostly red, 0 for too little of both.
  static int team_in(const Image& image, double u, int row, double wide, double high) {
    const int left = std::max(0, int(u - wide)), right = std::min(image.width() - 1, int(u + wide));
    const int top = std::max(0, row - int(high));
    int blues = 0, reds = 0;
    for (int v = top; v <= row; ++v)
      for (int x = left; x <= right; ++x) {
        const Color color = image.color(x, v);
        blues += color == blue, reds += color == red;
      }
    const int least = std::max(2, int(0.008 * (right - left + 1) * (row - top + 1)));
    if (std::max(blues, reds) < least) return 0;
    return blues > reds ? 1 : -1;
  }

  static void add(const SeenPlayer& player, Players& players) {
    constexpr double same = 0.3;  // m: nearer, it is an arm of a player that was found
    for (const SeenPlayer& other : players.all()) {
      const Vector apart = player.feet - other.feet;
      if (other.team == player.team && dot(apart, apart) < same * same) return;
    }
    players.add(player);
  }

  std::array<Column, most_columns> columns_{};
  std::size_t used_ = 0;
};

}  // namespace soccer
