// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "conversation.hpp"
#include "grants.hpp"
#include "muro/ext/run_control.hpp"
#include "params.hpp"
#include "scene_names.hpp"
#include "values.hpp"

namespace muro::jsonrpc {

/// The client that has the run stand, now or once it has gone on for a while.
struct Pauser {
  std::uint32_t client = 0;
  bool stays = false;  ///< the pause, when the client goes
};

/// What methods work on.
struct Served {
  SceneNames scene;
  RunControl& run;
  Grants grants;
  std::int64_t time = 0;                           ///< ns of simulated time
  std::int64_t period = 0;                         ///< ns, of the controller
  bool is_complete = false;                        ///< the instant: not within a step
  std::set<std::string, std::less<>> snapshots{};  ///< names of those that clients have made
  std::optional<Pauser> pauser{};                  ///< none: it goes on, or others have it stand
  std::string token{};                             ///< which clients have to say first; empty: they have not
};

/// A request that is being carried out. Either it is answered at once, or it waits for something.
class Call {
 public:
  Call(Served& all, Conversation& its_client, const Params& its_params, RequestDone& done)
      : served(all), client(its_client), params(its_params), done_(done) {}

  Served& served;
  Conversation& client;
  const Params& params;

  /// Answers now. What neither answers nor waits for something is answered with the time.
  void answer(Reply result) { result_ = std::move(result); }
  /// Of the message that the request is part of.
  Budget& budget() { return client.message->budget(); }
  /// Answers with the time when all effects are done. Hand ticket and `done` to each request to the simulation.
  std::uint64_t effect() {
    client.pending.until = Pending::Until::effects;
    ++client.pending.effects;
    return ticket_of(client);
  }
  static std::uint64_t ticket_of(const Conversation& c) { return std::uint64_t(c.requests) << 32 | c.client; }
  RequestDone* done() { return &done_; }
  /// Answers with the time then.
  void wait_for(Pending::Until until, std::int64_t time) { client.pending = {until, time, 0, ""}; }

  /// What it was answered with; null: nothing.
  Reply take_result() { return std::move(result_); }

 private:
  RequestDone& done_;
  Reply result_;
};

struct Method {
  std::string_view name;
  std::span<const std::string_view> parameters;  ///< in the order in which they may come without names
  bool is_granted = false;                       ///< only to scenarios that have "call:NAME"
  void (*carry_out)(Call&) = nullptr;            ///< throws RpcError
};

/// All that there are.
std::span<const Method> methods();

/// {"time": ns, "seconds": s}, which every result begins with that has nothing else to say.
Reply time_reply(std::int64_t time);

/// The parameter `encoding`.
Encoding encoding_of(const Params& params);

// In reading_methods.cpp, subscription_methods.cpp, changing_methods.cpp, run_methods.cpp.
void authenticate(Call&);
void info(Call&);
void list(Call&);
void describe(Call&);
void get(Call&);
void tell_time(Call&);
void hash(Call&);
void subscribe(Call&);
void unsubscribe(Call&);
void set(Call&);
void place(Call&);
void reset(Call&);
void snapshot(Call&);
void restore(Call&);
void pause(Call&);
void resume(Call&);
void speed(Call&);
void step(Call&);
void wait(Call&);
void stop(Call&);

}  // namespace muro::jsonrpc
