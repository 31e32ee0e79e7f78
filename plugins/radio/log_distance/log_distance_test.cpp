// SPDX-License-Identifier: MIT
// Messages between robots. Each sender has a medium of its own.
#include <random>

#include "radio_testing.hpp"

namespace muro::log_distance {
namespace {

constexpr double light = 299792458;  // m/s

TEST(Radio, CarriesBytesWithTimesAndPower) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {10, 0, 0});
  s.place("c", {40, 0, 0});
  s.start(1000, {{"keep", 1.0}});
  s.run_for(0.0005);
  s.send(0, "hello", -1, 127);
  s.run_for(0.010);
  ASSERT_EQ(s.received(1).size(), 1u);
  const Header h = s.received(1)[0];
  EXPECT_EQ(h.from, 0);
  EXPECT_EQ(h.number, 1);
  EXPECT_EQ(h.size, 127);
  EXPECT_EQ(h.sent, 0.001);
  EXPECT_NEAR(h.received, 0.001 + 4.256e-3 + 10 / light, 1e-15) << "(127 + 6) bytes at 250 kbit/s";
  EXPECT_NEAR(h.rssi, -20 * std::log10(4 * M_PI * 2.44e9 / light) - 30, 1e-9);
  EXPECT_EQ(s.text(1, h).substr(0, 6), std::string("hello\0", 6));
  EXPECT_EQ(s.world().value(s.radios[1].object, keys::radio_last).number, 1);
  EXPECT_EQ(s.world().value(s.radios[1].object, keys::radio_last_bytes).bytes[4], 'o');
  EXPECT_TRUE(s.received(0).empty()) << "nobody hears himself";
  EXPECT_TRUE(s.received(2).empty()) << "out of range, which is 31.2 m";
  EXPECT_EQ(s.counters(0).sent, 1u);
}

TEST(Radio, ComesWhenItsLastBitHasComeAndStaysForAStep) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {15, 0, 0});
  s.start(1000,
          {{"propagation_speed", 1500.0}, {"frequency", 25e3}, {"bit_rate", 1e4}, {"overhead", 0.0}});  // in water
  s.run_for(0.0005);
  s.send(0, "ping", -1, 5);  // 4 ms, and 10 ms on the way
  for (int ms = 1; ms < 20; ++ms) {
    s.run_for(0.001);
    EXPECT_EQ(s.received(1).size(), ms == 15 ? 1u : 0u) << ms;
  }
}

TEST(Radio, ReachesWhomItIsAddressedToAlone) {
  Radios s;
  for (int i = 0; i < 4; ++i) s.place("r" + std::to_string(i), {double(i), 0, 0});
  s.start(1000, {{"keep", 1.0}, {"obstacles", "ignore"}});
  s.run_for(0.0005);
  s.send(0, "to 2", 2);
  s.send(3, "to all");
  s.run_for(0.01);
  EXPECT_EQ(s.received(0).size(), 1u);
  EXPECT_EQ(s.received(1).size(), 1u);
  ASSERT_EQ(s.received(2).size(), 2u);
  EXPECT_EQ(s.text(2, s.received(2)[0]), "to 2");
  EXPECT_EQ(s.text(2, s.received(2)[1]), "to all");
}

TEST(Radio, IsHeardWithTheProbabilityThatShadowingLeaves) {
  const double range = std::pow(10, (0 - 40 + 85) / 25.0);
  for (const char* shadowing : {"message", "link"}) {
    Radios s(3);
    const bool by_link = std::string(shadowing) == "link";
    s.place("sender", {0, 0, 0});
    std::vector<int> of[3];
    for (int i = 0; i < (by_link ? 1500 : 3); ++i) {
      const double factor = std::pow(2, i % 3 - 1), angle = 0.7 * i;
      of[i % 3].push_back(i + 1);
      s.place("r" + std::to_string(i), {factor * range * std::cos(angle), factor * range * std::sin(angle), 0});
    }
    const int messages = by_link ? 1 : 3000;
    s.start(1000, {{"reference_loss", 40.0},
                   {"exponent", 2.5},
                   {"shadowing_sigma", 10.0},
                   {"shadowing", shadowing},
                   {"obstacles", "ignore"},
                   {"bit_rate", 1e9}});
    for (int k = 0; k < messages; ++k) {
      s.send(0, "x");
      s.run_for(0.001);
    }
    s.run_for(0.002);
    const double expected[] = {0.774, 0.5, 0.226};
    for (int k = 0; k < 3; ++k) {
      std::uint64_t count = 0, lost = 0;
      for (const int i : of[k])
        count += s.counters(std::size_t(i)).received, lost += s.counters(std::size_t(i)).lost_signal;
      EXPECT_EQ(count + lost, messages * of[k].size());
      expect_ratio(count, messages * of[k].size(), expected[k], shadowing + std::to_string(k));
    }
  }
}

TEST(Radio, LosesPacketsToNoiseAsTheFormulaSays) {
  Radios s;
  s.place("sender", {0, 0, 0});
  for (int i = 0; i < 3; ++i) s.place("r" + std::to_string(i), {0, i - 1.0 + (i == 1 ? 1 : 0), i == 1 ? 0.0 : 0.0});
  const Settings channel = {
      {"reference_loss", 40.0}, {"overhead", 0.0}, {"bit_rate", 1e9}, {"modulation", "qpsk"}, {"obstacles", "ignore"}};
  s.use("radio.log_distance", 1000, {s.radios[0]}, channel);
  for (int i = 0; i < 3; ++i) {
    Settings own = channel;
    own["noise_floor"] = -46.0 - 2 * i;  // 6, 8, 10 dB below the signal
    s.use("radio.log_distance", 1000, {s.radios[std::size_t(i) + 1]}, own);
  }
  s.complete();
  const std::uint64_t messages = 4000;
  for (std::uint64_t k = 0; k < messages; ++k) {
    s.send(0, "x", -1, 100);
    s.run_for(0.001);
  }
  s.run_for(0.002);
  const double lost[] = {0.852, 0.1416, 0.0031};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(s.counters(i + 1).received + s.counters(i + 1).lost_error, messages);
    expect_ratio(s.counters(i + 1).lost_error, messages, lost[i], std::to_string(i));
  }
}

/// Returns the mean wait, in units of a message, of messages of 20 steps at random instants with this load.
double mean_wait(double load, int messages) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {1, 0, 0});
  s.start(1000, {{"bit_rate", 8000.0}, {"overhead", 0.0}, {"queue", std::int64_t(1000)}, {"obstacles", "ignore"}});
  std::mt19937 engine(11);
  std::bernoulli_distribution comes(load / 20);
  double waited = 0;
  int count = 0;
  while (count < messages) {
    if (comes(engine)) s.send(0, "x", -1, 20);  // 20 ms
    s.run_for(0.001);
    for (const Header& h : s.received(1)) waited += h.received - h.sent - 0.020, ++count;
  }
  return waited / count / 0.020;
}

TEST(Radio, QueuesAsOneServerWithOneServiceTimeDoes) {
  // u / (2 (1 - u)), less one part in 20, since arrivals come at whole steps
  EXPECT_NEAR(mean_wait(0.5, 4000), 0.95 * 0.5, 0.05);
  EXPECT_NEAR(mean_wait(0.8, 8000), 0.95 * 2, 0.3);
}

TEST(Radio, NeverCarriesMoreThanItsBitRateAndCountsTheRest) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {1, 0, 0});
  s.start(1000, {{"bit_rate", 100e3}, {"overhead", 0.0}, {"queue", std::int64_t(5)}});
  for (int k = 0; k < 1000; ++k) {
    s.send(0, "x", -1, 25);  // 2 ms, each ms
    s.run_for(0.001);
  }
  const std::uint64_t received = s.counters(1).received;
  EXPECT_LE(received * 25 * 8, 100000u);
  EXPECT_GE(received, 497u);
  EXPECT_EQ(s.counters(0).sent + s.counters(0).lost_queue + 6, 1000u) << "one is on the air, five wait";
}

TEST(Radio, IsCutByWallsAndOtherRobotsNotByItsOwnBody) {
  const auto powers = [](const char* obstacles) {
    Radios s;
    s.add_ground();
    s.place("a", {0, 0, 0});
    s.place("behind_two_walls", {5, 0, 0});
    s.place("free", {0, 5, 0});
    s.place("behind_free", {0, 9, 0});
    s.wall("wall", Shape::box({0.1, 2, 2}), {2, 0, 1});
    s.wall("other_wall", Shape::box({0.1, 2, 2}), {3, 0, 1});
    s.start(1000, {{"obstacles", obstacles}, {"keep", 1.0}});
    s.send(0, "x");
    s.run_for(0.01);
    std::vector<double> rssi;
    for (std::size_t i = 1; i < 4; ++i) rssi.push_back(s.received(i).empty() ? 0 : s.received(i)[0].rssi);
    return rssi;
  };
  const std::vector<double> through = powers("ignore"), weaker = powers("loss"), cut = powers("block");
  EXPECT_NEAR(weaker[0], through[0] - 2 * 6.9, 1e-9);
  EXPECT_EQ(weaker[1], through[1]);
  EXPECT_NEAR(weaker[2], through[2] - 6.9, 1e-9);
  EXPECT_EQ(cut[0], 0);
  EXPECT_EQ(cut[1], through[1]);
  EXPECT_EQ(cut[2], 0);
}

/// Has a hundred robots between walls send, all at once or one after the other. Returns the power by receiver and
/// sender, 0 when nothing was received.
std::vector<std::vector<double>> powers_among_walls(bool all_at_once) {
  constexpr std::size_t robots = 100;
  Radios s;
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> at(-15, 15), height(0, 1);
  for (std::size_t i = 0; i < robots; ++i)
    s.place("r" + std::to_string(i), {at(engine), at(engine), 0.2 * height(engine)});
  for (int i = 0; i < 40; ++i)
    s.wall("wall" + std::to_string(i), Shape::box({1 + 4 * height(engine), 0.2, 2}), {at(engine), at(engine), 0.5});
  s.wall("roof", Shape::box({4, 4, 0.1}), {0, 0, 0.5});
  s.start(100, {{"keep", 100.0}, {"tx_power", 10.0}});
  for (std::size_t i = 0; i < robots; ++i) {
    s.send(i, "x");
    if (!all_at_once) s.run_for(0.01);
  }
  s.run_for(0.02);
  std::vector<std::vector<double>> powers(robots, std::vector<double>(robots));
  for (std::size_t i = 0; i < robots; ++i)
    for (const Header& h : s.received(i)) powers[i][std::size_t(h.from)] = h.rssi;
  return powers;
}

TEST(Radio, HasExactlyEqualPowerInBothDirections) {
  const std::vector<std::vector<double>> together = powers_among_walls(true);
  int links = 0, weakened = 0;
  for (std::size_t i = 0; i < together.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_EQ(together[i][k], together[k][i]) << i << " " << k;
      links += together[i][k] != 0;
      weakened += together[i][k] == 0;
    }
  EXPECT_GT(links, 1000);
  EXPECT_GT(weakened, 100) << "walls and robots are in the way";
  EXPECT_EQ(powers_among_walls(false), together) << "it does not matter who else sends";
}

TEST(Radio, JoinsRobotsOfOneWorldWhateverTheirParameters) {
  Radios s;
  for (int i = 0; i < 3; ++i) s.place("r" + std::to_string(i), {double(i), 0, 0});
  s.use("radio.log_distance", 100, {s.radios[0]}, {{"tx_power", 10.0}});
  s.use("radio.log_distance", 100, {s.radios[1]}, {{"tx_power", -10.0}, {"queue", std::int64_t(2)}});
  s.use("radio.log_distance", 50, {s.radios[2]}, {{"world", "other"}, {"exponent", 2.0}});
  s.complete();
  for (std::size_t i = 0; i < 3; ++i) s.send(i, "x");
  s.run_for(0.1);
  EXPECT_EQ(s.counters(0).received, 1u);
  EXPECT_EQ(s.counters(1).received, 1u);
  EXPECT_EQ(s.counters(2).received, 0u);
  EXPECT_NEAR(s.world().value(s.radios[1].object, keys::radio_last).rssi -
                  s.world().value(s.radios[0].object, keys::radio_last).rssi,
              20, 1e-12);
}

TEST(Radio, TellsWhatDoesNotFitTogether) {
  const auto complaint = [](Settings a, Settings b) {
    Radios s;
    s.place("a", {0, 0, 0});
    s.place("b", {1, 0, 0});
    s.use("radio.log_distance", 100, {s.radios[0]}, std::move(a));
    s.use("radio.log_distance", 100, {s.radios[1]}, std::move(b));
    return test::complaint_of([&] { s.complete(); });
  };
  EXPECT_SAYS(complaint({}, {{"exponent", 2.0}}),
              "robot `b`, cannot be connected: `exponent` is 2, but 3 for the radio of `a`, which is of the same "
              "channel; give both the same, or another `world` to one of them");
  EXPECT_SAYS(complaint({}, {{"reference_loss", 40.0}}), "`reference_loss` is 40, but 40.1956 for the radio of `a`");
  EXPECT_EQ(complaint({}, {{"exponent", 3.0}}), "no complaint") << "the default, given";
  EXPECT_SAYS(complaint({{"medium", "shared"}}, {}), "`medium` is `separate`, but `shared` for the radio of `a`");
  EXPECT_SAYS(complaint({{"min_exponent", std::int64_t(6)}}, {}), "min_exponent (6) is above max_exponent (5)");
}

TEST(Radio, WarnsOfParametersThatDoNothing) {
  const auto warnings = [](const Settings& settings) {
    Radios s;
    s.place("a", {0, 0, 0});
    s.place("b", {1, 0, 0});
    std::string all;
    s.set_log([&](LogLevel, std::string_view line) { all += std::string(line) + "\n"; });
    s.start(100, settings);
    return all;
  };
  EXPECT_SAYS(warnings({{"carrier_sense", -70.0}}), "robot `a`: `carrier_sense` has no effect with `medium: separate`");
  EXPECT_SAYS(warnings({{"noise_bandwidth", 2e6}}), "`noise_bandwidth` has no effect with `modulation: none`");
  EXPECT_SAYS(warnings({{"shadowing", "link"}}), "`shadowing` has no effect with `shadowing_sigma: 0`");
  EXPECT_SAYS(warnings({{"sensitivity", 10.0}}),
              "no radio of this channel hears another, however near: the strongest `tx_power` is received with at most "
              "-40.1956 dBm, which is below each `sensitivity`");
  EXPECT_EQ(warnings({{"medium", "shared"}, {"carrier_sense", -70.0}, {"capture", 3.0}, {"tx_power", 3.0}}), "");
}

TEST(Radio, CountsWhatItsControlCodeWritesTooFast) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {1, 0, 0});
  s.start(100, {{"keep", 1.0}});
  s.run_for(0.005);
  s.send(0, "1");
  s.run_for(0.01);
  for (const char* text : {"2", "3", "4"}) s.send(0, text);
  s.run_for(0.02);
  EXPECT_EQ(s.counters(0).lost_overrun, 2u);
  ASSERT_EQ(s.received(1).size(), 2u);
  EXPECT_EQ(s.received(1)[1].number, 4) << "numbers are those of the control code";
  EXPECT_EQ(s.text(1, s.received(1)[1]), "4");
}

TEST(Radio, TakesAnyNumberAndRefusesMessagesThatAreTooLong) {
  Radios s;
  s.place("a", {0, 0, 0});
  s.place("b", {1, 0, 0});
  s.start(100, {{"keep", 10.0}});
  std::int64_t& number = s.world().value(s.radios[0].object, keys::radio_send_number);
  for (const std::int64_t n : {std::int64_t(5), std::int64_t(-7), INT64_MAX, INT64_MIN, std::int64_t(1)}) {
    s.world().value(s.radios[0].object, keys::radio_send_size) = 1;
    number = n;
    s.run_for(0.01);
  }
  s.run_for(0.05);
  std::vector<double> numbers;
  for (const Header& h : s.received(1)) numbers.push_back(h.number);
  EXPECT_EQ(numbers, (std::vector<double>{5, 6, 7, 8, 9})) << "always counted up";
  s.send(0, "x", -1, 65536);
  EXPECT_SAYS(test::complaint_of<StepError>([&] { s.run_for(0.1); }),
              "radio.send.size is 65536; a message has at most 65535 bytes");
}

TEST(Radio, LosesTheSameMessagesWhoeverElseIsThere) {
  const auto heard = [](int others) {
    Radios s(5);
    for (int i = 0; i < others; ++i) s.place("other" + std::to_string(i), {1.0 * i, 3, 0});
    s.place("a", {0, 0, 0});
    s.place("b", {35, 0, 0});
    s.start(1000, {{"shadowing_sigma", 8.0},
                   {"modulation", "qpsk"},
                   {"noise_floor", -90.0},
                   {"bit_rate", 1e8},
                   {"obstacles", "ignore"}});
    std::vector<double> numbers;
    for (int k = 0; k < 200; ++k) {
      for (std::size_t i = 0; i < s.radios.size(); ++i) s.send(i, "x", -1, 50);
      s.run_for(0.001);
      for (const Header& h : s.received(s.radios.size() - 1))
        if (h.from == others) numbers.push_back(h.number);
    }
    return numbers;
  };
  const std::vector<double> alone = heard(0);
  EXPECT_GT(alone.size(), 20u);
  EXPECT_LT(alone.size(), 180u);
  EXPECT_EQ(heard(7), alone);
}

}  // namespace
}  // namespace muro::log_distance
