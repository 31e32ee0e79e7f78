// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "method.hpp"

namespace muro::jsonrpc {

/// Output to clients. No function waits for a client.
class Outlet {
 public:
  /// Whether the client reads its replies. False: too much output waits for it, so no request of it is begun.
  virtual bool has_room(std::uint32_t client) const = 0;
  /// Whether there is room for updates; they leave room for replies.
  virtual bool has_room_for_updates(std::uint32_t client) const = 0;
  /// Sends a line. Returns false when there is no room for it.
  virtual bool send(std::uint32_t client, std::string_view line) = 0;
  virtual bool send_update(std::uint32_t client, std::string_view line) = 0;
  /// Stops reading from a client while `held` is true.
  virtual void hold(std::uint32_t client, bool held) = 0;
  /// Reports that a request of a client has changed the state.
  virtual void changed() = 0;
  /// Reports that a received line needs nothing more.
  virtual void answered() = 0;
  virtual void disconnect(std::uint32_t client) = 0;

 protected:
  ~Outlet() = default;
};

/// Serves clients: takes their lines, carries out the requests in them, and sends replies and updates. Everything runs
/// on the thread of the simulation: in steps, between steps and while the run is paused.
///
/// A line begins in a step or in a pause. So an early line and a line that comes just in time have the same effect.
/// Requests of a batch follow each other at once, unless the time for clients in this step is used up. Then the rest is
/// done in the next step, in which other clients come first.
class Service final : public RequestDone {
 public:
  Service(Served served, Outlet& outlet) : served_(std::move(served)), outlet_(outlet) {}

  SceneNames& scene() { return served_.scene; }
  /// Sets the token that clients must give first, if they connect from now on.
  void set_token(std::string token) { served_.token = std::move(token); }
  /// Sets the time that the requests of all clients may take in a step, by the wall clock; the default is no limit.
  void set_time_in_a_step(std::chrono::nanoseconds time) { time_in_a_step_ = time; }

  /// Sets the time (ns) of the calls that follow: in a step of this period, or at a complete instant.
  void begin_step(std::int64_t time, std::int64_t period);
  void begin_pause();

  void connected(std::uint32_t client);
  /// Marks that the client sends nothing any more. Its earlier requests are still answered.
  void disconnected(std::uint32_t client);
  /// Takes a line of a client, with its end.
  void received(std::uint32_t client, std::string_view line);

  /// Answers the requests whose time has come, in a step or while the run is paused. Called before lines are received.
  void answer_due();
  /// Sends the updates of subscriptions. Called at the end of a step, and while the run is paused.
  void send_updates();
  /// Handles a reset or a restored snapshot: ends the waits for a time that will not come.
  void time_was_set(std::int64_t time);

  void done(std::uint64_t ticket, std::string_view problem) noexcept override;

  /// Returns the client that has paused the run for a while without further messages; once for each such pause.
  std::optional<Pauser> who_keeps_it_waiting();

  /// Whether a request waits for something.
  bool is_waiting() const;
  /// Returns the number of clients that are connected, or have left with unanswered requests.
  std::size_t clients() const { return conversations_.size(); }

 private:
  static constexpr std::size_t most_left = 16;                           ///< clients that have left
  static constexpr auto time_to_authenticate = std::chrono::seconds(5);  ///< wall-clock time
  static constexpr auto long_pause = std::chrono::seconds(3);            ///< wall-clock time
  enum class Lines : std::uint8_t { may_begin, later };
  void carry_on(Conversation& c, Lines lines);
  bool has_time() const { return spent_ < time_in_a_step_; }
  void answer_due(Conversation& c);
  void begin_request(Conversation& c);
  void end_wait(Conversation& c, Lines lines, const RpcError* error = nullptr);
  void finish_message(Conversation& c);
  void hold_or_release(Conversation& c);
  void end(Conversation& c);
  void end_pause_of(std::uint32_t client);
  void forget_who_left();
  void hang_up_on_strangers();

  Served served_;
  Outlet& outlet_;
  std::map<std::uint32_t, Conversation> conversations_;
  bool in_step_ = false;
  std::chrono::nanoseconds time_in_a_step_ = std::chrono::nanoseconds::max(), spent_{0};
  std::uint32_t first_ = 0;                          ///< first client in the next step
  std::chrono::steady_clock::time_point last_news_;  ///< when the run went on, or a client sent something
  std::chrono::steady_clock::time_point told_news_;  ///< `last_news_` of the last pause that was reported
};

}  // namespace muro::jsonrpc
