// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "muro/connector.hpp"
#include "muro/description.hpp"
#include "muro/step.hpp"

namespace muro {

/// A user's mistake, or a failure of a device, found by an algorithm. Say what, which value and what to
/// do; the host adds the names of algorithm and robot, the simulated time and the line of the scenario.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The base of every algorithm: motion, sensor, controller, recorder.
///
/// An algorithm is created, connected once, started once and then stepped, many times. All of its
/// state lies in properties; members are handles, parameters and caches that can be built again.
/// Any of these functions may throw muro::Error; it ends at the plugin's boundary.
class Algorithm {
 public:
  Algorithm() = default;
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;
  virtual ~Algorithm() = default;

  /// Binds every property that a step reads or writes, for every item. Creates no threads, opens no
  /// files. [setup]
  virtual void connect(Connector& connector) = 0;

  /// Binds what is looked up by its name or by what others have made of it, when all algorithms have connected, in the
  /// order of by_name_order: for controllers, then for motions and others that depend on what is written or read, then
  /// for recorders and views. Creates no property that a kind before it could look for. [setup]
  virtual void connect_by_name(Connector& connector) { static_cast<void>(connector); }

  /// All handles may be read. Opens what the algorithm needs to run; also called again at a reset. [setup]
  virtual void start() {}

  /// How a step is divided. Asked once, after connect. None: an algorithm that is `batched` has one phase over its
  /// items, which reads all; anything else runs in one call. [setup]
  virtual std::span<const Phase> phases() const { return {}; }

  /// Serves the elements of `range` at `step.time`: brings their outputs up to date, or, for a motion
  /// model, carries their state from `step.time` to `step.time + step.dt`. Does not allocate once warm. [step, any
  /// thread]
  virtual void step(const Step& step, Range range) = 0;

  /// Another motion has moved robot `item` so far; from the next step on this one does. The state lies in the
  /// properties; here goes what only this motion keeps beside them. [between steps]
  virtual void on_handover(std::uint32_t item) { static_cast<void>(item); }

  /// A snapshot has replaced the properties: rebuild what was kept beside them. [between steps]
  virtual void restored() {}

  /// The run is over or is about to be read by the user: flush files. [between steps]
  virtual void finish() {}
};

}  // namespace muro
