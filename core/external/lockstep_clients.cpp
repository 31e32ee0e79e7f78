// SPDX-License-Identifier: MIT
#include "core/external/lockstep_clients.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace muro {

LockstepStream& LockstepClients::join(std::string_view client, std::string_view stream, double timeout) noexcept {
  auto found = std::find_if(clients_.begin(), clients_.end(), [&](const Client& c) { return c.name == client; });
  if (found == clients_.end()) {
    clients_.emplace_back(client);
    found = std::prev(clients_.end());
  }
  return found->streams.emplace_back(*this, *found, stream, timeout);
}

/// Whether it has all its answers, and a client that could send something is connected or expected.
bool LockstepClients::Client::is_its_turn() const {
  const auto is_owed = [](const Stream& s) { return s.pending > 0; };
  const auto may_speak = [](const Stream& s) { return (s.connections > 0 || s.is_expected) && !s.is_subscribed; };
  return !is_given_up && std::none_of(streams.begin(), streams.end(), is_owed) &&
         std::any_of(streams.begin(), streams.end(), may_speak);
}

void LockstepClients::Stream::set_connected(bool connected) noexcept {
  const std::lock_guard lock(client.mutex);
  if (connected) {
    ++connections;
    is_expected = client.is_given_up = false;
  } else if (connections > 0 && --connections == 0) {  // no client is there that waits for an answer
    void_answers += std::exchange(pending, 0);
    is_subscribed = false;
  }
  client.changed.notify_all();
}

void LockstepClients::Stream::message_arrived() noexcept {
  const std::lock_guard lock(client.mutex);
  ++pending;
  client.is_given_up = false;
  client.changed.notify_all();
}

void LockstepClients::Stream::message_answered() noexcept {
  const std::lock_guard lock(client.mutex);
  if (void_answers > 0)
    --void_answers;
  else if (pending > 0)
    --pending;
}

void LockstepClients::Stream::set_subscribed(bool subscribed) noexcept {
  const std::lock_guard lock(client.mutex);
  is_subscribed = subscribed;
}

std::string LockstepClients::Stream::why_it_waits(std::int64_t time) const {
  return fmt::format(
      "the run stands at {:g} s and waits in lockstep for {} on {}, which {}; it goes on when that "
      "sends a message, or after {:g} s",
      1e-9 * double(time), in_backquotes(client.name), in_backquotes(name),
      is_expected ? "has not connected yet" : "has all its answers", timeout);
}

LockstepStream::Outcome LockstepClients::Stream::wait(std::int64_t time) noexcept {
  if (clients.is_replayed && clients.is_replayed()) return Outcome::go_on;
  using Clock = std::chrono::steady_clock;
  constexpr auto slice = std::chrono::milliseconds(20);  // between checks of `is_stopping`
  const auto begin = Clock::now(),
             end = begin + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout));
  std::unique_lock lock(client.mutex);
  while (client.is_its_turn()) {
    if (clients.is_stopping && clients.is_stopping()) return Outcome::stopping;
    if (Clock::now() >= end) {
      client.is_given_up = true;
      return Outcome::timed_out;
    }
    const std::chrono::duration<double> waited = Clock::now() - begin;
    if (clients.say && waited.count() >= std::ldexp(clients.patience, int(client.notes))) {
      ++client.notes;
      clients.say(why_it_waits(time));
    }
    client.changed.wait_for(lock, slice);
  }
  return Outcome::go_on;
}

}  // namespace muro
