// SPDX-License-Identifier: MIT
#include "service.hpp"

#include <algorithm>
#include <exception>

#include "plugins/common/text/quote.hpp"

namespace muro::jsonrpc {

namespace {

/// Throws RpcError when there is no such method.
const Method& method_of(const std::string& name) {
  std::vector<std::string> known;
  for (const Method& m : methods()) {
    if (m.name == name) return m;
    known.emplace_back(m.name);
  }
  throw RpcError{Code::method_not_found, "Method not found", nearest_as_data(name, known)};
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r\n") == std::string_view::npos; }

}  // namespace

void Service::begin_step(std::int64_t time, std::int64_t period) {
  served_.time = time;
  served_.period = period;
  served_.is_complete = false;
  in_step_ = true;
  last_news_ = std::chrono::steady_clock::now();
  if (!served_.run.is_paused()) served_.pauser.reset();
  spent_ = {};
}

void Service::begin_pause() {
  served_.time = served_.run.time();
  served_.is_complete = true;
  in_step_ = false;
  spent_ = {};
}

void Service::end(Conversation& c) {
  c.is_over = true;
  end_pause_of(c.client);
  outlet_.disconnect(c.client);
}

void Service::end_pause_of(std::uint32_t client) {
  if (!served_.pauser || served_.pauser->client != client) return;
  if (served_.pauser->stays) return;
  served_.run.set_paused(false);
  served_.pauser.reset();
}

std::optional<Pauser> Service::who_keeps_it_waiting() {
  const bool is_long = std::chrono::steady_clock::now() - last_news_ > long_pause;
  if (!served_.pauser || !is_long || std::exchange(told_news_, last_news_) == last_news_) return std::nullopt;
  return served_.pauser;
}

void Service::connected(std::uint32_t client) {
  Conversation& c = conversations_[client];
  c.client = client;
  c.is_trusted = served_.token.empty();
}

/// Disconnects clients that have not given the token in time.
void Service::hang_up_on_strangers() {
  const auto now = std::chrono::steady_clock::now();
  for (auto& [client, c] : conversations_) {
    if (!c.is_trusted && !c.is_over && now - c.since >= time_to_authenticate) end(c);
  }
}

void Service::disconnected(std::uint32_t client) {
  const auto found = conversations_.find(client);
  if (found == conversations_.end()) return;
  found->second.has_left = true;
  found->second.subscriptions.clear();
  forget_who_left();
}

/// Removes clients that have left: those with no open request, and the first ones when there are too many.
void Service::forget_who_left() {
  const auto left = [](const auto& entry) { return entry.second.has_left; };
  auto surplus = std::count_if(conversations_.begin(), conversations_.end(), left) - std::ptrdiff_t(most_left);
  std::erase_if(conversations_, [&](const auto& entry) {
    const bool is_forgotten = left(entry) && (entry.second.is_idle() || surplus-- > 0);
    if (is_forgotten) end_pause_of(entry.first), outlet_.disconnect(entry.first);
    return is_forgotten;
  });
}

void Service::received(std::uint32_t client, std::string_view line) {
  last_news_ = std::chrono::steady_clock::now();
  const auto found = conversations_.find(client);
  if (found == conversations_.end() || found->second.is_over || is_blank(line)) return outlet_.answered();
  Conversation& c = found->second;
  if (c.lines.size() >= Conversation::most_lines || c.bytes + line.size() > Conversation::most_bytes) {
    if (!outlet_.has_room(client)) {  // the client goes on sending and does not read
      end(c);
      return outlet_.answered();
    }
    Message refused(line);
    while (refused.present()) refused.fail({Code::too_many, "too many requests wait for others to be answered"});
    if (const std::string reply = refused.reply(); !reply.empty()) outlet_.send(client, reply);
    return outlet_.answered();
  }
  c.lines.emplace_back(line);
  c.bytes += line.size();
  carry_on(c, Lines::may_begin);
  hold_or_release(c);
}

/// Stops or resumes reading from a client, long before it has reached its limits.
void Service::hold_or_release(Conversation& c) {
  constexpr std::size_t many = Conversation::most_lines / 8, much = Conversation::most_bytes / 8;
  const bool is_full = c.lines.size() >= many || c.bytes >= much;
  const bool has_room = c.lines.size() < many / 2 && c.bytes < much / 2;
  if (c.is_held ? has_room : is_full) outlet_.hold(c.client, c.is_held = !c.is_held);
}

/// Carries out requests until one of them waits, all are answered, the client does not read, or no time remains.
void Service::carry_on(Conversation& c, Lines lines) {
  if (c.is_active) return;  // a caller on the stack goes on with it
  c.is_active = true;
  const bool had_time = has_time();
  while (!c.is_over && c.pending.until == Pending::Until::nothing && has_time()) {
    const auto begin = std::chrono::steady_clock::now();
    if (!c.message) {
      if (c.lines.empty() || lines == Lines::later || !outlet_.has_room(c.client)) break;
      c.message.emplace(c.lines.front());
      c.bytes -= c.lines.front().size();
      c.lines.pop_front();
    }
    if (c.message->present())
      begin_request(c);
    else
      finish_message(c);
    spent_ += std::chrono::steady_clock::now() - begin;
  }
  c.is_active = false;
  if (had_time && !has_time()) first_ = c.client + 1;
}

void Service::begin_request(Conversation& c) {
  const Request& request = *c.message->present();
  const std::size_t left = c.message->left();
  ++c.requests;
  try {
    if (!c.is_trusted && request.method != "authenticate")
      throw RpcError{Code::not_authenticated, "say `authenticate` with the token first"};
    const Method& method = method_of(request.method);
    const Params params(request.params, method.parameters);
    if (method.is_granted && !served_.grants.may_call(method.name))
      throw RpcError{Code::not_granted, quote(method.name) +
                                            " is not granted: the scenario's `write` would have \"call:" +
                                            std::string(method.name) + "\""};
    Call call(served_, c, params, *this);
    method.carry_out(call);
    if (c.pending.until != Pending::Until::nothing || c.message->left() != left) return;  // it waits, or has waited
    Reply result = call.take_result();
    c.message->answer(result.is_null() ? time_reply(served_.time) : std::move(result));
  } catch (const RpcError& error) {
    c.pending = {};
    c.message->fail(error);
  } catch (const std::exception& error) {
    c.pending = {};
    c.message->fail({Code::internal_error, "Internal error", std::string(error.what())});
  }
}

void Service::finish_message(Conversation& c) {
  const std::string reply = c.message->reply();
  c.message.reset();
  const bool is_lost = !reply.empty() && !outlet_.send(c.client, reply);  // else the client waits for ever
  if (is_lost || c.failures >= Conversation::most_failures) end(c);
  outlet_.answered();
}

void Service::end_wait(Conversation& c, Lines lines, const RpcError* error) {
  c.pending = {};
  if (error)
    c.message->fail(*error);
  else
    c.message->answer(time_reply(served_.time));
  carry_on(c, lines);
}

bool Service::is_waiting() const {
  return std::any_of(conversations_.begin(), conversations_.end(),
                     [](const auto& entry) { return entry.second.pending.until != Pending::Until::nothing; });
}

void Service::answer_due() {
  forget_who_left();
  if (!served_.token.empty()) hang_up_on_strangers();
  const std::uint32_t first = first_;
  for (auto i = conversations_.lower_bound(first); i != conversations_.end(); ++i) answer_due(i->second);
  for (auto i = conversations_.begin(); i != conversations_.end() && i->first < first; ++i) answer_due(i->second);
}

void Service::answer_due(Conversation& c) {
  const bool is_paused = !in_step_;
  const bool will_pause = served_.run.is_paused();
  hold_or_release(c);
  const Pending& p = c.pending;
  if (p.until == Pending::Until::nothing) {
    carry_on(c, Lines::may_begin);
  } else if (p.until == Pending::Until::instant) {
    if (in_step_ && served_.time >= p.time) end_wait(c, Lines::may_begin);
  } else if (p.until == Pending::Until::pause && (is_paused || !will_pause)) {
    const RpcError other{Code::refused,
                         is_paused ? "the run was paused before that, by another client or in a window"
                                   : "the run was resumed, by another client or in a window",
                         {{"time", served_.time}}};
    end_wait(c, Lines::may_begin, is_paused && served_.time >= p.time ? nullptr : &other);
  }
}

void Service::send_updates() {
  for (auto& [client, c] : conversations_) {
    if (c.is_over) continue;
    for (Subscription& s : c.subscriptions) {
      const Reply update = s.update(served_.scene, served_.time, in_step_, outlet_.has_room_for_updates(client));
      if (update.is_null()) continue;
      if (outlet_.send_update(client, line_of(update)))
        s.was_sent();
      else
        s.was_lost();
    }
  }
}

void Service::time_was_set(std::int64_t time) {
  served_.time = time;
  const RpcError gone{Code::refused, "the time was set anew by a reset or a restored snapshot", {{"time", time}}};
  for (auto& [client, c] : conversations_) {
    for (Subscription& s : c.subscriptions) s.begin_anew();
    if (c.pending.until == Pending::Until::instant || c.pending.until == Pending::Until::pause)
      end_wait(c, Lines::later, &gone);
  }
}

void Service::done(std::uint64_t ticket, std::string_view problem) noexcept {
  try {
    const auto found = conversations_.find(std::uint32_t(ticket));
    if (found == conversations_.end() || Call::ticket_of(found->second) != ticket) return;
    if (found->second.pending.until != Pending::Until::effects) return;
    begin_pause();
    Conversation& c = found->second;
    if (problem.empty()) outlet_.changed();
    if (c.pending.problem.empty()) c.pending.problem = problem;
    if (--c.pending.effects > 0) return;
    const std::string why = c.pending.problem;
    const RpcError refused{Code::refused, why};
    end_wait(c, Lines::later, why.empty() ? nullptr : &refused);
  } catch (...) {  // no memory for the reply: the client gets none
  }
}

}  // namespace muro::jsonrpc
