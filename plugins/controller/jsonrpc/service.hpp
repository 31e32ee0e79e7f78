// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

#include "method.hpp"

namespace muro::jsonrpc {

/// Where lines to clients go. None of the functions waits for a client.
class Outlet {
 public:
  /// Whether the client reads what it is sent. False: much waits for it, so nothing more is done for it.
  virtual bool has_room(std::uint32_t client) const = 0;
  /// The same for updates, which leave room for replies.
  virtual bool has_room_for_updates(std::uint32_t client) const = 0;
  /// False: there is no room for it.
  virtual bool send(std::uint32_t client, std::string_view line) = 0;
  virtual bool send_update(std::uint32_t client, std::string_view line) = 0;
  /// Whether what more a client says is to stay with it.
  virtual void hold(std::uint32_t client, bool held) = 0;
  /// What a client has asked for has changed the state.
  virtual void changed() = 0;
  /// A line that came in needs nothing more.
  virtual void answered() = 0;
  virtual void disconnect(std::uint32_t client) = 0;

 protected:
  ~Outlet() = default;
};

/// Serves clients: takes their lines, carries out the requests in them, and sends replies and updates. All on the
/// thread that runs the simulation, in steps, between steps and while the run is paused.
///
/// A line begins in a step, or in a pause, so that it makes no difference whether it came early or just in time.
/// Requests of a batch follow each other at once, unless the clients have had their time in this step: then what is
/// left is for the next one, in which others come first.
class Service final : public RequestDone {
 public:
  Service(Served served, Outlet& outlet) : served_(std::move(served)), outlet_(outlet) {}

  SceneNames& scene() { return served_.scene; }
  /// Clients that connect from now on have to say it first.
  void set_token(std::string token) { served_.token = std::move(token); }
  /// How long the requests of all clients may take in a step, by the wall clock; without it, as long as they take.
  void set_time_in_a_step(std::chrono::nanoseconds time) { time_in_a_step_ = time; }

  /// What follows happens at this time (ns), in a step of this period or when an instant is complete.
  void begin_step(std::int64_t time, std::int64_t period);
  void begin_pause();

  void connected(std::uint32_t client);
  /// It says nothing any more. What it has asked for is still answered.
  void disconnected(std::uint32_t client);
  /// A line that a client has sent, with its end.
  void received(std::uint32_t client, std::string_view line);

  /// Answers those whose time has come, in a step or while the run is paused. Before lines are received.
  void answer_due();
  /// Sends what clients have subscribed to. At the end of a step, and while the run is paused.
  void send_updates();
  /// The simulation was reset, or a snapshot restored: nobody waits for a time that will not come.
  void time_was_set(std::int64_t time);

  void done(std::uint64_t ticket, std::string_view problem) noexcept override;

  /// Who has had the run stand for a while, and has said nothing: once for each such pause.
  std::optional<Pauser> who_keeps_it_waiting();

  /// Whether a request waits for something.
  bool is_waiting() const;
  /// Those that are there, and those that have left without having been answered.
  std::size_t clients() const { return conversations_.size(); }

 private:
  static constexpr std::size_t most_left = 16;                           ///< that have left
  static constexpr auto time_to_authenticate = std::chrono::seconds(5);  ///< of the wall clock
  static constexpr auto long_pause = std::chrono::seconds(3);            ///< the same
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
  std::uint32_t first_ = 0;                          ///< of clients in the next step
  std::chrono::steady_clock::time_point last_news_;  ///< when the run went on, or a client said something
  std::chrono::steady_clock::time_point told_news_;  ///< those that were the last when who_keeps_it_waiting() told
};

}  // namespace muro::jsonrpc
