// SPDX-License-Identifier: MIT
#include "reception.hpp"

#include <algorithm>

namespace muro::log_distance {

namespace {

/// Draw that decides whether the bits of a message are right.
constexpr std::uint32_t error_draw = 3;

/// Another transmission that overlaps with one that is received.
struct Disturbance {
  double from, until;  ///< s
  double power;        ///< mW
};

enum class Outcome : std::uint8_t { received, weak, wrong, disturbed };

struct Reception {
  const Surroundings& s;
  std::uint32_t number;  ///< of the receiver
  const Radio& r;
  std::span<double> powers;  ///< mW, of each transmission of the medium here; below 0: not known yet

  Outcome outcome(std::uint32_t sender, const Frame& f, double& rssi) const;
  /// Fills in what overlaps with the frame; returns whether the receiver itself was sending.
  bool find_disturbances(std::uint32_t sender, const Frame& f, std::vector<Disturbance>& found) const;
  double power_of(const Transmission& t) const;
  /// The probability that all bits are right.
  double all_right(const Radio& sender, const Frame& f, double signal, std::span<const Disturbance> others) const;
};

bool Reception::find_disturbances(std::uint32_t sender, const Frame& f, std::vector<Disturbance>& found) const {
  bool is_sending = false;
  s.medium.each_overlapping(f.start, f.end, [&](const Transmission& t, std::size_t i) {
    if (t.radio == number) is_sending = true;
    if (t.radio == number || t.radio == sender) return;
    double& power = powers[i];
    if (power < 0) power = power_of(t);
    if (power > 0) found.push_back({t.start, t.end, power});
  });
  return is_sending;
}

double Reception::power_of(const Transmission& t) const {
  if ((s.places[t.radio] - s.places[number]).squaredNorm() > s.disturbing * s.disturbing) return 0;
  const double least = r.parameters.noise_floor - below_noise;
  const auto power =
      s.channel.received_power(s.seed, s.radios[t.radio], s.places[t.radio], r, s.places[number], t.number, least);
  return power ? from_decibels(*power) : 0;
}

/// Between two instants at which something begins or ends, the bits have one probability.
double Reception::all_right(const Radio& sender, const Frame& f, double signal,
                            std::span<const Disturbance> others) const {
  const Channel& c = s.channel;
  const double bit_rate = sender.parameters.bit_rate, noise = from_decibels(r.parameters.noise_floor);
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

Outcome Reception::outcome(std::uint32_t sender, const Frame& f, double& rssi) const {
  const Channel& c = s.channel;
  const Radio& a = s.radios[sender];
  const auto power =
      c.received_power(s.seed, a, s.places[sender], r, s.places[number], f.number, r.parameters.sensitivity);
  if (!power) return Outcome::weak;
  rssi = *power;
  thread_local std::vector<Disturbance> others;
  others.clear();
  others.reserve(256);
  if (c.is_shared && find_disturbances(sender, f, others)) return Outcome::disturbed;
  if (c.modulation == Modulation::none && others.empty()) return Outcome::received;
  const double draw = c.random(s.seed, a, r, f.number).uniform(error_draw);
  if (draw < all_right(a, f, rssi, others)) return Outcome::received;
  const bool by_noise = others.empty() || draw >= all_right(a, f, rssi, {});
  return by_noise ? Outcome::wrong : Outcome::disturbed;
}

Arrival arrival_of(const Surroundings& s, std::uint32_t sender, std::uint32_t receiver, const Frame& f, double rssi) {
  const double distance = (s.places[sender] - s.places[receiver]).norm();
  Arrival a;
  a.sent = f.handed_over;
  a.received = f.end + distance / s.channel.speed;
  a.rssi = rssi;
  a.number = f.number;
  a.from = s.radios[sender].robot;
  a.size = f.size;
  a.payload = f.payload;
  return a;
}

void deliver(const Radio& r, const Arrival& a) {
  const std::uint32_t carried = std::min(a.size, radio::max_bytes);
  const radio::Header header{
      double(a.from), double(a.number), a.sent, a.received, a.rssi, double(a.size), double((*r.received_bytes).size())};
  r.received.push_back(header);
  for (std::uint32_t i = 0; i < carried; ++i) r.received_bytes.push_back(a.payload.bytes[i]);
  *r.last = header;
  *r.last_bytes = a.payload;
  ++r.counters->received;
}

/// Moves what has come by now from the way to the lists, in the order of its coming.
void deliver_what_has_come(const Radio& r, double now) {
  const std::span<Arrival> all = *r.arriving;
  if (all.empty()) return;
  thread_local std::vector<std::uint32_t> order;
  order.reserve(256);
  order.resize(all.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t k) {
    const Arrival &a = all[i], &b = all[k];
    return a.received != b.received ? a.received < b.received
           : a.from != b.from       ? a.from < b.from
                                    : a.number < b.number;
  });
  for (const std::uint32_t i : order)
    if (all[i].received <= now) deliver(r, all[i]);
  r.arriving.clear();
  for (const Arrival& a : all)
    if (a.received > now) r.arriving.push_back(a);
}

void count(radio::Counters& counters, Outcome outcome) {
  if (outcome == Outcome::weak) ++counters.lost_signal;
  if (outcome == Outcome::wrong) ++counters.lost_error;
  if (outcome == Outcome::disturbed) ++counters.lost_collision;
}

}  // namespace

void forget_messages(const Radio& r, double now) {
  const std::span<radio::Header> headers = *r.received;
  const std::span<std::uint8_t> bytes = *r.received_bytes;
  const auto is_old = [&](const radio::Header& h) { return h.received <= now - r.parameters.keep; };
  std::size_t old = 0;
  while (old < headers.size() && is_old(headers[old])) ++old;
  if (old == 0) return;
  const std::size_t first = old < headers.size() ? std::size_t(headers[old].first) : bytes.size();
  r.received.clear();
  for (radio::Header h : headers.subspan(old)) {
    h.first -= double(first);
    r.received.push_back(h);
  }
  r.received_bytes.clear();
  for (const std::uint8_t byte : bytes.subspan(first)) r.received_bytes.push_back(byte);
}

void receive(const Surroundings& s, std::uint32_t number) {
  const Radio& r = s.radios[number];
  thread_local std::vector<double> powers;
  powers.assign(s.channel.is_shared ? s.medium.transmission_count() : 0, -1);
  const Reception reception{s, number, r, powers};
  s.hash.each_within(s.places[number], s.hearing, [&](std::uint32_t member, double) {
    const std::uint32_t sender = s.members[member];
    if (sender == number) return;
    for (const Frame& f : *s.radios[sender].frames) {
      if (f.stage != Stage::complete || (f.receiver != radio::broadcast && f.receiver != r.robot)) continue;
      double rssi = 0;
      const Outcome outcome = reception.outcome(sender, f, rssi);
      if (outcome == Outcome::received)
        r.arriving.push_back(arrival_of(s, sender, number, f, rssi));
      else
        count(*r.counters, outcome);
    }
  });
  deliver_what_has_come(r, s.now);
}

}  // namespace muro::log_distance
