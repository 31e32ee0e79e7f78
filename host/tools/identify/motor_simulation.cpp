// SPDX-License-Identifier: MIT
#include "host/tools/identify/motor_simulation.hpp"

#include <Eigen/Dense>

namespace muro::host {

namespace {

constexpr double gap_factor = 5, shortest_gap = 0.05;  // usual periods; s
constexpr double slope_window = 0.04;                  // s
constexpr double least_slope_rise = 0.006;             // rad: four steps of an encoder of 12 bits

double usual_period(const MotorRecord& r) {
  std::vector<double> periods;
  for (std::size_t i = 1; i < r.samples.size(); ++i) periods.push_back(r.samples[i].time - r.samples[i - 1].time);
  std::nth_element(periods.begin(), periods.begin() + std::ptrdiff_t(periods.size() / 2), periods.end());
  return periods[periods.size() / 2];
}

/// Slope (rad/s) at `first`. It is that of the parabola through the samples of a short time from there to before `end`,
/// or of the line if they are few; 0 when there is no visible motion.
double initial_slope(const MotorRecord& r, std::size_t first, std::size_t end) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double rise = 0;
  std::size_t count = 0;
  for (std::size_t i = first; i < end && r.samples[i].time - r.samples[first].time <= slope_window; ++i, ++count) {
    const double t = (r.samples[i].time - r.samples[first].time) / slope_window;
    rise = r.samples[i].position - r.samples[first].position;
    const Eigen::Vector3d powers(1, t, t * t);
    normal += powers * powers.transpose();
    right += rise * powers;
  }
  constexpr std::size_t fewest_of_parabola = 5;
  if (count < 2 || std::abs(rise) < least_slope_rise) return 0;
  if (count >= fewest_of_parabola) return normal.ldlt().solve(right)[1] / slope_window;
  return normal.topLeftCorner<2, 2>().ldlt().solve(right.head<2>())[1] / slope_window;
}

/// Mean (rad), from sample `i` to the next one, of the goals that reach the servo after `delay` (s). `command`: the
/// sample of its latest goal, at most `i`.
double mean_goal(const MotorRecord& r, std::size_t i, double delay, std::size_t& command) {
  const double from = r.samples[i].time, to = r.samples[i + 1].time;
  const auto comes = [&](std::size_t k) { return r.samples[k].time + delay; };
  while (command < i && comes(command + 1) <= from) ++command;
  double sum = 0, begin = from;
  for (; command < i && comes(command + 1) < to; ++command) {
    sum += (comes(command + 1) - begin) * r.samples[command].goal;
    begin = comes(command + 1);
  }
  return (sum + (to - begin) * r.samples[command].goal) / (to - from);
}

}  // namespace

PreparedRecord prepare(const MotorRecord& r, double longest_step, double delay) {
  PreparedRecord p;
  p.p_gain = r.p_gain;
  p.duty_gain = r.duty_gain, p.duty_limit = r.duty_limit;
  p.has_temperature = r.has_temperature;
  p.load = r.load;
  const double gap = std::max(gap_factor * usual_period(r), shortest_gap);
  std::size_t command = 0;
  for (std::size_t first = 0; first + 1 < r.samples.size();) {
    std::size_t end = first + 1;
    while (end < r.samples.size() && r.samples[end].time - r.samples[end - 1].time <= gap) ++end;
    RecordSegment s;
    s.first = first;
    s.initial_position = r.samples[first].position;
    s.initial_velocity = initial_slope(r, first, end);
    s.intervals.reserve(end - first - 1);
    for (std::size_t i = first; i + 1 < end; ++i) {
      const RecordSample& sample = r.samples[i];
      const double dt = r.samples[i + 1].time - sample.time;
      const auto steps = std::int32_t(std::ceil(dt / longest_step - 1e-9));
      const double goal = delay == 0 ? sample.goal : mean_goal(r, i, delay, command);
      s.intervals.push_back({goal, sample.supply_voltage, dt / steps, steps, sample.torque_enable, sample.temperature,
                             r.samples[i + 1].position});
    }
    p.sample_count += s.intervals.size();
    if (end < r.samples.size()) ++p.gap_count;
    if (!s.intervals.empty()) p.segments.push_back(std::move(s));
    first = end;
  }
  return p;
}

RecordError error_of(const PreparedRecord& record, const MotorEstimate& estimate) {
  RecordError all;
  double squares = 0;
  for (const RecordSegment& s : record.segments)
    simulate(s, record, estimate, [&](double error, const RecordSegment::Interval&) {
      const double size = std::abs(error);
      all.mean += size;
      squares += error * error;
      all.largest = size > all.largest || std::isnan(size) ? size : all.largest;
    });
  const double count = double(std::max<std::size_t>(record.sample_count, 1));
  all.mean /= count;
  all.rms = std::sqrt(squares / count);
  return all;
}

Residuals residuals_of(const PreparedRecord& record, const MotorRecord& times, const MotorEstimate& estimate) {
  Residuals r;
  for (const RecordSegment& s : record.segments) {
    std::size_t sample = s.first;
    simulate(s, record, estimate, [&](double error, const RecordSegment::Interval&) {
      r.times.push_back(times.samples[++sample].time);
      r.errors.push_back(error);
    });
  }
  return r;
}

}  // namespace muro::host
