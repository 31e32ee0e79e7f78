// SPDX-License-Identifier: MIT
// Methods that let time pass or stop it.
#include <algorithm>
#include <cmath>

#include "method.hpp"

namespace muro::jsonrpc {

namespace {

constexpr double longest = 1e9;  ///< longest time that one request lets pass, s

std::int64_t nanoseconds(double seconds) { return std::int64_t(std::llround(1e9 * seconds)); }

/// Makes the client the owner of the pause, unless others have paused the run already.
void take_pause(Call& c) {
  if (c.served.run.is_paused() && !c.served.pauser) return;
  c.served.pauser = Pauser{c.client.client, c.params.flag("keep", false)};
}

}  // namespace

void pause(Call& c) {
  take_pause(c);
  c.served.run.set_paused(true);
  c.wait_for(Pending::Until::pause, c.served.time);
}

void resume(Call& c) {
  c.served.run.set_paused(false);
  c.served.pauser.reset();
  c.answer(time_reply(c.served.time));
}

void speed(Call& c) {
  const double factor = c.params.real("factor", 0, 1e6);
  if (factor != 0 && factor < 1e-6)
    throw RpcError{Code::invalid_params, "`factor` must be 0 (as fast as possible), or from 1e-6 to 1e6"};
  c.served.run.set_speed(factor);
  Reply result = time_reply(c.served.time);
  result["speed"] = factor;
  c.answer(std::move(result));
}

void step(Call& c) {
  if (c.params.has("seconds") == c.params.has("steps"))
    throw RpcError{Code::invalid_params, "give either `seconds` or `steps`, which are those of this controller"};
  const std::int64_t ns = c.params.has("seconds") ? nanoseconds(c.params.real("seconds", 1e-9, longest))
                                                  : c.params.integer("steps", 1, 1'000'000'000) * c.served.period;
  take_pause(c);
  c.served.run.step_for(ns);
  c.wait_for(Pending::Until::pause, c.served.time + ns);
}

/// Ends the run. The reply is sent before that.
void stop(Call& c) {
  c.served.scene.inspection().stop();
  c.answer(time_reply(c.served.time));
}

void wait(Call& c) {
  const double seconds = c.params.has("seconds") ? c.params.real("seconds", 0, longest) : 0;
  const std::int64_t ns = nanoseconds(seconds);
  // Between instants, the time may be 1 ns after the last instant. Within a step, that step does not count.
  const std::int64_t rest = c.served.is_complete ? std::max<std::int64_t>(ns - 1, 0) : std::max<std::int64_t>(ns, 1);
  c.wait_for(Pending::Until::instant, c.served.time + rest);
}

}  // namespace muro::jsonrpc
