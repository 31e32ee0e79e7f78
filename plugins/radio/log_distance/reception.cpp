// SPDX-License-Identifier: MIT
#include "reception.hpp"

#include <algorithm>

#include "delivery.hpp"

namespace muro::log_distance {

namespace {

/// Draw that decides whether the bits of a message are right.
constexpr std::uint32_t error_draw = 3;

enum class Outcome : std::uint8_t { received, weak, wrong, disturbed };

/// A frame that may be heard.
struct Heard {
  const CompleteFrame* complete;
  double squared_distance;  ///< m^2, squared distance to its sender
};

/// A transmission of another radio that may disturb receptions here.
struct Nearby {
  Transmission transmission;
  double squared_distance;  ///< m^2, squared distance to its sender
  double power = -1;        ///< mW, received power; below 0: not known yet
};

bool overlap(const Transmission& t, const Frame& f) { return t.start < f.end && t.end > f.start; }

bool disturbs(const Nearby& n, const Heard& h) {
  return n.transmission.radio != h.complete->radio && overlap(n.transmission, *h.complete->frame);
}

/// Another transmission that overlaps with a received one.
struct Disturbance {
  double from, until;  ///< s
  double power;        ///< mW
};

/// Reception of one radio in a step. A thread uses one object for one receiver after another.
class Reception {
 public:
  void take_up(const Surroundings& s, std::uint32_t number);
  void listen();

 private:
  void find_nearby();
  void look_around();
  std::uint32_t obstacles_to(std::uint32_t radio, std::uint32_t most);
  Outcome outcome(const Heard& h, double& rssi);
  double power_of(Nearby& n);
  bool is_sending_during(const Frame& f) const;
  bool is_drowned(const Heard& h, double signal);
  void find_disturbances(const Heard& h);
  double all_right(const Radio& sender, const Frame& f, double signal, std::span<const Disturbance> others) const;
  Incoming incoming_of(const Heard& h, double rssi) const;
  void count(Outcome outcome) const;

  const Surroundings* s_ = nullptr;
  std::uint32_t number_ = 0;  ///< number of the receiver
  const Radio* r_ = nullptr;
  std::vector<Heard> heard_;
  std::vector<Nearby> nearby_;
  std::vector<Transmission> own_;
  std::vector<Disturbance> disturbances_;
  std::vector<Incoming> incoming_;
  bool has_looked_ = false;
  line_of_sight::Fan fan_;
};

void Reception::take_up(const Surroundings& s, std::uint32_t number) {
  s_ = &s, number_ = number, r_ = &s.radios[number];
  has_looked_ = false;
  heard_.clear(), nearby_.clear(), own_.clear(), incoming_.clear();
  heard_.reserve(s.complete.size()), incoming_.reserve(s.complete.size());
  nearby_.reserve(s.medium.transmission_capacity()), disturbances_.reserve(s.medium.transmission_capacity());
}

void Reception::listen() {
  s_->hash.each_within(s_->places[number_], s_->hearing, [&](std::uint32_t i, double squared) {
    const CompleteFrame& c = s_->complete[i];
    const bool is_for_us = c.receiver == radio::broadcast || c.receiver == std::int64_t(index_of(r_->robot));
    if (c.radio != number_ && is_for_us) heard_.push_back({&c, squared});
  });
  if (s_->channel.is_shared && !heard_.empty()) find_nearby();
  for (const Heard& h : heard_) {
    double rssi = 0;
    const Outcome o = outcome(h, rssi);
    if (o == Outcome::received)
      incoming_.push_back(incoming_of(h, rssi));
    else
      count(o);
  }
  deliver(*r_, incoming_, s_->now);
}

/// Finds the transmissions that are on the air at the same time as one of the frames.
void Reception::find_nearby() {
  double first = heard_[0].complete->frame->start, last = heard_[0].complete->frame->end;
  for (const Heard& h : heard_)
    first = std::min(first, h.complete->frame->start), last = std::max(last, h.complete->frame->end);
  s_->medium.each_within(s_->places[number_], s_->disturbing, [&](std::uint32_t i, double squared) {
    const Transmission& t = s_->medium[i];
    if (t.start >= last || t.end <= first) return;
    if (t.radio == number_)
      own_.push_back(t);
    else
      nearby_.push_back({t, squared});
  });
}

void Reception::look_around() {
  double squared = 0;
  for (const Heard& h : heard_) squared = std::max(squared, h.squared_distance);
  for (const Nearby& n : nearby_) squared = std::max(squared, n.squared_distance);
  s_->channel.sight->look_around(s_->places[number_], r_->robot, std::sqrt(squared), heard_.size() + nearby_.size(),
                                 fan_);
  has_looked_ = true;
}

std::uint32_t Reception::obstacles_to(std::uint32_t radio, std::uint32_t most) {
  if (!has_looked_) look_around();
  return s_->channel.sight->obstacles(fan_, s_->places[radio], s_->radios[radio].robot, most);
}

double Reception::power_of(Nearby& n) {
  if (n.power >= 0) return n.power;
  const Transmission& t = n.transmission;
  const auto power = s_->channel.received_power(s_->seed, s_->radios[t.radio], s_->places[t.radio], *r_,
                                                s_->places[number_], t.number, r_->parameters.noise_floor - below_noise,
                                                [&](std::uint32_t most) { return obstacles_to(t.radio, most); });
  return n.power = power ? from_decibels(*power) : 0;
}

bool Reception::is_sending_during(const Frame& f) const {
  return std::any_of(own_.begin(), own_.end(), [&](const Transmission& t) { return overlap(t, f); });
}

/// Without a modulation: returns whether one of the other transmissions alone is too strong. Checks senders that are
/// not much farther away than the frame's sender first, since they are the likeliest.
bool Reception::is_drowned(const Heard& h, double signal) {
  const double bearable =
      from_decibels(signal - s_->channel.capture) * (1 + 1e-9);  // slightly more: `all_right` decides
  const double near = 4 * h.squared_distance;
  const auto drowns = [&](bool nearer) {
    return std::any_of(nearby_.begin(), nearby_.end(), [&](Nearby& n) {
      return (n.squared_distance <= near) == nearer && disturbs(n, h) && power_of(n) > bearable;
    });
  };
  return drowns(true) || drowns(false);
}

void Reception::find_disturbances(const Heard& h) {
  disturbances_.clear();
  for (Nearby& n : nearby_) {
    if (disturbs(n, h) && power_of(n) > 0) disturbances_.push_back({n.transmission.start, n.transmission.end, n.power});
  }
}

/// Returns the probability that all bits are right. All bits between two instants at which a transmission begins or
/// ends have one probability.
double Reception::all_right(const Radio& sender, const Frame& f, double signal,
                            std::span<const Disturbance> others) const {
  const Channel& c = s_->channel;
  const double bit_rate = sender.parameters.bit_rate, noise = from_decibels(r_->parameters.noise_floor);
  const double bandwidth_per_bit = c.noise_bandwidth > 0 ? c.noise_bandwidth / bit_rate : 1;
  const double power = from_decibels(signal);
  double probability = 1, from = f.start;
  while (from < f.end) {
    double until = f.end, disturbance = 0;
    for (const Disturbance& d : others) {
      if (d.from > from) until = std::min(until, d.from);
      if (d.until > from) until = std::min(until, d.until);
      if (d.from <= from && d.until > from) disturbance += d.power;
    }
    const double ratio = power / (noise + disturbance);
    if (c.modulation != Modulation::none)
      probability *=
          log_distance::all_right(bit_error(c.modulation, ratio, bandwidth_per_bit), (until - from) * bit_rate);
    else if (disturbance > 0 && ratio < from_decibels(c.capture))
      return 0;
    from = until;
  }
  return probability;
}

Outcome Reception::outcome(const Heard& h, double& rssi) {
  const Channel& c = s_->channel;
  const Frame& f = *h.complete->frame;
  const std::uint32_t sender = h.complete->radio;
  const Radio& a = s_->radios[sender];
  const auto power =
      c.received_power(s_->seed, a, s_->places[sender], *r_, s_->places[number_], f.number, r_->parameters.sensitivity,
                       [&](std::uint32_t most) { return obstacles_to(sender, most); });
  if (!power) return Outcome::weak;
  rssi = *power;
  if (c.is_shared && is_sending_during(f)) return Outcome::disturbed;
  if (c.modulation == Modulation::none && !nearby_.empty() && is_drowned(h, rssi)) return Outcome::disturbed;
  find_disturbances(h);
  if (c.modulation == Modulation::none && disturbances_.empty()) return Outcome::received;
  const double draw = c.random(s_->seed, a, *r_, f.number).uniform(error_draw);
  if (draw < all_right(a, f, rssi, disturbances_)) return Outcome::received;
  const bool by_noise = disturbances_.empty() || draw >= all_right(a, f, rssi, {});
  return by_noise ? Outcome::wrong : Outcome::disturbed;
}

Incoming Reception::incoming_of(const Heard& h, double rssi) const {
  const Frame& f = *h.complete->frame;
  const double distance = std::sqrt(h.squared_distance);
  return {f.end + distance / s_->channel.speed,
          f.handed_over,
          rssi,
          f.number,
          std::int32_t(index_of(s_->radios[h.complete->radio].robot)),
          f.size,
          &f.payload};
}

void Reception::count(Outcome outcome) const {
  radio::Counters& counters = *r_->counters;
  if (outcome == Outcome::weak) ++counters.lost_signal;
  if (outcome == Outcome::wrong) ++counters.lost_error;
  if (outcome == Outcome::disturbed) ++counters.lost_collision;
}

}  // namespace

void receive(const Surroundings& s, std::uint32_t number) {
  thread_local Reception reception;
  reception.take_up(s, number);
  reception.listen();
}

}  // namespace muro::log_distance
