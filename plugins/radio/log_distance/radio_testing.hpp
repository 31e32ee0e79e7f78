// SPDX-License-Identifier: MIT
// Robots with radios, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "muro/vocabulary/radio.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro::log_distance {

using Settings = std::map<std::string, ParameterInput>;
using radio::Counters, radio::Header;

/// Robots as balls of 0.1 m, each with a radio in its middle. All have the same settings unless some are given.
struct Radios : test::Scene {
  explicit Radios(std::uint64_t seed = 1) : Scene(seed) {}

  const RobotView& place(const std::string& name, const Vec3& at) {
    const RobotView& robot = add(name, test::ball(1, 0.1, 0.5), {at, Quat::Identity()});
    radios.push_back({&robot, add_sensor_object(robot, "radio", robot.base())});
    return robot;
  }
  void wall(const std::string& name, const Shape& shape, const Vec3& at) {
    world().add_scenery(name, {at, Quat::Identity()}, std::span<const Shape>(&shape, 1));
  }
  void start(double rate, Settings settings = {}) {
    for (const Item& item : radios) use("radio.log_distance", rate, {item}, settings);
    complete();
  }
  void complete() {
    use("motion.point", 10, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    build();
  }
  /// Writes a message as control code of a radio does.
  void send(std::size_t i, const std::string& text, std::int64_t receiver = -1, std::uint32_t size = 0) {
    const ObjectId o = radios[i].object;
    radio::Payload& payload = world().value(o, keys::radio_send_bytes);
    payload = {};
    std::copy(text.begin(), text.end(), payload.bytes);
    world().value(o, keys::radio_send_size) = size > 0 ? size : std::uint32_t(text.size());
    world().value(o, keys::radio_send_receiver) = receiver;
    ++world().value(o, keys::radio_send_number);
  }
  std::span<const Header> received(std::size_t i) { return world().values(radios[i].object, keys::radio_received); }
  std::string text(std::size_t i, const Header& h) {
    const auto bytes = world().values(radios[i].object, keys::radio_received_bytes);
    const auto carried = std::min<std::size_t>(std::size_t(h.size), radio::max_bytes);
    return std::string(bytes.begin() + std::ptrdiff_t(h.first),
                       bytes.begin() + std::ptrdiff_t(h.first) + std::ptrdiff_t(carried));
  }
  const Counters& counters(std::size_t i) { return world().value(radios[i].object, keys::radio_counters); }

  std::vector<Item> radios;
};

/// Expects a value within three standard deviations of a binomial distribution.
inline void expect_ratio(std::uint64_t count, std::uint64_t of, double probability, const std::string& what = "") {
  EXPECT_NEAR(double(count) / double(of), probability, 3 * std::sqrt(probability * (1 - probability) / double(of)))
      << what;
}

}  // namespace muro::log_distance
