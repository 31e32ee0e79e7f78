// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

#include "muro/connector.hpp"
#include "muro/description.hpp"
#include "muro/step.hpp"

namespace muro {

/// A user's mistake, or a failure of a device, found by an algorithm. The text says what is wrong, which value it is
/// and what to do; the host adds the names of algorithm and robot, the simulated time and the line of the scenario.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The base class of every algorithm: motion, sensor, controller, recorder.
///
/// An algorithm is created, connected once, started once and then stepped many times. All of its state lies in
/// properties; members are handles, parameters and caches that can be built again. Any of these functions may throw
/// muro::Error; at the plugin's boundary it becomes a message.
class Algorithm {
 public:
  Algorithm() = default;
  Algorithm(const Algorithm&) = delete;
  Algorithm& operator=(const Algorithm&) = delete;
  virtual ~Algorithm() = default;

  /// Binds every property that a step reads or writes, for every item. Creates no threads, opens no
  /// files. [setup]
  virtual void connect(Connector& connector) = 0;

  /// Binds properties that are found by their names or by how others use them. Called when all algorithms have
  /// connected, in the order of by_name_order: controllers, then motions and others that depend on what is written or
  /// read, then recorders and views. Creates no property that an earlier kind could look for. [setup]
  virtual void connect_by_name(Connector& connector) { static_cast<void>(connector); }

  /// Opens what the algorithm needs to run. Handles may be read. Called again at a reset. [setup]
  virtual void start() {}

  /// Returns the phases of a step. Called once, after connect. Without phases an algorithm that is `batched` has one
  /// phase over its items, which reads all; any other runs in one call. [setup]
  virtual std::span<const Phase> phases() const { return {}; }

  /// Serves the elements of `range` at `step.time`: brings their outputs up to date, or, in a motion, carries their
  /// state from `step.time` to `step.time + step.dt`. Does not allocate after warm-up. [step, any thread]
  virtual void step(const Step& step, Range range) = 0;

  /// Takes robot `item` over from another motion: from the next step on this one moves it. The state lies in the
  /// properties; here a motion sets up what it keeps beside them. [between steps]
  virtual void on_handover(std::uint32_t item) { static_cast<void>(item); }

  /// Builds again what is kept beside the properties, after a snapshot has replaced them. [between steps]
  virtual void restored() {}

  /// Flushes files: the run is over, or its user is about to read them. [between steps]
  virtual void finish() {}

  /// Returns the algorithm's own interface of this name, version and layout (`id == Interface::id()`), or null. The
  /// host asks once, after start; the interface is valid as long as the algorithm. [setup]
  virtual void* find_extension(const ExtensionId&) { return nullptr; }
};

}  // namespace muro
