// SPDX-License-Identifier: MIT
// Crosses hills to a goal by a 3D laser scanner, around steep ground. Each scan becomes a grid of heights around the
// vehicle, level, with the heading of the vehicle. Headings are compared by how far they lead before the ground under
// the wheels and beside them is too steep or unknown, by the unevenness until then, and by how much they get nearer to
// the goal (in the manner of Lacroix et al., Autonomous Rover Navigation on Unknown Terrains, Int. J. Robotics Research
// 21, 2002). Frames follow ROS REP-103.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "../common/angle.hpp"
#include "../common/vector.hpp"
#include "muro_controller.hpp"
#include "muro_elementary.h"  // sines and the like with equal bits on every machine

namespace {

using namespace muro::controller;
using examples::Rotation;
using examples::Vector;
using examples::yaw_of;

constexpr double pi = 3.14159265358979323846;
constexpr double scanner_x = 0.1, scanner_z = 0.33, ground_z = -0.09;  // m: in the frame of the vehicle
constexpr double aside[] = {-0.45, -0.17, 0.17, 0.45};  // m: the ruts of the wheels, and a margin on either side
constexpr double under_vehicle = 0.8;                   // m: area that the scanner cannot see

/// Rotation from the frame of the vehicle to a level frame with its heading.
struct Level {
  double yaw;  // rad
  Rotation rotation;

  /// `pose`: x y z of the position, x y z w of the quaternion.
  explicit Level(std::span<const double> pose)
      : yaw(yaw_of(pose.last(4))), rotation(levelled(Rotation::of(pose.last(4)), yaw)) {}
  Vector operator()(const Vector& v) const { return rotation * v; }
};

/// Mean height of the points that were seen in each cell around the vehicle.
class HeightGrid {
 public:
  void clear() { cells_.fill({}); }
  void add(const Vector& p) {
    const int at = number(p.x, p.y);
    if (at >= 0) cells_[std::size_t(at)].sum += p.z, cells_[std::size_t(at)].count += 1;
  }
  std::optional<double> height(double x, double y) const {
    const int at = number(x, y);
    if (at < 0 || cells_[std::size_t(at)].count == 0) return std::nullopt;
    return cells_[std::size_t(at)].sum / cells_[std::size_t(at)].count;
  }

 private:
  static constexpr int middle = 24, side = 2 * middle;
  static constexpr double cell = 0.2;  // m
  static int number(double x, double y) {
    const double column = std::floor(x / cell) + middle, row = std::floor(y / cell) + middle;
    return column >= 0 && column < side && row >= 0 && row < side ? int(row) * side + int(column) : -1;
  }
  struct Cell {
    double sum = 0, count = 0;
  };
  std::array<Cell, side * side> cells_;
};

class Cross {
 public:
  static constexpr const char* name = "cross";
  static constexpr const char* version = "1.0.0";
  static constexpr const char* summary = "Crosses hills to a goal by a 3D laser scanner";
  static constexpr muro_port inputs[] = {{"ranges", "m", 0, 0},
                                         {"laser.columns", "1", 1, MURO_PORT_INTEGER},
                                         {"laser.min_angle", "rad", 1, 0},
                                         {"laser.angle_increment", "rad", 1, 0},
                                         {"laser.min_elevation", "rad", 1, 0},
                                         {"laser.elevation_increment", "rad", 1, 0},
                                         {"laser.max_range", "m", 1, 0},
                                         {"pose", "m", 7, 0}};
  static constexpr muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}};
  static constexpr muro_tunable tunables[] = {{"goal_x", "m", 0, -1e4, 1e4, "in the world"},
                                              {"goal_y", "m", 0, -1e4, 1e4, "in the world"},
                                              {"goal_spacing", "m", 0, -1e4, 1e4, "along y, between goals of a team"},
                                              {"speed", "m/s", 0.6, 0.05, 2, "on even ground"},
                                              {"max_slope", "1", 0.4, 0.05, 100, "rise over run that it takes"}};

  explicit Cross(const Setup& setup) : place_in_team_(setup.index() - 0.5 * (setup.count() - 1)) {
    directions_.reserve(setup.input_size(at_ranges));
  }

  void step(const Step& now) {
    if (directions_.empty()) find_directions(now);
    const std::span<const double> pose = now.input(at_pose);
    const Level level(pose);
    see(now, level);
    const double to_x = now.tunable(goal_x) - pose[0];
    const double to_y = now.tunable(goal_y) + place_in_team_ * now.tunable(goal_spacing) - pose[1];
    const std::span<double> twist = now.output(0);
    twist[0] = twist[5] = 0;
    if (to_x * to_x + to_y * to_y < 1) return;  // it is there
    const double wanted = wrapped(muro_atan2(to_y, to_x) - level.yaw);
    Way best;
    for (int i = -headings; i <= headings; ++i) {
      const Way way = way_along(widest * i / headings, wanted, wrapped(last_ - level.yaw), now.tunable(max_slope));
      if (way.reach >= needed && way.score > best.score) best = way;
    }
    if (best.reach < needed) {  // it turns on the spot, always to the same side, until there is a way
      twist[5] = 0.8;
      last_ = level.yaw;
      return;
    }
    last_ = wrapped(level.yaw + best.heading);
    twist[0] = now.tunable(speed) * std::max(0.0, 1 - std::abs(best.heading) / 1.2) * std::min(1.0, best.reach / 2);
    twist[5] = std::clamp(1.5 * best.heading, -1.0, 1.0);
  }

  static constexpr std::size_t save_size = sizeof(double);
  void save(Saver& to) const { to.put(last_); }
  void load(Loader& from) { last_ = from.get<double>(); }

 private:
  enum { at_ranges, at_columns, at_min_angle, at_increment, at_min_elevation, at_rise, at_max_range, at_pose };
  enum { goal_x, goal_y, goal_spacing, speed, max_slope };
  static constexpr int headings = 24;                                                               // to either side
  static constexpr double widest = 1.25, horizon = 4, needed = 1.2, pace = 0.4, longest_gap = 1.3;  // rad, m

  struct Way {
    double heading = 0, reach = 0, score = -1e9;  // rad, m
  };

  static double wrapped(double angle) { return angle - 2 * pi * std::round(angle / (2 * pi)); }

  /// Finds the directions of the rays in the frame of the vehicle.
  void find_directions(const Step& now) {
    const std::size_t columns = std::size_t(now.integer_input(at_columns)[0]);
    for (std::size_t i = 0; i < now.input(at_ranges).size(); ++i) {
      const std::size_t row = i / columns, column = i % columns;
      const double azimuth = now.input(at_min_angle)[0] + double(column) * now.input(at_increment)[0];
      const double elevation = now.input(at_min_elevation)[0] + double(row) * now.input(at_rise)[0];
      const double level = muro_cos(elevation);
      directions_.push_back({level * muro_cos(azimuth), level * muro_sin(azimuth), muro_sin(elevation)});
    }
  }

  /// Fills the grid: the ground under the vehicle leans as the vehicle does; the scan shows the ground around it.
  void see(const Step& now, const Level& level) {
    grid_.clear();
    for (double x = -under_vehicle; x <= under_vehicle; x += 0.1)
      for (double y = -under_vehicle; y <= under_vehicle; y += 0.1) grid_.add(level({x, y, ground_z}));
    const std::span<const double> ranges = now.input(at_ranges);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double range = ranges[i];
      if (!(range > 0 && range < now.input(at_max_range)[0])) continue;
      const Vector& d = directions_[i];
      grid_.add(level({scanner_x + range * d.x, range * d.y, scanner_z + range * d.z}));
    }
  }

  /// Ground along a heading, at a distance to the side.
  struct Rut {
    double at = 0, height = 0;  // m: the last height that is known
    bool is_steep = false;
    double unevenness = 0;  // squares of slopes, summed over the way
    /// `next`: height at the distance `to`, if it is known.
    void follow(double to, std::optional<double> next, double steepest) {
      if (!next) return;
      const double slope = (*next - height) / (to - at);
      is_steep = std::abs(slope) > steepest;
      unevenness += slope * slope * (to - at);
      at = to, height = *next;
    }
  };

  Way way_along(double heading, double wanted, double last, double steepest) const {
    const double c = muro_cos(heading), s = muro_sin(heading);
    const auto height = [&](double along, double across) {
      return grid_.height(along * c - across * s, along * s + across * c);
    };
    std::array<Rut, std::size(aside)> ruts;
    for (std::size_t i = 0; i < ruts.size(); ++i) ruts[i] = {0, height(0, aside[i]).value_or(ground_z)};
    Way way{heading};
    double unevenness = 0;
    for (double at = pace; at <= horizon; at += pace) {
      bool ends = false;
      for (std::size_t i = 0; i < ruts.size(); ++i) {
        ruts[i].follow(at, height(at, aside[i]), steepest);
        ends = ends || ruts[i].is_steep || at - ruts[i].at > longest_gap;
        if (i > 0) ends = ends || std::abs(ruts[i].height - ruts[i - 1].height) > steepest * (aside[i] - aside[i - 1]);
      }
      if (ends) break;
      way.reach = at;
    }
    for (const Rut& rut : ruts) unevenness += rut.unevenness;
    way.score = way.reach / horizon * muro_cos(heading - wanted) - 0.1 * std::abs(wrapped(heading - last)) -
                unevenness / (double(ruts.size()) * std::max(way.reach, pace));
    return way;
  }

  double place_in_team_;  // 0 in the middle
  std::vector<Vector> directions_;
  HeightGrid grid_;
  double last_ = 0;  // rad: heading chosen last, in the world
};

}  // namespace

MURO_CONTROLLER(Cross)
