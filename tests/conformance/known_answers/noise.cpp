// SPDX-License-Identifier: MIT
// sensor.error on sensors of a robot and on constant readings.
#include "tests/conformance/known_answers/answer.hpp"
#include "tests/support/bodies.hpp"

namespace muro::known_answers {

namespace {

using Errors = std::map<std::string, ParameterInput>;

constexpr Key<double> truth{"reading", "1", "array: true values"}, read{"reading.measured", "1", ""};

/// Independent readings of one true value, `size` of them.
struct Readings : test::Scene {
  Readings(std::size_t size, double value, double rate, Errors errors, std::uint64_t seed = 1) : Scene(seed) {
    const RobotView& robot = add("r", test::ball(1, 0.1, 0.5));
    device = add_sensor_object(robot, "device", robot.base());
    const std::vector<double> values(size, value);
    world().set_array(device, truth, std::span<const double>(values));
    use("motion.point", rate, all_robots());
    errors.emplace("of", std::string("reading"));
    use("sensor.error", rate, {{&robot, device}}, errors);
    build();
    period_ = 1 / rate;
    run_for(0.5 * period_);
  }
  std::span<const double> now() { return world().values(device, read); }
  std::vector<double> at_once() { return {now().begin(), now().end()}; }
  void next() { run_for(period_); }
  /// Returns `count` samples of the first reading.
  std::vector<double> series(std::size_t count) {
    std::vector<double> all;
    for (; all.size() < count; next()) all.push_back(now()[0]);
    return all;
  }
  ObjectId device = no_object;

 private:
  double period_ = 0;
};

double mean_product(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum / double(a.size());
}

/// Overlapping Allan variance of clusters of m samples (Riley: Handbook of Frequency Stability Analysis, 5.2.4).
double allan_variance(const std::vector<double>& y, std::size_t m) {
  std::vector<double> sums{0};
  for (const double v : y) sums.push_back(sums.back() + v);
  double sum = 0;
  const std::size_t count = y.size() + 1 - 2 * m;
  for (std::size_t k = 0; k < count; ++k) {
    const double d = (sums[k + 2 * m] - 2 * sums[k + m] + sums[k]) / double(m);
    sum += d * d;
  }
  return sum / (2 * double(count));
}
/// Three standard deviations of the estimate of an Allan deviation, relative to it (IEEE Std 952, annex C).
double allan_tolerance(double samples, double m) { return 3 / std::sqrt(2 * (samples / m - 1)); }

constexpr double density = 1e-3;  ///< N of white noise
constexpr std::size_t samples = 100000;

Found white_deviation() {
  Readings r(samples, 0, 100, {{"noise_density", density}});
  const std::vector<double> y = r.at_once();
  return {std::abs(std::sqrt(mean_product(y, y)) / 0.01 - 1), three_sigma_of_deviation(samples)};
}

Found allan_of_white() {
  const std::size_t count = 50000, m = 100;
  Readings r(1, 0, 100, {{"noise_density", density}});
  return {std::abs(std::sqrt(allan_variance(r.series(count), m)) / density - 1), allan_tolerance(count, m)};
}

Found variance_of_walk(double rate) {
  Readings r(samples, 0, rate, {{"random_walk", 0.02}});
  for (int k = 0; k < int(4 * rate); ++k) r.next();
  const std::vector<double> y = r.at_once();
  return {std::abs(mean_product(y, y) / (0.02 * 0.02 * 4) - 1), three_sigma_of_variance(samples)};
}
Found walk_at_10_hz() { return variance_of_walk(10); }

Found allan_of_walk() {
  const std::size_t count = 50000, m = 100;
  Readings r(1, 0, 100, {{"random_walk", 0.02}});
  return {std::abs(std::sqrt(allan_variance(r.series(count), m)) / (0.02 * std::sqrt(1.0 / 3)) - 1),
          allan_tolerance(count, m)};
}

/// Correlation over 30 s for a GPS part with s 1.5 m and T 60 s.
Found gauss_markov(double rate) {
  constexpr std::size_t devices = 30000;
  Readings r(devices, 0, rate, {{"gauss_markov_sigma", 1.5}, {"gauss_markov_time", 60.0}});
  const std::vector<double> begin = r.at_once();
  for (int k = 0; k < int(30 * rate); ++k) r.next();
  const double s2 = 1.5 * 1.5, expected = std::exp(-30.0 / 60);
  return {std::abs(mean_product(begin, r.at_once()) / s2 - expected),
          3 * std::sqrt((1 + expected * expected) / devices)};
}
Found gauss_markov_at_1_hz() { return gauss_markov(1); }
Found gauss_markov_at_10_hz() { return gauss_markov(10); }

/// Deviation for a given density of the driving noise: s = K sqrt(T / 2).
Found driven_gauss_markov() {
  Readings r(samples, 0, 1, {{"gauss_markov_density", 0.05}, {"gauss_markov_time", 8.0}});
  const std::vector<double> y = r.at_once();
  return {std::abs(std::sqrt(mean_product(y, y)) / (0.05 * 2) - 1), three_sigma_of_deviation(samples)};
}

/// Kurtosis of the bias: 3 for normal numbers, 1.8 for uniform ones; the variance of its estimate is 24 / n.
Found turn_on_bias() {
  Readings r(samples, 0, 10, {{"turn_on_bias_tolerance", 3.0}});
  const std::vector<double> y = r.at_once();
  std::vector<double> squares;
  for (const double v : y) squares.push_back(v * v);
  return {std::abs(mean_product(squares, squares) / std::pow(mean_product(y, y), 2) - 3),
          3 * std::sqrt(24.0 / samples)};
}

Found bias_is_added() {
  Readings r(1, 9.81, 100, {{"bias", 0.3}, {"resolution", 0.0}});
  return {std::abs(r.now()[0] - 10.11), 1e-14};
}

Found saturation() {
  Readings r(1, 5, 100, {{"full_scale", 4.363323}});
  return {std::abs(r.now()[0] - 4.363323), 0};
}

/// Error of a converter of 12 bits from -10 to 10: no reading is off by more than half a step.
Found converter() {
  double worst = 0;
  for (int k = 0; k < 41; ++k) {
    const double value = -9.9 + 0.4876 * k, step = 20.0 / 4096;
    Readings r(1, value, 100, {{"full_scale", 10.0}, {"bits", std::int64_t(12)}});
    worst = std::max(worst, std::abs(r.now()[0] - value) / step);
  }
  return {worst, 0.5 * (1 + 1e-9)};
}

/// Delay of a robot that moves at 1 m/s: its GPS position is 0.03 s late at 100 Hz.
Found delay() {
  test::Scene s;
  const RobotView& robot = s.add("r", test::ball(1, 0.1, 0.5));
  const ObjectId gps = s.add_sensor_object(robot, "gps", robot.base());
  s.use("motion.point", 100, s.all_robots());
  s.use_kinematics();
  s.use("sensor.gps", 100, {{&robot, gps}});
  s.use("sensor.error", 100, {{&robot, gps}}, {{"of", "gps.position"}, {"delay", 0.03}});
  s.build();
  s.world().value(robot.base(), keys::command_twist) = {{1, 0.3, 0}, {0, 0, 0.2}};
  s.run_for(0.005);
  const Key<Vec3> late{"gps.position.measured", "m", ""};
  std::vector<Vec3> truths;
  double worst = 0;
  for (std::size_t k = 0; k < 200; ++k) {
    truths.push_back(s.world().value(gps, keys::gps_position));
    worst = std::max(worst, (s.world().value(gps, late) - truths[k < 3 ? 0 : k - 3]).norm());
    s.run_for(0.01);
  }
  return {truths.back() == truths.front() ? 1 : worst, 0};
}

/// Filter of first order with a ramp of slope 1/s as input, w = 2 pi 3/s: y = t - 1/w + exp(-w t)/w.
Found bandwidth() {
  test::Scene s;
  const RobotView& robot = s.add("r", test::ball(1, 0.1, 0.5), {}, {{1, 0, 0}, {0, 0, 0}});
  const ObjectId gps = s.add_sensor_object(robot, "gps", robot.base());
  s.use("motion.point", 100, s.all_robots(), {{"max_acceleration", 1e9}});
  s.use_kinematics();
  s.use("sensor.gps", 100, {{&robot, gps}});
  s.use("sensor.error", 100, {{&robot, gps}}, {{"of", "gps.position"}, {"bandwidth", 3.0}});
  s.build();
  s.world().value(robot.base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0}};
  s.run_for(0.005);
  const Key<Vec3> filtered{"gps.position.measured", "m", ""};
  const double w = 6 * M_PI;
  double worst = 0;
  for (int k = 0; k < 100; ++k) {
    const double t = s.world().value(gps, keys::gps_position).x();
    worst = std::max(worst, std::abs(s.world().value(gps, filtered).x() - (t - 1 / w + std::exp(-w * t) / w)));
    s.run_for(0.01);
  }
  return {worst, 1e-12};
}

}  // namespace

std::vector<Answer> noise_answers() {
  const std::string_view e = "sensor.error", kalibr = "kalibr, IMU noise model",
                         sampling = "3 deviations of the estimate";
  return {
      {e, "white noise of 1e-3 by sqrt(Hz) at 100 Hz has the deviation 0.01", kalibr, "relative", sampling,
       white_deviation},
      {e, "the Allan deviation of such noise over 1 s is 1e-3", "IEEE Std 952", "relative", sampling, allan_of_white},
      {e, "a random walk of density K has the variance K^2 t", kalibr, "relative", sampling, walk_at_10_hz},
      {e, "the Allan deviation of such a walk over 1 s is K sqrt(1/3)", "IEEE Std 952", "relative", sampling,
       allan_of_walk},
      {e, "a Gauss-Markov bias has the correlation exp(-lag/T) at 1 Hz", "closed form", "of 1", sampling,
       gauss_markov_at_1_hz},
      {e, "a Gauss-Markov bias has the correlation exp(-lag/T) at 10 Hz", "closed form", "of 1", sampling,
       gauss_markov_at_10_hz},
      {e, "a Gauss-Markov bias by its driving density K deviates by K sqrt(T/2)", "closed form", "relative", sampling,
       driven_gauss_markov},
      {e, "turn-on biases are normal numbers, of kurtosis 3", "closed form", "of 3", sampling, turn_on_bias},
      {e, "a bias is added to the reading", "closed form", "as read", "rounding", bias_is_added},
      {e, "a low-pass answers a ramp by t - 1/w + exp(-w t)/w", "closed form", "as read", "rounding", bandwidth},
      {e, "readings saturate exactly at full scale", "closed form", "as read", "none", saturation},
      {e, "a converter of 12 bits is off by half a step at most", "closed form", "steps", "half a step", converter},
      {e, "30 ms late at 100 Hz are the bits of three readings before", "closed form", "m", "none", delay},
  };
}

}  // namespace muro::known_answers
