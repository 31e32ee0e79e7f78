// SPDX-License-Identifier: MIT
#include "plugins/controller/common/stream/exchange.hpp"

#include <algorithm>
#include <utility>

namespace muro::stream {

namespace {

constexpr std::size_t first_buffer = 4096;  // bytes

}  // namespace

Exchange::Exchange(const Limits& limits, std::uint32_t clients, LockstepStream* lockstep)
    : limits_(limits),
      most_entries_((limits.input_messages + 2) * clients * 2),
      most_bytes_(limits.input_bytes * clients * 2),
      lockstep_(lockstep) {
  arrived_.entries.reserve(64);
  arrived_.bytes.reserve(first_buffer);
  clients_.reserve(clients);
}

std::shared_ptr<Client> Exchange::connected() {
  const std::lock_guard lock(mutex_);
  if (arrived_.entries.size() >= most_entries_ || arrived_.bytes.size() >= most_bytes_) return nullptr;
  auto client = std::make_shared<Client>(next_number_);
  client->outgoing.reserve(first_buffer);
  clients_.push_back(client);
  arrived_.add(Event::Kind::connected, next_number_++);
  ++statistics_.clients;
  has_arrived_.store(true, std::memory_order_release);
  if (lockstep_) lockstep_->set_connected(true);
  return client;
}

bool Exchange::has_room(Client& client) {
  const std::lock_guard lock(mutex_);
  if (client.generation != generation_ && !client.is_held) return true;
  const bool has =
      !client.is_held && client.messages_waiting < limits_.input_messages && client.bytes_waiting < limits_.input_bytes;
  is_waited_for_ |= !has;
  statistics_.held_back += has ? 0 : 1;
  return has;
}

void Exchange::message(Client& client, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  arrived_.add(Event::Kind::message, client.number, bytes);
  if (client.generation != generation_) {
    client.generation = generation_;
    client.messages_waiting = client.bytes_waiting = 0;
  }
  ++client.messages_waiting;
  client.bytes_waiting += bytes.size();
  ++statistics_.messages;
  has_arrived_.store(true, std::memory_order_release);
  // Called under the mutex: a step cannot answer the message before it counts as arrived.
  if (lockstep_) lockstep_->message_arrived();
}

void Exchange::disconnected(const Client& client) {
  const std::lock_guard lock(mutex_);
  arrived_.add(Event::Kind::disconnected, client.number);
  has_arrived_.store(true, std::memory_order_release);
  if (lockstep_) lockstep_->set_connected(false);
}

void Exchange::remove(const Client& client) {
  const std::lock_guard lock(mutex_);
  std::erase_if(clients_, [&](const auto& c) { return c.get() == &client; });
}

bool Exchange::take_output(Client& client, std::string& buffer) {
  const std::lock_guard lock(mutex_);
  if (client.outgoing.empty()) return false;
  client.outgoing.swap(buffer);
  client.sending = buffer.size();
  return true;
}

void Exchange::sent(Client& client, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  client.sending -= bytes;
  statistics_.bytes_out += bytes;
}

bool Exchange::is_ending(const Client& client) {
  const std::lock_guard lock(mutex_);
  return client.is_ending;
}

void Exchange::received(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  statistics_.bytes_in += bytes;
}

void Exchange::count_refused() {
  const std::lock_guard lock(mutex_);
  ++statistics_.refused;
}

void Exchange::count_ended() {
  const std::lock_guard lock(mutex_);
  ++statistics_.disconnected;
}

void Exchange::count_lost() {
  const std::lock_guard lock(mutex_);
  ++statistics_.lost;
}

void Exchange::count_dropped() {
  const std::lock_guard lock(mutex_);
  ++statistics_.dropped;
}

bool Exchange::collect(Inbox& inbox) {
  const std::lock_guard lock(mutex_);
  if (inbox.entries.empty()) {
    std::swap(inbox, arrived_);
  } else {
    const std::size_t offset = inbox.bytes.size();
    inbox.bytes += arrived_.bytes;
    for (Inbox::Entry entry : arrived_.entries) {
      entry.begin += offset;
      inbox.entries.push_back(entry);
    }
  }
  arrived_.clear();
  ++generation_;
  has_arrived_.store(false, std::memory_order_relaxed);
  return std::exchange(is_waited_for_, false);
}

Client* Exchange::find(std::uint32_t number) const {
  for (const auto& client : clients_)
    if (client->number == number) return client.get();
  return nullptr;
}

Exchange::Sent Exchange::queue(Client& client, std::string_view bytes, std::size_t most) {
  if (client.is_ending) return Sent::nothing;
  const std::size_t waiting = client.outgoing.size() + client.sending;
  if (waiting > 0 && waiting + bytes.size() > most) {
    ++statistics_.dropped;
    return Sent::dropped;
  }
  client.outgoing += bytes;
  return Sent::queued;
}

Exchange::Sent Exchange::send(std::uint32_t number, std::string_view bytes, std::size_t most) {
  const std::lock_guard lock(mutex_);
  Client* const client = find(number);
  return client ? queue(*client, bytes, most) : Sent::nothing;
}

std::size_t Exchange::waiting(std::uint32_t number) const {
  const std::lock_guard lock(mutex_);
  const Client* const client = find(number);
  return client ? client->outgoing.size() + client->sending : 0;
}

Exchange::Sent Exchange::send_to_all(std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  Sent sent = Sent::nothing;
  for (const auto& client : clients_) sent = std::max(sent, queue(*client, bytes, limits_.output_bytes));
  return sent;
}

bool Exchange::hold(std::uint32_t number, bool held) {
  const std::lock_guard lock(mutex_);
  Client* const client = find(number);
  return client && std::exchange(client->is_held, held) && !held;
}

bool Exchange::end(std::uint32_t number) {
  const std::lock_guard lock(mutex_);
  Client* const client = find(number);
  if (!client || client->is_ending) return false;
  client->is_ending = true;
  return true;
}

Statistics Exchange::statistics() const {
  const std::lock_guard lock(mutex_);
  return statistics_;
}

}  // namespace muro::stream
