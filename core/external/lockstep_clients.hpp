// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "muro/ext/lockstep.hpp"

namespace muro {

/// The external clients for which simulated time waits; decides which client has its turn.
class LockstepClients final : public Lockstep {
 public:
  LockstepStream& join(std::string_view client, std::string_view stream, double timeout) noexcept override;

  /// Whether the run is to end; a wait then ends.
  std::function<bool()> is_stopping;
  /// Whether a recording replaces all clients; then no client is waited for.
  std::function<bool()> is_replayed;
  /// Reports the client for which time waits, after `patience`. Each further note comes after twice as long.
  std::function<void(const std::string& note)> say;
  double patience = 3;  ///< s

 private:
  struct Stream;
  struct Client {
    explicit Client(std::string_view its_name) : name(its_name) {}
    bool is_its_turn() const;

    std::string name;
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Stream> streams;
    bool is_given_up = false;  ///< it did not answer in time; lasts until it sends something
    std::uint32_t notes = 0;   ///< number of reported waits
  };
  struct Stream final : LockstepStream {
    Stream(LockstepClients& its_clients, Client& its_client, std::string_view its_name, double its_timeout)
        : clients(its_clients), client(its_client), name(its_name), timeout(its_timeout) {}
    void set_connected(bool connected) noexcept override;
    void message_arrived() noexcept override;
    void message_answered() noexcept override;
    void set_subscribed(bool subscribed) noexcept override;
    Outcome wait(std::int64_t time) noexcept override;
    std::string why_it_waits(std::int64_t time) const;

    LockstepClients& clients;
    Client& client;
    std::string name;
    double timeout;  ///< s
    std::uint32_t connections = 0;
    bool is_expected = true;         ///< no client has connected yet
    std::uint64_t pending = 0;       ///< messages that arrived and are not answered yet
    std::uint64_t void_answers = 0;  ///< answers that are still due to clients that have left
    bool is_subscribed = false;
  };

  std::deque<Client> clients_;
};

}  // namespace muro
