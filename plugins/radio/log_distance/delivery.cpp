// SPDX-License-Identifier: MIT
#include "delivery.hpp"

#include <algorithm>

namespace muro::log_distance {

namespace {

bool comes_before(const Incoming& a, const Incoming& b) {
  return a.received != b.received ? a.received < b.received : a.from != b.from ? a.from < b.from : a.number < b.number;
}

Arrival on_its_way(const Incoming& m) { return {m.sent, m.received, m.rssi, m.number, m.from, m.size, *m.payload}; }

void list(const Radio& r, const Incoming& m) {
  const std::size_t first = (*r.received_bytes).size();
  r.received.push_back({double(m.from), double(m.number), m.sent, m.received, m.rssi, double(m.size), double(first)});
  for (const std::uint8_t byte : std::span(m.payload->bytes, std::min(m.size, radio::max_bytes)))
    r.received_bytes.push_back(byte);
}

void forget_arrived(const Radio& r, double now) {
  const std::span<Arrival> all = *r.arriving;
  r.arriving.clear();
  for (const Arrival& a : all)
    if (a.received > now) r.arriving.push_back(a);
}

}  // namespace

void deliver(const Radio& r, std::span<const Incoming> incoming, double now) {
  thread_local std::vector<Incoming> come;
  come.clear();
  come.reserve(std::max<std::size_t>(256, incoming.size()));
  for (const Arrival& a : *r.arriving)
    if (a.received <= now) come.push_back({a.received, a.sent, a.rssi, a.number, a.from, a.size, &a.payload});
  const bool were_on_way = !come.empty();
  for (const Incoming& m : incoming)
    if (m.received <= now) come.push_back(m);
  std::sort(come.begin(), come.end(), comes_before);
  for (const Incoming& m : come) list(r, m);
  if (!come.empty()) {
    *r.last = (*r.received).back();
    *r.last_bytes = *come.back().payload;
    r.counters->received += come.size();
  }
  if (were_on_way) forget_arrived(r, now);
  for (const Incoming& m : incoming)
    if (m.received > now) r.arriving.push_back(on_its_way(m));
}

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

}  // namespace muro::log_distance
