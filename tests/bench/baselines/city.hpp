// SPDX-License-Identifier: MIT
// Scene of the benchmarks, equal for every engine: it depends only on number of vehicles, seed and time.
#pragma once

#include <vector>

#include "muro/geometry.hpp"

namespace muro::bench {

/// The vehicle of examples/models/rover.urdf; the wheels are front left, front right, rear left, rear right.
struct Rover {
  static constexpr double length = 0.35, width = 0.25, height = 0.12;  ///< m, of the chassis
  static constexpr double chassis_mass = 4, wheel_mass = 0.3;          ///< kg
  static constexpr double wheel_radius = 0.06, wheel_width = 0.04;     ///< m
  static constexpr double ride_height = 0.09;                          ///< m, of the chassis' centre
  static constexpr double track = 0.3;                                 ///< m
  static constexpr double max_torque = 0.8;                            ///< N m, of each wheel's drive
  static constexpr double friction = 0.8;                              ///< between wheels and everything
  static constexpr double mass = chassis_mass + 4 * wheel_mass;
  static bool is_left(int wheel) { return wheel % 2 == 0; }
  static Vec3 wheel_centre(int wheel) { return {wheel < 2 ? 0.12 : -0.12, is_left(wheel) ? 0.15 : -0.15, -0.03}; }
  static Inertia chassis();
  static Inertia wheel();  ///< its axis is y
  /// The vehicle as one body, in the frame of the chassis.
  static Inertia composite();
};

/// A building or wall, parallel to the axes.
struct Block {
  Vec3 centre, lengths;  ///< m
};

struct WheelSpeeds {
  double left = 0, right = 0;  ///< rad/s
};

/// Blocks of 10 m, each with a building of 6 x 6 x 5 m, so streets of 4 m; four low walls around; ground at z = 0.
class City {
 public:
  /// Builds a city of ten by ten blocks, or of more if every vehicle needs them to have a quarter of a block.
  explicit City(int vehicles, std::uint64_t seed = 1);
  /// Returns a city as full as that of 1000 vehicles: for each vehicle there are 5.4 to 6 m of streets.
  static City crowded(int vehicles, std::uint64_t seed);
  /// Returns the ground alone with the same vehicles.
  static City open(int vehicles, std::uint64_t seed);

  const std::vector<Block>& blocks() const { return blocks_; }
  /// Poses of the chassis' centres at the start: on two lanes of every street, a metre apart, none on a crossing.
  const std::vector<Pose>& starts() const { return starts_; }
  int vehicles() const { return int(starts_.size()); }

  /// Commands are constant in intervals of this length; a vehicle gets a new one each 1 to 3 s.
  static constexpr int interval = 100;  ///< ms
  bool changes(int vehicle, int index) const;
  WheelSpeeds command(int vehicle, int index) const;

 private:
  City(int vehicles, std::uint64_t seed, int across);
  int period(int vehicle) const;

  std::uint64_t seed_;
  std::vector<Block> blocks_;
  std::vector<Pose> starts_;
};

}  // namespace muro::bench
