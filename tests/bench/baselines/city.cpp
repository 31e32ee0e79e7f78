// SPDX-License-Identifier: MIT
#include "tests/bench/baselines/city.hpp"

#include <algorithm>
#include <cmath>

#include "muro/base/random.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::bench {

namespace {

constexpr double pitch = 10;      // m between the middles of neighbouring blocks
constexpr double lane = 0.8;      // m from the middle of a street to the middle of a lane
constexpr double crossing = 2.9;  // m from the middle of a crossing, kept free

Pose start_pose(double x, double y, double heading) { return {{x, y, Rover::ride_height}, from_rpy(0, 0, heading)}; }

}  // namespace

Inertia Rover::chassis() {
  constexpr double xx = length * length, yy = width * width, zz = height * height, k = chassis_mass / 12;
  return {.mass = chassis_mass, .ixx = k * (yy + zz), .iyy = k * (xx + zz), .izz = k * (xx + yy)};
}

Inertia Rover::wheel() {
  constexpr double rr = wheel_radius * wheel_radius, ww = wheel_width * wheel_width, k = wheel_mass / 12;
  return {.mass = wheel_mass, .ixx = k * (3 * rr + ww), .iyy = k * 6 * rr, .izz = k * (3 * rr + ww)};
}

Inertia Rover::composite() {
  Inertia whole = chassis();
  for (int w = 0; w < 4; ++w) whole = whole + wheel().in({wheel_centre(w), Quat::Identity()});
  return whole;
}

City::City(int vehicles, std::uint64_t seed)
    : City(vehicles, seed, std::max(10, int(std::ceil(std::sqrt(vehicles / 4.0))))) {}

City::City(int vehicles, std::uint64_t seed, int across) : seed_(seed) {
  const double half = 0.5 * pitch * across, wall = half + 2.2;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      blocks_.push_back({{(i + 0.5) * pitch - half, (j + 0.5) * pitch - half, 2.5}, {6, 6, 5}});
  for (const double side : {-wall, wall}) {
    blocks_.push_back({{side, 0, 0.5}, {0.4, 2 * wall + 0.4, 1}});
    blocks_.push_back({{0, side, 0.5}, {2 * wall + 0.4, 0.4, 1}});
  }

  std::vector<Pose> places;
  for (int street = 0; street <= across; ++street)
    for (int metre = 1; metre < int(pitch) * across; ++metre) {
      const double from_crossing = std::fmod(metre, pitch), along = metre - half, middle = street * pitch - half;
      if (from_crossing < crossing || from_crossing > pitch - crossing) continue;
      places.push_back(start_pose(along, middle - lane, 0));
      places.push_back(start_pose(along, middle + lane, M_PI));
      places.push_back(start_pose(middle - lane, along, -M_PI / 2));
      places.push_back(start_pose(middle + lane, along, M_PI / 2));
    }
  const Random random(seed, fnv1a("places"), 0);
  for (int v = 0; v < vehicles; ++v) {  // the first `vehicles` places of a random order
    const std::size_t rest = places.size() - std::size_t(v);
    std::swap(places[std::size_t(v)],
              places[std::size_t(v) + std::size_t(random.uniform(std::uint32_t(v)) * double(rest))]);
    starts_.push_back(places[std::size_t(v)]);
  }
}

City City::crowded(int vehicles, std::uint64_t seed) {
  const auto streets = [](int across) { return 2 * pitch * across * (across + 1); };
  int across = 1;
  while (streets(across) < 5.4 * vehicles) ++across;
  return City(vehicles, seed, across);
}

City City::open(int vehicles, std::uint64_t seed) {
  City city(vehicles, seed);
  city.blocks_.clear();
  return city;
}

int City::period(int vehicle) const {
  return 10 + int(20 * Random(seed_, fnv1a("period"), std::uint64_t(vehicle)).uniform(0));
}

bool City::changes(int vehicle, int index) const { return index % period(vehicle) == 0; }

WheelSpeeds City::command(int vehicle, int index) const {
  const Random random(seed_, std::uint64_t(vehicle), std::uint64_t(index / period(vehicle)));
  const double speed = random.uniform(0) < 0.75 ? 0.4 + 0.6 * random.uniform(1) : -0.8 + 0.5 * random.uniform(1);
  const double turn = -1 + 2 * random.uniform(2);
  return {(speed - 0.5 * Rover::track * turn) / Rover::wheel_radius,
          (speed + 0.5 * Rover::track * turn) / Rover::wheel_radius};
}

}  // namespace muro::bench
