// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <string_view>

#include "method.hpp"

namespace muro::jsonrpc {

/// Where lines to clients go. None of the functions waits for a client.
class Outlet {
 public:
  /// False: there is no room for it.
  virtual bool send(std::uint32_t client, std::string_view line) = 0;
  /// The same for updates, which leave room for replies.
  virtual bool send_update(std::uint32_t client, std::string_view line) = 0;
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
/// Requests of a batch follow each other at once.
class Service final : public RequestDone {
 public:
  Service(Served served, Outlet& outlet) : served_(std::move(served)), outlet_(outlet) {}

  SceneNames& scene() { return served_.scene; }
  /// Clients that connect from now on have to say it first.
  void set_token(std::string token) { served_.token = std::move(token); }

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

  /// Whether a request waits for something.
  bool is_waiting() const;
  /// Those that are there, and those that have left without having been answered.
  std::size_t clients() const { return conversations_.size(); }

 private:
  static constexpr std::size_t most_left = 16;                           ///< that have left
  static constexpr auto time_to_authenticate = std::chrono::seconds(5);  ///< of the wall clock
  enum class Lines : std::uint8_t { may_begin, later };
  void carry_on(Conversation& c, Lines lines);
  void begin_request(Conversation& c);
  void end_wait(Conversation& c, Lines lines, const RpcError* error = nullptr);
  void finish_message(Conversation& c);
  void forget_who_left();
  void hang_up_on_strangers();

  Served served_;
  Outlet& outlet_;
  std::map<std::uint32_t, Conversation> conversations_;
  bool in_step_ = false;
};

}  // namespace muro::jsonrpc
