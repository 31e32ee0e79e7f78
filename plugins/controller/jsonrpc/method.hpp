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

/// The client that has paused the run, or will pause it after some time.
struct Pauser {
  std::uint32_t client = 0;
  bool stays = false;  ///< whether the pause stays when the client leaves
};

/// The data that methods use.
struct Served {
  SceneNames scene;
  RunControl& run;
  Grants grants;
  std::int64_t time = 0;                           ///< simulated time, ns
  std::int64_t period = 0;                         ///< period of the controller, ns
  bool is_complete = false;                        ///< whether the instant is complete: not within a step
  std::set<std::string, std::less<>> snapshots{};  ///< names of snapshots that clients have made
  std::optional<Pauser> pauser{};                  ///< none: the run goes on, or others have paused it
  std::string token{};                             ///< token that clients have to give first; empty: none
};

/// A request that is being carried out. It is answered at once, or it waits for a condition.
class Call {
 public:
  Call(Served& all, Conversation& its_client, const Params& its_params, RequestDone& done)
      : served(all), client(its_client), params(its_params), done_(done) {}

  Served& served;
  Conversation& client;
  const Params& params;

  /// Answers now. A request that neither answers nor waits is answered with the time.
  void answer(Reply result) { result_ = std::move(result); }
  /// Returns the budget of the message that contains the request.
  Budget& budget() { return client.message->budget(); }
  /// Makes the call answer with the time when all its changes are done. Give the ticket and `done` to the simulation.
  std::uint64_t effect() {
    client.pending.until = Pending::Until::effects;
    ++client.pending.effects;
    return ticket_of(client);
  }
  static std::uint64_t ticket_of(const Conversation& c) { return std::uint64_t(c.requests) << 32 | c.client; }
  RequestDone* done() { return &done_; }
  /// Makes the request wait until the condition is met at `time` or later; then it answers with the time.
  void wait_for(Pending::Until until, std::int64_t time) { client.pending = {until, time, 0, ""}; }

  /// Returns the answer; null when there is none.
  Reply take_result() { return std::move(result_); }

 private:
  RequestDone& done_;
  Reply result_;
};

struct Method {
  std::string_view name;
  std::span<const std::string_view> parameters;  ///< in the order for parameters without names
  bool is_granted = false;                       ///< allowed only when the scenario grants "call:NAME"
  void (*carry_out)(Call&) = nullptr;            ///< throws RpcError
};

/// Returns all methods.
std::span<const Method> methods();

/// Returns {"time": ns, "seconds": s}: the begin of every result, or the whole of it.
Reply time_reply(std::int64_t time);

/// Reads the parameter `encoding`.
Encoding encoding_of(const Params& params);

// Defined in reading_methods.cpp, subscription_methods.cpp, changing_methods.cpp, run_methods.cpp.
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
