// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "plugins/controller/common/stream/stream.hpp"

namespace muro::stream {

/// Events in their order, with their bytes.
struct Inbox {
  struct Entry {
    Event::Kind kind;
    std::uint32_t client;
    std::size_t begin, size;  ///< in `bytes`
  };
  std::vector<Entry> entries;
  std::string bytes;

  void add(Event::Kind kind, std::uint32_t client, std::string_view message = {}) {
    entries.push_back({kind, client, bytes.size(), message.size()});
    bytes += message;
  }
  void clear() {
    entries.clear();
    bytes.clear();
  }
  /// Forgets the first `count`.
  void forget(std::size_t count) {
    const std::size_t begin = count < entries.size() ? entries[count].begin : bytes.size();
    entries.erase(entries.begin(), entries.begin() + std::ptrdiff_t(count));
    bytes.erase(0, begin);
    for (Entry& entry : entries) entry.begin -= begin;
  }
};

/// A client, as the exchange knows it. Guarded by its mutex.
struct Client {
  explicit Client(std::uint32_t its_number) : number(its_number) {}
  const std::uint32_t number;
  std::string outgoing;              ///< waits for the I/O thread
  std::size_t sending = 0;           ///< bytes that it has taken and not sent yet
  bool is_ending = false;            ///< to be disconnected once all is sent
  bool is_held = false;              ///< the steps want to hear no more of it for now
  std::uint64_t generation = 0;      ///< of what waits
  std::size_t messages_waiting = 0;  ///< for a step
  std::size_t bytes_waiting = 0;
};

/// What the steps and the I/O thread of one stream hand to each other.
class Exchange {
 public:
  Exchange(const Limits& limits, std::uint32_t clients, LockstepStream* lockstep);

  // --- I/O thread
  /// A new client with the next number. Null: too much waits for the steps already.
  std::shared_ptr<Client> connected();
  /// Whether a message of the client may be added; otherwise the steps signal when it may.
  bool has_room(Client& client);
  void message(Client& client, std::string_view bytes);
  void disconnected(const Client& client);
  /// Nobody sends to it any more.
  void remove(const Client& client);
  /// What is to be sent, in exchange for an empty buffer. False: nothing.
  bool take_output(Client& client, std::string& buffer);
  void sent(Client& client, std::size_t bytes);
  bool is_ending(const Client& client);
  void received(std::size_t bytes);
  void count_refused();
  void count_ended();
  void count_lost();

  // --- steps
  /// Whether something has arrived since the last collect: one load.
  bool has_arrived() const { return has_arrived_.load(std::memory_order_acquire); }
  /// Moves it behind what is in `inbox`. True: a client waits for room that there is now.
  bool collect(Inbox& inbox);
  enum class Sent : std::uint8_t { nothing, dropped, queued };
  /// Queues all of it or nothing, where not more than `most` bytes wait then.
  Sent send(std::uint32_t client, std::string_view bytes) { return send(client, bytes, limits_.output_bytes); }
  Sent send(std::uint32_t client, std::string_view bytes, std::size_t most);
  /// Bytes for the client that have not been sent.
  std::size_t waiting(std::uint32_t client) const;
  Sent send_to_all(std::string_view bytes);
  /// No more is read from the client, until it is told otherwise. True: it waits to be read from.
  bool hold(std::uint32_t client, bool held);
  /// Disconnects the client once all is sent. False: there is none.
  bool end(std::uint32_t client);
  void count_dropped();
  Statistics statistics() const;

 private:
  Sent queue(Client& client, std::string_view bytes, std::size_t most);
  Client* find(std::uint32_t number) const;

  const Limits limits_;
  const std::size_t most_entries_, most_bytes_;
  LockstepStream* const lockstep_;
  mutable std::mutex mutex_;
  Inbox arrived_;
  std::uint64_t generation_ = 1;  ///< of `arrived_`: counts collects
  bool is_waited_for_ = false;    ///< a client waits for room
  std::vector<std::shared_ptr<Client>> clients_;
  std::uint32_t next_number_ = 0;
  Statistics statistics_;
  std::atomic<bool> has_arrived_{false};
};

}  // namespace muro::stream
