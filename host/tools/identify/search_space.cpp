// SPDX-License-Identifier: MIT
#include "host/tools/identify/search_space.hpp"

#include "muro/base/elementary.hpp"

namespace muro::host {

namespace {

/// The scale of recorded quantities.
struct Scale {
  double volts = 0;    // the median
  double speed = 0;    // rad/s: the highest speed while the motor drives
  double torque = 0;   // N m: of gravity, or for the recorded motion of the load
  double inertia = 0;  // kg m^2
};

double middle(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Finds the largest speed and acceleration, over pieces of 0.05 s.
void add_motion(const MotorRecord& r, double& speed, double& acceleration) {
  double last_speed = 0;
  bool has_last = false;
  for (std::size_t i = 0, k = 0; k < r.samples.size(); ++k) {
    const double dt = r.samples[k].time - r.samples[i].time;
    if (dt < 0.05) continue;
    const double v = std::abs(r.samples[k].position - r.samples[i].position) / dt;
    if (r.samples[i].torque_enable && r.samples[k].torque_enable) speed = std::max(speed, v);
    if (has_last) acceleration = std::max(acceleration, std::abs(v - last_speed) / dt);
    last_speed = v, has_last = true, i = k;
  }
}

Scale scale_of(const std::vector<MotorRecord>& records) {
  Scale s;
  std::vector<double> volts;
  for (const MotorRecord& r : records) {
    double speed = 0, acceleration = 0;
    add_motion(r, speed, acceleration);
    for (const RecordSample& sample : r.samples) volts.push_back(sample.supply_voltage);
    const double inertia = r.load.moment_of_inertia();
    s.speed = std::max(s.speed, speed);
    s.torque = std::max({s.torque, r.load.gravity_torque(), inertia * acceleration});
    s.inertia = std::max(s.inertia, inertia);
  }
  s.volts = middle(std::move(volts));
  s.speed = std::max(s.speed, 0.1);
  s.torque = std::max(s.torque, 1e-9);
  return s;
}

}  // namespace

std::optional<TemperatureSpan> temperature_span(const std::vector<MotorRecord>& records) {
  std::optional<TemperatureSpan> span;
  for (const MotorRecord& r : records) {
    if (!r.has_temperature) continue;
    for (const RecordSample& s : r.samples) {
      if (!span) span = TemperatureSpan{s.temperature, s.temperature};
      span->low = std::min(span->low, s.temperature), span->high = std::max(span->high, s.temperature);
    }
  }
  return span;
}

SearchSpace::SearchSpace(const std::vector<MotorRecord>& records, const FitSettings& settings) : settings_(settings) {
  const Scale s = scale_of(records);
  double least_p = records.front().p_gain, most_p = least_p;
  for (const MotorRecord& r : records) least_p = std::min(least_p, r.p_gain), most_p = std::max(most_p, r.p_gain);
  const bool stribeck = settings.friction == FrictionKind::m2 || settings.friction == FrictionKind::m4;
  const bool load = settings.friction == FrictionKind::m3 || settings.friction == FrictionKind::m4;
  // The torque at standstill is about the load's or more, the speed without load about the highest recorded or more.
  add("kt", "N m/A", 0.03 * s.volts / s.speed, 3 * s.volts / s.speed, true);
  add("torque_by_voltage", "N m/V", 0.3 * s.torque / s.volts, 100 * s.torque / s.volts, true);
  add("armature", "kg m^2", 1e-3 * s.inertia, 100 * s.inertia, true);
  add("friction", "N m", 0, s.torque, false, true);
  add("viscous_friction", "N m s/rad", 0, 2 * s.torque / s.speed, false, true);
  if (stribeck) {
    if (settings.friction == FrictionKind::m2 || load) add("stribeck_friction", "N m", 0, s.torque, false, true);
    add("stribeck_velocity", "rad/s", 0.01 * s.speed, 3 * s.speed, true);
    add("stribeck_exponent", "1", 0.3, 4, true);
  }
  if (load) add("load_friction", "1", 0, 0.7, false, true);
  if (load && stribeck) add("load_stribeck_friction", "1", 0, 1, false, true);
  add("offset", "rad", -0.15, 0.15, false);
  if (settings.fit_gain) {
    // around the approximate value, or: full duty at an error from 0.003 to 30 rad
    const double low = settings.gain > 0 ? settings.gain / 4 : 1 / (30 * least_p);
    const double high = settings.gain > 0 ? settings.gain * 4 : 1 / (0.003 * most_p);
    add("duty_gain", "1/rad", low, std::max(high, 10 * low), true);
  }
  if (const std::optional<TemperatureSpan> span = temperature_span(records); settings.fit_temperature && span) {
    reference_temperature_ = span->middle();
    temperature_coefficient_ = copper_temperature_coefficient;
    if (span->high - span->low >= least_temperature_span) add("temperature_coefficient", "1/K", 0, 0.1, false, true);
  }
  if (settings.fit_delay) add("delay", "s", 0, 0.05, false, true);
}

void SearchSpace::add(const char* name, const char* unit, double low, double high, bool logarithmic, bool may_be_low) {
  FitParameter p;
  p.name = name, p.unit = unit, p.low = low, p.high = high, p.logarithmic = logarithmic, p.may_be_low = may_be_low;
  parameters_.push_back(std::move(p));
}

double SearchSpace::value(std::size_t i, double x) const {
  const FitParameter& p = parameters_[i];
  if (p.logarithmic) return p.low * elementary::exp(x * elementary::log(p.high / p.low));
  // from 0 on, small values are searched as finely as large ones
  if (p.low == 0) return p.high * x * x;
  return p.low + x * (p.high - p.low);
}

double SearchSpace::coordinate(std::size_t i, double value) const {
  const FitParameter& p = parameters_[i];
  const double v = std::clamp(value, p.low, p.high);
  if (p.logarithmic) return elementary::log(v / p.low) / elementary::log(p.high / p.low);
  if (p.low == 0) return std::sqrt(v / p.high);
  return (v - p.low) / (p.high - p.low);
}

std::vector<double> SearchSpace::coordinates(const std::vector<FitParameter>& others) const {
  std::vector<double> x(size(), 0.5);
  for (std::size_t i = 0; i < size(); ++i)
    for (const FitParameter& other : others)
      if (other.name == parameters_[i].name) x[i] = coordinate(i, other.value);
  return x;
}

MotorEstimate SearchSpace::estimate(const double* x) const {
  MotorEstimate e;
  e.motor.gain = settings_.gain;
  e.motor.duty_limit = settings_.duty_limit;
  e.temperature_coefficient = temperature_coefficient_, e.reference_temperature = reference_temperature_;
  double by_voltage = 1;
  motor::FrictionModel& f = e.motor.friction;
  const std::pair<const char*, double*> targets[] = {{"kt", &e.motor.kt},
                                                     {"torque_by_voltage", &by_voltage},
                                                     {"armature", &e.motor.armature},
                                                     {"friction", &f.coulomb},
                                                     {"viscous_friction", &f.viscous},
                                                     {"stribeck_friction", &f.stribeck},
                                                     {"stribeck_velocity", &f.stribeck_velocity},
                                                     {"stribeck_exponent", &f.stribeck_exponent},
                                                     {"load_friction", &f.load},
                                                     {"load_stribeck_friction", &f.load_stribeck},
                                                     {"offset", &e.offset},
                                                     {"duty_gain", &e.motor.gain},
                                                     {"temperature_coefficient", &e.temperature_coefficient},
                                                     {"delay", &e.delay}};
  std::size_t next = 0;
  for (const auto& [name, to] : targets)
    if (next < parameters_.size() && parameters_[next].name == name) *to = value(next, x[next]), ++next;
  e.motor.resistance = e.motor.kt / by_voltage;
  return e;
}

std::vector<FitParameter> SearchSpace::described(const double* x) const {
  std::vector<FitParameter> all = parameters_;
  constexpr double near = 1e-3;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].value = value(i, x[i]);
    all[i].is_at_low = x[i] < near;
    all[i].is_at_high = x[i] > 1 - near;
  }
  return all;
}

}  // namespace muro::host
