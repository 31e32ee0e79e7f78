// SPDX-License-Identifier: MIT
#include "plugins/controller/common/wire_protocol/service.hpp"

#include <algorithm>
#include <cmath>

#include "muro/algorithm.hpp"
#include "plugins/common/text/quote.hpp"
#include "plugins/controller/common/wire_protocol/number_text.hpp"

namespace muro::wire {

namespace {

// Limits for messages after a `wait`; a client that sends more is disconnected.
constexpr std::size_t most_behind = 1024, most_bytes_behind = 1 << 18;
/// Tolerance for rounded periods, ns: a wait that ends at most this much after the time of a step is over in that step.
constexpr std::int64_t rounding = 1;

}  // namespace

Service::Service(const Protocol& protocol, std::string title, std::vector<std::unique_ptr<Group>> groups,
                 Outlet& outlet)
    : protocol_(protocol), title_(std::move(title)), groups_(std::move(groups)), outlet_(outlet) {
  for (const auto& g : groups_) names_.push_back(g->name());
}

void Service::check_sizes() const {
  for (const auto& g : groups_)
    if (g->size() > protocol_.most_values())
      throw Error("group " + quote(g->name()) + " has " + std::to_string(g->size()) +
                  " numbers, and a message of this protocol has room for " + std::to_string(protocol_.most_values()) +
                  "; divide it, or use `protocol: text`");
}

Service::Session* Service::find(std::uint32_t client) {
  const auto found =
      std::find_if(sessions_.begin(), sessions_.end(), [&](const Session& s) { return s.client == client; });
  return found == sessions_.end() ? nullptr : &*found;
}

bool Service::is_connected(std::uint32_t client) const {
  return std::any_of(sessions_.begin(), sessions_.end(), [&](const Session& s) { return s.client == client; });
}

bool Service::is_reporting() const {
  return std::any_of(sessions_.begin(), sessions_.end(), [](const Session& s) { return s.report.period > 0; });
}

void Service::connected(std::uint32_t client) {
  if (find(client)) return;
  Session& s = sessions_.emplace_back();
  s.client = client;
  if (first_report_ > 0) {
    s.report.period = 1e9 / first_report_;
    s.report.begin = now_;
  }
}

void Service::disconnected(std::uint32_t client) {
  Session* const s = find(client);
  if (!s) return;
  for (std::size_t owed = s->behind.size() + (s->waiting ? 1 : 0); owed > 0; --owed) outlet_.answered();
  sessions_.erase(sessions_.begin() + (s - sessions_.data()));
}

void Service::begin_step(std::int64_t time, double dt) {
  now_ = time;
  dt_ = dt;
  for (Session& s : sessions_) {
    if (is_time_set_) {
      s.due = time;
      s.report.begin = time;
      s.report.count = 0;
    }
    if (s.waiting && s.due <= time + rounding) {
      end_wait(s);
      carry_out_behind(s);
    }
    if (s.report.period > 0 && s.report.due() <= time) send_report(s);
  }
  is_time_set_ = false;
}

void Service::received(std::uint32_t client, std::string_view message) {
  Session* const s = find(client);
  if (!s || s->is_ended) return outlet_.answered();
  if (!s->waiting) return take(*s, message);
  s->behind.emplace_back(message);
  s->bytes_behind += message.size();
  if (s->behind.size() <= most_behind && s->bytes_behind <= most_bytes_behind) return;
  s->is_ended = true;
  outlet_.disconnect(client);
}

void Service::end_wait(Session& s) {
  const Request request = std::move(*s.waiting);
  s.waiting.reset();
  reply_.clear();
  try {
    protocol_.add_state(reply_, request.tag, state_of(request.group, request.quantity));
  } catch (const Fault& fault) {
    protocol_.add_fault(reply_, request.tag, now_, fault);
  }
  outlet_.send(s.client, reply_);
  outlet_.answered();
}

void Service::carry_out_behind(Session& s) {
  while (!s.waiting && !s.behind.empty()) {
    const std::string message = std::move(s.behind.front());
    s.behind.pop_front();
    s.bytes_behind -= message.size();
    take(s, message);
  }
}

void Service::take(Session& s, std::string_view message) {
  Request request;
  reply_.clear();
  try {
    if (!protocol_.read(message, names_, request)) return outlet_.answered();
    if (!carry_out(s, request)) return;
  } catch (const Fault& fault) {
    reply_.clear();
    protocol_.add_fault(reply_, request.tag, now_, fault);
  }
  outlet_.send(s.client, reply_);
  outlet_.answered();
}

/// Writes the reply. False: it is due later.
bool Service::carry_out(Session& s, Request& request) {
  switch (request.verb) {
    case Verb::info:
      protocol_.add_info(reply_, request.tag, info(request));
      return true;
    case Verb::get:
      protocol_.add_state(reply_, request.tag, state_of(request.group, request.quantity));
      return true;
    case Verb::set:
      groups_[request.group]->set(request.quantity, request.values, {s.client, now_});
      break;
    case Verb::stop:
      for (std::uint32_t i = 0; i < groups_.size(); ++i)
        if (!request.names_group || request.group == i) groups_[i]->stop();
      break;
    case Verb::wait:
      state_of(request.group, request.quantity);  // throws when it cannot be read
      s.due = now_ + request.duration;
      s.waiting = std::move(request);
      return false;
    case Verb::report:
      start_report(s, request);
      break;
    case Verb::time:
      protocol_.add_time(reply_, request.tag, now_);
      return true;
  }
  protocol_.add_ok(reply_, request.tag, now_);
  return true;
}

void Service::start_report(Session& s, const Request& request) {
  if (request.period > 0 && request.period < 1e9 * dt_ * (1 - 1e-9)) {
    std::string text = "reports come at most at ";
    add_number(text, std::round(1e6 / dt_) / 1e6);
    throw Fault{FaultCode::out_of_range, text.append(" Hz, the rate of the controller")};
  }
  state_of(request.group, request.quantity);  // throws when it cannot be read
  s.report = {.tag = {0, request.tag.is_wide},
              .group = request.group,
              .quantity = request.quantity,
              .period = request.period,
              .begin = now_};
}

void Service::send_report(Session& s) {
  Report& r = s.report;
  while (r.due() <= now_) ++r.count;
  reply_.clear();
  try {
    protocol_.add_report(reply_, r.tag, state_of(r.group, r.quantity), names_[r.group]);
  } catch (const Fault& fault) {
    protocol_.add_fault(reply_, r.tag, now_, fault);
  }
  ++r.tag.sequence;
  outlet_.send_report(s.client, reply_);
}

std::string Service::info(const Request& request) const {
  std::string text;
  if (request.names_group) {
    text = names_[request.group];
    groups_[request.group]->describe(request.quantity, text);
    return text;
  }
  text = title_;
  text += ' ';
  add_number(text, std::round(1e6 / dt_) / 1e6);
  for (const std::string& name : names_) text.append(1, ' ').append(name);
  return text;
}

State Service::state_of(std::uint32_t group, Quantity quantity) {
  groups_[group]->read(quantity, values_);
  return {now_, group, quantity, values_};
}

}  // namespace muro::wire
