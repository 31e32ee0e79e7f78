// SPDX-License-Identifier: MIT
// Effects of the commands of SCIP 2.0.
#include <algorithm>

#include "device.hpp"
#include "fault.hpp"

namespace muro::scip2 {

ReplyWriter Device::begin_reply(const Call& call, std::string_view status) {
  text_.clear();
  ReplyWriter r(text_);
  r.plain(call.line);
  r.summed(status);
  return r;
}

void Device::reply(const Call& call, std::string_view status) {
  begin_reply(call, status).end();
  send(call);
}

void Device::reply_state(const Call& call) {
  const State& s = call.state;
  ReplyWriter r = begin_reply(call, "00");
  r.summed(health_of(s.fault, s.fault_scans) == Health::failed ? "900"
           : s.is_adjusting                                    ? "002"
           : sends_scans(s)                                    ? "004"
           : s.has_laser_on                                    ? "003"
           : s.is_asleep                                       ? "005"
                                                               : "000");
  r.end();
  send(call);
}

bool Device::answer(const Call& call) {
  if (is_scip1(call.state, call.line)) return answer_scip1(call);
  return answer_scip2(call, parse(call.line, model_));
}

bool Device::answer_scip2(const Call& call, const Request& request) {
  State& s = call.state;
  const Command command = request.command;
  if (s.is_adjusting && command != Command::TM && command != Command::ST) return reply(call, "0E"), true;
  if (request.status != "00") return reply(call, request.status), true;
  if (is_single_scan(command)) return answer_scan(call, request);
  switch (command) {
    case Command::VV:
    case Command::PP:
    case Command::II: {
      ReplyWriter r = begin_reply(call, "00");
      if (command == Command::VV) write_version(r);
      if (command == Command::PP) write_parameters(r);
      if (command == Command::II) write_status(r, s, call.now);
      r.end();
      send(call);
      break;
    }
    case Command::BM:
      if (health_of(s.fault, s.fault_scans) == Health::failed) return reply(call, "01"), true;
      reply(call, s.has_laser_on ? "02" : "00");
      laser_on(s, call.now);
      break;
    case Command::QT:
    case Command::SL:
      laser_off(s);
      s.is_asleep = command == Command::SL;
      reply(call, "00");
      break;
    case Command::ST:
      reply_state(call);
      break;
    case Command::RS:
    case Command::RT:
    case Command::RB:
      reset(call, command);
      break;
    case Command::scip2:
      reply(call, "0E");
      break;
    case Command::TM:
      if (const std::string_view status = adjust(call, request.value); !status.empty()) reply(call, status);
      break;
    case Command::MD:
    case Command::MS:
    case Command::ME:
    case Command::ND:
    case Command::NE:
      start_scans(call, request);
      break;
    default: {
      const std::uint32_t bit_rate = s.bit_rate;
      reply(call, change_setting(call, request));
      if (s.bit_rate != bit_rate) call.host.set_bit_rate(s.bit_rate);
      break;
    }
  }
  return true;
}

/// Answers GD and similar commands. With the laser on, it waits for a scan. A repeated request of a client gets a new
/// scan: drivers report an error when the time stamp does not change.
bool Device::answer_scan(const Call& call, const Request& request) {
  State& s = call.state;
  if (health_of(s.fault, s.fault_scans) == Health::failed) return reply(call, "50"), true;
  if (!s.has_laser_on) return reply(call, "10"), true;
  const bool is_known = Command(s.answered_command) == request.command && s.answered_client == call.client &&
                        s.answered_scan_time == s.scan_time;
  if (!s.has_scan || is_known) return false;
  s.answered_command = std::uint8_t(request.command);
  s.answered_client = call.client;
  s.answered_scan_time = s.scan_time;
  ReplyWriter r = begin_reply(call, "00");
  write_timestamp(r, s, s.scan_time);
  write_scan(r, scan_of(s), request.window, form_of(request.command));
  r.end();
  send(call);
  return true;
}

void Device::start_scans(const Call& call, const Request& request) {
  State& s = call.state;
  if (health_of(s.fault, s.fault_scans) == Health::failed) return reply(call, "50");
  laser_on(s, call.now);
  Measurement& m = s.measurement;
  m = {};
  m.since = call.now;
  m.client = call.client;
  m.start = request.window.start;
  m.end = request.window.end;
  m.cluster = request.window.cluster;
  m.interval = m.left_out = request.interval;
  m.remaining = request.count;
  m.command = std::uint8_t(request.command);
  m.is_endless = request.count == 0;
  m.line_length = std::uint8_t(call.line.size());
  std::copy(call.line.begin(), call.line.end(), m.line);
  reply(call, "00");
}

/// Carries out RS, RT and RB. RS resets laser, motor speed, bit rate and timer. RT keeps motor speed and bit rate. RB,
/// when sent twice, switches the device off and on.
void Device::reset(const Call& call, Command command) {
  State& s = call.state;
  if (command == Command::RB && !s.is_restart_asked) {
    s.is_restart_asked = 1;
    return reply(call, "01");
  }
  reply(call, "00");
  if (command == Command::RB) return switch_on(s, call.now);
  laser_off(s);
  s.timer_zero = call.now;
  s.fault = s.is_restart_asked = 0;
  if (command == Command::RT) return;
  s.percent_slower = s.is_sensitive = 0;
  if (s.bit_rate != 0) call.host.set_bit_rate(0);
  s.bit_rate = 0;
}

/// Carries out SS, CR, HS or DB; returns the status.
std::string_view Device::change_setting(const Call& call, const Request& request) {
  State& s = call.state;
  switch (request.command) {
    case Command::SS:
      if (bit_rate_of(s) == request.value) return "03";
      s.bit_rate = request.value;
      return "00";
    case Command::CR: {
      const auto percent = std::uint8_t(request.value == 99 ? 0 : request.value);
      if (s.percent_slower == percent) return "03";
      s.percent_slower = percent;
      return "00";
    }
    case Command::HS:
      if (s.is_sensitive == request.value) return "02";
      s.is_sensitive = std::uint8_t(request.value);
      return "00";
    default: {  // DB
      const auto fault = std::uint8_t(request.value == 10 ? 0 : request.value);
      if (has_ended(s.fault, s.fault_scans)) s.fault = 0;
      if (s.fault == fault) return fault == 0 ? "03" : "02";
      s.fault = fault;
      s.fault_scans = 0;
      return "00";
    }
  }
}

/// Carries out TM; returns the status, or none when it has replied itself.
std::string_view Device::adjust(const Call& call, std::uint32_t code) {
  State& s = call.state;
  if (code == 0) {
    if (s.is_adjusting) return "02";
    laser_off(s);
    s.is_adjusting = 1;
    return "00";
  }
  if (!s.is_adjusting) return code == 1 ? "04" : "03";
  if (code == 2) {
    s.is_adjusting = 0;
    return "00";
  }
  ReplyWriter r = begin_reply(call, "00");
  write_timestamp(r, s, call.now);
  r.end();
  send(call);
  return {};
}

}  // namespace muro::scip2
