// SPDX-License-Identifier: MIT
// Control of a run by remote controls, windows and referees: pause and speed, reset, snapshots, placing.
#pragma once

#include "muro/connector.hpp"
#include "muro/detail/layout.hpp"

namespace muro {

/// Receives the outcome of a request. [between steps]
class RequestDone {
 public:
  /// `problem`: why it was refused; empty: it is done.
  virtual void done(std::uint64_t ticket, std::string_view problem) noexcept = 0;

 protected:
  ~RequestDone() = default;
};

/// An extension of algorithms, version 1. The host calls it again and again while a run is paused, so that the
/// algorithm that paused the run can also let it go on.
class PauseAttendant {
 public:
  virtual void attend() noexcept = 0;  ///< [between steps]

  static ExtensionId id() noexcept {
    return {"muro.PauseAttendant", 1, abi::extension_layout<PauseAttendant>({}, &PauseAttendant::attend)};
  }

 protected:
  ~PauseAttendant() = default;
};

/// A new place of a robot, or of an object that moves.
struct Placement {
  ObjectId object = no_object;  ///< the base of a robot, or an object that moves alone
  Pose pose{};                  ///< in the world
  Twist twist{};                ///< of the base, in the world; 0 unless it is thrown
  bool is_forced = false;       ///< also where it overlaps something
};

/// An extension of hosts, version 2: for algorithms, in their steps, and for pause attendants.
///
/// The host carries requests out when the present instant is complete. Requests of pause attendants and of algorithms
/// that run alone come from outside: they keep their order, and are recorded and replayed as external inputs. Requests
/// of other algorithms follow, in an order of their own; equal requests of one instant are one. `done` may be null.
class RunControl {
 public:
  virtual bool is_paused() const noexcept = 0;
  /// Stops time after the present instant, or lets it go on.
  virtual void set_paused(bool paused) noexcept = 0;
  /// Lets time go on for `ns` of simulated time, then pauses.
  virtual void step_for(std::int64_t ns) noexcept = 0;
  /// Simulated seconds in a second; 0: as fast as possible.
  virtual double speed() const noexcept = 0;
  virtual void set_speed(double factor) noexcept = 0;

  virtual void place(const Placement& placement, std::uint64_t ticket, RequestDone* done) noexcept = 0;
  /// Replaces element `element` (of an array; else 0) of a property that is state by `bytes`.
  virtual void set(ObjectId object, std::string_view key, std::uint32_t element, std::string_view bytes,
                   std::uint64_t ticket, RequestDone* done) noexcept = 0;
  /// Brings back the state right after the set-up.
  virtual void reset(std::uint64_t ticket, RequestDone* done) noexcept = 0;
  /// Keeps the state under a name, in memory; replaces a snapshot of this name.
  virtual void snapshot(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept = 0;
  virtual void restore(std::string_view name, std::uint64_t ticket, RequestDone* done) noexcept = 0;
  virtual std::uint64_t state_hash() const noexcept = 0;  ///< [pause attendants, RequestDone]
  virtual std::int64_t time() const noexcept = 0;         ///< ns

  static ExtensionId id() noexcept;
  /// Returns the host's, or null. [setup]
  static RunControl* of(Host& host) { return static_cast<RunControl*>(host.find_extension(id())); }

 protected:
  ~RunControl() = default;
};

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Winvalid-offsetof"
inline ExtensionId RunControl::id() noexcept {
  static constexpr abi::Place structs[] = {MURO_SIZE(Placement), MURO_PLACE(Placement, object),
                                           MURO_PLACE(Placement, pose), MURO_PLACE(Placement, twist),
                                           MURO_PLACE(Placement, is_forced)};
  return {"muro.RunControl", 2,
          abi::extension_layout<RunControl>(
              structs, &RequestDone::done, &RunControl::is_paused, &RunControl::set_paused, &RunControl::step_for,
              &RunControl::speed, &RunControl::set_speed, &RunControl::place, &RunControl::set, &RunControl::reset,
              &RunControl::snapshot, &RunControl::restore, &RunControl::state_hash, &RunControl::time)};
}
#pragma GCC diagnostic pop

}  // namespace muro
