// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "muro/ext/lockstep.hpp"

namespace muro {

/// The external clients for which time waits, and whose turn it is.
class LockstepClients final : public Lockstep {
 public:
  LockstepStream& join(std::string_view client, std::string_view stream, double timeout) noexcept override;

  /// Whether the run is to end: a wait ends then.
  std::function<bool()> is_stopping;
  /// Whether a recording stands in for all clients: nobody is waited for.
  std::function<bool()> is_replayed;
  /// Tells the user for whom time waits, when it has done so for `patience`; twice as long before the next note.
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
    bool is_given_up = false;  ///< it did not answer in time; until it says something
    std::uint32_t notes = 0;   ///< how often a wait for it was told
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
    bool is_expected = true;         ///< nobody has connected yet
    std::uint64_t pending = 0;       ///< messages that arrived and are not answered
    std::uint64_t void_answers = 0;  ///< of messages of clients that have left: they are still to be given
    bool is_subscribed = false;
  };

  std::deque<Client> clients_;
};

}  // namespace muro
