// SPDX-License-Identifier: MIT
// radio.log_distance: powers, ranges, losses, times and queues of messages between robots.
#include <random>

#include "muro/vocabulary/radio.hpp"
#include "tests/conformance/known_answers/answer.hpp"
#include "tests/support/bodies.hpp"

namespace muro::known_answers {

namespace {

using radio::Counters, radio::Header;
using Settings = std::map<std::string, ParameterInput>;

constexpr double light = 299792458;  ///< m/s

/// Balls of 0.1 m with a radio in the middle, 1000 steps a second.
struct Radios : test::Scene {
  explicit Radios(std::uint64_t seed = 1) : Scene(seed) {}

  void place(const Vec3& at) {
    const RobotView& robot = add("r" + std::to_string(radios.size()), test::ball(1, 0.1, 0.5), {at, Quat::Identity()});
    radios.push_back({&robot, add_sensor_object(robot, "radio", robot.base())});
  }
  void start(const Settings& settings) {
    use("radio.log_distance", 1000, radios, settings);
    complete();
  }
  void complete() {
    use("motion.point", 10, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    build();
    run_for(0.0005);
  }
  void send(std::size_t i, std::uint32_t size) {
    const ObjectId o = radios[i].object;
    world().value(o, keys::radio_send_size) = size;
    world().value(o, keys::radio_send_receiver) = radio::broadcast;
    ++world().value(o, keys::radio_send_number);
    run_for(0.001);
  }
  const Counters& counters(std::size_t i) { return world().value(radios[i].object, keys::radio_counters); }
  const Header& last(std::size_t i) { return world().value(radios[i].object, keys::radio_last); }

  std::vector<Item> radios;
};

/// Returns the received power at `distance` (m), dBm.
double power_at(double distance, Settings settings) {
  Radios s;
  s.place({0, 0, 0});
  s.place({distance, 0, 0});
  settings["bit_rate"] = 1e9;
  s.start(settings);
  s.send(0, 1);
  s.run_for(0.002);
  return s.counters(1).received == 1 ? s.last(1).rssi : -std::numeric_limits<double>::infinity();
}

Found friis() {
  const double loss = power_at(1, {{"frequency", 2.4e9}, {"tx_power", 0.0}});
  const double at_5 = power_at(1, {{"frequency", 5.15e9}, {"tx_power", 0.0}});
  return {std::max(std::abs(loss + 40.05), std::abs(at_5 + 46.68)), 0.005};
}

/// Returns the largest distance that a message reaches, m; found by bisection.
double range_of(const Settings& settings) {
  double near = 1, far = 2000;
  while (far - near > 1e-3) {
    const double middle = 0.5 * (near + far);
    (std::isfinite(power_at(middle, settings)) ? near : far) = middle;
  }
  return near;
}
Found range_of_wifi() {
  const double seen = range_of({{"tx_power", 16.0206},
                                {"sensitivity", -101.0},
                                {"reference_loss", 46.6777},
                                {"exponent", 3.0},
                                {"max_range", 1e4}});
  return {std::abs(seen - 221.19), 0.01};
}
Found range_of_zigbee() {
  const double seen = range_of(
      {{"tx_power", 0.0}, {"sensitivity", -85.0}, {"frequency", 2.44e9}, {"exponent", 3.0}, {"max_range", 1e4}});
  return {std::abs(seen - 31.2), 0.05};
}

Settings settings_of_rfcomms() {
  return {{"tx_power", 27.0}, {"reference_loss", 40.0}, {"exponent", 2.5}, {"sensitivity", -90.0}, {"max_range", 1e4}};
}
Found power_of_rfcomms() { return {std::abs(power_at(50, settings_of_rfcomms()) + 55.5), 0.05}; }
Found range_of_rfcomms() { return {std::abs(range_of(settings_of_rfcomms()) - 1202), 0.5}; }

/// Losses at half, once and twice the range without shadowing; n 2.5, s 10 dB. The worst, in units of three deviations.
Found shadowing() {
  const double range = std::pow(10, (0 - 40 + 85) / 25.0), messages = 3000, expected[] = {0.774, 0.5, 0.226};
  Radios s(3);
  s.place({0, 0, 0});
  for (const double factor : {0.5, 1.0, 2.0}) s.place({factor * range, factor, 0});
  s.start({{"reference_loss", 40.0},
           {"exponent", 2.5},
           {"shadowing_sigma", 10.0},
           {"shadowing", "message"},
           {"obstacles", "ignore"},
           {"bit_rate", 1e9}});
  for (int k = 0; k < int(messages); ++k) s.send(0, 1);
  s.run_for(0.002);
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    worst = std::max(worst, std::abs(double(s.counters(i + 1).received) / messages - expected[i]) /
                                three_sigma_of_ratio(expected[i], messages));
  return {worst, 1};
}

/// Losses of 100 bytes at 6, 8 and 10 dB: 1 - (1 - 0.5 erfc(sqrt(snr)))^800. The worst, in units of three deviations.
Found packet_errors() {
  Radios s;
  for (int i = 0; i < 4; ++i) s.place({0.25 * i, 0, 0});
  const Settings channel = {{"reference_loss", 40.0}, {"overhead", 0.0},       {"bit_rate", 1e9},
                            {"modulation", "qpsk"},   {"obstacles", "ignore"}, {"tx_power", 0.0}};
  s.use("radio.log_distance", 1000, {s.radios[0]}, channel);
  for (int i = 0; i < 3; ++i) {
    Settings own = channel;
    own["noise_floor"] = -46.0 - 2 * i;
    s.use("radio.log_distance", 1000, {s.radios[std::size_t(i) + 1]}, own);
  }
  s.complete();
  const double messages = 4000, lost[] = {0.852, 0.1416, 0.0031};
  for (int k = 0; k < int(messages); ++k) s.send(0, 100);
  s.run_for(0.002);
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i)
    worst = std::max(worst, std::abs(double(s.counters(i + 1).lost_error) / messages - lost[i]) /
                                three_sigma_of_ratio(lost[i], messages));
  return {worst, 1};
}

/// Time for 127 + 6 bytes at 250 kbit/s over 10 m.
Found time_on_air() {
  Radios s;
  s.place({0, 0, 0});
  s.place({10, 0, 0});
  s.start({});
  s.send(0, 127);
  s.run_for(0.01);
  return {std::abs(s.last(1).received - s.last(1).sent - 4.256e-3 - 10 / light), 1e-15};
}

/// Waiting time in a queue of one server with fixed service time, load 0.5: u / (2 (1 - u)) services. 1/20 less, since
/// messages come at whole steps of a twentieth of a service.
Found queue() {
  Radios s;
  s.place({0, 0, 0});
  s.place({1, 0, 0});
  s.start({{"bit_rate", 8000.0}, {"overhead", 0.0}, {"queue", std::int64_t(1000)}, {"keep", 0.0}});
  std::mt19937 engine(11);
  std::bernoulli_distribution comes(0.5 / 20);
  double waited = 0;
  int count = 0;
  for (std::int64_t number = 0; count < 4000;) {
    if (comes(engine))
      s.send(0, 20);
    else
      s.run_for(0.001);
    if (const Header& h = s.last(1); std::int64_t(h.number) != number)
      number = std::int64_t(h.number), waited += h.received - h.sent - 0.020, ++count;
  }
  return {std::abs(waited / count / 0.020 - 0.95 * 0.5), 0.05};
}

/// Sends twice as much as 100 kbit/s can carry for a second. The error is in bit/s above the capacity, or 0.
Found capacity() {
  Radios s;
  s.place({0, 0, 0});
  s.place({1, 0, 0});
  s.start({{"bit_rate", 100e3}, {"overhead", 0.0}, {"queue", std::int64_t(5)}});
  for (int k = 0; k < 1000; ++k) s.send(0, 25);
  const double carried = double(s.counters(1).received) * 25 * 8;
  return {carried < 99e3 ? 1 : std::max(0.0, carried - 100e3), 0};
}

/// Messages that pass through a wall, and messages that do not leave the sender's own body.
Found walls() {
  Radios s;
  s.place({0, 0, 1});
  s.place({2, 0, 1});
  s.place({0, 2, 1});
  const Shape wall = Shape::box({0.1, 1, 1});
  s.world().add_scenery("wall", {{1, 0, 1}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
  s.start({{"obstacles", "block"}});
  s.send(0, 10);
  s.run_for(0.01);
  return {double(s.counters(1).received) + double(1 - s.counters(2).received), 0};
}

/// Losses depend only on seed, sender, receiver and message: a third robot changes nothing.
Found losses_repeat() {
  const auto received = [](bool third) {
    Radios s(5);
    s.place({0, 0, 0});
    s.place({60, 0, 0});
    if (third) s.place({0, 30, 0});
    s.start({{"reference_loss", 40.0}, {"exponent", 2.5}, {"shadowing_sigma", 10.0}, {"bit_rate", 1e9}});
    std::vector<std::uint64_t> counts;
    for (int k = 0; k < 300; ++k) s.send(0, 10), counts.push_back(s.counters(1).received);
    return counts;
  };
  return {received(true) == received(false) && received(true).back() > 0 ? 0.0 : 1.0, 0};
}

/// Largest difference between the power from a to b and from b to a, among walls.
Found reciprocity() {
  constexpr int robots = 12;
  double worst = 0;
  for (int a = 0; a < robots; ++a)
    for (int b = 0; b < a; ++b) {
      Radios s;
      const int pair[] = {a, b};
      for (const int i : pair) s.place({3.7 * std::cos(1.3 * i), 3.1 * std::sin(2.1 * i), 0.01 * i});
      for (int i = 0; i < 3; ++i) {
        const Shape wall = Shape::box({0.2, 2, 2});
        s.world().add_scenery("wall" + std::to_string(i), {{1.5 * i - 1.4, 0.3 * i, 0}, Quat::Identity()},
                              std::span<const Shape>(&wall, 1));
      }
      s.start({{"bit_rate", 1e9}, {"tx_power", 20.0}});
      s.send(0, 1), s.send(1, 1);
      s.run_for(0.002);
      if (s.counters(0).received + s.counters(1).received != 2) return {std::numeric_limits<double>::infinity(), 0};
      worst = std::max(worst, std::abs(s.last(0).rssi - s.last(1).rssi));
    }
  return {worst, 0};
}

}  // namespace

std::vector<Answer> radio_answers() {
  const std::string_view r = "radio.log_distance", three = "1 is 3 deviations";
  return {
      {r, "over 1 m 40.05 dB are lost at 2.4 GHz, 46.68 dB at 5.15 GHz", "Friis", "dB", "digits of the source", friis},
      {r, "wifi with n 3 reaches 221.19 m", "ns-3", "m", "digits of the source", range_of_wifi},
      {r, "Zigbee with n 3 and a sensitivity of -85 dBm reaches 31.2 m", "data sheets", "m", "digits of the source",
       range_of_zigbee},
      {r, "RFComms with n 2.5 and 27 dBm is received with -55.5 dBm at 50 m", "gz-sim", "dB", "digits of the source",
       power_of_rfcomms},
      {r, "RFComms with a noise of -90 dBm has a ratio of 0 dB at 1202 m", "gz-sim", "m", "digits of the source",
       range_of_rfcomms},
      {r, "at half, once and twice the range shadowing lets 0.774, 0.5 and 0.226 through", "closed form", "of 1", three,
       shadowing},
      {r, "QPSK at 6, 8 and 10 dB loses 0.852, 0.1416 and 0.0031 of 100 bytes", "Proakis, 5.2", "of 1", three,
       packet_errors},
      {r, "127 bytes are 4.256 ms on the air, and then on their way", "IEEE 802.15.4", "s", "rounding", time_on_air},
      {r, "a load u waits u/(2 (1 - u)) services in the queue", "Pollaczek and Khinchin", "services", "10 %", queue},
      {r, "no more is carried than the bit rate", "closed form", "bit/s", "none", capacity},
      {r, "a wall stops messages, the own body does not", "geometry", "messages", "none", walls},
      {r, "which messages are lost does not depend on other robots", "bits of two runs", "1", "none", losses_repeat},
      {r, "power from one radio to another is that of the way back, walls or not", "reciprocity", "dB", "none",
       reciprocity},
  };
}

}  // namespace muro::known_answers
