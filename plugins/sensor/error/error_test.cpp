// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <set>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::Scene;

constexpr Key<double> battery{"battery.voltage", "V", "of a sensor that is one number"};
constexpr Key<double> measured_battery{"battery.voltage.measured", "V", ""};
constexpr Key<Vec3> gyro_key{"angular_velocity", "rad/s", ""}, measured_gyro{"angular_velocity.measured", "rad/s", ""};
constexpr Key<Vec3> force_key{"linear_acceleration", "m/s^2", ""};
constexpr Key<Vec3> measured_force{"linear_acceleration.measured", "m/s^2", ""};
constexpr Key<Wrench> wrench_key{"wrench", "N, N m", ""}, measured_wrench{"wrench.measured", "N, N m", ""};
const Vec3 true_rate(0.1, 0.2, 0.3), true_force(0, 0, 9.81);

/// Robots that each carry a scanner; the true reading of all scanners is the same constant.
struct Devices : Scene {
  explicit Devices(const std::vector<std::string>& names, std::uint64_t seed = 1, bool has_force = true) : Scene(seed) {
    for (const std::string& name : names) {
      const RobotView& robot =
          add(name, test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
      const ObjectId scanner = add_sensor_object(robot, "scanner", robot.base());
      world().set_array(scanner, keys::ranges, std::span<const double>(truth));
      world().set(scanner, keys::laser_min_range, 0.02);
      world().set(scanner, keys::laser_max_range, 5.6);
      world().set(scanner, battery, 12.0);
      world().set(scanner, gyro_key, true_rate);
      if (has_force) world().set(scanner, force_key, true_force);
      world().set(scanner, wrench_key, Wrench{{1, 2, 3}, {4, 5, 6}});
      items.push_back({&robot, scanner});
    }
    use("motion.point", 10, all_robots());
  }
  std::vector<double> measured(std::size_t i) {
    const auto found = world().values(items[i].object, keys::measured_ranges);
    return {found.begin(), found.end()};
  }
  template <class T>
  T& value(const Key<T>& key, std::size_t i = 0) {
    return world().value(items[i].object, key);
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
  s.world().set(s.items[0].object, keys::encoder_count, std::int64_t(7));
  s.use("sensor.error", 10, s.items, {{"of", std::string("encoder.count")}});
  EXPECT_SAYS(message_of(s), "`encoder.count` of `a/scanner` is not made of real numbers");
}

TEST(SensorError, RefusesCorrelationOfASingleNumberAndExchangedLimits) {
  Devices single({"a"});
  single.use("sensor.error", 10, single.items, {{"of", std::string("battery.voltage")}, {"correlation", 0.5}});
  EXPECT_NE(message_of(single).find("correlation"), std::string::npos);
  Devices exchanged({"a"});
  exchanged.use("sensor.error", 10, exchanged.items, {{"minimum", 3.0}, {"maximum", 2.0}});
  EXPECT_NE(message_of(exchanged).find("minimum (3) is greater than maximum (2)"), std::string::npos);
}

using Given = std::map<std::string, ParameterInput>;

/// Settings for every stage that has a memory or draws numbers.
const Given everything{{"of", std::string("angular_velocity")},
                       {"bandwidth", 20.0},
                       {"bandwidth_order", std::int64_t(2)},
                       {"scale_tolerance", 0.03},
                       {"cross_axis_tolerance", 0.02},
                       {"g_sensitivity", 0.01},
                       {"turn_on_bias_tolerance", 0.3},
                       {"random_walk", 0.01},
                       {"gauss_markov_density", 0.1},
                       {"gauss_markov_time", 3.0},
                       {"bias_instability", 0.02},
                       {"flicker_to", 100.0},
                       {"noise_density", 0.001},
                       {"full_scale", 4.0},
                       {"bits", std::int64_t(16)},
                       {"delay", 0.024},
                       {"dropout", 0.2},
                       {"dropout_reads", std::string("hold")}};

TEST(SensorError, WorksOnVectorsAndWrenches) {
  Devices s({"a"});
  s.use("sensor.error", 10, s.items,
        {{"of", std::string("angular_velocity")}, {"bias", std::vector<double>{1, 2, 3}}, {"scale", 1.0}});
  s.use("sensor.error", 10, s.items, {{"of", std::string("wrench")}, {"bias", 0.5}});
  s.build();
  s.run_for(0.05);
  EXPECT_TRUE(s.value(measured_gyro).isApprox(Vec3(1.2, 2.4, 3.6), 1e-14));
  EXPECT_EQ(s.value(measured_wrench).force, Vec3(1.5, 2.5, 3.5));
  EXPECT_EQ(s.value(measured_wrench).torque, Vec3(4.5, 5.5, 6.5));
  EXPECT_EQ(s.value(gyro_key), true_rate) << "the truth stays readable";
}

TEST(SensorError, RepeatsAllStagesAfterARestoreAndAReset) {
  Devices s({"a"});
  s.use("sensor.error", 100, s.items, everything);
  s.build();
  s.run_for(0.005);
  const Vec3 begin = s.value(measured_gyro);
  s.run_for(0.5);
  const Snapshot middle = s.snapshot();
  s.run_for(0.5);
  const Vec3 end = s.value(measured_gyro);
  const std::uint64_t hash = s.state_hash();
  s.restore(middle);
  EXPECT_NE(s.state_hash(), hash);
  s.run_for(0.5);
  EXPECT_EQ(s.value(measured_gyro), end);
  EXPECT_EQ(s.state_hash(), hash);
  s.reset();
  s.run_for(0.005);
  EXPECT_EQ(s.value(measured_gyro), begin);
  s.run_for(1);
  EXPECT_EQ(s.value(measured_gyro), end);
  EXPECT_EQ(s.state_hash(), hash);
}

TEST(SensorError, DependsOnTheSeedFromTheFirstReadingOn) {
  Devices a({"a"}, 1), again({"a"}, 1), other({"a"}, 2);
  for (Devices* s : {&a, &again, &other}) {
    s->use("sensor.error", 100, s->items, {{"of", std::string("angular_velocity")}, {"turn_on_bias_tolerance", 0.3}});
    s->build();
    s->run_for(0.005);
  }
  EXPECT_EQ(a.value(measured_gyro), again.value(measured_gyro));
  EXPECT_NE(a.value(measured_gyro), other.value(measured_gyro));
}

TEST(SensorError, HasTheSameBitsOnAnyNumberOfThreads) {
  std::vector<std::string> names;
  for (int i = 0; i < 40; ++i) names.push_back("r" + std::to_string(i));
  std::set<std::uint64_t> hashes;
  for (const unsigned threads : {1u, 2u, 4u}) {
    Devices s(names);
    s.use("sensor.error", 100, s.items, everything);
    s.use("sensor.error", 100, s.items, {{"sigma", 0.03}, {"correlation", 0.5}, {"delay", 0.02}});
    s.build();
    s.set_threads(threads);
    s.run_for(0.3);
    hashes.insert(s.state_hash());
  }
  EXPECT_EQ(hashes.size(), 1U);
}

TEST(SensorError, DoesNotAllocateInAStep) {
  Devices s({"a", "b"});
  s.use("sensor.error", 100, s.items, everything);
  s.use("sensor.error", 100, s.items, {{"sigma", 0.03}, {"correlation", 0.5}, {"delay", 0.02}, {"random_walk", 0.1}});
  s.build();
  s.run_for(0.1);
  const std::uint64_t before = test::allocations();
  s.run_for(1);
  EXPECT_EQ(test::allocations(), before);
}

TEST(SensorError, HoldsALateReadingAtTheStart) {
  Devices s({"a"});
  s.use("sensor.error", 100, s.items, {{"of", std::string("angular_velocity")}, {"delay", 0.03}});
  s.build();
  s.run_for(0.005);
  EXPECT_EQ(s.value(measured_gyro), true_rate);
}

// --- orientations

const Quat true_orientation = from_rpy(0.4, -0.3, 2);
constexpr Key<Quat> measured_orientation{"orientation.measured", "1", ""};
constexpr Key<Pose> measured_pose{"odometry.pose.measured", "m", ""};

// convention of geometry_msgs/PoseWithCovariance: rotations about the fixed axes x, y, z of the frame of reference
TEST(SensorError, TurnsAnOrientationAboutTheAxesOfItsFrame) {
  Devices s({"a"});
  s.world().set(s.items[0].object, keys::orientation, true_orientation);
  s.use("sensor.error", 10, s.items,
        {{"of", std::string("orientation")}, {"bias", std::vector<double>{0.01, -0.02, 0.3}}});
  s.build();
  s.run_for(0.05);
  const Vec3 off = rotation_vector_of(s.value(measured_orientation) * true_orientation.conjugate());
  EXPECT_TRUE(off.isApprox(Vec3(0.01, -0.02, 0.3), 1e-14)) << off.transpose();
}

TEST(SensorError, DriftsAndShakesAPoseWithDeviationsOfEachAxis) {
  Devices s({"a"});
  const Pose truth{{3, -2, 0}, true_orientation};
  s.world().set(s.items[0].object, keys::odometry_pose, truth);
  s.use("sensor.error", 100, s.items,
        {{"of", std::string("odometry.pose")}, {"sigma", std::vector<double>{0.1, 0.2, 0, 0, 0.01, 0.05}}});
  s.build();
  const int count = 5000;
  double squares[6] = {};
  for (int k = 0; k < count; ++k) {
    s.run_for(0.01);
    const Pose& read = s.value(measured_pose);
    const Vec3 moved = read.position - truth.position;
    const Vec3 turned = rotation_vector_of(read.orientation * truth.orientation.conjugate());
    for (int i = 0; i < 3; ++i) squares[i] += moved[i] * moved[i], squares[i + 3] += turned[i] * turned[i];
    ASSERT_NEAR(read.orientation.norm(), 1, 1e-12);
  }
  const double sigma[] = {0.1, 0.2, 0, 0, 0.01, 0.05};
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(std::sqrt(squares[i] / count), sigma[i], 3 * sigma[i] / std::sqrt(2.0 * count) + 1e-12) << i;
}

TEST(SensorError, DelaysAndHoldsWholeOrientations) {
  Devices s({"a"});
  const RobotView& robot = *s.items[0].robot;
  const ObjectId imu = s.add_sensor_object(robot, "imu", robot.base());
  s.use("sensor.imu", 10, {{&robot, imu}});
  s.use("sensor.error", 10, {{&robot, imu}}, {{"of", std::string("orientation")}, {"delay", 0.3}, {"dropout", 0.3}});
  s.use_kinematics();
  s.build();
  s.world().value(robot.base(), keys::command_twist) = {{0, 0, 0}, {0, 0, 1}};
  std::vector<Quat> truth;
  int held = 0;
  Quat last = Quat::Identity();
  for (std::size_t k = 0; k < 500; ++k) {
    s.run_for(0.1);
    truth.push_back(s.world().value(imu, keys::orientation));
    const Quat read = s.world().value(imu, measured_orientation);
    const bool is_late = read.coeffs() == truth[k < 3 ? 0 : k - 3].coeffs();
    EXPECT_TRUE(is_late || read.coeffs() == last.coeffs()) << k;
    held += !is_late;
    last = read;
  }
  EXPECT_NEAR(held / 500.0, 0.3, 3 * std::sqrt(0.21 / 500));
}

// --- images

// structured light: 1.4 mm at 1 m, growing with the square (Khoshelham and Elberink, Sensors 12, 2012)
TEST(SensorError, ShakesADepthWithTheSquareOfIt) {
  const float nothing = std::numeric_limits<float>::infinity();
  std::vector<float> depth(30000, 1.0F);
  std::fill(depth.begin() + 10000, depth.begin() + 20000, 4.0F);
  std::fill(depth.begin() + 20000, depth.end(), nothing);
  Devices s({"a"});
  s.world().set_array(s.items[0].object, keys::camera_depth, std::span<const float>(depth));
  s.use("sensor.error", 10, s.items,
        {{"of", std::string("camera.depth")}, {"sigma_quadratic", 1.425e-3}, {"bias", 0.01}, {"dropout", 0.02}});
  s.build();
  s.run_for(0.05);
  const auto read = s.world().values(s.items[0].object, Key<float>{"camera.depth.measured", "m", ""});
  ASSERT_EQ(read.size(), depth.size());
  for (const std::size_t begin : {0u, 10000u, 20000u}) {
    double squares = 0, seen = 0;
    for (std::size_t i = begin; i < begin + 10000; ++i)
      if (read[i] > 0) ++seen, squares += std::pow(double(read[i]) - double(depth[i]) - 0.01, 2);
    EXPECT_NEAR(seen / 10000, 0.98, 3 * std::sqrt(0.02 * 0.98 / 10000));
    const double z = double(depth[begin]), sigma = 1.425e-3 * z * z;
    if (std::isfinite(z)) {
      EXPECT_NEAR(std::sqrt(squares / seen), sigma, 3 * sigma / std::sqrt(2 * seen));
    }
  }
  EXPECT_TRUE(std::all_of(read.begin() + 20000, read.end(), [&](float z) { return z == nothing || z == 0; }));
  Devices slow({"a"});
  slow.world().set_array(slow.items[0].object, keys::camera_depth, std::span<const float>(depth));
  slow.use("sensor.error", 10, slow.items, {{"of", std::string("camera.depth")}, {"bandwidth", 5.0}});
  EXPECT_SAYS(message_of(slow), "bandwidth is of what is seen at every instant, but `camera.depth` is an image");
}

// --- satellite navigation

// expected: 100 m to the east and 50 m to the north at 49.87 deg, by the radii of curvature of WGS 84
TEST(SensorError, PutsTheErrorsOfAPositionIntoLatitudeAndLongitude) {
  Devices s({"a"});
  const RobotView& robot = *s.items[0].robot;
  const ObjectId gps = s.add_sensor_object(robot, "gps", robot.base());
  s.use("sensor.gps", 10, {{&robot, gps}}, {{"reference", std::vector<double>{49.87, 8.65, 144}}});
  s.use("sensor.error", 10, {{&robot, gps}},
        {{"of", std::string("gps.position")}, {"bias", std::vector<double>{100, 50, 7}}});
  s.use_kinematics();
  s.build();
  s.run_for(0.05);
  const auto measured = [&](const char* name, const char* unit) {
    return s.world().value(gps, Key<double>{name, unit, ""});
  };
  const double degree = M_PI / 180, a = 6378137, f = 1 / 298.257223563, e2 = f * (2 - f);
  const double root = std::sqrt(1 - e2 * std::pow(std::sin(49.87 * degree), 2));
  const double across = a / root + 144, along = a * (1 - e2) / std::pow(root, 3) + 144;
  EXPECT_NEAR((measured("latitude.measured", "deg") - 49.87) * degree * along, 50, 2e-3);
  EXPECT_NEAR((measured("longitude.measured", "deg") - 8.65) * degree * across * std::cos(49.87 * degree), 100, 2e-3);
  EXPECT_NEAR(measured("altitude.measured", "m"), 151, 2e-3) << "over a ground that is bent by 1 mm";
  EXPECT_EQ(s.world().value(gps, keys::altitude), 144) << "the truth stays readable";
}

// half of the fixes are within 2.5 m, for any drift
TEST(SensorError, HasTheCircularErrorProbableOfAReceiver) {
  int inside = 0;
  const int receivers = 400;
  for (int seed = 1; seed <= receivers; ++seed) {
    Devices s({"a"}, std::uint64_t(seed));
    s.world().set(s.items[0].object, keys::gps_position, Vec3(10, 20, 30));
    s.use("sensor.error", 5, s.items, {{"part", std::string("neo_m8")}});
    s.build();
    s.run_for(0.1);
    const Vec3 off = s.value(Key<Vec3>{"gps.position.measured", "m", ""}) - Vec3(10, 20, 30);
    inside += std::sqrt(off.x() * off.x() + off.y() * off.y()) < 2.5;
  }
  EXPECT_NEAR(inside / double(receivers), 0.5, 3 * 0.5 / std::sqrt(receivers));
}

// --- parts

TEST(SensorError, ServesAllReadingsThatAPartKnows) {
  Devices s({"a"});
  s.use("sensor.error", 200, s.items, {{"part", std::string("mpu6050")}});
  s.build();
  s.run_for(0.002);
  const double lsb = 250 * M_PI / 180 / 32768, lsb_force = 2 * 9.80665 / 32768;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.value(measured_gyro)[i] / lsb, std::round(s.value(measured_gyro)[i] / lsb), 0.01);
    EXPECT_NE(s.value(measured_gyro)[i], true_rate[i]);
    EXPECT_NEAR(s.value(measured_force)[i] / lsb_force, std::round(s.value(measured_force)[i] / lsb_force), 1e-6);
    EXPECT_NE(s.value(measured_force)[i], true_force[i]);
  }
}

TEST(SensorError, LetsTheScenarioBeatThePart) {
  Devices s({"a"});
  Given quiet{{"part", std::string("mpu6050")}, {"of", std::string("angular_velocity")}, {"bias", 0.5}};
  for (const char* name : {"noise_density", "turn_on_bias_tolerance", "scale_tolerance", "cross_axis_tolerance",
                           "g_sensitivity", "resolution"})
    quiet[name] = 0.0;
  s.use("sensor.error", 200, s.items, quiet);
  s.build();
  s.run_for(0.002);
  EXPECT_TRUE(s.value(measured_gyro).isApprox(true_rate + Vec3::Constant(0.5), 1e-14));
  EXPECT_EQ(s.world().store().find(s.items[0].object, "linear_acceleration.measured"), nullptr) << "`of` chose";
}

TEST(SensorError, LeavesOutTheGSensitivityOfAPartWithoutAForce) {
  Devices s({"a"}, 1, false);
  s.use("sensor.error", 200, s.items, {{"part", std::string("mpu6050")}});
  s.build();
  s.run_for(0.002);
  EXPECT_NE(s.value(measured_gyro), true_rate);

  Devices given({"a"}, 1, false);
  given.use("sensor.error", 200, given.items, {{"of", std::string("angular_velocity")}, {"g_sensitivity", 0.1}});
  EXPECT_SAYS(message_of(given), "no `linear_acceleration` for the g-sensitivity");
}

TEST(SensorError, AddsTheSpecificForceOfItsObject) {
  Devices s({"a"});
  s.use("sensor.error", 200, s.items, {{"of", std::string("angular_velocity")}, {"g_sensitivity", 0.01}});
  s.build();
  s.run_for(0.002);
  EXPECT_TRUE(s.value(measured_gyro).isApprox(Vec3(0.1, 0.2, 0.3981), 1e-14));
}

TEST(SensorError, ReadsAPartOfTheUser) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("mine.yaml", "gyro:\n  reading: angular_velocity\n  bias: [1, 2, 3]\n");
  Devices s({"a"});
  s.use("sensor.error", 200, s.items, {{"part", file}});
  s.build();
  s.run_for(0.002);
  EXPECT_EQ(s.value(measured_gyro), Vec3(1.1, 2.2, 3.3));

  folder.file("mine.yaml", "gyro:\n  reading: angular_velocity\n  bias: [1, 2]\n");
  Devices wrong({"a"});
  wrong.use("sensor.error", 200, wrong.items, {{"part", file}});
  EXPECT_SAYS(message_of(wrong), file +
                                     ":3:9: bias has 2 numbers, but `angular_velocity` has 3 components; give one "
                                     "number or 3");
}

TEST(SensorError, CountsTheStepsOfAnEncoderOrOfSeveral) {
  Devices s({"a"});
  const std::vector<double> joints{0.1, -0.2, 3.0};
  s.world().set_array(s.items[0].object, keys::encoder_position, std::span<const double>(joints));
  s.use("sensor.error", 200, s.items, {{"part", std::string("as5045")}});
  s.build();
  s.run_for(0.002);
  const Key<double> measured{"encoder.position.measured", keys::encoder_position.unit, ""};
  const auto read = s.world().values(s.items[0].object, measured);
  ASSERT_EQ(read.size(), 3U);
  const double step = 2 * M_PI / 4096;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(read[i], step * std::round(joints[i] / step));
}

// Gazebo's dynamic bias is ambiguous: gauss_markov_sigma is its stationary deviation, gauss_markov_density drives it
TEST(SensorError, TakesADriftingBiasByItsDeviationOrByItsDrivingDensity) {
  Devices by_sigma({"a"}), by_density({"a"});
  const double density = 0.05, time = 8;
  const auto run = [&](Devices& s, const char* name, double value) {
    s.use("sensor.error", 100, s.items,
          {{"of", std::string("angular_velocity")}, {name, value}, {"gauss_markov_time", time}});
    s.build();
    s.run_for(3);
    return s.value(measured_gyro);
  };
  const Vec3 a = run(by_sigma, "gauss_markov_sigma", density * std::sqrt(time / 2));
  EXPECT_EQ(a, run(by_density, "gauss_markov_density", density));
  EXPECT_NE(a, true_rate);
}

TEST(SensorError, TellsOfPartsThatDoNotFit) {
  const auto said = [](const Given& parameters) {
    Devices s({"a"});
    s.use("sensor.error", 200, s.items, parameters);
    return message_of(s);
  };
  EXPECT_SAYS(said({{"part", std::string("mpu6000")}}),
              "there is no part `mpu6000` (did you mean `mpu6050`?); ready "
              "are `adis16448`, `as5045`, `mpu6050`, `mti1`, `neo_m8`, and a file");
  EXPECT_SAYS(said({{"part", std::string("as5045")}}),
              "has none of the readings of the part (`encoder.position`); it has");
  EXPECT_SAYS(said({{"part", std::string("mti1")}, {"of", std::string("wrench")}}),
              "has no errors of `wrench`; it has those of `angular_velocity`, `linear_acceleration`");
}

TEST(SensorError, TellsOfErrorsThatDoNotFitTheReading) {
  const auto said = [](const char* of, const Given& more, double rate = 100) {
    Devices s({"a"});
    Given parameters = more;
    parameters["of"] = std::string(of);
    s.use("sensor.error", rate, s.items, parameters);
    return message_of(s);
  };
  EXPECT_SAYS(said("wrench", {{"g_sensitivity", 1.0}}), "g_sensitivity is of a vector, but `wrench` is a value of 6");
  EXPECT_SAYS(said("ranges", {{"bias", std::vector<double>{1, 2, 3}}}), "bias has 3 numbers, but `ranges` is an array");
  EXPECT_SAYS(said("pose", {{"scale", 0.1}}), "scale is of numbers alone, but `pose` is a pose; remove it");
  EXPECT_SAYS(said("pose", {{"sigma", std::vector<double>{1, 2, 3}}}), "sigma has 3 numbers, but `pose` has 6");
  EXPECT_SAYS(said("pose", {{"dropout", 0.1}, {"dropout_value", 0.0}}), "dropout_value is of numbers alone");
  EXPECT_SAYS(said("angular_velocity", {{"misalignment", 0.1}}), "misalignment has 1 number but must have six");
  EXPECT_SAYS(said("angular_velocity", {{"gauss_markov_sigma", 0.1}}), "gauss_markov_sigma needs the correlation time");
  EXPECT_SAYS(said("angular_velocity", {{"gauss_markov_sigma", 0.1}, {"gauss_markov_density", 0.1}}),
              "gauss_markov_sigma and gauss_markov_density say the same in two ways");
  EXPECT_SAYS(said("angular_velocity", {{"bits", std::int64_t(12)}}), "give full_scale too");
  EXPECT_SAYS(said("angular_velocity", {{"flicker_from", 5.0}, {"flicker_to", 1.0}}), "is greater than flicker_to");
  EXPECT_SAYS(said("angular_velocity", {{"delay", 1e5}}, 1000), "keeps more than 10 million numbers");
}

}  // namespace
}  // namespace muro
