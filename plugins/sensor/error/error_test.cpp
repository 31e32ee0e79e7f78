// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

using test::Scene;

constexpr Key<double> battery{"battery.voltage", "V", "of a sensor that is one number"};
constexpr Key<double> measured_battery{"battery.voltage.measured", "V", ""};

/// Robots that carry a scanner each, whose true reading is the same constant.
struct Devices : Scene {
  explicit Devices(const std::vector<std::string>& names, std::uint64_t seed = 1) : Scene(seed) {
    for (const std::string& name : names) {
      const RobotView& robot =
          add(name, test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
      const ObjectId scanner = add_sensor_object(robot, "scanner", robot.base());
      world().set_array(scanner, keys::ranges, std::span<const double>(truth));
      world().set(scanner, keys::laser_min_range, 0.02);
      world().set(scanner, keys::laser_max_range, 5.6);
      world().set(scanner, battery, 12.0);
      items.push_back({&robot, scanner});
    }
    use("motion.point", 10, all_robots());
  }
  std::vector<double> measured(std::size_t i) {
    const auto found = world().values(items[i].object, keys::measured_ranges);
    return {found.begin(), found.end()};
  }
  std::vector<double> truth = std::vector<double>(500, 2.0);
  std::vector<Item> items;
};

std::string message_of(Simulation& simulation) {
  return test::complaint_of([&] { simulation.build(); });
}

TEST(SensorError, WritesWhatTheDeviceReadsBesideTheTrueReading) {
  Devices s({"a"});
  s.use("sensor.error", 10, s.items, {{"bias", 0.25}, {"resolution", 0.1}});
  s.build();
  s.run_for(0.05);
  EXPECT_EQ(s.world().values(s.items[0].object, keys::ranges)[0], 2.0);
  ASSERT_EQ(s.measured(0).size(), 500u);
  for (const double r : s.measured(0)) EXPECT_NEAR(r, 2.3, 1e-12);
}

TEST(SensorError, GivesEveryRobotAndEveryScanNumbersOfItsOwn) {
  Devices s({"a", "b"});
  s.use("sensor.error", 10, s.items, {{"sigma", 0.03}});
  s.build();
  s.run_for(0.05);
  const std::vector<double> a = s.measured(0), b = s.measured(1);
  s.run_for(0.1);
  const std::vector<double> later = s.measured(0);
  double cross = 0, lagged = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    cross += (a[i] - 2) * (b[i] - 2) / 9e-4 / 500;
    lagged += (a[i] - 2) * (later[i] - 2) / 9e-4 / 500;
  }
  EXPECT_NEAR(cross, 0, 5 / std::sqrt(500.0));
  EXPECT_NEAR(lagged, 0, 5 / std::sqrt(500.0));
}

TEST(SensorError, GivesARobotTheSameNumbersWhateverElseIsInTheScene) {
  Devices alone({"a"}), together({"b", "a", "c"}), other_seed({"a"}, 2);
  for (Devices* s : {&alone, &together, &other_seed}) {
    s->use("sensor.error", 10, s->items, {{"sigma", 0.03}, {"correlation", 0.5}, {"dropout", 0.1}});
    s->build();
    s->run_for(0.35);
  }
  EXPECT_EQ(alone.measured(0), together.measured(1));
  EXPECT_NE(alone.measured(0), together.measured(0));
  EXPECT_NE(alone.measured(0), other_seed.measured(0));
}

TEST(SensorError, RepeatsItselfAfterARestoreAndAReset) {
  Devices s({"a"});
  s.use("sensor.error", 10, s.items, {{"sigma", 0.03}});
  s.build();
  s.run_for(0.25);
  const Snapshot middle = s.snapshot();
  s.run_for(0.3);
  const std::vector<double> end = s.measured(0);
  s.restore(middle);
  s.run_for(0.3);
  EXPECT_EQ(s.measured(0), end);
  s.reset();
  s.run_for(0.55);
  EXPECT_EQ(s.measured(0), end);
}

TEST(SensorError, TakesTheLimitsOfTheScannerUnlessGiven) {
  Devices s({"a"});
  s.use("sensor.error", 10, s.items, {{"bias", 100.0}});
  s.build();
  s.run_for(0.05);
  EXPECT_EQ(s.measured(0)[0], 5.6);

  Devices limited({"a"});
  limited.use("sensor.error", 10, limited.items, {{"bias", 100.0}, {"maximum", 50.0}});
  limited.build();
  limited.run_for(0.05);
  EXPECT_EQ(limited.measured(0)[0], 50);
}

TEST(SensorError, WorksOnASingleNumberOfAnyName) {
  Devices s({"a", "b"});
  s.use("sensor.error", 10, s.items, {{"of", std::string("battery.voltage")}, {"bias", -0.5}});
  s.build();
  s.run_for(0.05);
  for (const Item& item : s.items) EXPECT_EQ(s.world().value(item.object, measured_battery), 11.5);
}

TEST(SensorError, NamesWhatThereIsWhenThePropertyIsMissing) {
  Devices s({"a"});
  s.use("sensor.error", 10, s.items, {{"of", std::string("battery.current")}});
  const std::string message = message_of(s);
  EXPECT_NE(message.find("no property `battery.current`"), std::string::npos) << message;
  EXPECT_NE(message.find("battery.voltage"), std::string::npos) << message;
}

TEST(SensorError, RefusesWhatIsNotMadeOfRealNumbers) {
  Devices s({"a"});
  s.use("sensor.error", 10, s.items, {{"of", std::string("pose")}});
  const std::string message = message_of(s);
  EXPECT_NE(message.find("`pose` of `a/scanner` is not made of real numbers"), std::string::npos) << message;
}

TEST(SensorError, RefusesCorrelationOfASingleNumberAndExchangedLimits) {
  Devices single({"a"});
  single.use("sensor.error", 10, single.items, {{"of", std::string("battery.voltage")}, {"correlation", 0.5}});
  EXPECT_NE(message_of(single).find("correlation"), std::string::npos);
  Devices exchanged({"a"});
  exchanged.use("sensor.error", 10, exchanged.items, {{"minimum", 3.0}, {"maximum", 2.0}});
  EXPECT_NE(message_of(exchanged).find("minimum (3.000000) is greater than maximum (2.000000)"), std::string::npos);
}

}  // namespace
}  // namespace muro
