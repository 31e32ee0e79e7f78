// SPDX-License-Identifier: MIT
// Time: turns of the mirror, scans, and lines that wait for their answers.
#include "device.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "fault.hpp"

namespace muro::scip2 {

namespace {

std::span<std::uint32_t> memory_behind(State& s, std::size_t count) {
  return {reinterpret_cast<std::uint32_t*>(&s + 1), count};
}

bool begins_alike(std::string_view a, std::string_view b) { return a.substr(0, 2) == b.substr(0, 2); }

void remove_pending(State& s, std::uint32_t from, std::uint32_t count) {
  std::copy(s.pending + from + count, s.pending + s.pending_count, s.pending + from);
  std::fill(s.pending + s.pending_count - count, s.pending + s.pending_count, Pending{});
  s.pending_count -= count;
}

}  // namespace

Device::Device(Model model, bool is_swept, std::uint32_t line_rate)
    : model_(std::move(model)), is_swept_(is_swept), line_rate_(line_rate) {
  const std::size_t values = 6 * (std::size_t(model_.last_measurement_point()) + 1);
  text_.reserve(values + 2 * (values / block_line_length + 1) + 2 * longest_line + 1024);
}

std::uint32_t Device::state_size() const {
  return std::uint32_t(sizeof(State) + 2 * sizeof(std::uint32_t) * model_.step_count());
}

/// Resets the state, but keeps the waiting lines.
void Device::switch_on(State& s, std::int64_t now) const {
  State fresh{};
  std::copy(s.pending, s.pending + s.pending_count, fresh.pending);
  fresh.pending_count = s.pending_count;
  s = fresh;
  for (std::uint32_t& value : memory_behind(s, 2 * model_.step_count())) value = 0;
  s.is_on = 1;
  s.power_on = s.timer_zero = s.scan_begin = now;
  s.scan_period = model_.scan_period();
  s.speaks_scip2 = model_.start == Start::scip2;
}

void Device::receive(State& s, std::uint32_t client, std::string_view line, DeviceHost& host) {
  line = line.substr(0, longest_line);
  if (line.empty()) return host.answered();
  if (s.pending_count == State::queue_size) {
    reply({s, 0, client, line, host}, "0B");
    return host.answered();
  }
  Pending& p = s.pending[s.pending_count];
  const auto is_same = [&](const Pending& other) { return other.client == client && begins_alike(other.text(), line); };
  p.is_repeated = std::any_of(s.pending, s.pending + s.pending_count, is_same);
  p.client = client;
  p.length = std::uint8_t(line.size());
  std::copy(line.begin(), line.end(), p.line);
  ++s.pending_count;
}

void Device::advance(State& s, std::int64_t now, DeviceHost& host) {
  if (!s.is_on) switch_on(s, now);
  while (s.scan_begin + s.scan_period <= now) pass_step_zero(s, host);
  bool is_due = model_.reply_time == ReplyTime::at_once || s.is_adjusting;
  if (model_.reply_time == ReplyTime::at_interval) {
    const std::int64_t index = (now - s.power_on) / model_.reply_interval;
    is_due = is_due || index != s.reply_index;
    s.reply_index = index;
  }
  if (is_due) answer_pending(s, now, host);
}

/// Ends a turn and begins the next one. The scan is sent before requests are answered, so a client that stops the scans
/// gets only complete ones.
void Device::pass_step_zero(State& s, DeviceHost& host) {
  const std::int64_t now = s.scan_begin + s.scan_period;
  if (s.has_laser_on && s.fault != 0 && s.fault_scans < 1000) ++s.fault_scans;
  if (is_swept_ && s.has_laser_on && s.laser_since <= s.scan_begin) store_scan(s, s.scan_begin, host);
  send_scan(s, host);
  s.scan_begin = now;
  s.scan_period = model_.scan_period(s.percent_slower);
  if (model_.reply_time == ReplyTime::with_scans) answer_pending(s, now, host);
  if (!is_swept_ && s.has_laser_on) store_scan(s, now, host);
}

void Device::store_scan(State& s, std::int64_t time, DeviceHost& host) const {
  const std::size_t steps = model_.step_count();
  const std::span<std::uint32_t> memory = memory_behind(s, 2 * steps);
  host.read_scan(memory.first(steps), memory.last(steps));
  s.scan_time = time;
  s.has_scan = 1;
}

ScanView Device::scan_of(const State& s) const {
  const std::size_t steps = model_.step_count();
  const auto* memory = reinterpret_cast<const std::uint32_t*>(&s + 1);
  return {
      {memory, steps}, {memory + steps, steps}, std::uint32_t(model_.first_step), std::uint32_t(model_.min_distance)};
}

std::uint32_t Device::timestamp(const State& s, std::int64_t time) {
  return std::uint32_t((time - s.timer_zero) / 1'000'000) & 0xffffff;
}

void Device::write_timestamp(ReplyWriter& reply, const State& s, std::int64_t time) {
  reply.begin_block();
  reply.value(timestamp(s, time), 4);
  reply.end_block();
}

void Device::send_scan(State& s, DeviceHost& host) {
  Measurement& m = s.measurement;
  if (!sends_scans(s)) return;
  const Health health = health_of(s.fault, s.fault_scans);
  if (health == Health::normal && (!s.has_scan || s.scan_time < m.since)) return;
  if (m.left_out < m.interval && health == Health::normal) {
    ++m.left_out;
    return;
  }
  const std::int64_t now = s.scan_begin + s.scan_period;
  if (s.line_free > now) return;  // a device does not store scans for later
  m.left_out = 0;
  if (health == Health::normal && !m.is_endless) --m.remaining;
  text_.clear();
  ReplyWriter reply(text_);
  reply.plain({m.line, m.line_length});
  const std::size_t digits = 2 + 11;  // place of the number of scans, after symbol, steps, cluster and interval
  text_[digits] = char('0' + m.remaining / 10);
  text_[digits + 1] = char('0' + m.remaining % 10);
  if (health != Health::normal) {
    reply.summed(health == Health::checking ? "21" : health == Health::resuming ? "98" : "50");
  } else {
    reply.summed("99");
    write_timestamp(reply, s, s.scan_time);
    write_scan(reply, scan_of(s), {m.start, m.end, m.cluster}, form_of(Command(m.command)));
  }
  reply.end();
  const std::uint32_t client = m.client;
  const bool is_last = health == Health::failed || (health == Health::normal && !m.is_endless && m.remaining == 0);
  if (is_last) laser_off(s);
  send(s, now, client, host);
}

/// Sends `text_`.
void Device::send(State& s, std::int64_t now, std::uint32_t client, DeviceHost& host) const {
  host.send(client, text_);
  if (line_rate_ == 0) return;
  s.line_free = std::max(s.line_free, now) + std::int64_t(text_.size()) * 10'000'000'000 / bit_rate_of(s);
}

void Device::answer_pending(State& s, std::int64_t now, DeviceHost& host) {
  std::uint32_t done = 0;
  for (; done < s.pending_count; ++done) {
    const Pending p = s.pending[done];
    const Call call{s, now, p.client, p.text(), host};
    if (p.is_repeated)
      reply(call, "0B");
    else if (!answer(call))
      break;
    host.answered();
  }
  remove_pending(s, 0, done);
}

void Device::laser_on(State& s, std::int64_t now) const {
  if (s.has_laser_on) return;
  s.has_laser_on = 1;
  s.is_asleep = 0;
  s.laser_since = now;
}

void Device::laser_off(State& s) const {
  s.has_laser_on = s.has_scan = 0;
  s.answered_command = std::uint8_t(Command::none);
  s.measurement = {};
}

void Device::forget(State& s, std::uint32_t client, DeviceHost& host) const {
  for (std::uint32_t i = s.pending_count; i-- > 0;) {
    if (s.pending[i].client != client || !is_scanning(parse(s.pending[i].text(), model_).command)) continue;
    remove_pending(s, i, 1);
    host.answered();
  }
  if (s.measurement.client == client && sends_scans(s)) laser_off(s);
}

bool Device::owes(const State& s, std::uint32_t client) {
  const std::span<const Pending> pending(s.pending, s.pending_count);
  return std::any_of(pending.begin(), pending.end(), [&](const Pending& p) { return p.client == client; });
}

void Device::shift(State& s, std::int64_t offset) const {
  for (std::int64_t* time :
       {&s.power_on, &s.timer_zero, &s.scan_begin, &s.laser_since, &s.scan_time, &s.answered_scan_time, &s.line_free})
    *time += offset;
  s.measurement.since += offset;
}

}  // namespace muro::scip2
