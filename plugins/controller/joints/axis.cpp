// SPDX-License-Identifier: MIT
#include "axis.hpp"

#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/fault.hpp"
#include "plugins/controller/common/wire_protocol/number_text.hpp"

namespace muro::joints {

namespace {

using wire::Fault;
using wire::FaultCode;

constexpr Quantity quantities[] = {Quantity::position, Quantity::velocity, Quantity::acceleration, Quantity::effort};

constexpr std::size_t index_of(Quantity q) { return std::size_t(q); }

}  // namespace

void Axis::set_reading(Quantity q, const double* place, std::string_view unit) {
  readings_[index_of(q)] = {place, unit};
}

void Axis::set_base_velocity(const Pose* pose, const Twist* twist, std::uint32_t component, std::string_view unit) {
  base_pose_ = pose;
  base_twist_ = twist;
  component_ = component;
  readings_[index_of(Quantity::velocity)] = {nullptr, unit};
}

void Axis::set_target(Quantity q, const Target& target) { targets_[index_of(q)] = target; }

Quantity Axis::standard_reading() const {
  for (const Quantity q : quantities)
    if (!readings_[index_of(q)].unit.empty()) return q;
  return Quantity::standard;
}

Quantity Axis::standard_target() const {
  for (const Quantity q : quantities)
    if (targets_[index_of(q)].place) return q;
  return Quantity::standard;
}

bool Axis::is_idle() const {
  return standard_reading() == Quantity::standard && standard_target() == Quantity::standard;
}

std::string_view Axis::unit_of_reading(Quantity q) const { return readings_[index_of(q)].unit; }

double Axis::base_velocity() const {
  const Quat to_base = base_pose_->orientation.conjugate();
  return component_ < 3 ? (to_base * base_twist_->linear)[component_]
                        : (to_base * base_twist_->angular)[component_ - 3];
}

double Axis::read(Quantity q) const {
  if (q == Quantity::setpoint) {
    const Quantity by = state_.set_by != 0 ? Quantity(state_.set_by) : standard_target();
    if (const double* const place = targets_[index_of(by)].place) return *place;
    throw Fault{FaultCode::not_available, quote(name_) + " takes no setpoint"};
  }
  const Reading& reading = readings_[index_of(q == Quantity::standard ? standard_reading() : q)];
  if (reading.place) return *reading.place;
  if (!reading.unit.empty()) return base_velocity();
  throw Fault{FaultCode::not_available,
              quote(name_).append(" has no ").append(q == Quantity::standard ? "reading" : wire::name_of(q))};
}

void Axis::check(Quantity q, double value) const {
  const Quantity by = q == Quantity::standard ? standard_target() : q;
  const Target& t = targets_[index_of(by)];
  if (!t.place)
    throw Fault{FaultCode::not_available,
                quote(name_).append(" takes no ").append(q == Quantity::standard ? "setpoint" : wire::name_of(q))};
  if (value >= t.lower && value <= t.upper) return;
  std::string text = quote(name_) + ": ";
  wire::add_number(text, value);
  text.append(" is no ").append(wire::name_of(by)).append(" that it takes; allowed is ");
  wire::add_number(text, t.lower);
  text += " to ";
  wire::add_number(text, t.upper);
  throw Fault{FaultCode::out_of_range, text.append(1, ' ').append(t.unit)};
}

void Axis::set(Quantity q, double value, wire::Origin origin) {
  const Quantity by = q == Quantity::standard ? standard_target() : q;
  *targets_[index_of(by)].place = value;
  state_ = {origin.time, origin.client, std::uint32_t(by)};
}

void Axis::stop() {
  for (const Quantity q : quantities) {
    double* const place = targets_[index_of(q)].place;
    if (!place) continue;
    const double* const position = readings_[index_of(q)].place;
    *place = q == Quantity::position && position ? *position : 0;
  }
  state_ = {};
}

}  // namespace muro::joints
