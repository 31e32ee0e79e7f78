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
    std::size_t begin, size;  ///< place in `bytes`
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
  /// Removes the first `count` entries.
  void forget(std::size_t count) {
    const std::size_t begin = count < entries.size() ? entries[count].begin : bytes.size();
    entries.erase(entries.begin(), entries.begin() + std::ptrdiff_t(count));
    bytes.erase(0, begin);
    for (Entry& entry : entries) entry.begin -= begin;
  }
};

/// The exchange's record of a client. Guarded by the mutex of the exchange.
struct Client {
  explicit Client(std::uint32_t its_number) : number(its_number) {}
  const std::uint32_t number;
  std::string outgoing;              ///< bytes that wait for the I/O thread
  std::size_t sending = 0;           ///< bytes that the I/O thread has taken and not sent yet
  bool is_ending = false;            ///< it is to be disconnected when all is sent
  bool is_held = false;              ///< the steps want no more messages of it for now
  std::uint64_t generation = 0;      ///< collect count to which the waiting counts below belong
  std::size_t messages_waiting = 0;  ///< messages that wait for a step
  std::size_t bytes_waiting = 0;
};

/// Data that the steps and the I/O thread of one stream pass to each other.
class Exchange {
 public:
  Exchange(const Limits& limits, std::uint32_t clients, LockstepStream* lockstep);

  // --- I/O thread
  /// Adds a client with the next number. Returns null when too much already waits for the steps.
  std::shared_ptr<Client> connected();
  /// Whether a message of the client may be added. If not, the steps signal when there is room.
  bool has_room(Client& client);
  void message(Client& client, std::string_view bytes);
  void disconnected(const Client& client);
  /// Removes the client: nothing can be sent to it any more.
  void remove(const Client& client);
  /// Moves the bytes to send into `buffer`, which must be empty. Returns false when there are none.
  bool take_output(Client& client, std::string& buffer);
  void sent(Client& client, std::size_t bytes);
  bool is_ending(const Client& client);
  void received(std::size_t bytes);
  void count_refused();
  void count_ended();
  void count_lost();

  // --- steps
  /// Whether something has arrived since the last collect. Costs one atomic load.
  bool has_arrived() const { return has_arrived_.load(std::memory_order_acquire); }
  /// Appends the arrived events to `inbox`. Returns true when a client waits for room: there is room now.
  bool collect(Inbox& inbox);
  enum class Sent : std::uint8_t { nothing, dropped, queued };
  /// Queues all bytes, or none when more than `most` bytes would wait then.
  Sent send(std::uint32_t client, std::string_view bytes) { return send(client, bytes, limits_.output_bytes); }
  Sent send(std::uint32_t client, std::string_view bytes, std::size_t most);
  /// Number of bytes for the client that are not sent yet.
  std::size_t waiting(std::uint32_t client) const;
  Sent send_to_all(std::string_view bytes);
  /// Stops reading from the client while `held` is true. Returns true when this call ends a hold.
  bool hold(std::uint32_t client, bool held);
  /// Disconnects the client when all is sent. Returns false when there is no such client.
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
  std::uint64_t generation_ = 1;  ///< counts the collects of `arrived_`
  bool is_waited_for_ = false;    ///< whether a client waits for room
  std::vector<std::shared_ptr<Client>> clients_;
  std::uint32_t next_number_ = 0;
  Statistics statistics_;
  std::atomic<bool> has_arrived_{false};
};

}  // namespace muro::stream
